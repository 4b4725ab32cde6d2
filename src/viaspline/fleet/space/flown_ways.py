"""The paths of robots in space, where they come near each other, and when they fly along them.

Tested through ``fleet/space/test_plan_spatial_fleet``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from viaspline.fleet.courses import FleetCourses, courses_of
from viaspline.fleet.crossings import FleetCrossings, crossings_of
from viaspline.fleet.timing.improve_laws import improve_laws
from viaspline.fleet.timing.rides import FleetRides, rides_of
from viaspline.fleet.timing.time_paths import Timing, time_paths
from viaspline.fleet.timing.timed_trajectory import timed_trajectory
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.space.spatial_plan import SpatialPlan


@dataclass(frozen=True, eq=False)
class FlownWays:
    """The paths of robots in space, and where they come near each other.

    Attributes:
        members: Those that have a path.
        plans: Their paths, with the laws that they would fly alone, in the order of the members.
        courses: These paths, cut into cells.
        crossings: Where they come near each other.
        rides: How each robot flies alone.
    """

    members: tuple[FleetMember, ...]
    plans: tuple[SpatialPlan, ...]
    courses: FleetCourses
    crossings: FleetCrossings
    rides: FleetRides

    @classmethod
    def of(
        cls, members: Sequence[FleetMember], plans: Sequence[SpatialPlan], separation: float
    ) -> FlownWays:
        """The ways of robots along paths.

        Args:
            members: The robots.
            plans: Theirs.
            separation: Free space between any two bodies [m].

        Raises:
            GaveUpError: They come near each other in too many places.
        """
        named = {one.name: plan for one, plan in zip(members, plans, strict=True)}
        courses = courses_of(named, separation)
        rides = rides_of(members, list(plans), courses)
        return cls(tuple(members), tuple(plans), courses, crossings_of(courses), rides)

    def timed(self, left_out: Sequence[int] = ()) -> Timing:
        """Robots timed by priority and by the orders that are forced.

        Args:
            left_out: Robots that stand at their starts for good.
        """
        priorities = [one.priority for one in self.members]
        return time_paths(self.courses, self.crossings, self.rides, priorities, left_out)

    def past_standing_ones(self, timing: Timing) -> Timing:
        """With those that could not be timed standing at their starts, in the way of others."""
        blocked = dict(timing.blocked)
        found = self.timed(sorted(blocked))
        while found.blocked:
            blocked |= found.blocked
            found = self.timed(sorted(blocked))
        by_priority = sorted(blocked, key=lambda k: (-self.members[k].priority, k))
        for robot in by_priority:  # in whose way others stood that don't now
            fewer = {k: by for k, by in blocked.items() if k != robot}
            again = self.timed(sorted(fewer))
            if not again.blocked:
                blocked, found = fewer, again
        return replace(found, blocked=blocked)

    def improved(self, timing: Timing, seconds: float, progress: Callable[[float], None]) -> Timing:
        """With sooner laws, for so much work [s on the reference machine]."""
        priorities = [one.priority for one in self.members]
        return improve_laws(
            self.courses, self.crossings, self.rides, timing, priorities, seconds, progress
        )

    def flown(self, timing: Timing) -> dict[str, SpatialPlan]:
        """The plans of those that are timed, with their laws by the clock of the fleet, by name."""
        return {
            member.name: replace(
                plan,
                trajectory=timed_trajectory(
                    plan.trajectory, self.courses, self.rides, timing.laws, k
                ),
            )
            for k, (member, plan) in enumerate(zip(self.members, self.plans, strict=True))
            if k not in timing.blocked
        }

    def with_paths(self, plans: Mapping[int, SpatialPlan], separation: float) -> FlownWays:
        """The ways of the same robots, of which some take other paths."""
        laid = [plans.get(k, plan) for k, plan in enumerate(self.plans)]
        return FlownWays.of(self.members, laid, separation)
