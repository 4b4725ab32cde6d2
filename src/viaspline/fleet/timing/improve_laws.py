"""Sooner laws for a fleet, for as much time as one wants to spend."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.timing.law_search import FORESEEN, LawSearch
from viaspline.fleet.timing.rides import FleetRides
from viaspline.fleet.timing.time_paths import MANY, Timing, copied_laws
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.passages import passages_of

WORK_PER_S = 3_000_000
"""How many nodes and passages a search looks at in a second of the reference machine."""
TIMED_ANEW_SHARE = 0.5
"""So much of that may go to timing all robots anew, of many,"""
ORDERS_WORK = 0.1
"""what a node or a passage counts where orders are settled or turned: others are looked at one by
one,"""
CHANCE_S = 0.3
"""and up to how much an order may hold up more there and be taken all the same [s]."""
ROUND_S = 0.25
"""After so much work it says how far it is."""


def improve_laws(
    courses: FleetCourses,
    crossings: FleetCrossings,
    rides: FleetRides,
    timing: Timing,
    priorities: Sequence[float],
    seconds: float,
    progress: Callable[[float], None] | None = None,
    settled: Sequence[int] = (),
) -> Timing:
    """The timing with sooner laws.

    Seconds count work, not the clock: the same fleet gets the same laws on every machine.

    Args:
        courses: The paths of the robots.
        crossings: Where these come near each other.
        rides: How they drive alone.
        timing: Where it begins.
        priorities: See ``time_paths``, (n,).
        seconds: What may be spent, on the reference machine.
        progress: Called with the share that is spent.
        settled: Robots that have their laws before the others, and keep them.

    Returns:
        A timing of the same robots (those that are blocked stand as they did), in which the
        lateness of all, weighed by priority, is no more.
    """
    given = timing.laws.packed
    laws = copied_laws(given)
    passages = passages_of(courses.packed, crossings.packed)
    fixed = sorted({*timing.blocked, *settled})
    search = LawSearch.of(courses, crossings, passages, rides, priorities, fixed)
    work, rounds, spent = int(seconds * WORK_PER_S), 0, 0
    if np.count_nonzero(search.movable) >= MANY:
        laws, spent = _timed_anew(search, laws, int(TIMED_ANEW_SHARE * work))
    while spent < work:
        most = min(work - spent, int(ROUND_S * WORK_PER_S))
        if rounds % 2:  # each finds what the other one doesn't
            spent += search.look(laws, most)
        else:
            spent += max(int(ORDERS_WORK * search.turn(laws, int(most / ORDERS_WORK))), 1)
        rounds += 1
        if progress is not None:
            progress(min(spent / work, 1.0))
    return replace(timing, laws=FleetLaws(laws))


def timed_ahead(
    courses: FleetCourses, crossings: FleetCrossings, rides: FleetRides, given: FleetLaws,
    priorities: Sequence[float], times: int,
) -> Timing | None:  # fmt: skip
    """The soonest of some timings in which orders are settled with what lies ahead in view.

    Args:
        courses: The paths of the robots.
        crossings: Where these come near each other.
        rides: How they drive alone.
        given: Laws of robots that have theirs before the others, and keep them.
        priorities: See ``time_paths``, (n,).
        times: How many.

    Returns:
        None where each of these leaves robots without a law.
    """
    passages = passages_of(courses.packed, crossings.packed)
    settled = np.flatnonzero(given.packed.is_timed).tolist()
    search = LawSearch.of(courses, crossings, passages, rides, priorities, settled)
    best, chance = None, 0.0
    for _ in range(times):
        tried = copied_laws(given.packed)
        search.first_come(tried, FORESEEN, chance)
        chance = CHANCE_S
        if tried.is_timed.all() and (best is None or _gain(search, best, tried) > 0.0):
            best = tried
    return None if best is None else Timing(FleetLaws(best), {})


def _gain(search: LawSearch, laws: PackedLaws, others: PackedLaws) -> float:
    """How much sooner all that may be changed arrive by other laws, weighed by priority [s]."""
    ends = (search.courses.packed.first[1:] - 1)[search.movable]
    return float(search.weight[search.movable] @ (laws.arrive[ends] - others.arrive[ends]))


def _timed_anew(search: LawSearch, laws: PackedLaws, work: int) -> tuple[PackedLaws, int]:
    """All robots timed anew, each time with other orders, as often as there is work for it.

    Args:
        search: What they drive among.
        laws: That they have.
        work: How many nodes and passages may be looked at.

    Returns:
        The soonest laws, those that there were among them, and how many were looked at.
    """
    best, each, spent, chance = laws, 0, 0, 0.0
    while spent + each <= work:
        tried = copied_laws(laws)
        tried.is_timed[search.movable] = False
        each = int(ORDERS_WORK * search.first_come(tried, FORESEEN, chance))
        spent, chance = spent + each, CHANCE_S
        if tried.is_timed[search.movable].all() and _gain(search, best, tried) > 0.0:
            best = tried
    return best, spent
