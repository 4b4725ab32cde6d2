"""Squares over a bounded world, and in which of them a robot may be: too many, never too few.

Tested through ``spacetime/test_cut_off``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.world.world import World

TOUCHING_M = 1e-5
"""By so much less than asked a robot may keep: rounding [m]."""


@dataclass(frozen=True, eq=False)
class WorldSquares:
    """Squares over the bounds of a world.

    Attributes:
        low: The corner with the least coordinates [m], (2,).
        side: Of a square [m].
        least: What a robot keeps [m].
        free: Those in which it may be beside what stands, (rows, columns).
        places: Their middles [m], (n, 2).
    """

    low: Floats
    side: float
    least: float
    free: Flags
    places: Floats

    @classmethod
    def over(cls, world: World, count: int, least: float) -> WorldSquares | None:
        """About so many squares; None in a world without bounds.

        Args:
            world: What stands.
            count: About so many squares there are.
            least: What a robot keeps of it [m].
        """
        if world.bounds is None:
            return None
        x_min, y_min, x_max, y_max = world.bounds
        side = math.sqrt((x_max - x_min) * (y_max - y_min) / count)
        shape = math.ceil((y_max - y_min) / side), math.ceil((x_max - x_min) / side)
        rows, columns = (side * (np.arange(n) + 0.5) for n in shape)
        middles = np.stack(np.meshgrid(x_min + columns, y_min + rows), axis=-1)
        low, every = np.array([x_min, y_min]), np.ones(shape, np.bool_)
        whole = cls(low, side, least, every, middles.reshape(-1, 2))
        free = whole.may_be_in(world)
        return cls(low, side, least, free, middles[free])

    @property
    def half(self) -> float:
        """Half of a square's diagonal [m]."""
        return self.side * math.sqrt(0.5)

    def of(self, place: Sequence[float]) -> tuple[int, int]:
        """Row and column of a place."""
        column, row = np.floor((np.array(place[:2]) - self.low) / self.side).astype(int).tolist()
        rows, columns = self.free.shape
        return min(max(row, 0), rows - 1), min(max(column, 0), columns - 1)

    def may_be_in(self, world: World) -> Flags:
        """Those of them in which a robot may be in a world of more obstacles, (rows, columns)."""
        found = self.free.copy()
        found[self.free] = world.distance(self.places) + self.half >= self.least - TOUCHING_M
        return found

    def may_join(self, world: World, points: Sequence[Sequence[float]]) -> bool:
        """Whether there may be a way from each of some places to all others.

        Args:
            world: The one that the squares lie over, with more obstacles.
            points: The places [m].
        """
        from scipy.ndimage import label

        regions = label(self.may_be_in(world), np.ones((3, 3), np.int8))[0]
        ends = {int(regions[self.of(point)]) for point in points}
        return len(ends) == 1 and 0 not in ends
