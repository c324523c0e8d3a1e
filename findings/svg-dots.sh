#!/usr/bin/env bash
# A line of no length with round or square ends is a dot in SVG: a disc of 314 pixels, a square of 400 here. It is
# what a turtle's step of length 0 leaves on paper.
# Seen with CairoSVG 2.9.1, resvg (resvg-py 0.5.0), Skia (skia-python 144.1) and librsvg (sharp 0.35.5): the two that draw
# with cairo leave out square dots; CairoSVG leaves out the dot of a closed path, too. None says so.
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv python
python/bin/pip install --quiet --disable-pip-version-check cairosvg==2.9.1 resvg-py==0.5.0 skia-python==144.1 pillow==12.0.0 numpy==2.3.5
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
    'round': '<path d="M50 50h0" stroke-width="20" stroke-linecap="round" fill="none" stroke="#000"/>',
    'square': '<path d="M50 50h0" stroke-width="20" stroke-linecap="square" fill="none" stroke="#000"/>',
    'closed': '<path d="M50 50z" stroke-width="20" stroke-linecap="round" fill="none" stroke="#000"/>',
}

import json

json.dump({name: SVG.format(shape) for name, shape in SHAPES.items()}, open("svgs.json", "w"))
for maker, make in MAKERS.items():
    for name, shape in SHAPES.items():
        print(f"{maker} {name}: {ink(make(SVG.format(shape))):.0f}")
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
    node draw.mjs
} | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
CairoSVG round: 310
CairoSVG square: 0
CairoSVG closed: 0
resvg round: 310
resvg square: 400
resvg closed: 310
Skia round: 300
Skia square: 400
Skia closed: 300
librsvg round: 310
librsvg square: 0
librsvg closed: 310
END
