"""How far points are from an edge of a strip, near the place of the strip where they are.

Tested through ``planning/corridor/test_corridor_planner``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats, Ints

ON_EDGE_M = 1e-6  # from where on the direction to the edge is the edge's own


@dataclass(frozen=True, eq=False)
class StripEdge:
    """One edge of a strip, in the direction of driving.

    Attributes:
        points: [m], (n, 2).
        inward: 1 if the strip lies to the left of it, -1 if to the right.
        closed: Whether the last point is followed by the first.
        window: How many points before and after a place count: a strip that comes back to where
            it was has another edge there.
    """

    points: Floats
    inward: float
    closed: bool
    window: int

    def room(self, places: Floats, rows: Ints) -> tuple[Floats, Floats]:
        """How far inside of the edge places are, and in which direction they get farther inside.

        Args:
            places: [m], (k, 2).
            rows: The strip's row that is nearest to each, (k,).

        Returns:
            (distance (k,) [m], negative outside; unit vectors (k, 2)).
        """
        start, step = self._segments(rows)
        size = np.maximum((step * step).sum(axis=2), 1e-18)
        away = places[:, None, :] - start
        part = np.clip((away * step).sum(axis=2) / size, 0.0, 1.0)
        away = away - part[..., None] * step
        squared = (away * away).sum(axis=2)
        across = self.inward * np.stack((-step[..., 1], step[..., 0]), axis=2)
        across /= np.sqrt(size)[..., None]
        beside = (across * away).sum(axis=2)
        least = squared.min(axis=1, keepdims=True)
        # where segments meet, the one that faces the place tells the side
        nearest = squared <= least * (1.0 + 1e-9) + 1e-18
        best = np.where(nearest, np.abs(beside), -1.0).argmax(axis=1)
        every = np.arange(len(places))
        side = np.where(beside[every, best] >= 0.0, 1.0, -1.0)
        distance = np.sqrt(least[:, 0])
        along = side[:, None] * away[every, best] / np.maximum(distance, ON_EDGE_M)[:, None]
        along = np.where((distance > ON_EDGE_M)[:, None], along, across[every, best])
        return side * distance, along

    def _segments(self, rows: Ints) -> tuple[Floats, Floats]:
        """Starts and steps of the segments round some rows, both (k, 2 window, 2)."""
        at = rows[:, None] + np.arange(-self.window, self.window)
        count = len(self.points)
        if self.closed:
            start, end = self.points[at % count], self.points[(at + 1) % count]
        else:
            at = np.clip(at, 0, count - 2)
            start, end = self.points[at], self.points[at + 1]
        return start, end - start
