"""Runs what `lsys` exports in the programs that it is for, and compares the numbers. `cargo xtask test --thorough` runs it.

The arguments are lsys, the repository and a folder, which keeps the packages of PINS. Standard output gets a line for each
check: the output, the programs with their versions, and what was found, or `WRONG` and why, or `skipped` and what is missing;
tabs stand between them.
"""

import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

PINS = {
    "inkex": "inkex==1.4.1 lxml==6.1.3 cssselect==1.6.0 tinycss2==1.5.1 webencodings==0.6.1",
    "svg-turtle": "svg-turtle==1.2.0 svgwrite==1.4.3",
    "basthon-turtle": "basthon-turtle==0.4.1",
    "vpype-gcode": "vpype-gcode==0.13.0",
}
LINDENMAYER = "lindenmayer@1.5.4"
INKSCAPE = Path("/usr/share/inkscape/extensions/lindenmayer.py")
WEED, HILBERT, PENROSE = "abop/1.24f", "curves/hilbert", "curves/penrose"

lsys, root, folder = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise RuntimeError(f"{words[0]} failed: {(done.stdout + done.stderr).strip()[-600:]}")
    # Some programs tell their version on standard error.
    return done.stdout or done.stderr


class Missing(Exception):
    """A program that is not installed."""


def program(name):
    if shutil.which(name) is None:
        raise Missing(f"{name} is missing")
    return name


def package(name):
    """The folder with a package for Python, away from all others."""
    place = folder / name
    if not (place / PINS[name].replace(" ", "-")).exists():
        shutil.rmtree(place, ignore_errors=True)
        words = ["install", "--quiet", "--disable-pip-version-check", "--no-deps", "--target", place]
        run(sys.executable, "-m", "pip", *words, *PINS[name].split())
        (place / PINS[name].replace(" ", "-")).touch()
    return {**os.environ, "PYTHONPATH": str(place)}


def source(system):
    return root / "data_in" / f"{system}.json"


def draw(system, format, *words):
    """A file of a system, and what `lsys` tells."""
    name = folder / "-".join([system.replace("/", "-"), format, *words]).replace(" ", "")
    for old in folder.glob(f"{name.name}.*"):
        old.unlink()
    said = run(lsys, "draw", source(system), name, "--format", format, *words)
    return next(folder.glob(f"{name.name}.*")), said


def opened(file):
    """The axiom, the rules, the angle and the steps of the system in a file."""
    out = folder / "opened.json"
    out.unlink(missing_ok=True)
    run(lsys, "draw", file, out.with_suffix(""), "--format", "json")
    found = json.loads(out.read_text(encoding="utf-8"))
    return [found[key] for key in ("initial", "rules", "angle_deg", "num_iters")]


def segments(system):
    """The ends of all segments."""
    with open(draw(system, "csv")[0], newline="", encoding="utf-8") as rows:
        return [[float(row[key]) for key in ("x0", "y0", "x1", "y1")] for row in csv.DictReader(rows)]


def same(found, told, what):
    if found != told:
        raise ValueError(f"{what}: found {found}, told {told}")


def near(found, told, most, what):
    if not abs(found - told) <= most:
        raise ValueError(f"{what}: found {found}, told {told}")


def placed(lines):
    """Lines as parts of the size of all."""
    xs, ys = [x for line in lines for x in line[::2]], [y for line in lines for y in line[1::2]]
    size = max(max(xs) - min(xs), max(ys) - min(ys))
    return [((a - min(xs)) / size, (b - min(ys)) / size, (c - min(xs)) / size, (d - min(ys)) / size) for a, b, c, d in lines]


def same_lines(found, told):
    same(len(found), len(told), "lines")
    far = max(abs(a - b) for one, other in zip(placed(found), placed(told)) for a, b in zip(one, other))
    near(far, 0, 1e-4, "largest distance in parts of the drawing")
    return f"{len(found)} lines as in the drawing"


def again(name, version, *words):
    """A PDF that a program writes again still has its system."""

    def check():
        pdf, again = draw(WEED, "pdf")[0], folder / f"{name}.pdf"
        run(program(name), *[str(word).replace("IN", str(pdf)).replace("OUT", str(again)) for word in words])
        same(opened(again), opened(source(WEED)), "the system")
        return "the system of its source"

    return f"{WEED} as pdf, {' '.join(words)}", lambda: f"{name} {run(program(name), version).split(chr(10))[0]}", check


def drawing(kind):
    """An SVG that Inkscape saves still has its system."""

    def check():
        svg, again = draw(WEED, "svg")[0], folder / "inkscape.svg"
        run(program("inkscape"), svg, *kind.split(), f"--export-filename={again}")
        same(opened(again), opened(source(WEED)), "the system")
        return "the system of its source"

    return f"{WEED} as svg, {kind}", lambda: run(program("inkscape"), "--version").strip().split("\n")[-1], check


def inkscape(system, real):
    """The lines that Inkscape's extension draws by the exported text."""

    def check():
        text = run(lsys, "export", source(system), "--as", "inkscape")
        values = [re.search(f"^{label}: (.*)$", text, re.M)[1] for label in ("Axiom", "Rules", "Order", "Left angle", "Right angle")]
        if real:
            names = ["axiom", "rules", "order", "langle", "rangle"]
            page = folder / "page.svg"
            page.write_text('<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"/>')
            options = [f"--{name}={value}" for name, value in zip(names, values)]
            path = re.search(' d="([^"]*)"', run(sys.executable, INKSCAPE, *options, page, env=package("inkex")))[1]
        else:
            path = run(sys.executable, "-c", TURTLE, *values, env=package("inkex"))
        lines = []
        for part in path.strip().replace(",", " ").split("M")[1:]:
            points = [[float(number) for number in point.split()] for point in part.split("L")]
            lines += [[x, -y, u, -v] for (x, y), (u, v) in zip(points, points[1:])]
        return same_lines(lines, segments(system))

    def version():
        if real and not INKSCAPE.exists():
            raise Missing("Inkscape is missing")
        return run("inkscape", "--version").strip().split("\n")[-1] if real else PINS["inkex"].split()[0]

    return f"{system} as inkscape", version, check


# What Inkscape's extension does, by its library.
TURTLE = """
import sys
from inkex.turtle import PathTurtle
word, rules, order, left, right = sys.argv[1:]
rules = dict(rule.split("=") for rule in rules.split(";"))
for _ in range(int(order)):
    word = "".join(rules.get(symbol, symbol) for symbol in word)
turtle, saved = PathTurtle(), []
for symbol in word:
    if symbol in "ABCDEFGHIJKL":
        (turtle.pendown if symbol < "G" else turtle.penup)()
        turtle.forward(10)
    elif symbol in "+-|":
        turtle.right(float(right)) if symbol == "-" else turtle.left(180 if symbol == "|" else float(left))
    elif symbol == "[":
        saved.append((turtle.getpos(), turtle.getheading()))
    elif symbol == "]":
        turtle.penup()
        position, heading = saved.pop()
        turtle.setpos(position)
        turtle.setheading(heading)
print(turtle.getPath())
"""


def turtle(name, how):
    """The lines of the exported program in a turtle without a window."""

    def check():
        text, out = run(lsys, "export", source(HILBERT), "--as", "python"), folder / "turtle.svg"
        found = run(sys.executable, "-c", how, text, out, env=package(name))
        told = len(segments(HILBERT))
        same(found.split()[-1], f"{told}", "lines")
        return f"{told} lines"

    return f"{HILBERT} as python", lambda: PINS[name].split()[0], check


SVG_TURTLE = """
import re, sys, turtle
from svg_turtle import SvgTurtle
pen = SvgTurtle(800, 600)
turtle.Screen, turtle.Turtle, turtle.done = lambda: pen.screen, lambda visible: pen, lambda: None
exec(sys.argv[1], {"__name__": "__main__"})
print(sum(len(points.split()) - 1 for points in re.findall('<polyline[^>]* points="([^"]*)"', pen.to_svg())))
"""
BASTHON = """
import sys, warnings
warnings.simplefilter("ignore")
import basthon.turtle
sys.modules["turtle"] = basthon.turtle
exec(sys.argv[1], {"__name__": "__main__"})
basthon.turtle.Screen().save(sys.argv[2])
print(open(sys.argv[2]).read().count("<line"))
"""


def lindenmayer():
    """The symbols that draw, by the exported object."""
    place = folder / "lindenmayer"
    if not (place / LINDENMAYER).exists():
        words = ["install", "--silent", "--no-audit", "--no-fund", "--prefix", place, LINDENMAYER]
        run(program("npm"), *words)
        (place / LINDENMAYER).touch()
    script = place / "count.mjs"
    text = run(lsys, "export", source(PENROSE), "--as", "js")
    script.write_text(
        f"import LSystem from 'lindenmayer';\n{text}\nconst word = new LSystem(lsystem).iterate(lsystem.iterations);\n"
        "console.log([...word].filter((symbol) => 'FG'.includes(symbol)).length);\n"
    )
    found, told = int(run("node", script)), len(segments(PENROSE))
    same(found, told, "lines")
    return f"{told} lines"


def plots():
    """The commands of the document about plotters draw the whole plot: the lengths of an upright and of a lying one."""
    text = (root / "docs/plotting.md").read_text(encoding="utf-8")
    (folder / "pen.toml").write_text(re.search("```toml\n(.*?)```", text, re.S)[1])
    [hpgl, gcode] = re.findall("^vpype (.*)$", text, re.M)
    vpype, env, told = Path(sys.executable).with_name("vpype"), package("vpype-gcode"), []
    for words, more in (["--portrait"], ""), (["--landscape"], " --landscape"):
        plot, said = draw(WEED, "plotter", *words)
        shutil.copy(plot, folder / "weed.svg")
        length = 1000 * float(re.search("([0-9.]+) m drawn", said)[1])
        run(vpype, *hpgl.replace(" weed.hpgl", f"{more} weed.hpgl").split(), cwd=folder, env=env)
        near(down((folder / "weed.hpgl").read_text()), length, 0.01 * length, f"mm drawn by HPGL{more}")
        run(vpype, *gcode.split(), cwd=folder, env=env)
        near(lowered((folder / "weed.gcode").read_text()), length, 0.01 * length, f"mm drawn by G-code{more}")
        told.append(f"{length / 1000:.2f} m")
    return f"{' and '.join(told)} by HPGL and by G-code"


def down(hpgl):
    """The millimetres that a plotter draws with its pen down."""
    at, length, is_down, is_relative = [0, 0], 0, False, False
    for word, numbers in re.findall("(PU|PD|PA|PR)([-0-9.,]*)", hpgl):
        is_down = {"PU": False, "PD": True}.get(word, is_down)
        is_relative = {"PA": False, "PR": True}.get(word, is_relative)
        values = [float(number) for number in numbers.split(",") if number]
        for point in zip(values[::2], values[1::2]):
            to = [a + b for a, b in zip(at, point)] if is_relative else point
            length += math.dist(at, to) / 40 if is_down else 0
            at = to
    return length


def lowered(gcode):
    """The millimetres of a machine below its travelling height."""
    at, length, height = (0, 0), 0, 5
    for line in gcode.split("\n"):
        words = dict((word[0], float(word[1:])) for word in line.split() if word[0] in "XYZ")
        height = words.get("Z", height)
        if "X" in words:
            point = (words["X"], words["Y"])
            length += math.dist(at, point) if height <= 0 else 0
            at = point
    return length


CHECKS = [
    again("qpdf", "--version", "--linearize", "--object-streams=generate", "--recompress-flate", "IN", "OUT"),
    again("mutool", "-v", "clean", "-gggg", "-z", "IN", "OUT"),
    again("gs", "--version", "-q", "-sDEVICE=pdfwrite", "-o", "OUT", "IN"),
    again("pdfunite", "-v", "IN", "IN", "OUT"),
    drawing("--export-plain-svg"),
    drawing("--export-type=svg"),
    inkscape(WEED, False),
    inkscape(HILBERT, False),
    inkscape(WEED, True),
    turtle("svg-turtle", SVG_TURTLE),
    turtle("basthon-turtle", BASTHON),
    (f"{PENROSE} as js", lambda: LINDENMAYER, lindenmayer),
    (f"{WEED} as plotter, by docs/plotting.md", lambda: "vpype, " + PINS["vpype-gcode"], plots),
]

folder.mkdir(parents=True, exist_ok=True)
for what, version, check in CHECKS:
    by = "real programs"
    try:
        by = version()
        found = check()
    except Missing as missing:
        found = f"skipped: {missing}"
    # Whatever a program says is the answer.
    except Exception as error:
        found = f"WRONG: {error}"
    print(what, by, " ".join(found.split()), sep="\t", flush=True)
