#!/usr/bin/env bash
# Drawings of repeated parts are small in SVG by `use` within `use`: four lines here, of one path. The attribute `href` without
# `xlink:` is SVG 2, and how editors write it today.
# Seen: svgpathtools 1.8.0 returns one line, the one in `defs`, and its Document none; Skia (skia-python 144.1) draws nothing; picosvg
# 0.23.0 refuses plain `href`. CairoSVG 2.9.1, resvg (resvg-py 0.5.0), librsvg (sharp 0.35.5), svgelements 1.9.6 and svglib 2.3.2 have all four.
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv python
python/bin/pip install --quiet --disable-pip-version-check cairosvg==2.9.1 resvg-py==0.5.0 skia-python==144.1 pillow==12.0.0 numpy==2.3.5 svgpathtools==1.8.0 svgelements==1.9.6 svglib==2.3.2 picosvg==0.23.0
npm install --silent --no-audit --no-fund --prefix . sharp@0.35.5

cat >draw.py <<'END'
import io
import numpy
from PIL import Image

SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" viewBox="0 0 100 100">{}</svg>'


def ink(png):
    """How many pixels of ink a picture has, to the nearest ten."""
    pixels = numpy.asarray(Image.open(io.BytesIO(png)).convert("RGBA")).astype(float) / 255
    return round(float((pixels[..., 3] * (1 - pixels[..., :3].mean(-1))).sum()), -1)


import cairosvg, resvg_py, skia


def by_cairosvg(svg):
    return cairosvg.svg2png(svg.encode())


def by_resvg(svg):
    return bytes(resvg_py.svg_to_bytes(svg_string=svg))


def by_skia(svg):
    surface = skia.Surface(100, 100)
    document = skia.SVGDOM.MakeFromStream(skia.MemoryStream(svg.encode()))
    document.setContainerSize(skia.Size(100, 100))
    document.render(surface.getCanvas())
    return bytes(surface.makeImageSnapshot().encodeToData())


MAKERS = {"CairoSVG": by_cairosvg, "resvg": by_resvg, "Skia": by_skia}

SHAPES = {
    'use': '<defs><path id="a" d="M0 0h10" stroke-width="4" fill="none" stroke="#000"/><g id="b"><use href="#a"/><use href="#a" x="10" y="10"/></g><g id="c"><use href="#b"/><use href="#b" transform="translate(30 30)"/></g></defs><use href="#c" x="5" y="5"/>',
}

import json

json.dump({name: SVG.format(shape) for name, shape in SHAPES.items()}, open("svgs.json", "w"))
for maker, make in MAKERS.items():
    for name, shape in SHAPES.items():
        print(f"{maker} {name}: {ink(make(SVG.format(shape))):.0f}")
END

cat >read.py <<'END'
import io, json
import svgelements, svgpathtools
from picosvg.svg import SVG
from svglib.svglib import svg2rlg

text = json.load(open("svgs.json"))["use"]
open("use.svg", "w").write(text)
print("svgpathtools svg2paths:", len(svgpathtools.svg2paths("use.svg")[0]))
print("svgpathtools Document:", len(svgpathtools.Document("use.svg").paths()))
print("svgelements:", sum(isinstance(part, svgelements.Path) for part in svgelements.SVG.parse("use.svg").elements()))


def paths(group):
    return sum(type(part).__name__ == "Path" or paths(part) for part in getattr(group, "contents", []))


print("svglib:", paths(svg2rlg(io.StringIO(text))))
try:
    SVG.fromstring(text).topicosvg()
    print("picosvg: read")
except ValueError as error:
    print("picosvg:", str(error).strip())
END

cat >draw.mjs <<'END'
import sharp from 'sharp';
import { readFileSync } from 'node:fs';

for (const [name, svg] of Object.entries(JSON.parse(readFileSync('svgs.json', 'utf8')))) {
    const pixels = await sharp(Buffer.from(svg)).ensureAlpha().raw().toBuffer();
    let ink = 0;
    for (let at = 0; at < pixels.length; at += 4)
        ink += (pixels[at + 3] / 255) * (1 - (pixels[at] + pixels[at + 1] + pixels[at + 2]) / 765);
    console.log(`librsvg ${name}: ${Math.round(ink / 10) * 10}`);
}
END

{
    python/bin/python draw.py
    python/bin/python read.py
    node draw.mjs
} | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
CairoSVG use: 160
resvg use: 160
Skia use: 0
svgpathtools svg2paths: 1
svgpathtools Document: 0
svgelements: 4
svglib: 4
picosvg: Only use #fragment supported, reject
librsvg use: 160
END
