"""The strip of a corridor: its middle line, its edges, and the area between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Final

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.mission.fields import Corners
from viaspline.mission.route_spec import Route

if TYPE_CHECKING:
    import shapely

MAX_SLIVER_M2: Final = 1e-9
"""Holes of such an area are rounding."""
FAN_STEP_RAD: Final = 0.1
"""From chord to chord round a corner."""
MAX_WINDOW_ROWS: Final = 200
"""How many rows before and after a place are looked at."""


@dataclass(frozen=True, eq=False)
class Strip:
    """A line with a width to either side, driven from its first point to its last.

    Attributes:
        middle: The line's points [m], (n, 2).
        right: The edge on the right, a point for each of the line's [m], (n, 2).
        left: The edge on the left [m], (n, 2).
        closed: Whether the last point is followed by the first.

    >>> strip = Strip.of_rows([[0, 0, 2, 1], [10, 0, 2, 1]], closed=False)
    >>> strip.left.tolist(), strip.right.tolist()
    ([[0.0, 1.0], [10.0, 1.0]], [[0.0, -2.0], [10.0, -2.0]])
    """

    middle: Floats
    right: Floats
    left: Floats
    closed: bool

    @classmethod
    def of_rows(cls, rows: object, *, closed: bool) -> Strip:
        """The strip of rows x, y, right, left [m], (n, 4); at right angles to the line's chords."""
        table = np.array(rows, np.float64)
        middle = table[:, :2]
        if closed:
            along = np.roll(middle, -1, axis=0) - np.roll(middle, 1, axis=0)
        else:
            around = np.vstack((2 * middle[0] - middle[1], middle, 2 * middle[-1] - middle[-2]))
            along = around[2:] - around[:-2]
        size = np.linalg.norm(along, axis=1)
        along = along / np.where(size > 0.0, size, 1.0)[:, None]
        across = np.column_stack((-along[:, 1], along[:, 0]))
        return cls(middle, middle - across * table[:, 2:3], middle + across * table[:, 3:4], closed)

    @cached_property
    def folds(self) -> tuple[tuple[int, str], ...]:
        """Where an edge runs against its line: (row from 0, ``left`` or ``right``)."""
        run = self._steps(self.middle)
        found = [
            (int(row), name)
            for name, edge in (("right", self.right), ("left", self.left))
            for row in np.flatnonzero(np.einsum("ij,ij->i", self._steps(edge), run) < 0.0)
        ]
        return tuple(sorted(found))

    def _steps(self, points: Floats) -> Floats:
        following = np.roll(points, -1, axis=0) if self.closed else points[1:]
        return np.asarray(following - points[: len(following)])

    @cached_property
    def area(self) -> shapely.Polygon:
        """What lies between the edges, from row to row.

        An open strip goes straight on beyond its ends by the larger of its widths there. Where a
        strip crosses itself, the area is what any part of it covers.
        """
        import shapely

        strip = self if self.closed else self._extended()
        rings = strip.right, strip.left
        whole = shapely.Polygon(np.vstack((rings[0], rings[1][::-1])))
        if self.closed:
            outer, inner = sorted(map(shapely.Polygon, rings), key=_area, reverse=True)
            whole = shapely.Polygon(outer.exterior, [inner.exterior])
        if whole.is_valid and not self.folds:
            return whole
        first = np.arange(len(strip.middle) - (not self.closed))
        then = (first + 1) % len(strip.middle)
        right, left = rings
        corners = np.stack((right[first], right[then], left[then], left[first]), axis=1)
        return _joined([*np.asarray(shapely.make_valid(shapely.polygons(corners)))])

    def _extended(self) -> Strip:
        """With one more row before the first and after the last."""
        parts = []
        for at, before in ((0, 1), (-1, -2)):
            ahead = self.middle[at] - self.middle[before]
            size = np.linalg.norm(ahead)
            wide = max(
                np.linalg.norm(edge[at] - self.middle[at]) for edge in (self.right, self.left)
            )
            parts.append(ahead * (wide / size if size > 0.0 else 0.0))
        first, last = parts
        middle, right, left = (
            np.vstack((edge[:1] + first, edge, edge[-1:] + last))
            for edge in (self.middle, self.right, self.left)
        )
        return Strip(middle, right, left, self.closed)

    @cached_property
    def widths(self) -> Floats:
        """From edge to edge at each row [m], (n,)."""
        return np.asarray(np.linalg.norm(self.left - self.right, axis=1))

    @cached_property
    def along(self) -> Floats:
        """Distance of each row along the middle line [m], (n,)."""
        run = np.linalg.norm(np.diff(self.middle, axis=0), axis=1)
        return np.concatenate(([0.0], np.cumsum(run)))

    def nearest_row(self, place: object) -> int:
        """The row that is nearest to a place [m]."""
        away = self.middle - np.array(place, np.float64)[:2]
        return int((away * away).sum(axis=1).argmin())

    def rows_within(self, distance: float) -> int:
        """The most rows that lie within a distance [m] of a row, to one side of it."""
        along = self.along
        after = np.searchsorted(along, along + distance, side="right") - np.arange(along.size)
        return int(min(after.max() + 1, MAX_WINDOW_ROWS))

    def follow(self, places: Floats, rows: Ints, window: int) -> Ints:
        """The row that is nearest to each place, not far from the row that was.

        Args:
            places: [m], (k, 2).
            rows: Near which rows they are, (k,).
            window: How many rows away from it they may be.
        """
        near = rows[:, None] + np.arange(-window, window + 1)
        count = len(self.middle)
        near = near % count if self.closed else np.clip(near, 0, count - 1)
        gap = ((self.middle[near] - places[:, None, :]) ** 2).sum(axis=2)
        return np.asarray(near[np.arange(len(rows)), gap.argmin(axis=1)])

    def track(self, places: Floats, first: int, window: int) -> Ints:
        """The row that is nearest to each place of a line, from row ``first`` on, (k,)."""
        rows = np.empty(len(places), np.int64)
        row = np.array([first], np.int64)
        for k in range(len(places)):
            row = self.follow(places[k : k + 1], row, window)
            rows[k] = row[0]
        return rows

    def piece(self, rows: Ints) -> Strip:
        """The open strip of some of the rows."""
        return Strip(self.middle[rows], self.right[rows], self.left[rows], closed=False)

    def finer(self, step: float) -> Strip:
        """The strip with rows at most a step apart [m]."""
        middle, right, left = (
            self._refined(edge, step) for edge in (self.middle, self.right, self.left)
        )
        return Strip(middle, right, left, self.closed)

    def _refined(self, edge: Floats, step: float) -> Floats:
        run = np.linalg.norm(self._steps(self.middle), axis=1)
        parts = np.maximum(np.ceil(run / step - 1e-9), 1.0).astype(np.int64)
        start = np.repeat(np.arange(parts.size), parts)
        share = (np.arange(start.size) - np.repeat(np.cumsum(parts) - parts, parts)) / parts[start]
        fine = edge[start] + share[:, None] * self._steps(edge)[start]
        return fine if self.closed else np.vstack((fine, edge[-1:]))


def _area(polygon: shapely.Polygon) -> float:
    return float(polygon.area)


def _joined(parts: Sequence[shapely.Geometry]) -> shapely.Polygon:
    """The union of shapes that hang together, without what is left of it by rounding."""
    import shapely

    union = shapely.union_all(parts)
    areas = [part for part in shapely.get_parts(union) if part.geom_type == "Polygon"]
    whole = max(areas, key=_area)
    holes = [ring for ring in whole.interiors if shapely.Polygon(ring).area > MAX_SLIVER_M2]
    return shapely.Polygon(whole.exterior, holes)


def around(points: object, right: float, left: float, *, closed: bool) -> shapely.Polygon:
    """What lies within a width to either side of a polyline.

    Corners are rounded on their outside, by chords that cut into the arc; an open line goes
    straight on beyond its ends by the larger of the widths. Where parts of it come close to each
    other, the area is what any of them covers.

    Args:
        points: [m], (n, 2), each different from the one before.
        right: [m].
        left: [m].
        closed: Whether the last point is followed by the first.

    >>> area = around([[0, 0], [10, 0]], right=1, left=2, closed=False)
    >>> area.bounds, area.area
    ((-2.0, -1.0, 12.0, 2.0), 42.0)
    """
    import shapely

    line = np.array(points, np.float64)[:, :2]
    line = np.vstack((line, line[:1])) if closed else line
    steps = np.diff(line, axis=0)
    steps /= np.linalg.norm(steps, axis=1)[:, None]
    across = np.column_stack((-steps[:, 1], steps[:, 0]))
    first, last = line[:-1].copy(), line[1:].copy()
    if not closed:
        first[0] -= max(right, left) * steps[0]
        last[-1] += max(right, left) * steps[-1]
    sides = [
        first - right * across,
        last - right * across,
        last,  # a corner, so that what is round it has whole edges in common
        last + left * across,
        first + left * across,
        first,
    ]
    parts = [*np.asarray(shapely.polygons(np.stack(sides, axis=1)))]
    for k in range(0 if closed else 1, len(steps)):
        before, after = steps[k - 1], steps[k]
        turn = np.arctan2(before[0] * after[1] - before[1] * after[0], before @ after)
        width, normal = (-right, across[k - 1]) if turn > 0.0 else (left, across[k - 1])
        if abs(turn) < 1e-12:
            continue
        angles = np.linspace(0.0, turn, max(2, int(abs(turn) / FAN_STEP_RAD) + 2))[1:-1]
        turned = np.column_stack(
            (
                np.cos(angles) * normal[0] - np.sin(angles) * normal[1],
                np.sin(angles) * normal[0] + np.cos(angles) * normal[1],
            )
        )
        arc = np.vstack((normal, turned, across[k]))
        parts.append(shapely.Polygon(np.vstack((line[k], line[k] + width * arc))))
    return _joined(parts)


def has_line(route: Route) -> bool:
    """Whether a route has a corridor with a line of its own, along which the path is laid."""
    return route.corridor is not None and route.corridor.line is not None


def strip_of(route: Route) -> Strip | None:
    """The strip of a route whose corridor has a line of its own; None for others."""
    corridor = route.corridor
    if corridor is None or corridor.line is None:
        return None
    return Strip.of_rows(corridor.line, closed=route.closed)


def corridor_area(route: Route) -> shapely.Polygon | None:
    """What the path of a route stays inside of; None without a corridor."""
    corridor = route.corridor
    strip = strip_of(route)
    if strip is not None:
        return strip.area
    if corridor is None or corridor.left_m is None or corridor.right_m is None:
        return None
    points = [via.at for _, via in route.points()]
    return around(points, corridor.right_m, corridor.left_m, closed=route.closed)


def corridor_rings(route: Route) -> tuple[Corners, ...]:
    """The outer ring of a route's corridor, then the holes in it [m]; nothing without one."""
    area = corridor_area(route)
    return () if area is None else rings_of(area)


def rings_of(area: shapely.Polygon) -> tuple[Corners, ...]:
    """The outer ring of an area, then its holes [m]; no last point repeats the first."""
    rings = (area.exterior, *area.interiors)
    return tuple(tuple((x, y) for x, y in ring.coords[:-1]) for ring in rings)
