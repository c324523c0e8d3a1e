"""Reads files with programs of other people, and tells the figures that they find.

Standard input has a JSON array of questions such as {"look": "png", "file": "a.png"}; standard output gets an array of
answers in the same order. `cargo xtask outside` asks the questions and compares the figures.
"""

import csv
import json
import math
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pypdf
import svgelements
import trimesh
import vpype
from markdown_it import MarkdownIt
from PIL import Image, ImageDraw, ImageSequence
from scipy.ndimage import distance_transform_edt

Image.MAX_IMAGE_PIXELS = None

# vpype's pixels: 96 an inch of 25.4 mm.
MM = 25.4 / 96
MM_OF_POINT = 25.4 / 72

# Ink is what differs from white by more than this in a channel of 255 steps: more than rounding, less than a pale stroke.
INK = 16


def sizes(segments):
    """The number of segments, the length of all, and their box."""
    ends = np.array(segments, dtype=float).reshape(-1, 2, 2)
    sides = np.ptp(ends.reshape(-1, 2), axis=0)
    length = np.hypot(*(ends[:, 1] - ends[:, 0]).T).sum()
    return {"segments": len(ends), "length": length, "width": sides[0], "height": sides[1]}


def svg(file):
    """The strokes of a picture, by svgelements. The sizes are in pixels."""
    segments = []
    for path in svgelements.SVG.parse(file, reify=True).elements(lambda element: isinstance(element, svgelements.Path)):
        if path.stroke.value is None:
            continue
        for part in path:
            if isinstance(part, (svgelements.Line, svgelements.Close)) and part.start != part.end:
                segments.append([part.start.x, part.start.y, part.end.x, part.end.y])
    return sizes(segments)


def table(file):
    """The segments of a table in the plane, by Python's csv."""
    with open(file, newline="", encoding="utf-8") as rows:
        return sizes([[float(row[key]) for key in ("x0", "y0", "x1", "y1")] for row in csv.DictReader(rows)])


def plot(file, start):
    """The layers of a plot, by vpype. Lengths are in millimetres; every pen starts and ends at `start`."""
    document = vpype.read_multilayer_svg(file, quantization=0.01, crop=False)
    down = travel = points = polylines = 0
    corner = complex(*start)
    for lines in document.layers.values():
        down += lines.length() * MM
        ends = [corner] + [end * MM for line in lines for end in (line[0], line[-1])] + [corner]
        travel += sum(abs(b - a) for a, b in zip(ends[::2], ends[1::2]))
        points += sum(len(line) for line in lines)
        polylines += len(lines)
    names = [lines.metadata.get("vp_name", "") for lines in document.layers.values()]
    colours = [lines.metadata["vp_color"].as_hex()[:7] for lines in document.layers.values()]
    return {
        "layers": list(document.layers),
        "names": names,
        "colours": colours,
        "polylines": polylines,
        "points": points,
        "down": down,
        "travel": travel,
        "sheet": [side * MM for side in document.page_size],
        "box": [side * MM for side in document.bounds()],
    }


def png(file):
    """The size and the resolution of a picture, by Pillow, and the part of its pixels that has ink."""
    picture = Image.open(file)
    return {
        "size": picture.size,
        "dpi": picture.info.get("dpi"),
        "ink": float(mask(picture).mean()),
    }


def gif(file):
    """The size of a film's frames, their milliseconds and the number of different ones, by Pillow."""
    picture = Image.open(file)
    frames = [(frame.info["duration"], hash(frame.convert("RGB").tobytes())) for frame in ImageSequence.Iterator(picture)]
    return {
        "size": picture.size,
        "frames": len(frames),
        "milliseconds": sum(time for time, _ in frames),
        "different": len({pixels for _, pixels in frames}),
    }


def pdf(file):
    """The pages of a document and their sizes in millimetres, by pypdf."""
    pages = pypdf.PdfReader(file, strict=True).pages
    return {
        "sizes": [[float(side) * MM_OF_POINT for side in (page.mediabox.width, page.mediabox.height)] for page in pages],
        "text": "".join(page.extract_text() for page in pages),
    }


def mesh(file):
    """A mesh in one piece, by trimesh."""
    whole = trimesh.load(file, force="mesh")
    return {
        "faces": len(whole.faces),
        "box": np.ptp(whole.bounds, axis=0).tolist(),
        "is_watertight": bool(whole.is_watertight),
        "is_oriented": bool(whole.is_winding_consistent),
        "volume": float(whole.volume),
        "area": float(whole.area),
    }


def words(file):
    """The characters of a text's first line, by Python."""
    return {"characters": len(Path(file).read_text(encoding="utf-8").split("\n")[0])}


def system(file):
    """The axiom, the rules and the steps of a system, by Python's json."""
    found = json.loads(Path(file).read_text(encoding="utf-8"))
    return {"initial": found["initial"], "rules": found["rules"], "steps": found["num_iters"]}


def markdown(file):
    """The list items of a text, each as its pieces of code, by markdown-it."""
    items = []
    for token in MarkdownIt("commonmark").parse(Path(file).read_text(encoding="utf-8")):
        if token.type == "list_item_open":
            items.append([])
        elif token.type == "inline" and items:
            items[-1].extend(child.content for child in token.children if child.type == "code_inline")
    return {"items": items}


def pyramid(file):
    """The tiles of a Deep Zoom pyramid, by Pillow, and the ink of each level, in parts of the level's square."""
    space = "{http://schemas.microsoft.com/deepzoom/2008}"
    image = ElementTree.parse(file).getroot()
    size = image.find(f"{space}Size")
    side, width, height = int(image.get("TileSize")), int(size.get("Width")), int(size.get("Height"))
    levels = {}
    for tile in Path(file).parent.glob("*_files/*/*.png"):
        picture = Image.open(tile)
        if max(picture.size) > side:
            raise ValueError(f"{tile} is larger than {side} pixels")
        ink = float(mask(picture).sum())
        count, before = levels.get(int(tile.parent.name), (0, 0))
        levels[int(tile.parent.name)] = (count + 1, before + ink)
    return {
        "size": [width, height],
        "top": max(levels),
        "tiles": {level: count for level, (count, _) in levels.items()},
        "ink": levels[max(levels)][1] / (width * height),
    }


def mask(picture):
    """The pixels with ink of a picture on white or on nothing."""
    paper = Image.new("RGBA", picture.size, "white")
    paper.alpha_composite(picture.convert("RGBA"))
    return (255 - np.asarray(paper.convert("RGB")).min(axis=2)) > INK


def drawn(file):
    """The pixels with ink of a plot, drawn with its pen at 10 pixels a millimetre."""
    document = vpype.read_multilayer_svg(file, quantization=0.01, crop=False)
    scale = 10 * MM
    picture = Image.new("L", [math.ceil(side * scale) for side in document.page_size])
    pen = ImageDraw.Draw(picture)
    for lines in document.layers.values():
        width = round(lines.metadata["vp_pen_width"] * scale)
        for line in lines:
            pen.line([(point.real * scale, point.imag * scale) for point in line], fill=255, width=width)
    return np.asarray(picture) > INK


def shape(ink):
    """The ink within its box, where the box has this many pixels along its longer side."""
    side = 400
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    cut = ink[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    scale = side / max(cut.shape)
    small = np.zeros([max(1, math.ceil(length * scale)) for length in cut.shape], dtype=bool)
    y, x = np.nonzero(cut)
    small[((y + 0.5) * scale).astype(int), ((x + 0.5) * scale).astype(int)] = True
    return small


def same(file, other):
    """How far two pictures of a drawing differ: the longest way from ink of one to the ink of the other, in parts of the
    longer side of the drawing, and the height by the width of each."""
    a, b = (shape(drawn(name) if name.endswith(".svg") else mask(Image.open(name))) for name in (file, other))
    sides = [max(one) for one in zip(a.shape, b.shape)]
    a, b = (np.pad(one, [(0, side - own) for side, own in zip(sides, one.shape)]) for one in (a, b))
    far = [float(distance_transform_edt(~to)[ink].max()) for ink, to in ((a, b), (b, a))]
    return {"far": max(far) / max(sides), "ink": [float(a.mean()), float(b.mean())]}


def strip(file, page):
    """The part of a rendered page that has ink, from its left and top edges to the right and bottom ones."""
    ink = mask(Image.open(file))
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    scale = [page[0] / ink.shape[1], page[1] / ink.shape[0]]
    low, high = (columns[0], rows[0]), (columns[-1] + 1, rows[-1] + 1)
    return {"low": [a * s for a, s in zip(low, scale)], "high": [a * s for a, s in zip(high, scale)]}


LOOKS = [svg, table, plot, png, gif, pdf, mesh, words, system, markdown, pyramid, same, strip]


def answer(question):
    looks = {look.__name__: look for look in LOOKS}
    try:
        return looks[question.pop("look")](**question)
    # Whatever a library says about a file is the answer.
    except Exception as error:
        return {"error": f"{type(error).__name__}: {error}"}


def plain(value):
    return value.item() if isinstance(value, np.generic) else list(value)


json.dump([answer(question) for question in json.load(sys.stdin)], sys.stdout, default=plain)
