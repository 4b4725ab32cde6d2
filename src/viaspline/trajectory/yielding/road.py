"""A path as it is looked at among things that move: chords, and a tree over them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from weakref import WeakKeyDictionary

import numpy as np

from viaspline.curve.bending import curvature_bound
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.timing.yielding.chord_ends import chord_ends
from viaspline.kernels.timing.yielding.path_tree import PathTree, path_tree

CHORD_MISS_M = 0.0002
"""A chord from which a path may be farther is halved [m],"""
MIN_CHORD_M, MAX_CHORDS = 0.02, 20_000
"""unless it is so short [m], or there are so many."""

_TREES: WeakKeyDictionary[PiecewiseCubic, PathTree] = WeakKeyDictionary()
"""The chords of every path that is still in use: a robot times the path that it is on again and
again."""


@dataclass(frozen=True, eq=False)
class Road:
    """A path in chords.

    Attributes:
        path: The path itself.
        tree: Its chords.
    """

    path: PiecewiseCubic
    tree: PathTree

    @classmethod
    def of(cls, path: PiecewiseCubic) -> Road:
        """The chords of a path, the shorter the more it bends where they are."""
        tree = _TREES.get(path)
        if tree is None:
            tree = _TREES[path] = _in_chords(path)
        return cls(path, tree)

    @cached_property
    def bend(self) -> float:
        """No place of the path bends more [1/m]; infinite at a corner."""
        return float(curvature_bound(self.path)[0])

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


def _in_chords(path: PiecewiseCubic) -> PathTree:
    """The chords between the joints of a path, the shorter the more it bends."""
    least = max(MIN_CHORD_M, path.length / MAX_CHORDS)
    begin, end = path.domain
    ends = chord_ends(np.ascontiguousarray(path.spans), CHORD_MISS_M, least)
    u = np.minimum(begin + ends * ((end - begin) / len(path.spans)), end)
    along = np.asarray(path.distance(u), dtype=np.float64)
    return path_tree(along, np.ascontiguousarray(np.asarray(path.evaluate(u))[:, :2]))
