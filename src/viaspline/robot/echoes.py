"""Points that beams have hit: kept while confirmed, dropped when beams see through them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels import sight
from viaspline.mission.parts import Circle, Obstacle
from viaspline.robot.lidar import WILDEST, Scan

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

BELIEVED = 2  # scans that have to see through a point that was hit once
CERTAIN = 10  # and through one that was hit again and again
SETTLED = 64  # hits after which the place of a point is not estimated any better


@dataclass(frozen=True, eq=False)
class Echoes:
    """Points on surfaces, each the middle of a small disc that covers what was hit round it.

    A hit inside of a disc confirms it. Without noise a point is the first hit itself; with noise
    it is the mean of the hits that confirmed it, put right at the 4th, 16th and 64th of them.

    Attributes:
        grain: Radius of the discs [m].
        noise: Standard deviation of a measured distance [m].
        obstacles: The discs, n of them.
        means: Of the hits of each disc [m], shape (n, 2).
        hits: How many there were, shape (n,).
        trust: How many scans have yet to see through each, shape (n,).
    """

    grain: float
    noise: float
    obstacles: tuple[Obstacle, ...]
    means: Floats
    hits: Ints
    trust: Ints

    @classmethod
    def none(cls, grain: float, noise: float) -> Echoes:
        """Nothing was hit yet."""
        nothing = np.empty(0, np.int64)
        return cls(grain, noise, (), np.empty((0, 2)), nothing, nothing)

    def __len__(self) -> int:
        return len(self.obstacles)

    @property
    def tolerance(self) -> float:
        """How far off a surface it may be measured [m]."""
        return WILDEST * self.noise

    @property
    def places(self) -> Floats:
        """The middles of the discs [m], shape (n, 2)."""
        return np.array([_center(obstacle) for obstacle in self.obstacles]).reshape(-1, 2)

    def confirmed(self, hits: Floats, index: Ints) -> Echoes:
        """The same after some hits, shape (k, 2), each inside of the disc ``index``, shape (k,)."""
        count = np.bincount(index, minlength=len(self))
        total = self.hits + count
        means = self.means
        if self.noise > 0.0:
            sums = np.column_stack(
                [np.bincount(index, hits[:, axis], minlength=len(self)) for axis in range(2)]
            )
            share = (count / np.maximum(total, 1))[:, None]
            means = means + share * (sums / np.maximum(count, 1)[:, None] - means)
        trust = np.where(count > 0, np.minimum(self.trust + 1, CERTAIN), self.trust)
        return Echoes(self.grain, self.noise, self.obstacles, means, total, trust)

    def put_right(self, before: Ints) -> tuple[Echoes, tuple[Obstacle, ...]]:
        """The same with the discs moved whose hits, ``before`` so many, have become enough.

        Returns:
            (echoes, the discs in their new places).
        """
        if self.noise <= 0.0:
            return self, ()
        due = np.flatnonzero((_level(self.hits) > _level(before)) & (before < SETTLED))
        obstacles = list(self.obstacles)
        for i in due.tolist():
            obstacles[i] = _disc(self.means[i], self.grain)
        moved = tuple(obstacles[i] for i in due.tolist())
        return self._with(tuple(obstacles)), moved

    def with_hits(self, hits: Floats) -> tuple[Echoes, tuple[Obstacle, ...]]:
        """The same with new discs that cover some hits [m], shape (k, 2), each the first there.

        Returns:
            (echoes, the new discs).
        """
        points = np.ascontiguousarray(hits)
        points = points[sight.spread(points, self.grain)]
        new = tuple(_disc(point, self.grain) for point in points)
        ones = np.ones(len(new), np.int64)
        grown = Echoes(
            self.grain,
            self.noise,
            self.obstacles + new,
            np.concatenate((self.means, points)),
            np.concatenate((self.hits, ones)),
            np.concatenate((self.trust, BELIEVED * ones)),
        )
        return grown, new

    def without_seen_through(self, scan: Scan) -> tuple[Echoes, int]:
        """The same without the points that scans have seen through often enough.

        A scan sees through a point if the beams on either side of it go on well beyond it, and
        are not farther apart there than the disc is wide.

        Returns:
            (echoes, how many points have gone).
        """
        if not len(self):
            return self, 0
        x, y = (float(value) for value in scan.position[:2])
        through = sight.seen_through(
            self.means, x, y, scan.first_direction, scan.angle_increment, scan.free,
            2.0 * self.grain, 4.0 * self.grain + 2.0 * self.tolerance,
        )  # fmt: skip
        trust = self.trust - through
        kept = trust > 0
        gone = len(self) - int(np.count_nonzero(kept))
        if not gone:
            return Echoes(self.grain, self.noise, self.obstacles, self.means, self.hits, trust), 0
        left = tuple(self.obstacles[i] for i in np.flatnonzero(kept).tolist())
        return Echoes(
            self.grain, self.noise, left, self.means[kept], self.hits[kept], trust[kept]
        ), gone

    def _with(self, obstacles: tuple[Obstacle, ...]) -> Echoes:
        return Echoes(self.grain, self.noise, obstacles, self.means, self.hits, self.trust)


def _level(hits: Ints) -> Ints:
    """0 below 4 hits, 1 below 16, 2 below 64, then 3."""
    return np.searchsorted(np.array([4, 16, SETTLED]), hits, side="right")


def _disc(point: Floats, radius: float) -> Obstacle:
    """A disc; it is made without checks, which take ten times as long."""
    x, y = point.tolist()
    circle = Circle.model_construct(center=(x, y), radius=radius)
    return Obstacle.model_construct(circle=circle, name=f"what is seen at ({x:.2f}, {y:.2f})")


def _center(obstacle: Obstacle) -> tuple[float, float]:
    assert obstacle.circle is not None
    return obstacle.circle.center
