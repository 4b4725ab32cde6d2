"""Robots with paths and laws: by priority, or by the order of a lattice.

Tested through ``fleet/test_plan_fleet``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from viaspline.fleet.courses import FleetCourses, courses_of
from viaspline.fleet.crossing_paths import CrossingPaths
from viaspline.fleet.crossings import FleetCrossings, crossings_of
from viaspline.fleet.lattice_order.lattice_paths import lattice_paths
from viaspline.fleet.lattice_order.no_lattice_order import NoLatticeOrder
from viaspline.fleet.lattice_order.time_in_order import time_in_order
from viaspline.fleet.timing.improve_laws import improve_laws
from viaspline.fleet.timing.rides import FleetRides, rides_of
from viaspline.fleet.timing.time_paths import Timing, time_paths
from viaspline.fleet.timing.timed_trajectory import timed_trajectory
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.planner import Plan


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
        ways, priorities = self.ways, [one.priority for one in self.ways.members]
        blocked = dict(self.timing.blocked)
        while True:
            timing = time_paths(
                ways.courses, ways.crossings, ways.rides, priorities, sorted(blocked)
            )
            if not timing.blocked:
                return replace(self, timing=replace(timing, blocked=blocked))
            blocked |= timing.blocked

    def improved(
        self, seconds: float, progress: Callable[[float], None] | None = None
    ) -> TimedFleet:
        """With sooner laws, for so much work [s on the reference machine]."""
        ways = self.ways
        priorities = [one.priority for one in ways.members]
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
    laid = lattice_paths(dict(zip(ways.courses.names, ways.plans, strict=True)), separation)
    if isinstance(laid, NoLatticeOrder):
        return laid
    led = ways.along(laid.plans, separation)
    steps = list(laid.steps.values())
    return TimedFleet(led, time_in_order(led.courses, led.crossings, led.rides, steps))
