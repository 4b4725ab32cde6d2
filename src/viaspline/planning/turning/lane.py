"""The straight line between two via points, as a frame of its own.

Tested through ``planning/turning/test_local_detours``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.via_sequence import WholeLeg


@dataclass(frozen=True)
class Lane:
    """The line that a leg keeps to: how far along it and how far left of it places lie.

    Attributes:
        start: [m], (2,).
        along: Its direction, (2,).
        length: [m].
    """

    start: Floats
    along: Floats
    length: float

    @classmethod
    def of(cls, leg: WholeLeg) -> Lane:
        """The line of a leg of the route; one without length points along x."""
        way = leg.goal[:2] - leg.start[:2]
        length = float(np.hypot(*way))
        return cls(leg.start[:2], way / length if length > 0.0 else np.array((1.0, 0.0)), length)

    def seen(self, places: Floats) -> Floats:
        """Places (..., 2) as distances along the line and to the left of it [m], (..., 2)."""
        off = places[..., :2] - self.start
        found = np.empty_like(off)
        found[..., 0] = off @ self.along
        found[..., 1] = self.along[0] * off[..., 1] - self.along[1] * off[..., 0]
        return found

    def at(self, along: float, left: float = 0.0) -> Floats:
        """The place so far along the line and to the left of it [m], (2,)."""
        across = np.array((-self.along[1], self.along[0]))
        place: Floats = self.start + along * self.along + left * across
        return place
