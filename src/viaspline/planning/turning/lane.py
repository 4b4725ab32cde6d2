"""The straight line between two via points, as a frame of its own.

Tested through ``planning/turning/test_local_detours``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.via_sequence import WholeLeg


@dataclass(frozen=True)
class Lane:
    """The line that a leg keeps to: how far along it and how far left of it places lie.

    Attributes:
        start: [m], (2,).
        frame: Its direction, and the one across it to the left, as columns, (2, 2).
        length: [m].
    """

    start: Floats
    frame: Floats
    length: float

    @classmethod
    def of(cls, leg: WholeLeg) -> Lane:
        """The line of a leg of the route; one without length points along x."""
        way = leg.goal[:2] - leg.start[:2]
        length = math.hypot(way[0], way[1])
        x, y = (way / length).tolist() if length > 0.0 else (1.0, 0.0)
        return cls(leg.start[:2], np.array(((x, -y), (y, x))), length)

    def seen(self, places: Floats) -> Floats:
        """Places (..., 2) as distances along the line and to the left of it [m], (..., 2)."""
        found: Floats = (places[..., :2] - self.start) @ self.frame
        return found

    def at(self, along: float, left: float = 0.0) -> Floats:
        """The place so far along the line and to the left of it [m], (2,)."""
        place: Floats = self.start + self.frame @ (along, left)
        return place
