#!/usr/bin/env bash
# A path may leave out blanks between numbers where the next one begins with a point: `m1e1.5e2h80` moves to 10, 50. Programs that
# make small files write so.
# Seen with CairoSVG 2.9.1: the line is gone, without an error; with a blank between the numbers it is drawn. resvg (resvg-py 0.5.0) and Skia
# (skia-python 144.1) draw both.
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv python
python/bin/pip install --quiet --disable-pip-version-check cairosvg==2.9.1 resvg-py==0.5.0 skia-python==144.1 pillow==12.0.0 numpy==2.3.5

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
    'close': '<path d="m1e1.5e2h80" stroke-width="10" fill="none" stroke="#000"/>',
    'apart': '<path d="m1e1 .5e2h80" stroke-width="10" fill="none" stroke="#000"/>',
}

import json

json.dump({name: SVG.format(shape) for name, shape in SHAPES.items()}, open("svgs.json", "w"))
for maker, make in MAKERS.items():
    for name, shape in SHAPES.items():
        print(f"{maker} {name}: {ink(make(SVG.format(shape))):.0f}")
END

{
    python/bin/python draw.py
} | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
CairoSVG close: 0
CairoSVG apart: 800
resvg close: 800
resvg apart: 800
Skia close: 800
Skia apart: 800
END
