"""Robots with paths and laws: by priority, or by the order of a lattice.

Tested through ``fleet/test_plan_fleet``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from viaspline.fleet.courses import FleetCourses, courses_of
from viaspline.fleet.crossing_paths import CrossingPaths
from viaspline.fleet.crossings import FleetCrossings, crossings_of
from viaspline.fleet.lattice_order.lattice_paths import SHAPES, lattice_paths
from viaspline.fleet.lattice_order.no_lattice_order import NoLatticeOrder
from viaspline.fleet.lattice_order.time_in_order import time_in_order
from viaspline.fleet.renewed_courses import renewed_courses
from viaspline.fleet.renewed_crossings import renewed_crossings
from viaspline.fleet.timing.improve_laws import improve_laws
from viaspline.fleet.timing.rides import FleetRides, rides_of
from viaspline.fleet.timing.time_paths import Timing, standing_laws, time_paths
from viaspline.fleet.timing.timed_trajectory import timed_trajectory
from viaspline.kernels.fleet.yielding_ride import CLEAR, timed_in_order
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.planner import Plan

MOST_TRIED_AGAIN = 40
"""Robots that stand at their starts and are tried once more when others stand there too."""


@dataclass(frozen=True, eq=False)
class FleetWays:
    """The paths of robots, and where they come near each other.

    Attributes:
        members: The robots.
        plans: Their paths, with the laws of robots that are alone, in the order of the members.
        courses: These paths, cut into cells.
        crossings: Where they come near each other.
        rides: How each robot drives alone.
    """

    members: tuple[FleetMember, ...]
    plans: tuple[Plan, ...]
    courses: FleetCourses
    crossings: FleetCrossings
    rides: FleetRides

    @classmethod
    def of(cls, fleet: Fleet, paths: CrossingPaths) -> FleetWays:
        """The ways of those robots of a fleet that have a path.

        Args:
            fleet: What is asked for.
            paths: Of the fleet.
        """
        plans = paths.laid.plans
        members = tuple(one for one in fleet.members if one.name in plans)
        rides = rides_of(members, list(plans.values()), paths.courses)
        return cls(members, tuple(plans.values()), paths.courses, paths.crossings, rides)

    def along(self, plans: Mapping[str, Plan], separation: float) -> FleetWays:
        """The ways of the same robots along other paths.

        Args:
            plans: By name, in the order of the robots.
            separation: Free space between any two bodies [m].
        """
        courses = courses_of(plans, separation)
        laid = tuple(plans.values())
        rides = rides_of(self.members, laid, courses)
        return FleetWays(self.members, laid, courses, crossings_of(courses), rides)

    def with_path(self, robot: int, plan: Plan, separation: float) -> FleetWays:
        """The ways of the same robots, one of which takes another path.

        What each takes alone stays as it was: along the path that it had.

        Args:
            robot: Which one.
            plan: Its path, with the law that it would drive alone.
            separation: Free space between any two bodies [m].
        """
        laid = (*self.plans[:robot], plan, *self.plans[robot + 1 :])
        changed = np.array([robot], np.int64)
        names = [one.name for one in self.members]
        by_name = dict(zip(names, laid, strict=True))
        courses = renewed_courses(self.courses, by_name, separation, changed)
        crossings = renewed_crossings(self.crossings, self.courses, courses, changed)
        rides = replace(rides_of(self.members, laid, courses), alone=self.rides.alone)
        return FleetWays(self.members, laid, courses, crossings, rides)


@dataclass(frozen=True, eq=False)
class TimedFleet:
    """Robots with paths, and when they drive along them.

    Attributes:
        ways: Their paths.
        timing: When each drives among the others.
    """

    ways: FleetWays
    timing: Timing

    @classmethod
    def by_priority(cls, ways: FleetWays) -> TimedFleet:
        """Robots timed by priority, and by the orders that are forced."""
        priorities = [one.priority for one in ways.members]
        return cls(ways, time_paths(ways.courses, ways.crossings, ways.rides, priorities))

    def with_ways(self, ways: FleetWays, robot: int) -> TimedFleet:
        """One robot timed anew, along another path, among all others as they are timed.

        Args:
            ways: In which this robot alone has another path.
            robot: Which one.
        """
        laws = standing_laws(ways.courses)
        old, new = self.ways.courses.packed.first, ways.courses.packed.first
        given = self.timing.laws.packed
        for k in range(len(ways.members)):
            if k == robot:
                continue
            was, now = slice(old[k], old[k + 1]), slice(new[k], new[k + 1])
            for one, other in zip(laws.packed[:3], given[:3], strict=True):
                one[now] = other[was]
            laws.packed.is_timed[k] = given.is_timed[k]
        failed = timed_in_order(
            ways.courses.packed, ways.crossings.packed, ways.rides.packed, laws.packed,
            np.array([robot], np.int64),
        )  # fmt: skip
        blocked = {k: by for k, by in self.timing.blocked.items() if k != robot}
        if failed[0] != CLEAR:
            blocked[robot] = int(ways.crossings.packed.other[failed[0]])
        return TimedFleet(ways, Timing(laws, blocked))

    @property
    def blocked(self) -> tuple[str, ...]:
        """The robots that could not be timed."""
        return tuple(self.ways.courses.names[k] for k in sorted(self.timing.blocked))

    def plans(self) -> dict[str, Plan]:
        """The plans of those that are timed, with their laws by the clock of the fleet, by name."""
        ways, laws = self.ways, self.timing.laws
        return {
            member.name: replace(
                plan,
                trajectory=timed_trajectory(plan.trajectory, ways.courses, ways.rides, laws, k),
            )
            for k, (member, plan) in enumerate(zip(ways.members, ways.plans, strict=True))
            if k not in self.timing.blocked
        }

    def past_standing_ones(self) -> TimedFleet:
        """With those that could not be timed standing at their starts, in the way of others."""
        blocked = dict(self.timing.blocked)
        timing = self._around(blocked)
        while timing.blocked:
            blocked |= timing.blocked
            timing = self._around(blocked)
        by_priority = sorted(blocked, key=lambda k: (-self.ways.members[k].priority, k))
        for robot in by_priority[:MOST_TRIED_AGAIN]:  # in whose way others stand that don't now
            fewer = {k: by for k, by in blocked.items() if k != robot}
            again = self._around(fewer)
            if not again.blocked:
                blocked, timing = fewer, again
        return replace(self, timing=replace(timing, blocked=blocked))

    def _around(self, standing: Mapping[int, int]) -> Timing:
        """All others timed by priority, round those that stand at their starts."""
        ways, priorities = self.ways, [one.priority for one in self.ways.members]
        return time_paths(ways.courses, ways.crossings, ways.rides, priorities, sorted(standing))

    def improved(
        self, seconds: float, progress: Callable[[float], None] | None = None
    ) -> TimedFleet:
        """With sooner laws, for so much work [s on the reference machine]."""
        ways = self.ways
        priorities = np.array([one.priority for one in ways.members], float)
        timing = improve_laws(
            ways.courses, ways.crossings, ways.rides, self.timing, priorities, seconds, progress
        )
        return replace(self, timing=timing)


def on_lattice(ways: FleetWays, separation: float) -> TimedFleet | NoLatticeOrder:
    """Robots led over a lattice, all of them, where priority alone leaves some without a law.

    Args:
        ways: The paths that robots would drive alone.
        separation: Free space between any two bodies [m].
    """
    plans = dict(zip(ways.courses.names, ways.plans, strict=True))
    best: TimedFleet | None = None
    for shape in SHAPES:
        laid = lattice_paths(plans, separation, shape=shape)
        if isinstance(laid, NoLatticeOrder):
            return laid
        led = ways.along(laid.plans, separation)
        steps = list(laid.steps.values())
        timing = time_in_order(led.courses, led.crossings, led.rides, steps)
        if best is None or len(timing.blocked) < len(best.blocked):
            best = TimedFleet(led, timing)
        if not best.blocked:
            break
    assert best is not None  # there are shapes
    return best
