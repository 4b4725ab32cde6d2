"""What discs, capsules and polygons have in common: a core of closed loops, grown by a radius."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from viaspline.kernels.arrays import Floats

Loop = Sequence[tuple[float, float]]


@dataclass(frozen=True, slots=True)
class RoundedRing:
    """All places no farther than a radius from a core.

    Attributes:
        loops: The core [m]: one vertex is a point, two are a segment, more are a polygon; further
            loops are its holes. Not closed, in either direction.
        radius: By how much the core is grown [m].

    Example:
        >>> RoundedRing([[(0.0, 0.0), (4.0, 0.0)]], 1.0).box
        (-1.0, -1.0, 5.0, 1.0)
    """

    loops: Sequence[Loop]
    radius: float = 0.0

    @property
    def vertices(self) -> Floats:
        """The outer loop [m], shape (k, 2)."""
        return np.array(self.loops[0], np.float64)

    @property
    def is_disc(self) -> bool:
        """Whether it is round about one place."""
        return len(self.loops[0]) == 1

    @property
    def box(self) -> tuple[float, float, float, float]:
        """``x_min, y_min, x_max, y_max`` [m]."""
        low, high = self.vertices.min(axis=0), self.vertices.max(axis=0)
        (x0, y0), (x1, y1) = (low - self.radius).tolist(), (high + self.radius).tolist()
        return x0, y0, x1, y1

    def disc_around(self) -> tuple[float, float, float]:
        """Centre and radius of a disc that contains it: x, y, radius [m]."""
        ring = self.vertices
        x, y = (0.5 * (ring.min(axis=0) + ring.max(axis=0))).tolist()
        return x, y, float(np.hypot(*(ring - (x, y)).T).max()) + self.radius

    def polygon_around(self, segments: int = 8) -> tuple[Loop, float]:
        """Corners of a polygon without holes that it lies in, for those who know no rounded ones.

        Args:
            segments: Sides for each quarter circle.

        Returns:
            The corners [m], and how far at most the polygon reaches beyond the ring [m].

        >>> corners, beyond = RoundedRing([[(0, 0), (4, 0)]], 1.0).polygon_around()
        >>> len(corners), round(beyond, 4)
        (34, 0.0109)
        """
        if self.radius == 0.0:
            return self.loops[0], 0.0
        # Sides of an arc that is no whole number of steps may be half as long again.
        grown = self.radius / math.cos(0.75 * math.pi / (2 * segments))
        outline = self.core().buffer(grown, quad_segs=segments).exterior
        return [(x, y) for x, y in outline.coords[:-1]], grown - self.radius

    def core(self) -> Any:
        """The core as a geometry of shapely: a point, a line or a polygon."""
        import shapely

        outer = self.loops[0]
        if len(outer) == 1:
            return shapely.Point(outer[0])
        if len(outer) == 2:
            return shapely.LineString(outer)
        return shapely.Polygon(outer, self.loops[1:])

    def outline(self, segments: int = 64) -> Any:
        """The area as a polygon of shapely; arcs in this many segments a quarter circle."""
        core = self.core()
        return core if self.radius == 0.0 else core.buffer(self.radius, quad_segs=segments)
