"""Where and how a path that leads round something takes up the old one again.

A turn that has a via point in its middle begins before that. A path that takes up the old one at
the via point has to get from its own line into the middle of the turn; one that takes it up where
its last blocked span ends turns as the old one did. Behind what is close to that end the first is
the gentler one, so that both are laid where the first is late.

A robot that stands at the via point in any case may turn there: where it comes from another side
than it did on the old path, that spares it a loop before its station.

Tested through ``planning/replanning/test_taking_up``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.path import Path, PathVia
from viaspline.errors import PlanningError
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.driving_time import driving_time
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.replanning.departure import rolling
from viaspline.planning.replanning.rejoining import Rejoin, may_turn, merging, turning
from viaspline.planning.replanning.stretch import Stretch
from viaspline.planning.replanning.way_ahead import WayAhead

LITTLE = 1e-2
"""Part of its time that a path may lose to slow turns, or of its length by which it may be longer
than the old one, without that another is looked for."""

WORK_S = 0.012
"""What may be spent on a better one [s of the reference machine]: several times what it takes where
nothing but a disc has to get through."""

LEFT_S = 1.5 * WORK_S
"""It isn't sought where less is left: a path that was found has to be proven and timed, too."""


def best_taken_up(
    way: WayAhead, stretch: Stretch, blocked: NDArray[np.intp], found: Solution
) -> Solution:
    """The best of a path round something and those that take up the old path in other ways.

    Args:
        way: What is ahead.
        stretch: What was laid anew.
        blocked: The spans in it that something stands in the way of, in order.
        found: What came of it.

    Returns:
        The path that is driven in the least time, or is the shortest, as the mission asks.
    """
    end = way.path.domain[1] if stretch.tail is None else stretch.tail.u
    others = list(_others(way, stretch, float(blocked[-1]) + 1.0, end))
    if not others:
        return found
    rest = len(way.path.spans) - round(end)  # of the old path, that stays in any case
    before, cost = (
        _Cost.of(path, stretch.u, rest, way.requirements) for path in (way.path, found.path)
    )
    budget = way.requirements.budget
    for tried, rejoin_by in others:
        if cost.is_near(before) or (budget is not None and budget.left < LEFT_S):
            break
        try:
            with _some_work(budget) as one:
                requirements = way.requirements.within(one)
                other = replace(way, requirements=requirements).joined(tried, rolling, rejoin_by)
        except PlanningError:
            continue
        its_cost = _Cost.of(other.path, stretch.u, rest, way.requirements)
        if its_cost.value < cost.value:
            found, cost = other, its_cost
    return found


def _others(
    way: WayAhead, stretch: Stretch, until: float, end: float
) -> Iterator[tuple[Stretch, Rejoin]]:
    """Where and how else the old path may be taken up: by turning at its end, or sooner."""
    if may_turn(stretch.tail, way.requirements):
        yield stretch, turning
    if until < end:
        yield _taken_up_at(way.path, until, stretch), merging


def _taken_up_at(path: Path, u: float, stretch: Stretch) -> Stretch:
    """A stretch that ends sooner: at a joint of the old path's spans."""
    place = tuple(np.asarray(path.evaluate(u)).tolist())
    ahead = tuple(via for via in stretch.ahead if via.u < u)
    return Stretch(stretch.u, ahead, PathVia("the old path", place, "detour", u))


@dataclass(frozen=True)
class _Cost:
    """What a stretch of a path is chosen by.

    Attributes:
        value: That [s or m].
        least: The same if it were driven at full speed, or for its length [s or m].
    """

    value: float
    least: float

    @classmethod
    def of(cls, path: Path, u: float, rest: int, requirements: Requirements) -> _Cost:
        """The cost from a parameter on, up to so many spans before the end.

        Args:
            path: The old path, or a new one that begins as that does.
            u: Where the stretch begins.
            rest: Spans behind its end.
            requirements: What to keep, and what to have little of.
        """
        end, first = len(path.spans) - rest, math.floor(u)
        length = float(path.distance(float(end)) - path.distance(float(first)))
        objective = requirements.objective
        if not objective.is_time:
            return cls(length, length)
        rests = np.zeros(end - first + 1, np.bool_)
        rests[-1] = rest == 0
        for via in path.vias:
            if via.dwell > 0.0 and first <= via.u <= end:
                rests[round(via.u) - first] = True
        time = driving_time(path.spans[first:end], objective.pace, rests)
        return cls(time, length / objective.pace.speed)

    def is_near(self, before: _Cost) -> bool:
        """Whether hardly more is lost than what its length costs beyond that of the old path."""
        if self.value == self.least:
            return self.value <= (1.0 + LITTLE) * before.value
        return self.value - self.least <= before.value - before.least + LITTLE * self.value


def _some_work(budget: WorkBudget | None) -> AbstractContextManager[WorkBudget]:
    """What a try that may be spared may spend of a budget, or of none."""
    return nullcontext(WorkBudget(WORK_S)) if budget is None else budget.share(WORK_S)
