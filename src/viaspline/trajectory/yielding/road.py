"""A path as it is looked at among things that move: chords, a tree over them, and legs.

Tested through ``trajectory/yielding/test_law_among``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viaspline.curve.bending import curvature_bound
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.kernels.timing.yielding.path_tree import PathTree, path_tree

CHORD_MISS_M = 0.002
"""How far a path may be from its chords, about [m]."""
MIN_CHORD_M, MAX_CHORDS = 0.02, 20_000
STRAIGHT = 1e-9
"""A path that bends less is a chord for each span [1/m]."""


@dataclass(frozen=True, eq=False)
class Road:
    """A path in chords.

    Attributes:
        path: The path itself.
        bend: No place of it bends more [1/m]; infinite at a corner.
        tree: Its chords.
    """

    path: PiecewiseCubic
    bend: float
    tree: PathTree

    @classmethod
    def of(cls, path: PiecewiseCubic) -> Road:
        """The chords of a path, the shorter the more it bends."""
        bend = float(curvature_bound(path)[0])
        if bend < STRAIGHT:
            u = np.linspace(*path.domain, len(path.spans) + 1)
            along, points = np.asarray(path.distance(u), dtype=np.float64), path.evaluate(u)
        else:
            chord = math.sqrt(7.0 * CHORD_MISS_M / bend)
            chord = max(chord, MIN_CHORD_M, path.length / MAX_CHORDS)
            _, along, points = path.sample(min(chord, path.length))
        tree = path_tree(np.ascontiguousarray(along), np.ascontiguousarray(points[:, :2]))
        return cls(path, bend, tree)

    @property
    def length(self) -> float:
        """[m]."""
        return float(self.tree.along[-1])

    @cached_property
    def optimistic(self) -> PathTree:
        """The tree for proofs that something is blocked."""
        return self.tree._replace(misses=-self.tree.misses)

    def at(self, distance: float) -> tuple[float, float]:
        """A place on it [m]."""
        if distance >= self.length:
            return float(self.tree.points[-1, 0]), float(self.tree.points[-1, 1])
        x, y = np.asarray(self.path.at_distance(distance), dtype=np.float64)[:2]
        return float(x), float(y)

    def points_at(self, distances: Floats) -> Floats:
        """Places on it [m], (n, 2)."""
        return np.asarray(self.path.at_distance(distances), dtype=np.float64)[:, :2]
