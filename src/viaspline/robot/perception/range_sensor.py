"""A range sensor: it sees every obstacle of which a part is near enough."""

from __future__ import annotations

from collections.abc import Container, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.errors import GeometryError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.world.world import World


class RangeSensor:
    """Sees all round, up to a range, whatever stands in between.

    Args:
        unseen: What there is to see.
        range_m: How far it sees from the robot's centre [m].

    Example:
        >>> rock = Obstacle(circle={"center": (10, 0), "radius": 2}, name="rock")
        >>> sensor = RangeSensor([rock], range_m=5)
        >>> [len(sensor.seen((x, 0))) for x in (0, 2, 3, 30)]
        [0, 0, 1, 0]
    """

    def __init__(self, unseen: Sequence[Obstacle], range_m: float) -> None:
        if not range_m > 0:
            raise GeometryError(f"range_m is {range_m}; give a range above 0")
        self.range = float(range_m)
        self.obstacles = tuple(unseen)
        self._world = World(self.obstacles)
        discs = np.array([_disc_around(o) for o in self.obstacles]).reshape(-1, 3)
        self._centers, self._radii = discs[:, :2], discs[:, 2]

    def seen(self, position: ArrayLike) -> tuple[Obstacle, ...]:
        """The obstacles within range of a position [m], shape (d,), in their own order."""
        point = np.asarray(position, dtype=float)[None, :2]
        return tuple(self.obstacles[i] for i in self._near(point) if self._sights(i, point).size)

    def first_sight(self, positions: NDArray[np.float64], known: Container[Obstacle]) -> int | None:
        """Index of the first of some positions [m], shape (n, d), that shows something unknown."""
        points = positions[:, :2]
        firsts = [
            int(sights[0])
            for i in self._near(points)
            if self.obstacles[i] not in known and (sights := self._sights(i, points)).size
        ]
        return min(firsts, default=None)

    def _near(self, points: NDArray[np.float64]) -> list[int]:
        """Indices of the obstacles that may be in range of one of the points."""
        low, high = points.min(axis=0), points.max(axis=0)
        aside = np.maximum(np.maximum(low - self._centers, self._centers - high), 0.0)
        near: list[int] = np.flatnonzero(np.hypot(*aside.T) <= self.range + self._radii).tolist()
        return near

    def _sights(self, index: int, points: NDArray[np.float64]) -> NDArray[np.intp]:
        """Indices of the points that have an obstacle in range."""
        return np.flatnonzero(self._world.distances_to(index, points) <= self.range)


def _disc_around(obstacle: Obstacle) -> tuple[float, float, float]:
    """Centre and radius [m] of a disc that the obstacle lies in."""
    ring = obstacle.ring
    if ring is None:
        assert obstacle.grid is not None
        ring = RoundedRing([[(x, y) for x, y in obstacle.grid.corners.tolist()]])
    return ring.disc_around()
