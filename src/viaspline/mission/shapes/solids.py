"""What obstacles are in space: prisms over rounded rings, and lines with a radius.

Voxels and terrain are solids as well; they are maps, see ``maps/voxels`` and ``maps/terrain``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.rounded_ring import RoundedRing

Place = tuple[float, float, float]
Box6 = tuple[float, float, float, float, float, float]


@dataclass(frozen=True, slots=True)
class Prism:
    """All places over or under a rounded ring, between two heights.

    Attributes:
        ring: Its outline in plan.
        low: Height of its floor [m]; -inf for a thing without one.
        high: Height of its roof [m]; inf for a thing without one.

    Example:
        >>> Prism(RoundedRing([[(0.0, 0.0)]], 2.0), 0.0, 35.0).box
        (-2.0, -2.0, 0.0, 2.0, 2.0, 35.0)
    """

    ring: RoundedRing
    low: float = -math.inf
    high: float = math.inf

    @property
    def box(self) -> Box6:
        """``x_min, y_min, z_min, x_max, y_max, z_max`` [m]."""
        x0, y0, x1, y1 = self.ring.box
        return x0, y0, self.low, x1, y1, self.high


@dataclass(frozen=True, slots=True)
class RoundedSegment:
    """All places no farther than a radius from a line in space; from a place, if it has no length.

    Attributes:
        first: Where the line begins, x, y, z [m].
        last: Where it ends, x, y, z [m].
        radius: How far the solid reaches to all sides [m].

    Example:
        >>> RoundedSegment((0.0, 0.0, 5.0), (0.0, 0.0, 5.0), 2.0).box
        (-2.0, -2.0, 3.0, 2.0, 2.0, 7.0)
    """

    first: Place
    last: Place
    radius: float

    @property
    def box(self) -> Box6:
        """``x_min, y_min, z_min, x_max, y_max, z_max`` [m]."""
        (x0, y0, z0), (x1, y1, z1), r = self.first, self.last, self.radius
        return (
            min(x0, x1) - r, min(y0, y1) - r, min(z0, z1) - r,
            max(x0, x1) + r, max(y0, y1) + r, max(z0, z1) + r,
        )  # fmt: skip


Solid: TypeAlias = Prism | RoundedSegment | Voxels
"""Whatever an obstacle can be in space."""
