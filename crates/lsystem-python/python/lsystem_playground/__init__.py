"""L-systems: strings, exact counts, drawings as NumPy arrays, pictures and files, and a live widget for notebooks.

    import lsystem_playground as ls

    weed = ls.System(axiom="F", rules="F -> F[+F]F[-F]F", angle=25.7, n=4)
    weed                        # the picture, in a notebook
    weed.draw().segments        # an array
    weed.widget()               # the live drawing

The functions take a system in any form: see `as_system`.
"""

from ._core import Problem
from ._drawing import Drawing
from ._error import LSystemError
from ._system import Counts, System, as_system

__all__ = ["Counts", "Drawing", "LSystemError", "Problem", "System", "as_system", "count", "draw", "expand", "svg"]


def expand(source, n=None):
    """The string of a system: see `System.expand`."""
    return as_system(source).expand(n)


def count(source, n=None):
    """The exact numbers of symbols and segments: see `System.count`."""
    return as_system(source).count(n)


def draw(source, n=None):
    """The drawing as arrays: see `System.draw`."""
    return as_system(source).draw(n)


def svg(source, n=None, **options):
    """The picture as an SVG text: see `System.file`."""
    return as_system(source).svg(n, **options)
