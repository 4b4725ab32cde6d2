"""Other homotopy classes: rows of taut paths, laid from the shortest to the longest.

A row has a taut path for every leg. Rows that pass something on another side come from the row
before them: where what was laid along it got stuck, or where a leg has another side to offer.
What is laid along a taut path is no shorter than it, so a row that would cost more than the best of
what was laid can't win, nor any that comes after it.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import count
from typing import Generic, Protocol, TypeVar

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.problem.method import Found
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.routing.route_problem import NO_BARRIERS, on_the_line
from viaspline.planning.routing.taut_path import TautPath
from viaspline.world.world import World

LEAST_GAIN = 1e-6  # part of the length by which another row has to be shorter
GAP_END = 1e-3  # distance at which the segment across a gap ends, in required distances
MAX_RAY_STEPS = 200  # of such a segment to either side


Laid = TypeVar("Laid")
LaidIn = TypeVar("LaidIn", contravariant=True)


class Price(Protocol[LaidIn]):
    """What is laid along rows is to have little of [m or s]."""

    def of(self, laid: LaidIn, /) -> float:
        """What it has."""
        ...

    def least(self, row: TautRow, /) -> float:
        """No less has anything that is laid along a row."""
        ...


@dataclass(frozen=True)
class TautRow:
    """A taut path for every leg.

    Attributes:
        taut_paths: One for each leg.
        closed: For each leg, segments that its taut path avoids, (b, 4).
    """

    taut_paths: tuple[TautPath, ...]
    closed: tuple[Floats, ...]

    @classmethod
    def of(cls, taut_paths: Iterable[TautPath]) -> TautRow:
        """The row with which nothing is avoided yet."""
        paths = tuple(taut_paths)
        return cls(paths, (NO_BARRIERS,) * len(paths))

    @cached_property
    def length(self) -> float:
        """[m]."""
        return sum(taut_path.length for taut_path in self.taut_paths)

    def is_same(self, other: TautRow) -> bool:
        """Whether every leg has the taut path of another row."""
        return all(
            mine is its or mine.is_same(its)
            for mine, its in zip(self.taut_paths, other.taut_paths, strict=True)
        )

    def with_leg(self, leg: int, taut_path: TautPath, closed: Floats = NO_BARRIERS) -> TautRow:
        """This row with another taut path for one leg."""
        return replace(
            self,
            taut_paths=(*self.taut_paths[:leg], taut_path, *self.taut_paths[leg + 1 :]),
            closed=(*self.closed[:leg], closed, *self.closed[leg + 1 :]),
        )

    def past_gap(self, leg: LegSearch, by: Floats) -> TautRow | None:
        """The row whose leg avoids the gap that it goes through beside a place ``by``, (2,) [m]."""
        gap = gap_across(leg.world, leg.requirements, self.taut_paths[leg.index], by)
        if gap is None:
            return None
        closed = np.vstack((self.closed[leg.index], gap))
        active = on_the_line(leg.world, *leg.ends, leg.requirements.required)
        other, _ = leg.shortest_allowed(active, closed)
        return self.with_leg(leg.index, other.value, closed) if isinstance(other, Found) else None


@dataclass(frozen=True)
class Attempt(Generic[Laid]):
    """What came of a row.

    Attributes:
        laid: What was laid along it; None where it got stuck.
        then: The rows that come after it, found when they are asked for.
    """

    laid: Laid | None
    then: Iterable[TautRow] = ()


def cheapest_laid(
    first: Iterable[TautRow],
    attempt: Callable[[TautRow, float], Attempt[Laid]],
    price: Price[Laid],
    best: Laid | None = None,
    max_rows: float = math.inf,
) -> Laid | None:
    """The best of what can be laid along rows, from the most promising row on.

    The rows that come after one are tried too where it got stuck, and where what was laid along it
    is the best so far.

    Args:
        first: The rows to begin with.
        attempt: Lays something along a row, if it can and that may cost less than what is there.
        price: What it is to have little of.
        best: What is there already.
        max_rows: Rows that are tried.
    """
    number = count()
    open_: list[tuple[float, int, TautRow]] = []
    seen: list[TautRow] = []

    def add(rows: Iterable[TautRow]) -> None:
        for row in rows:
            if not any(row.is_same(before) for before in seen):
                seen.append(row)
                heapq.heappush(open_, (price.least(row), next(number), row))

    add(first)
    tried, bound = 0, math.inf if best is None else price.of(best)
    while open_ and tried < max_rows and open_[0][0] < bound:
        tried += 1
        try:
            made = attempt(heapq.heappop(open_)[2], bound)
            if made.laid is not None:
                cost = price.of(made.laid)
                if not cost < bound * (1.0 - LEAST_GAIN):
                    continue
                best, bound = made.laid, cost
            add(made.then)
        except SpentBudgetError:
            if best is None:
                raise
            break
    return best


def gap_across(
    world: World, requirements: Requirements, taut_path: TautPath, by: Floats
) -> Floats | None:
    """The segment from what a taut path goes by to what is opposite [m], (1, 4).

    Where nothing is, it ends as far away as the path is long.

    Args:
        world: The known world.
        requirements: What is kept.
        taut_path: The path.
        by: A place on the surface of what it goes by [m], (2,).

    Returns:
        The segment; None where the path touches the place.
    """
    corners = taut_path.corners[:, [X, Y]]
    steps = np.diff(corners, axis=0)
    along = ((by - corners[:-1]) * steps).sum(axis=1) / (steps**2).sum(axis=1)
    feet = corners[:-1] + np.clip(along, 0.0, 1.0)[:, None] * steps
    foot = feet[np.linalg.norm(feet - by, axis=1).argmin()]
    gap = float(np.linalg.norm(foot - by))
    if gap < GAP_END * requirements.required:
        return None
    out = (foot - by) / gap
    ends = [
        _touched(world, requirements, foot, side * out, taut_path.length) for side in (-1.0, 1.0)
    ]
    return np.concatenate(ends)[None]


def _touched(
    world: World, requirements: Requirements, place: Floats, out: Floats, farthest: float
) -> Floats:
    """Where a ray from a place touches something."""
    along = 0.0
    for _ in range(MAX_RAY_STEPS):
        left = float(world.distance(place + along * out))
        if left <= GAP_END * requirements.required or along >= farthest:
            break
        along = min(along + left, farthest)
    return place + along * out
