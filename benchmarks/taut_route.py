"""The shortest route that can be bent into a given one: by triangles and a funnel.

The free space is triangulated by shapely; the edges that the given route crosses, those taken out
that it crosses back at once, are what every route of its kind crosses, and the funnel through them
is the shortest (Lee and Preparata 1984). No planner has a part in it.
"""

from __future__ import annotations

import numpy as np
import shapely

Edge = tuple[int, int]


class Triangles:
    """Free space as triangles, for many routes.

    Args:
        free: A polygon, or many.
    """

    def __init__(self, free: shapely.Geometry) -> None:
        parts = shapely.get_parts(shapely.constrained_delaunay_triangles(free))
        corners = np.array([shapely.get_coordinates(part)[:3] for part in parts])
        self.places, index = np.unique(corners.reshape(-1, 2), axis=0, return_inverse=True)
        rows = np.sort(index.reshape(-1, 3)[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        pairs, count = np.unique(rows, axis=0, return_counts=True)
        self.doors = pairs[count == 2]  # edges of two triangles
        self.lines = shapely.linestrings(self.places[self.doors])
        self.tree = shapely.STRtree(self.lines)

    def taut(self, route: np.ndarray) -> np.ndarray:
        """The shortest route that can be bent into a given one [m], (k, 2).

        Args:
            route: A polyline [m] inside of the free space, (n, 2).
        """
        return funnel(route[0], route[-1], self._crossed(route))

    def _crossed(self, route: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
        """The doors on the way, each its left and its right end."""
        pieces = np.stack((route[:-1], route[1:]), axis=1)
        piece, door = self.tree.query(shapely.linestrings(pieces), predicate="intersects")
        a, b = pieces[piece, 0], pieces[piece, 1]
        p, q = (self.places[self.doors[door, k]] for k in (0, 1))
        before, after = _side(p, q, a), _side(p, q, b)
        crosses = (before > 0.0) != (after > 0.0)
        share = np.where(crosses, before / np.where(crosses, before - after, 1.0), 0.0)
        order = np.lexsort((share, piece))
        word: list[tuple[int, bool]] = []
        for k in order[crosses[order]].tolist():
            step = (int(door[k]), bool(before[k] > 0.0))
            if word and word[-1][0] == step[0]:
                word.pop()
            else:
                word.append(step)
        ends = self.places[self.doors[[which for which, _ in word]]] if word else ()
        return [
            (end[1], end[0]) if from_left else (end[0], end[1])
            for end, (_, from_left) in zip(ends, word, strict=True)
        ]


def funnel(
    start: np.ndarray, goal: np.ndarray, doors: list[tuple[np.ndarray, np.ndarray]]
) -> np.ndarray:
    """The shortest way through a row of doors, each its left and its right end [m], (k, 2)."""
    lefts = [*(door[0] for door in doors), np.asarray(goal, float)]
    rights = [*(door[1] for door in doors), np.asarray(goal, float)]
    apex = left = right = np.asarray(start, float)
    way, at_left, at_right, i = [apex], -1, -1, 0
    while i < len(lefts):
        if _area(apex, right, rights[i]) >= 0.0:
            if _same(apex, right) or _area(apex, left, rights[i]) < 0.0:
                right, at_right = rights[i], i
            else:
                apex = right = left
                i = at_right = at_left
                way.append(apex)
                i += 1
                continue
        if _area(apex, left, lefts[i]) <= 0.0:
            if _same(apex, left) or _area(apex, right, lefts[i]) > 0.0:
                left, at_left = lefts[i], i
            else:
                apex = left = right
                i = at_left = at_right
                way.append(apex)
                i += 1
                continue
        i += 1
    way.append(lefts[-1])
    rows = np.array(way)
    return rows[np.r_[True, np.hypot(*np.diff(rows, axis=0).T) > 1e-12]]


def _side(p: np.ndarray, q: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Above 0 where places lie to the left of lines from p to q."""
    return (q - p)[:, 0] * (at - p)[:, 1] - (q - p)[:, 1] * (at - p)[:, 0]


def _area(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def _same(a: np.ndarray, b: np.ndarray) -> bool:
    return bool(np.abs(a - b).max() < 1e-12)
