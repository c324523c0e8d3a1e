"""Drawings as arrays."""

from functools import cached_property

import numpy as np

#: The most segments and vertices of polygons that become arrays, about 60 bytes each.
MOST = 20_000_000


class Drawing:
    """A drawing. It is kept as a graph of shared parts, so that one of 10^30 segments has `bounds` and a picture; its
    arrays are made when they are first asked for.

    The segments and the polygons are in drawing order, in model units, x right, y up, z towards the viewer.
    """

    def __init__(self, core, system, n):
        self._core = core
        #: The system.
        self.system = system
        #: The number of derivation steps.
        self.n = n
        #: 2 in the plane, 3 in space.
        self.dimension = core.dimension
        #: The least and the greatest coordinates of segments and polygons without stroke widths: an array of shape
        #: (2, dimension), or None if nothing is drawn.
        self.bounds = None if core.bounds is None else np.array(core.bounds)

    @cached_property
    def count(self):
        """The exact number of segments."""
        # The core's count stops at its largest number.
        few = self._core.segment_count
        return few if few < 1 << 127 else self.system.count(self.n).segments

    def __len__(self):
        return self.count

    @property
    def segments(self):
        """Both ends of each segment: float64, shape (count, 2, dimension). `LineCollection` of Matplotlib takes it.

        This and the other arrays raise `LSystemError` for more than 20,000,000 segments and vertices."""
        return self._arrays["segments"]

    @property
    def widths(self):
        """The stroke widths at both ends of each segment: float64, shape (count, 2)."""
        return self._arrays["widths"]

    @property
    def colours(self):
        """Red, green and blue of each segment: uint8, shape (count, 3)."""
        return self._arrays["colours"]

    @property
    def colour_indices(self):
        """The turtle's colour index at each segment, not wrapped to the palette: int32."""
        return self._arrays["colour_indices"]

    @property
    def levels(self):
        """The number of open branches at each segment: uint32."""
        return self._arrays["levels"]

    @property
    def polygons(self):
        """The vertices of each filled polygon: a list of arrays, float64, shape (vertices, dimension)."""
        return self._arrays["polygons"]

    @property
    def polygon_colours(self):
        """Red, green and blue of each polygon: uint8, shape (polygons, 3)."""
        return self._arrays["polygon_colours"]

    @cached_property
    def _arrays(self):
        ends, widths, colours, indices, levels, vertices, sides, fills = self._core.arrays(MOST)
        vertices = np.frombuffer(vertices).reshape(-1, self.dimension)
        starts = np.cumsum(np.frombuffer(sides, np.uint32))[:-1]
        return {
            "segments": np.frombuffer(ends).reshape(-1, 2, self.dimension),
            "widths": np.frombuffer(widths).reshape(-1, 2),
            "colours": np.frombuffer(colours, np.uint8).reshape(-1, 3),
            "colour_indices": np.frombuffer(indices, np.int32),
            "levels": np.frombuffer(levels, np.uint32),
            "polygons": np.split(vertices, starts) if len(sides) > 0 else [],
            "polygon_colours": np.frombuffer(fills, np.uint8).reshape(-1, 3),
        }

    def __repr__(self):
        return f"<drawing of {self.count} segments in {'the plane' if self.dimension == 2 else 'space'}>"

    def _repr_mimebundle_(self, include=None, exclude=None):
        from ._system import SVG_SEGMENTS

        text = {"text/plain": repr(self)}
        if self._core.segment_count <= SVG_SEGMENTS:
            return text | {"image/svg+xml": self.system.svg(self.n)}
        return text | {"image/png": self.system.png(self.n)}
