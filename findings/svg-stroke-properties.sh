#!/usr/bin/env bash
# Three properties of strokes that writers of drawings use: vector-effect (a line keeps its width at any zoom), pathLength
# (dashes in parts of the whole, for lines that draw themselves) and paint-order (an outline behind its filling). Right: 160, 500 and
# 2000 pixels of ink.
# Seen with CairoSVG 2.9.1, resvg (resvg-py 0.5.0), Skia (skia-python 144.1) and librsvg (sharp 0.35.5): pathLength is passed over by all
# four, vector-effect by all but librsvg, paint-order by CairoSVG and Skia. The picture is another one, and nothing says so.
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
    'vector-effect': '<g transform="scale(10)"><path d="M1 5h8" stroke-width="2" vector-effect="non-scaling-stroke" fill="none" stroke="#000"/></g>',
    'pathLength': '<path d="M0 50h100" pathLength="1" stroke-width="10" stroke-dasharray="0.5 1" fill="none" stroke="#000"/>',
    'paint-order': '<rect x="30" y="30" width="40" height="40" fill="#fff" stroke="#000" stroke-width="20" paint-order="stroke"/>',
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
CairoSVG vector-effect: 1600
CairoSVG pathLength: 340
CairoSVG paint-order: 3200
resvg vector-effect: 1600
resvg pathLength: 340
resvg paint-order: 2000
Skia vector-effect: 1600
Skia pathLength: 330
Skia paint-order: 3200
librsvg vector-effect: 160
librsvg pathLength: 340
librsvg paint-order: 2000
END
