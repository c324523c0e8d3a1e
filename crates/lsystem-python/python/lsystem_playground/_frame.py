"""The live drawing as HTML that carries its page, for exported notebooks and static books."""

import html
import json
from functools import cache
from pathlib import Path
from urllib.parse import urlencode

from ._error import LSystemError


class Frame:
    """A live drawing that needs neither Python nor a server. Its HTML has about a megabyte."""

    def __init__(self, system, controls=("angle", "n"), theme="", height=400):
        self._link, self._height = system.link, int(height)
        self._options = urlencode({"controls": ",".join(controls), "theme": theme, "away": 0}, safe=",")

    def _repr_html_(self):
        # The page reads its system from the hash, before its own policy allows only its own scripts.
        place = json.dumps(f"{self._link}&{self._options}").replace("<", "\\u003c")
        text = page().decode().replace("<head>", f"<head><script>location.hash = {place}</script>", 1)
        style = f"display: block; width: 100%; height: {self._height}px; border: 0"
        allowed = "allow-scripts allow-downloads"
        return f'<iframe title="L-system" sandbox="{allowed}" style="{style}" srcdoc="{html.escape(text)}"></iframe>'


@cache
def page():
    """The page for embedding, as bytes."""
    try:
        return (Path(__file__).parent / "embed.html").read_bytes()
    except FileNotFoundError:
        raise LSystemError("this build of the package has no page: name an address by `base` for the widget") from None
