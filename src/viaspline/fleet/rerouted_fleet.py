"""Other paths for robots that wait for long, or can't be timed, along the paths that they have.

The pair that costs most is looked at: the one that passes second is laid off the stretch on which
the first one is in its way, then the first one off that of the second. All are timed anew; the path
is kept if more are served by it, or the same number with less delay. This is a large-neighbourhood
search with one robot as the neighbourhood.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from viaspline.fleet.laying.kept_paths import KeptPaths, PathAlone
from viaspline.fleet.laying.lay_round_stretch import lay_round_stretch, laying_cost
from viaspline.fleet.precedences import precedences_of
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.timing.law_search import priority_weights
from viaspline.kernels.arrays import Floats, Ints
from viaspline.planning.problem.work_budget import WorkBudget

LAYINGS_A_TRY = 2.0
"""What a try costs, in layings of a path: it is laid alone, and among resting places."""
BOXES_A_S = 800_000
"""Boxes of crossings that are timed in a second of the reference machine."""
SHORTEST_WAIT_S = 1.0
"""Waits that are shorter are left as they are [s]."""
MOST_SHARE = 0.25
"""Of what may be spent, that one try may spend on finding a path at all."""
LEAST_GAIN_S = 0.5
"""A path that saves less in all isn't taken [s]."""


@dataclass(frozen=True)
class ContestedStretch:
    """A stretch on which one robot is in another one's way.

    Attributes:
        robot: That has to keep off it.
        other: On whose path it is.
        between: From where to where along that path [m].
    """

    robot: int
    other: int
    between: tuple[float, float]


def rerouted_fleet(
    timed: TimedFleet, kept: KeptPaths, separation: float, budget: float, polish: float = 0.0,
    progress: Callable[[float], None] | None = None,
) -> TimedFleet:  # fmt: skip
    """A fleet of which some robots take other paths, so that more are served, or all sooner.

    Where some aren't served, only these are looked at, and it ends once all are.

    Args:
        timed: Along the paths that were laid.
        kept: What was found out while these were laid.
        separation: Free space between any two bodies [m].
        budget: What may be spent [s of the reference machine].
        polish: For so much of it sooner orders are sought with each path that is tried [s].
        progress: Called with the share that is spent.

    Returns:
        A fleet of the same robots, of which no fewer are served.
    """
    best, tried, spent = timed, set[tuple[int, int, int, int]](), 0.0
    asked = timed.ways.rides.alone.copy()
    score = _score(best, asked)
    while True:
        stretch = next((one for one in _worst(best) if _key(one) not in tried), None)
        if stretch is None:
            return best
        spent += try_cost(best, stretch.robot)
        if spent > budget:
            return best
        if progress is not None:
            progress(spent / budget)
        tried.add(_key(stretch))
        work = WorkBudget(min(MOST_SHARE * budget, budget - spent))
        found = _rerouted(best, stretch, kept, separation, work)
        spent += work.spent
        if found is None:
            continue
        then = _score(found, asked)
        if polish > 0.0 and then[0] <= score[0]:
            found = found.improved(polish)
            then = _score(found, asked)
            spent += polish
        if then[0] < score[0] or (then[0] == score[0] and then[1] < score[1] - LEAST_GAIN_S):
            best, score = found, then
            if timed.blocked and not best.blocked:
                return best


def try_cost(timed: TimedFleet, robot: int) -> float:
    """About what it costs to try another path for a robot [s of the reference machine]."""
    boxes = len(timed.ways.crossings.packed.cell)
    return LAYINGS_A_TRY * laying_cost(timed.ways.planar[robot]) + boxes / BOXES_A_S


def _key(stretch: ContestedStretch) -> tuple[int, int, int, int]:
    low, high = stretch.between
    return stretch.robot, stretch.other, round(low), round(high)


def _score(timed: TimedFleet, asked: Floats) -> tuple[int, float]:
    """How many aren't served, and how late the others are in all, weighed by priority [s]."""
    ways = timed.ways
    weight = priority_weights([one.priority for one in ways.members])
    late = timed.arrivals() - ways.rides.packed.depart - asked
    return len(timed.timing.blocked), float((weight * np.where(np.isfinite(late), late, 0.0)).sum())


def _worst(timed: TimedFleet) -> Iterator[ContestedStretch]:
    """Stretches on which robots are in each other's way, those that cost most first."""
    ways, laws = timed.ways, timed.timing.laws
    packed = ways.crossings.packed
    for robot, other in sorted(timed.timing.blocked.items()):
        of_both = (packed.robots == sorted((robot, other))).all(axis=1)
        for k in np.flatnonzero(of_both).tolist():
            yield from _either(packed.robots[k], packed.span[k], robot)
    if timed.timing.blocked:
        return
    passings = precedences_of(ways.courses, ways.crossings, laws, ways.rides.laws)
    order = sorted(range(len(passings)), key=lambda k: -passings[k].waits_s)
    for crossing in order:
        one = passings[crossing]
        if one.waits_s < SHORTEST_WAIT_S:
            return
        second = ways.courses.names.index(one.second)
        yield from _either(packed.robots[crossing], packed.span[crossing], second)


def _either(robots: Ints, span: Floats, first: int) -> Iterator[ContestedStretch]:
    """One robot kept off the other one's stretch, then the other way round."""
    lower, upper = robots.tolist()
    a, b, c, d = span.tolist()
    both = [ContestedStretch(lower, upper, (c, d)), ContestedStretch(upper, lower, (a, b))]
    yield from sorted(both, key=lambda one: one.robot != first)


def _rerouted(
    timed: TimedFleet, stretch: ContestedStretch, kept: KeptPaths, separation: float,
    work: WorkBudget,
) -> TimedFleet | None:  # fmt: skip
    """The fleet with one robot off a stretch of another one's path; None if none is found."""
    ways, robot, other = timed.ways, stretch.robot, stretch.other
    name = ways.courses.names[robot]
    alone = kept.alone[name]
    if not isinstance(alone, PathAlone):
        return None
    reach = ways.courses.packed.reach
    found = lay_round_stretch(
        alone, name, float(reach[robot]), kept.rests, ways.planar[other], float(reach[other]),
        stretch.between, work,
    )  # fmt: skip
    if found is None:
        return None
    led = ways.with_path(robot, found, separation)
    anew = TimedFleet.by_priority(led)
    among = timed.with_ways(led, robot)
    return min((among, anew), key=lambda one: _score(one, ways.rides.alone))
