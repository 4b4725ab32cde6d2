"""Sooner laws for a fleet, for as much time as one wants to spend."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.timing.law_search import LawSearch
from viaspline.fleet.timing.rides import FleetRides
from viaspline.fleet.timing.time_paths import Timing
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.passages import passages_of

WORK_PER_S = 3_000_000
"""How many nodes and passages a search looks at in a second of the reference machine."""
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
    laws = PackedLaws(
        given.arrive.copy(), given.leave.copy(), given.speed.copy(), given.is_timed.copy()
    )
    passages = passages_of(courses.packed, crossings.packed)
    fixed = sorted({*timing.blocked, *settled})
    search = LawSearch.of(courses, crossings, passages, rides, priorities, fixed)
    spent, work, rounds = 0, int(seconds * WORK_PER_S), 0
    while spent < work:
        look = search.look if rounds % 2 else search.turn  # each finds what the other one doesn't
        spent += look(laws, min(work - spent, int(ROUND_S * WORK_PER_S)))
        rounds += 1
        if progress is not None:
            progress(min(spent / work, 1.0))
    return replace(timing, laws=FleetLaws(laws))
