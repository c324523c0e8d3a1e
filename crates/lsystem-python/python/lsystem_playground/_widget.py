"""The live drawing for notebooks: the playground's page for embedding, in a frame."""

import gzip
from contextlib import contextmanager
from functools import cache
from pathlib import Path

try:
    import anywidget
    import traitlets
except ImportError as missing:
    raise ImportError("the widget needs anywidget: pip install 'lsystem-playground[widget]'") from missing

from ._frame import page
from ._system import System


class Widget(anywidget.AnyWidget):
    """A live drawing. Its traits follow the reader's changes, and the drawing follows changes of its traits."""

    _esm = Path(__file__).parent / "widget.js"

    #: The number of derivation steps, the angle in degrees, and the seed.
    n = traitlets.Int(1, min=0, max=1000).tag(sync=True)
    angle = traitlets.Float(0.0).tag(sync=True)
    seed = traitlets.Int(0, min=0, max=2**32 - 1).tag(sync=True)
    #: The whole drawing as the part of a link from `#` on; also `system`.
    link = traitlets.Unicode("").tag(sync=True)
    #: The controls in the frame: any of `angle`, `n`, `rules`, `string`, `play`, or `all`.
    controls = traitlets.List(traitlets.Unicode(), ["angle", "n"]).tag(sync=True)
    #: `light`, `dark`, or nothing for that of the notebook.
    theme = traitlets.Unicode("").tag(sync=True)
    #: The height in CSS pixels.
    height = traitlets.Int(400).tag(sync=True)
    #: The address of a folder with the page `embed.html`; nothing for the page in this package.
    base = traitlets.Unicode("").tag(sync=True)
    #: The message of a problem; nothing if there is none.
    error = traitlets.Unicode("").tag(sync=True)

    def __init__(self, system, **traits):
        self._is_told = True
        super().__init__(**{"link": system.link, "n": system.n, "angle": system.angle, "seed": system.seed} | traits)
        self._is_told = False
        self.on_msg(self._answer)

    @property
    def system(self):
        """The system that is drawn; assign another one to draw that."""
        return System.read(self.link).replace(n=self.n, angle=self.angle, seed=self.seed)

    @system.setter
    def system(self, system):
        with self._told():
            self.link, self.n, self.angle, self.seed = system.link, system.n, system.angle, system.seed
        self.send({"lsystem": "open", "link": self.link})

    @contextmanager
    def _told(self):
        """The frame knows what is assigned meanwhile."""
        self._is_told = True
        try:
            yield
        finally:
            self._is_told = False

    def set_state(self, sync_data):
        """Takes what the frame tells."""
        with self._told():
            super().set_state(sync_data)

    # A message, since the notebook's copy of a trait may be an echo of what the frame told some time ago.
    @traitlets.observe("n", "angle", "seed")
    def _set(self, change):
        if not self._is_told:
            self.send({"lsystem": "set", "values": {change.name: change.new}})

    @traitlets.observe("link")
    def _open(self, change):
        if not self._is_told:
            self.system = System.read(change.new)

    def _answer(self, _, message, __):
        """Sends the page or a still picture to the notebook, which keeps neither in its file."""
        if message == "page":
            self.send("page", [_page()])
        elif message == "picture":
            self.send("picture", [self.system.png()])

    def _repr_mimebundle_(self, **kwargs):
        """Viewers that run no widgets show the still picture."""
        bundle = super()._repr_mimebundle_(**kwargs)
        if not bundle:
            return bundle
        data, metadata = bundle if isinstance(bundle, tuple) else (bundle, {})
        return self.system._repr_mimebundle_() | data, metadata


@cache
def _page():
    """The page, compressed for its way to the browser."""
    return gzip.compress(page(), mtime=0)
