"""The laws of a fleet along fixed paths: by priority, or by who comes first to each crossing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.late_share import arrivals_of
from viaspline.fleet.timing.forced_orders import forced_orders, timing_order
from viaspline.fleet.timing.law_search import FORESEEN, LawSearch
from viaspline.fleet.timing.rides import FleetRides
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.sooner_in_order import sooner_in_order
from viaspline.kernels.fleet.yielding_ride import CLEAR, timed_in_order

RIDES_EACH = 200
"""So many rides are looked for at a time, for laws of robots that can't let others pass."""
MANY = 50
"""Of so many robots who passes first is also settled where two would meet, in the order of time."""
LEAST_LATE_S = 0.5
"""Few robots that are less late in all, each weighed by its priority, keep their order [s],"""
LEAST_GAIN_S = 0.1
"""and so they do if another one saves less [s]: of two alike rounding would choose."""
MAX_IDLE = 5
"""How often that, or another order of all, is tried without serving more by it."""


@dataclass(frozen=True, eq=False)
class Timing:
    """Laws of those robots that could be timed.

    Attributes:
        laws: Of the fleet; those that could not be timed stand at their starts.
        blocked: Those that could not, each with a robot that is in its way.
    """

    laws: FleetLaws
    blocked: dict[int, int]

    def arrivals(self, courses: FleetCourses) -> Floats:
        """When each robot comes to its goal; infinite for those that have no law [s], (n,).

        Args:
            courses: The paths of the robots.
        """
        arrivals = arrivals_of(courses, self.laws)
        arrivals[list(self.blocked)] = np.inf
        return arrivals

    def rank(self, courses: FleetCourses, weight: Floats) -> tuple[int, float]:
        """How many have no law, and when the others arrive, weighed: less is better.

        Args:
            courses: The paths of the robots.
            weight: What a second of each robot counts, (n,): see ``priority_weights``.
        """
        arrivals = self.arrivals(courses)
        there = np.isfinite(arrivals)
        return len(self.blocked), float(weight[there] @ arrivals[there])


def time_paths(
    courses: FleetCourses,
    crossings: FleetCrossings,
    rides: FleetRides,
    priorities: Sequence[float],
    left_out: Sequence[int] = (),
    given: FleetLaws | None = None,
) -> Timing:
    """Time robots along their paths, by priority and by the orders that are forced.

    Among equals those with the longer way come first. For a robot that can't let others pass some
    of these are timed anew, after it. Where that doesn't help, it is timed before the one that it
    can't let pass, and all from the beginning. Those that came last would wait for all others: so
    who passes first is also settled where two would meet, in the order of time, and the better of
    both is taken; of few robots that is done where priority serves them all, and makes them late.
    Where no path passes another's start or resting place, every robot is served.

    Args:
        courses: Their paths.
        crossings: Where these come near each other.
        rides: How they drive alone.
        priorities: Who has more is let pass, (n,).
        left_out: Robots that get no law and stand at their starts.
        given: Laws of robots that have theirs already, and are let pass by the others.
    """
    given = standing_laws(courses) if given is None else given
    settled = [*left_out, *np.flatnonzero(given.packed.is_timed).tolist()]
    passages = passages_of(courses.packed, crossings.packed)
    asked = forced_orders(courses.packed, passages, rides.packed.vanishes)
    ranks = [(-p, -t) for p, t in zip(priorities, rides.alone.tolist(), strict=True)]
    is_small = given.packed.is_timed.size - len(settled) < MANY
    if is_small:
        found = _timed(courses, crossings, passages, rides, asked, ranks, left_out, given)
        if len(settled) == given.packed.is_timed.size:
            return found
    search = LawSearch.of(courses, crossings, passages, rides, priorities, settled)
    if is_small and not found.blocked:
        return _met_sooner(search, found, _laws_to_fill(given, left_out))
    if is_small:
        best = _given_laws(search, found.laws.packed)
    else:
        best = _by_meeting(search, _laws_to_fill(given, left_out))
        if not best.blocked:
            order = _order(asked, ranks, settled)
            return _sooner_of_both(search, best, _laws_to_fill(given, left_out), order)
        found = _timed(courses, crossings, passages, rides, asked, ranks, left_out, given)
        other = _given_laws(search, found.laws.packed)
        best = min(other, best, key=lambda one: one.rank(courses, search.weight))
    idle = 0
    while best.blocked and idle < MAX_IDLE:
        learned = [(robot, other) for robot, other in found.blocked.items() if other not in settled]
        pairs = np.unique(
            np.concatenate([asked, np.array(learned, np.int64).reshape(-1, 2)]), axis=0
        )
        if len(pairs) == len(asked):
            break
        asked = pairs
        found = _timed(courses, crossings, passages, rides, asked, ranks, left_out, given)
        idle += 1
        if len(found.blocked) < len(best.blocked):
            best, idle = found, 0
    return best


def _met_sooner(search: LawSearch, found: Timing, given: PackedLaws) -> Timing:
    """A timing that serves all, or one by who meets whom first that does as well and is sooner.

    Args:
        search: What the robots drive among.
        found: By priority.
        given: The laws that are given.
    """
    ends = (search.courses.packed.first[1:] - 1)[search.movable]
    weight, soonest = search.weight[search.movable], search.rides.laws.packed.arrive[ends]
    late, best = float(weight @ (found.laws.packed.arrive[ends] - soonest)), found
    if late < LEAST_LATE_S:
        return found
    for foreseen in (0.0, FORESEEN):
        laws = copied_laws(given)
        search.first_come(laws, foreseen)
        then = float(weight @ (laws.arrive[ends] - soonest)) if laws.is_timed.all() else np.inf
        if then < late - LEAST_GAIN_S:
            late, best = then, Timing(FleetLaws(laws), {})
    return best


def _by_meeting(search: LawSearch, laws: PackedLaws) -> Timing:
    """A timing by who meets whom first.

    Args:
        search: What the robots drive among.
        laws: Those that are given; written to.
    """
    search.first_come(laws)
    return _given_laws(search, laws)


def _sooner_of_both(search: LawSearch, best: Timing, laws: PackedLaws, order: Ints) -> Timing:
    """A timing of all robots, or that by priority, if this serves all as well and is sooner.

    Args:
        search: What the robots drive among.
        best: A timing.
        laws: Those that are given; written to.
        order: The others, in the order of their priorities, (m,).
    """
    ends = search.courses.packed.first[1:] - 1
    late = best.laws.packed.arrive[ends] - search.rides.laws.packed.arrive[ends]
    room = float(search.weight[order] @ late[order])
    if sooner_in_order(
        search.courses.packed, search.crossings.packed, search.passages, search.rides.packed,
        laws, order, search.weight, room,
    ):  # fmt: skip
        return Timing(FleetLaws(laws), {})
    return best


def _given_laws(search: LawSearch, laws: PackedLaws) -> Timing:
    """A timing in which others are timed anew for those without a law, as far as that helps."""
    given = copied_laws(laws)
    courses, passages = search.courses.packed, search.passages
    work = RIDES_EACH * (courses.distance.size + passages.other.size) // given.is_timed.size
    served, idle = 0, 0
    while not given.is_timed.all() and idle < MAX_IDLE:
        search.look(given, work)
        idle = 0 if given.is_timed.sum() > served else idle + 1
        served = int(given.is_timed.sum())
    return Timing(FleetLaws(given), _who_is_in_the_way(search, given))


def _who_is_in_the_way(search: LawSearch, laws: PackedLaws) -> dict[int, int]:
    """Time those that have no law yet after all others; whom the rest of them can't let pass."""
    left = np.flatnonzero(~laws.is_timed)
    if not left.size:
        return {}
    boxes = timed_in_order(
        search.courses.packed, search.crossings.packed, search.passages, search.rides.packed,
        laws, left,
    )  # fmt: skip
    return _in_the_way(search.crossings, left, boxes)


def _in_the_way(crossings: FleetCrossings, robots: Ints, boxes: Ints) -> dict[int, int]:
    """Whom robots can't let pass, by the boxes where they can't."""
    failed = boxes != CLEAR
    others = crossings.packed.other[boxes[failed]].tolist()
    return dict(zip(robots[failed].tolist(), others, strict=True))


def _laws_to_fill(given: FleetLaws, left_out: Sequence[int]) -> PackedLaws:
    """The given laws, to which those of all others but some robots are to be added."""
    laws = copied_laws(given.packed)
    laws.is_timed[list(left_out)] = True
    return laws


def _timed(
    courses: FleetCourses, crossings: FleetCrossings, passages: PackedPassages,
    rides: FleetRides, asked: Ints, ranks: Sequence[tuple[float, ...]], left_out: Sequence[int],
    given: FleetLaws,
) -> Timing:  # fmt: skip
    """One round: those that wait for each other in a circle come last, the foremost one first."""
    laws = _laws_to_fill(given, left_out)
    order = _order(asked, ranks, np.flatnonzero(laws.is_timed))
    boxes = timed_in_order(courses.packed, crossings.packed, passages, rides.packed, laws, order)
    return Timing(FleetLaws(laws), _in_the_way(crossings, order, boxes))


def _order(asked: Ints, ranks: Sequence[tuple[float, ...]], settled: Sequence[int] | Ints) -> Ints:
    """All but the settled robots, those that wait for each other in a circle last."""
    plan = timing_order(asked[~np.isin(asked, settled).any(axis=1)], ranks)
    circular = sorted(plan.circular.tolist(), key=lambda robot: ranks[robot])
    order = np.array([*plan.order.tolist(), *circular], np.int64)
    return order[~np.isin(order, settled)]


def copied_laws(laws: PackedLaws) -> PackedLaws:
    """Laws of their own, to write to."""
    return PackedLaws(
        laws.arrive.copy(), laws.leave.copy(), laws.speed.copy(), laws.is_timed.copy()
    )


def standing_laws(courses: FleetCourses) -> FleetLaws:
    """Laws that no robot has yet: all stand at their starts, and play no part."""
    packed = courses.packed
    arrive = np.full(packed.distance.size, np.inf)
    arrive[packed.first[:-1]] = -np.inf
    return FleetLaws(
        PackedLaws(
            arrive,
            np.full(packed.distance.size, np.inf),
            np.zeros(packed.distance.size),
            np.zeros(packed.reach.size, np.bool_),
        )
    )
