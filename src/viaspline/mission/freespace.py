"""Where the middle of a disc robot may be: inside bounds and fences, clear of what is known.

Distances are signed [m]: negative on the wrong side. Asked with arrays and trees, so that a
million obstacles are no problem.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import chain
from typing import Any, TypeAlias

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.maps.grid import Grid
from viaspline.maps.squares import blocked_ground, signed_distance
from viaspline.mission.fields import Corners
from viaspline.mission.shapes.cores import Geometries, cores_of
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.shapes.rounded_ring import RoundedRing

Indices: TypeAlias = np.ndarray[Any, np.dtype[np.intp]]

_MAX_OBSTACLES_AROUND = (
    2000  # Obstacles round a point beyond which no nearest free place is looked for.
)
_QUARTER_CHORDS = 64  # Corners of a quarter circle where outlines are moved outwards.
_CHORD_GROWTH = 1 / math.cos(
    math.pi / (4 * _QUARTER_CHORDS)
)  # Chords cut corners; so much farther, none.
_GRID_QUARTER_CHORDS = 8  # Corners of a quarter circle round squares, which have so many.
_GRID_CHORD_GROWTH = 1 / math.cos(math.pi / (4 * _GRID_QUARTER_CHORDS))


class FreeSpace:
    """Bounds, fences and obstacles, moved inwards or outwards by the robot's margin.

    Args:
        bounds: ``x_min, y_min, x_max, y_max`` [m].
        fences: Inclusion polygons, each an outer ring and its holes.
        obstacles: Obstacles of one sound shape each.
        margin: Body radius plus clearance [m].
    """

    def __init__(
        self,
        bounds: tuple[float, float, float, float] | None,
        fences: Sequence[Sequence[Corners]],
        obstacles: Sequence[Obstacle],
        margin: float,
    ) -> None:
        self.bounds = bounds
        self.fences = cores_of(RoundedRing(rings) for rings in fences).geometries
        self.margin = margin
        self._pack(obstacles)

    def _pack(self, obstacles: Sequence[Obstacle]) -> None:
        """Cores and radii of the rounded rings, the boxes round all of them; the grids."""
        import shapely

        self.grids = [(j, item.grid) for j, item in enumerate(obstacles) if item.grid is not None]
        self.order = np.array([j for j, item in enumerate(obstacles) if item.grid is None], np.intp)
        rings = (ring for item in obstacles if (ring := item.ring) is not None)
        self.cores, self.radii = cores_of(rings)
        boxes = shapely.bounds(self.cores) if len(self.cores) else np.empty((0, 4))
        self.boxes: Floats = boxes + self.radii[:, None] * np.array([-1.0, -1.0, 1.0, 1.0])

    def near_bounds(self, places: Sequence[Sequence[float]]) -> Iterator[tuple[int, float]]:
        """Points nearer to the bounds than the margin, with their distance."""
        if self.bounds is None:
            return
        xy = np.array(places, dtype=float)
        low, high = np.array(self.bounds[:2]), np.array(self.bounds[2:])
        inside = np.minimum(xy - low, high - xy).min(axis=1)
        outside = np.hypot(*np.maximum(np.maximum(low - xy, xy - high), 0.0).T)
        distances = np.where(inside < 0, -outside, inside)
        for i in np.flatnonzero(distances < self.margin):
            yield int(i), float(distances[i])

    def near_fences(self, places: Sequence[Sequence[float]]) -> Iterator[tuple[int, int, float]]:
        """Points nearer to a fence than the margin: point, fence, distance."""
        import shapely

        points = _points(places)
        for j, fence in enumerate(self.fences):
            distances = shapely.distance(shapely.boundary(fence), points)
            distances = np.where(shapely.covers(fence, points), distances, -distances)
            for i in np.flatnonzero(distances < self.margin):
                yield int(i), j, float(distances[i])

    def near_obstacles(self, places: Sequence[Sequence[float]]) -> Iterator[tuple[int, int, float]]:
        """Points nearer to an obstacle than the margin: point, nearest obstacle, distance."""
        nearest: dict[int, tuple[float, int]] = {}
        for i, j, distance in chain(self._near_shapes(places), self._near_squares(places)):
            nearest[i] = min(nearest.get(i, (math.inf, -1)), (distance, j))
        for i, (distance, j) in sorted(nearest.items()):
            yield i, j, distance

    def _near_squares(self, places: Sequence[Sequence[float]]) -> Iterator[tuple[int, int, float]]:
        for j, grid in self.grids:
            for i, place in enumerate(places):
                distance = signed_distance(grid, place[:2], self.margin)
                if distance < self.margin:
                    yield i, j, distance

    def _near_shapes(self, places: Sequence[Sequence[float]]) -> Iterator[tuple[int, int, float]]:
        import shapely

        if not len(self.cores):
            return
        points = _points(places)
        grown = self.boxes + self.margin * np.array([-1.0, -1.0, 1.0, 1.0])
        # The tree holds the points: they are few, the obstacles may be a million.
        which, point = shapely.STRtree(points).query(shapely.box(*grown.T))
        distances = self._distances(points[point], which)
        order = np.lexsort((distances, point))
        _, first = np.unique(point[order], return_index=True)
        for k in order[first]:
            if distances[k] < self.margin:
                yield int(point[k]), int(self.order[which[k]]), float(distances[k])

    def _distances(self, points: Geometries, which: Indices) -> Floats:
        """Signed distances of points to obstacles, pair by pair."""
        import shapely

        cores = self.cores[which]
        distances = np.asarray(shapely.distance(cores, points), dtype=float)
        inside = np.flatnonzero((distances <= 0) & (shapely.get_dimensions(cores) == 2))
        if len(inside):
            edges = shapely.boundary(cores[inside])
            distances[inside] = -shapely.distance(edges, points[inside])
        return distances - self.radii[which]

    @cached_property
    def _tree(self) -> Any:
        import shapely

        return shapely.STRtree(list(np.atleast_1d(np.asarray(shapely.box(*self.boxes.T)))))

    def nearest(self, place: Sequence[float]) -> tuple[float, float] | None:
        """A place where the robot may be, as near as can be found, in round numbers.

        None if there is none near by, or too much stands around to say.
        """
        import shapely

        here = shapely.points(place)
        reach = 4 * self.margin + 1e-3
        while reach < 1e10:
            around = np.empty(0, dtype=np.intp)
            if len(self.boxes):
                around = self._tree.query(_window(place, reach + 2 * self.margin))
            if len(around) > _MAX_OBSTACLES_AROUND:
                return None
            free = self._free(_window(place, reach), around)
            if not free.is_empty:
                found = shapely.shortest_line(free, here).coords[0]
                if math.dist(found, place) <= reach:
                    return self._rounded(found)
            reach *= 4
        return None

    def _free(self, window: Any, around: Indices) -> Any:
        """The part of a window where the robot may be, a little smaller than it is."""
        import shapely

        margin = self.margin + 2 * self._step
        if self.bounds is not None:
            x_min, y_min, x_max, y_max = self.bounds
            if x_max - x_min < 2 * margin or y_max - y_min < 2 * margin:
                return shapely.Polygon()
            inner = shapely.box(x_min + margin, y_min + margin, x_max - margin, y_max - margin)
            window = shapely.intersection(window, inner)
        for fence in self._inner_fences:
            window = shapely.intersection(window, fence)
        grown = shapely.buffer(
            self.cores[around],
            (self.radii[around] + margin) * _CHORD_GROWTH,
            quad_segs=_QUARTER_CHORDS,
        )
        free = shapely.difference(window, shapely.union_all(grown))
        for _, grid in self.grids:
            free = shapely.difference(free, self._grown_squares(grid, free, margin))
        return free

    def _grown_squares(self, grid: Grid, window: Any, margin: float) -> Any:
        """A grid's blocked ground, moved outwards; all of it that reaches into a window."""
        import shapely

        if window.is_empty:
            return window
        x_min, y_min, x_max, y_max = window.bounds
        reach = 2 * margin
        box = (x_min - reach, y_min - reach, x_max + reach, y_max + reach)
        return shapely.buffer(
            blocked_ground(grid, box), margin * _GRID_CHORD_GROWTH, quad_segs=_GRID_QUARTER_CHORDS
        )

    @cached_property
    def _inner_fences(self) -> Geometries:
        import shapely

        margin = (self.margin + 2 * self._step) * _CHORD_GROWTH
        return np.asarray(
            shapely.buffer(self.fences, -margin, quad_segs=_QUARTER_CHORDS), dtype=object
        )

    @property
    def _step(self) -> float:
        """The decimals of a place that is good enough to print, as a step [m]."""
        return 1e-3 if self.margin >= 0.05 else 1e-5

    def _rounded(self, place: Sequence[float]) -> tuple[float, float] | None:
        """The place in round numbers, if the robot may really be there."""
        decimals = round(-math.log10(self._step))
        xy = (round(place[0], decimals), round(place[1], decimals))
        if any(self.near_bounds([xy])) or any(self.near_fences([xy])):
            return None
        if any(self._near_squares([xy])):
            return None
        if len(self.boxes):
            around = self._tree.query(_window(xy, self.margin))
            distances = self._distances(_points([xy] * len(around)), around)
            if (distances < self.margin).any():
                return None
        return xy


def _points(places: Sequence[Sequence[float]]) -> Geometries:
    import shapely

    xy = np.array(places, dtype=float).reshape(-1, 2)
    return np.asarray(shapely.points(xy), dtype=object)


def _window(place: Sequence[float], reach: float) -> Any:
    """A square round a place, up to ``reach`` [m] to each side."""
    import shapely

    x, y = place
    return shapely.box(x - reach, y - reach, x + reach, y + reach)
