"""The paths of the robots of a fleet, and where they come near each other.

Tested through ``fleet/test_plan_fleet``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from viaspline.fleet.courses import AnyPlan, FleetCourses, courses_of
from viaspline.fleet.crossing_paths import CrossingPaths
from viaspline.fleet.crossings import FleetCrossings, crossings_of
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.patrols.driven_laps import write_law
from viaspline.fleet.renewed_courses import renewed_courses
from viaspline.fleet.renewed_crossings import renewed_crossings
from viaspline.fleet.timing.improve_laws import improve_laws, timed_ahead
from viaspline.fleet.timing.rides import FleetRides, rides_of
from viaspline.fleet.timing.time_paths import Timing, standing_laws, time_paths
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.planner import Plan
from viaspline.trajectory.trajectory import Trajectory


def planar_plans(plans: Sequence[AnyPlan]) -> tuple[Plan, ...]:
    """Plans of robots in the plane, as such."""
    found = tuple(plan for plan in plans if isinstance(plan, Plan))
    assert len(found) == len(plans), "these are plans in the plane"
    return found


@dataclass(frozen=True, eq=False)
class FleetWays:
    """The paths of robots, and where they come near each other.

    Attributes:
        members: The robots.
        plans: Their paths, with the laws of robots that are alone, in the order of the members.
        courses: These paths, cut into cells.
        crossings: Where they come near each other.
        rides: How each robot drives alone.
        settled: The laws of robots that have theirs before the others are timed, by name.
    """

    members: tuple[FleetMember, ...]
    plans: tuple[AnyPlan, ...]
    courses: FleetCourses
    crossings: FleetCrossings
    rides: FleetRides
    settled: Mapping[str, Trajectory] = field(default_factory=dict)

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

    @classmethod
    def laid(
        cls, members: Sequence[FleetMember], plans: Mapping[str, AnyPlan], separation: float
    ) -> FleetWays:
        """The ways of robots along paths.

        Args:
            members: The robots.
            plans: Theirs, by name, in their order.
            separation: Free space between any two bodies [m].

        Raises:
            GaveUpError: They come near each other in too many places.
        """
        courses = courses_of(plans, separation)
        every = tuple(plans.values())
        rides = rides_of(members, every, courses)
        return cls(tuple(members), every, courses, crossings_of(courses), rides)

    @property
    def planar(self) -> tuple[Plan, ...]:
        """The paths of a fleet in the plane."""
        return planar_plans(self.plans)

    def name_of(self, number: int) -> str:
        """What a robot is called, by its number in a timing."""
        return self.courses.names[number]

    def timed(self, left_out: Sequence[int] = ()) -> Timing:
        """Robots timed by priority and by the orders that are forced.

        Args:
            left_out: Those that stand at their starts for good.
        """
        priorities = [one.priority for one in self.members]
        return time_paths(
            self.courses, self.crossings, self.rides, priorities, left_out, self.settled_laws()
        )

    def timed_ahead(self, times: int) -> Timing | None:
        """All robots timed with what lies ahead of them in view; None where some can't be so.

        Args:
            times: So often, each time with other orders.
        """
        priorities = [one.priority for one in self.members]
        settled = self.settled_laws()
        return timed_ahead(self.courses, self.crossings, self.rides, settled, priorities, times)

    def improved(
        self, timing: Timing, seconds: float, progress: Callable[[float], None] | None = None
    ) -> Timing:
        """Sooner laws.

        Args:
            timing: Of these robots.
            seconds: For so much work [s on the reference machine].
            progress: Called with the share of it that is done.
        """
        priorities = [one.priority for one in self.members]
        settled = np.flatnonzero(self.settled_laws().packed.is_timed).tolist()
        return improve_laws(
            self.courses, self.crossings, self.rides, timing, priorities, seconds, progress, settled
        )

    def along(self, plans: Mapping[str, AnyPlan], separation: float) -> FleetWays:
        """The ways of the same robots along other paths.

        Args:
            plans: By name, in the order of the robots.
            separation: Free space between any two bodies [m].
        """
        courses = courses_of(plans, separation, self.settled)
        laid = tuple(plans.values())
        rides = rides_of(self.members, laid, courses)
        return replace(
            self, plans=laid, courses=courses, crossings=crossings_of(courses), rides=rides
        )

    def settled_laws(self) -> FleetLaws:
        """The laws of the robots that have theirs, at the nodes of the courses."""
        laws = standing_laws(self.courses)
        for robot, name in enumerate(self.courses.names):
            if name in self.settled:
                write_law(self.settled[name], self.courses, robot, laws)
                begins = self.courses.packed.first[robot]
                laws.packed.arrive[begins] = self.rides.packed.depart[robot]
        return laws

    def with_path(self, robot: int, plan: AnyPlan, separation: float) -> FleetWays:
        """The ways of the same robots, one of which takes another path.

        What each takes alone stays as it was: along the path that it had.

        Args:
            robot: Which one.
            plan: Its path, with the law that it would drive alone.
            separation: Free space between any two bodies [m].
        """
        return self.with_paths({robot: plan}, separation)

    def with_paths(self, plans: Mapping[int, AnyPlan], separation: float) -> FleetWays:
        """The ways of the same robots, some of which take other paths; see ``with_path``.

        Args:
            plans: By robot.
            separation: Free space between any two bodies [m].
        """
        laid = tuple(plans.get(k, plan) for k, plan in enumerate(self.plans))
        changed = np.array(sorted(plans), np.int64)
        names = [one.name for one in self.members]
        by_name = dict(zip(names, laid, strict=True))
        courses = renewed_courses(self.courses, by_name, separation, changed)
        crossings = renewed_crossings(self.crossings, self.courses, courses, changed)
        rides = replace(rides_of(self.members, laid, courses), alone=self.rides.alone)
        return replace(self, plans=laid, courses=courses, crossings=crossings, rides=rides)
