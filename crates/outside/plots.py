"""Measures plots beside those that vpype makes of the plain SVG, and prints a table.

The arguments are the programs lsys and vpype, a folder for files, and the systems. Both plots have the same size; lengths are
in metres. Of a pen's travel, the way from the corner of the sheet and back is left out, since vpype knows no corner.

A second table compares plots that hide what is behind with those of vpype's plug-in occult.
"""

import json
import re
import subprocess
import sys
import time
from pathlib import Path

import numpy
import vpype
from scipy.spatial import KDTree

MM = 25.4 / 96
PEN = "0.05"
# Ends nearer than this are one end, in millimetres: a tenth of a plotter's step.
TOLERANCE = "0.01mm"


def timed(*words):
    start = time.perf_counter()
    done = subprocess.run(words, check=True, capture_output=True, text=True)
    return time.perf_counter() - start, done.stdout + done.stderr


def read(file):
    return vpype.read_multilayer_svg(str(file), quantization=0.01, crop=False)


def measured(document):
    """The length drawn, the travel between lines, the number of lines, and the width of the drawing, in metres."""
    layers = document.layers.values()
    travel = sum(lines.pen_up_length()[0] for lines in layers)
    left, _, right, _ = document.bounds()
    return [length * MM / 1000 for length in (document.length(), travel, right - left)] + [sum(map(len, layers))]


def ink(document, scale):
    """The length of all lines where every stretch counts once, in metres at a scale: lines along the same axis are merged."""
    lines = {}
    for layer, collection in document.layers.items():
        for line in collection:
            for a, b in zip(line[:-1], line[1:]):
                length = abs(b - a)
                if length < 1e-6:
                    continue
                way = (b - a) / length
                if way.real < -1e-4 or (way.real <= 1e-4 and way.imag < 0):
                    way = -way
                aside = (way.conjugate() * a).imag
                ends = sorted((way.conjugate() * point).real for point in (a, b))
                lines.setdefault((layer, round(way.real, 3), round(way.imag, 3), round(aside, 1)), []).append(ends)
    whole = 0
    for stretches in lines.values():
        reached = float("-inf")
        for start, end in sorted(stretches):
            whole += max(0, end - max(start, reached))
            reached = max(reached, end)
    return whole * scale


lsys, tool, folder = sys.argv[1], sys.argv[2], Path(sys.argv[3])
version = min(timed(tool, "--version")[0] for _ in range(3))
print(f"vpype starts in {version:.2f} s (vpype --version), which is part of its times. Lengths in m, times in s.")
print("| system | ink | drawn | drawn, vpype | polylines | polylines, vpype | travel before | travel | travel, vpype | time | time, vpype |")
print("|---|---|---|---|---|---|---|---|---|---|---|")
for source in sys.argv[4:]:
    name = Path(source).stem
    plain, plot, sorted_plot = (folder / f"{name}-{kind}.svg" for kind in ("plain", "plot", "vpype"))
    timed(lsys, "draw", source, str(plain.with_suffix("")), "--format", "svg", "--transparent")
    own_time, said = timed(lsys, "draw", source, str(plot.with_suffix("")), "--format", "plotter", "--pen", PEN)
    before = re.search(r"\((.*?) m in drawing order", said).group(1)
    own = read(plot)
    # A layer for each colour, as in our plots.
    words = ["read", "--attr", "stroke", str(plain), "linemerge", "-t", TOLERANCE, "linesort", "write", str(sorted_plot)]
    other_time, _ = timed(tool, *words)
    other = read(sorted_plot)
    drawn, travel, width, polylines = measured(own)
    other_drawn, other_travel, other_width, other_polylines = measured(other)
    scale = width / other_width
    whole = ink(vpype.read_svg_by_attributes(str(plain), ["stroke"], quantization=0.01, crop=False), scale * MM / 1000)
    print(
        f"| {name} | {whole:.2f} | {drawn:.2f} | {other_drawn * scale:.2f} | {polylines} | {other_polylines} | {before} | "
        f"{travel:.2f} | {other_travel * scale:.2f} | {own_time:.2f} | {other_time:.2f} |",
        flush=True,
    )


def points(document):
    """Points on all lines, 0.05 mm apart, from the drawing's corner, with the length that each stands for, in millimetres."""
    left, top, _, _ = document.bounds()
    places, lengths = [], []
    for collection in document.layers.values():
        for line in collection:
            for a, b in zip(line[:-1], line[1:]):
                length = abs(b - a) * MM
                count = int(length / 0.05) + 1
                places.append((a + (b - a) * (numpy.arange(count) + 0.5) / count - complex(left, top)) * MM)
                lengths.append(numpy.full(count, length / count))
    all_places = numpy.concatenate(places)
    return numpy.column_stack((all_places.real, all_places.imag)), numpy.concatenate(lengths)


def missing(lines, others):
    """The part of lines' length that is more than 0.2 mm from all others, in percent."""
    far = KDTree(others[0]).query(lines[0])[0] > 0.2
    return 100 * lines[1][far].sum() / lines[1].sum()


# Overlapping leaves: each hides what was drawn before.
LEAVES = {
    "initial": "A",
    "angle_deg": 27,
    "rules": ["A -> [{.-(20)g(1).+(40)g(1).+(140)g(1).+(40)g(1).}][+f(2.1)A][f(2.6)A][-f(2.3)A]"],
    "turtle": {"dialect": "abop"},
}

print()
print("| polygons | drawn | drawn, occult | ours, not occult's | occult's, not ours | time | time, occult | ratio |")
print("|---|---|---|---|---|---|---|---|")
for n in (5, 6, 7, 8):
    source, plain, plot, hidden = (folder / f"leaves-{n}{end}" for end in (".json", "-plain.svg", "-plot.svg", "-occult.svg"))
    source.write_text(json.dumps({**LEAVES, "num_iters": n}))
    timed(lsys, "draw", source, str(plain.with_suffix("")), "--format", "svg", "--transparent")
    words = ["--format", "plotter", "--pen", PEN, "--hide"]
    own_time = min(timed(lsys, "draw", source, str(plot.with_suffix("")), *words)[0] for _ in range(3))
    other_time, _ = timed(tool, "read", str(plain), "occult", "write", str(hidden))
    own, other = read(plot), read(hidden)
    drawn, _, width, _ = measured(own)
    other_drawn, _, other_width, _ = measured(other)
    scale = width / other_width
    other.scale(scale)
    [ours, theirs] = [points(document) for document in (own, other)]
    print(
        f"| {(3**n - 1) // 2} | {drawn:.2f} | {other_drawn * scale:.2f} | {missing(ours, theirs):.2f} % | "
        f"{missing(theirs, ours):.2f} % | {own_time:.2f} | {other_time:.2f} | {other_time / own_time:.0f} |",
        flush=True,
    )
