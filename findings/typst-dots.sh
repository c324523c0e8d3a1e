#!/usr/bin/env bash
# Typst draws an SVG's dots (lines of no length with round ends) in PNG, and leaves them out of the PDF of the same document:
# the page has no ink at all, and no warning.
# Seen with Typst 0.15.2 (typst from PyPI), its PDF looked at with PDFium (pypdfium2 5.1.0).
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv python
python/bin/pip install --quiet --disable-pip-version-check typst==0.15.2 pypdfium2==5.1.0 pillow==12.0.0 numpy==2.3.5

cat >dots.svg <<'END'
<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" viewBox="0 0 100 100"><path d="M30 50h0" stroke-width="20" stroke-linecap="round" fill="none" stroke="#000"/><path d="M70 50h0" stroke-width="20" stroke-linecap="square" fill="none" stroke="#000"/></svg>
END

cat >page.typ <<'END'
#set page(width: 100pt, height: 100pt, margin: 0pt)
#image("dots.svg", width: 100pt)
END

cat >draw.py <<'END'
import io
import numpy
from PIL import Image

SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" viewBox="0 0 100 100">{}</svg>'


def ink(png):
    """How many pixels of ink a picture has, to the nearest ten."""
    pixels = numpy.asarray(Image.open(io.BytesIO(png)).convert("RGBA")).astype(float) / 255
    return round(float((pixels[..., 3] * (1 - pixels[..., :3].mean(-1))).sum()), -1)


import pypdfium2, typst

png = typst.compile("page.typ", format="png", ppi=72)
print(f"PNG: {ink(png):.0f}")
typst.compile("page.typ", output="page.pdf", format="pdf")
page = io.BytesIO()
pypdfium2.PdfDocument("page.pdf")[0].render(scale=1).to_pil().save(page, "png")
print(f"PDF: {ink(page.getvalue()):.0f}")
END

{
    python/bin/python draw.py
} | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
PNG: 710
PDF: 0
END
