"""Systems."""

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from . import _core
from ._drawing import Drawing
from ._error import LSystemError
from ._frame import Frame

#: The most segments of a picture that notebooks show as SVG. Larger pictures are PNG, whose size does not grow.
SVG_SEGMENTS = 20_000


class Counts(NamedTuple):
    """Exact numbers, however large."""

    symbols: int
    segments: int


class System:
    """An L-system with all that its drawing needs. A system never changes; `replace` makes another.

    The fields are those of docs/links.md, by their names in links (`n`, `angle`, `colour`), in files (`num_iters`) or on
    the page (`iterations`). Each is also an attribute: `system.angle`. A notebook shows a system as its picture.

    Raises `LSystemError` if there is no such field, if it does not take the value, or if the rules have errors.
    """

    __slots__ = ("_core",)

    def __init__(self, **fields):
        self._core = _core.System.of(_json(fields))

    @classmethod
    def _of(cls, core):
        self = super().__new__(cls)
        self._core = core
        return self

    @classmethod
    def read(cls, text, *, name="the text", entry=None):
        """The system in a text or in the bytes of a file: in our notation or that of another program, a link of the
        playground, JSON, or a picture that contains its system. `entry` names one of several systems."""
        data = text.encode() if isinstance(text, str) else bytes(text)
        return cls._of(_core.System.read(data, name, entry))

    @classmethod
    def open(cls, path, *, entry=None):
        """The system in a file: see `read`."""
        return cls.read(Path(path).read_bytes(), name=os.fspath(path), entry=entry)

    def replace(self, **fields):
        """The same system with other values of fields."""
        return self._of(self._core.replace(_json(fields)))

    @property
    def values(self):
        """All fields, by their names in links."""
        return json.loads(self._core.fields(), parse_float=_number)

    def __getattr__(self, name):
        link = None if name.startswith("_") else _core.System.field(name)
        if link is None:
            raise AttributeError(f"a system has no field {name!r}", name=name, obj=self)
        return self.values[link]

    def __dir__(self):
        return [*super().__dir__(), *self.values]

    @property
    def warnings(self):
        """The warnings of the text and the rules, each a `Problem`."""
        return list(self._core.warnings)

    @property
    def json(self):
        """The system as a file of the playground."""
        return self._core.json()

    @property
    def link(self):
        """The system as the part of a link from `#` on."""
        return self._core.link()

    def expand(self, n=None):
        """The string after `n` derivation steps; the system's own number of steps if `n` is missing."""
        return self._core.expand(self._steps(n))

    def count(self, n=None):
        """The exact numbers of symbols and segments after `n` derivation steps: `Counts`."""
        return Counts(*map(_whole, self._core.count(self._steps(n))))

    def draw(self, n=None):
        """The drawing after `n` derivation steps: `Drawing`."""
        n = self._steps(n)
        return Drawing(self._core.draw(n), self, n)

    def file(self, format, n=None, **options):
        """The bytes of a file: `format` is `svg`, `png`, `pdf`, `glb`, `csv` or another one that `lsys draw` knows, and
        the options are its flags: `size="1600x1200"` (or a pair), `transparent=True`, `min_length=0.5`."""
        options = {name.replace("_", "-"): value for name, value in options.items()}
        if isinstance(options.get("size"), (tuple, list)):
            options["size"] = "x".join(map(str, options["size"]))
        return _core.file(self._core, format, self._steps(n), _json(options))

    def svg(self, n=None, **options):
        """The picture as an SVG text: see `file`."""
        return self.file("svg", n, **options).decode()

    def png(self, n=None, **options):
        """The picture as the bytes of a PNG: see `file`."""
        return self.file("png", n, **options)

    def save(self, path, n=None, *, format=None, **options):
        """Writes a file, in the format of the path's ending unless `format` names another."""
        path = Path(path)
        path.write_bytes(self.file(format or path.suffix.removeprefix("."), n, **options))

    def widget(self, **traits):
        """The live drawing for notebooks, with the widget's traits, such as `controls=["angle", "n", "rules"]`."""
        from ._widget import Widget

        return Widget(self, **traits)

    def frame(self, **options):
        """The live drawing as HTML that carries its page, for exported notebooks and static books: `controls`, `theme` and
        `height` are as for the widget."""
        return Frame(self, **options)

    def _steps(self, n):
        return self.n if n is None else n

    def __eq__(self, other):
        return self.json == other.json if isinstance(other, System) else NotImplemented

    def __hash__(self):
        return hash(self.json)

    def __repr__(self):
        usual = System().values
        changed = {name: value for name, value in self.values.items() if value != usual[name]}
        return f"System({', '.join(f'{name}={value!r}' for name, value in changed.items())})"

    def __reduce__(self):
        return _unpickled, (self.json,)

    def _repr_mimebundle_(self, include=None, exclude=None):
        return self.draw()._repr_mimebundle_()


def as_system(source):
    """The system in any form: a `System`, a text (see `System.read`), a path, fields by their names, or the content of a
    file as a dictionary."""
    if isinstance(source, System):
        return source
    if isinstance(source, os.PathLike):
        return System.open(source)
    if isinstance(source, Mapping):
        return System.read(_json(source)) if "initial" in source else System(**source)
    return System.read(source)


def _unpickled(text):
    return System.read(text)


def _json(values):
    try:
        return json.dumps(values, default=_plain, allow_nan=False)
    except (TypeError, ValueError) as problem:
        raise LSystemError(str(problem)) from None


def _plain(value):
    """A number or an array of NumPy as one of Python."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a field does not take {value!r}")


def _number(text):
    """A number of a field, whole if it can be: the core knows only one kind."""
    value = float(text)
    return int(value) if value.is_integer() else value


def _whole(digits):
    """A number of any length: Python refuses to read more than some thousand digits at once."""
    whole = 0
    for at in range(0, len(digits), 4000):
        part = digits[at : at + 4000]
        whole = whole * 10 ** len(part) + int(part)
    return whole
