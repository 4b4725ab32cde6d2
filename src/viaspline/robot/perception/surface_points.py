"""Points that beams have hit: kept while confirmed, dropped when beams see through them.

Tested through ``robot/perception/test_belief``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.sensing import visible_region
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.lidar import MAX_NOISE_SIGMAS, Scan

NEW_TRUST_SCANS = 2
"""Scans that have to see through a point that was hit once."""

MAX_TRUST_SCANS = 10
"""Scans that have to see through one that was hit again and again."""

RECENTRE_HITS = (4, 16, 64)
"""Hits of a point at which its place and its radius are put right."""


@dataclass(frozen=True, eq=False)
class SurfacePoints:
    """Points on surfaces, each the middle of a small disc that covers what was hit round it.

    A hit inside of a disc confirms it. Without noise a point is the first hit itself; with noise
    it is the mean of the hits that confirmed it, put right at the 4th, 16th and 64th of them. Of
    its radius, what is there for the noise shrinks with the error of that mean: so noise doesn't
    close for good a gap that the robot fits through.

    Attributes:
        cell_size: Radius of the discs on first hits [m].
        noise: Standard deviation of a measured distance [m].
        obstacles: The discs, n of them.
        discs: The same as x, y and radius [m], shape (n, 3).
        means: Of the hits of each disc [m], shape (n, 2).
        hits: How many there were, shape (n,).
        trust: How many scans have yet to see through each, shape (n,).
    """

    cell_size: float
    noise: float
    obstacles: tuple[Obstacle, ...]
    discs: Floats
    means: Floats
    hits: Ints
    trust: Ints

    @classmethod
    def none(cls, cell_size: float, noise: float) -> SurfacePoints:
        """Nothing was hit yet."""
        nothing = np.empty(0, np.int64)
        return cls(cell_size, noise, (), np.empty((0, 3)), np.empty((0, 2)), nothing, nothing)

    def __len__(self) -> int:
        return len(self.obstacles)

    @property
    def tolerance(self) -> float:
        """How far off a surface it may be measured [m]."""
        return MAX_NOISE_SIGMAS * self.noise

    @property
    def places(self) -> Floats:
        """The middles of the discs [m], shape (n, 2)."""
        return self.discs[:, :2]

    def confirmed(self, scan: Scan, hits: Floats, index: Ints) -> SurfacePoints:
        """The points after hits of a scan, shape (k, 2), each near the disc ``index``, (k,)."""
        trust = self.trust.copy()
        trust[np.unique(index)] += 1
        if self.noise > 0.0:
            index = self._beside(scan, hits, index)
        count = np.bincount(index, minlength=len(self))
        total = self.hits + count
        means = self.means
        if self.noise > 0.0:
            sums = np.column_stack(
                [np.bincount(index, hits[:, axis], minlength=len(self)) for axis in range(2)]
            )
            means = means + (sums - count[:, None] * means) / total[:, None]
        return replace(self, means=means, hits=total, trust=np.minimum(trust, MAX_TRUST_SCANS))

    def _beside(self, scan: Scan, hits: Floats, index: Ints) -> Ints:
        """For each hit the disc in whose direction it was, if that is as near as noise allows.

        The nearest one would not do: of two discs, the one before the surface would get the hits
        that were measured too short, and stay where it is.
        """
        if not len(hits):
            return index
        near = cKDTree(_seen_from(scan, self.means)).query(_seen_from(scan, hits))[1]
        apart = np.hypot(*(hits - self.means[near]).T)
        return np.where(apart <= self.cell_size + 2.0 * self.tolerance, near, index)

    def put_right(self, before: Ints) -> tuple[SurfacePoints, tuple[Obstacle, ...]]:
        """The points with those discs moved whose hits, ``before`` so many, have become enough.

        Returns:
            (points, the discs in their new places).
        """
        if self.noise <= 0.0:
            return self, ()
        level = _level(self.hits)
        due = np.flatnonzero(level > _level(before))
        radii = self.cell_size - self.noise * (1.0 - np.sqrt(1.0 / np.array((1, *RECENTRE_HITS))))
        obstacles, discs = list(self.obstacles), self.discs.copy()
        discs[due] = np.column_stack((self.means[due], radii[level[due]]))
        for i in due.tolist():
            obstacles[i] = _disc(discs[i])
        moved = tuple(obstacles[i] for i in due.tolist())
        return replace(self, obstacles=tuple(obstacles), discs=discs), moved

    def with_hits(self, hits: Floats) -> tuple[SurfacePoints, tuple[Obstacle, ...]]:
        """The points with new discs that cover some hits [m], shape (k, 2), each the first there.

        Returns:
            (points, the new discs).
        """
        points = np.ascontiguousarray(hits)
        points = points[visible_region.beam_spread(points, self.cell_size)]
        discs = np.column_stack((points, np.full(len(points), self.cell_size)))
        new = tuple(_disc(disc) for disc in discs)
        ones = np.ones(len(new), np.int64)
        grown = replace(
            self,
            obstacles=self.obstacles + new,
            discs=np.concatenate((self.discs, discs)),
            means=np.concatenate((self.means, points)),
            hits=np.concatenate((self.hits, ones)),
            trust=np.concatenate((self.trust, NEW_TRUST_SCANS * ones)),
        )
        return grown, new

    def without_seen_through(self, scan: Scan) -> tuple[SurfacePoints, int]:
        """The points without those that scans have seen through often enough.

        A scan sees through a point if the beams on either side of it go on well beyond it, and
        are not farther apart there than the disc is wide.

        Returns:
            (points, how many points have gone).
        """
        if not len(self):
            return self, 0
        x, y = (float(value) for value in scan.position[:2])
        through = visible_region.seen_through(
            self.means, x, y, scan.first_direction, scan.angle_increment, scan.free,
            2.0 * self.cell_size, 4.0 * self.cell_size + 2.0 * self.tolerance,
        )  # fmt: skip
        doubted = replace(self, trust=self.trust - through)
        return doubted._kept(doubted.trust > 0)

    def _kept(self, kept: NDArray[np.bool_]) -> tuple[SurfacePoints, int]:
        gone = len(self) - int(np.count_nonzero(kept))
        if not gone:
            return self, 0
        left = tuple(self.obstacles[i] for i in np.flatnonzero(kept).tolist())
        return replace(
            self, obstacles=left, discs=self.discs[kept], means=self.means[kept],
            hits=self.hits[kept], trust=self.trust[kept],
        ), gone  # fmt: skip


def _seen_from(scan: Scan, points: Floats) -> Floats:
    """Places in which directions from a scan count ten times as much as distances, (n, 2)."""
    away = points - np.asarray(scan.position[:2])
    bearings = np.arctan2(away[:, 1], away[:, 0]) - scan.heading
    distances = np.maximum(np.hypot(*away.T), 1e-9)
    return np.column_stack((np.remainder(bearings + np.pi, 2 * np.pi), 0.1 * np.log(distances)))


def _level(hits: Ints) -> Ints:
    return np.searchsorted(np.array(RECENTRE_HITS), hits, side="right")


def _disc(disc: Floats) -> Obstacle:
    x, y, radius = disc.tolist()
    circle = Circle(center=(x, y), radius=radius)
    return Obstacle(circle=circle, name=f"what is seen at ({x:.2f}, {y:.2f})")
