"""Points of a route that are one place, where the route has to go from one to another.

In a given order that is a point and the one before it. The shortest order brings any two together.

Tested through ``mission/test_model`` and ``mission/space/test_spatial_checks``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np

from viaspline.mission.unplaced_faults import Path, UnplacedFault, spell

SAME_POINT_M: Final = 1e-6
"""Points of the route nearer to each other than this are one point."""


class PointPlace(NamedTuple):
    """Where a point of the route is.

    Attributes:
        path: Where it is said.
        place: It [m], of two or three dimensions.
        rank: Its number among the points, 0 for the start.
    """

    path: Path
    place: tuple[float, ...]
    rank: int

    @property
    def is_via(self) -> bool:
        """Whether an order may put it elsewhere."""
        return self.path[:2] == ("route", "via")


def same_place_faults(
    points: Sequence[PointPlace], *, in_given_order: bool, closed: bool
) -> Iterator[UnplacedFault]:
    """The faults of points that are where another one is that may be served right before.

    Args:
        points: Those whose places are known, as they are given.
        in_given_order: Whether the via points are served as they are given.
        closed: Whether the route returns to its start.
    """
    told: set[int] = set()
    for before, point in pairwise(points):
        if point.rank == before.rank + 1 and _gap(before, point) < SAME_POINT_M:
            told.add(point.rank)
            yield same_place(point.path, before.path, _gap(before, point))
    if closed and len(points) > 2 and points[0].rank == 0 and points[-1].rank not in told:
        start, point = points[0], points[-1]
        if _gap(start, point) < SAME_POINT_M:
            told.add(point.rank)
            problem = f"is the same place as {_named(start.path)}, to which a closed route returns "
            yield UnplacedFault((*point.path, "at"), f"{problem}anyway", "leave it out")
    if not in_given_order:
        for before, point in _nearest(points):
            if point.rank not in told and _gap(before, point) < SAME_POINT_M:
                told.add(point.rank)
                yield _brought_together(point, before)


def same_place(path: Path, before: Path, gap: float) -> UnplacedFault:
    """The fault of a point that is where the one before it is.

    Args:
        path: The point.
        before: The one before it.
        gap: How far they are apart [m].
    """
    what = f"is {_apart(gap)} the same place as {_named(before)}, just before it: the route needs "
    return UnplacedFault((*path, "at"), f"{what}distinct points", _REMEDY)


_REMEDY: Final = "leave out one of the two (dwell_s makes the robot wait there)"


def _brought_together(point: PointPlace, other: PointPlace) -> UnplacedFault:
    what = f"is {_apart(_gap(other, point))} the same place as {_named(other.path)}, and the "
    what += "shortest order serves one right after the other: the route needs distinct points"
    return UnplacedFault((*point.path, "at"), what, _REMEDY)


def _apart(gap: float) -> str:
    return "exactly" if gap == 0 else f"to within {gap:.1g} m"


def _named(path: Path) -> str:
    return "the end of take-off" if path[-1] == "takeoff" else spell(path)


def _gap(a: PointPlace, b: PointPlace) -> float:
    """The distance of two points [m]; infinite if they are of different dimensions."""
    return math.dist(a.place, b.place) if len(a.place) == len(b.place) else math.inf


def _nearest(points: Sequence[PointPlace]) -> Iterator[tuple[PointPlace, PointPlace]]:
    """Every point that another one is nearest to, and that one: the earlier first, each pair once.

    Start and goal may be one place, with via points between them.
    """
    from scipy.spatial import cKDTree

    if len({len(point.place) for point in points}) != 1 or len(points) < 2:
        return
    places = np.array([point.place for point in points])
    _, found = cKDTree(places).query(places, 2)
    rows = enumerate(np.asarray(found).tolist())
    pairs = {(min(k, near), max(k, near)) for k, row in rows for near in row if near != k}
    for first, last in sorted(pairs):
        if points[first].is_via or points[last].is_via:
            yield points[first], points[last]
