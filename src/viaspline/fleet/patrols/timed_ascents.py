"""When patrols take off, so that their laps can begin when their rhythm says.

Each is timed among the laps of all patrols and the ascents before it: so late that it needn't hover
before its first lap, or else as soon as it may: then it hovers at the top, which no other patrol
passes.

Tested through ``fleet/patrols/test_patrols_that_take_off``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.errors import GaveUpError
from viaspline.fleet.courses import AnyPlan, FleetCourses, courses_along, fleet_path
from viaspline.fleet.crossings import FleetCrossings, box_owners, crossings_of
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.patrols.driven_laps import write_law
from viaspline.fleet.patrols.repeated_laws import SAME_S, set_out
from viaspline.fleet.space.courses_with_moving import without_boxes
from viaspline.fleet.timing.rides import FleetRides, rides_of
from viaspline.fleet.timing.time_paths import standing_laws
from viaspline.fleet.timing.timed_trajectory import timed_trajectory
from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.yielding_ride import CLEAR, timed_in_order
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.trajectory.trajectory import Trajectory


def timed_ascents(
    rising: Sequence[tuple[FleetMember, SpatialPlan]],
    laps: Mapping[str, AnyPlan],
    laws: Mapping[str, Trajectory],
    separation: float,
) -> dict[str, Trajectory]:
    """The laws of take-offs, by the names of the patrols.

    Args:
        rising: The patrols that take off, and their ascents.
        laps: The laps of all patrols, by name.
        laws: When these fly them, by name.
        separation: Free space between any two bodies [m].

    Returns:
        Each from when it leaves the ground; it may end after the laps were to begin.

    Raises:
        GaveUpError: One finds no time; ``obstacles`` names it, and who is in its way.
    """
    if not rising:
        return {}
    scene = _Ascents.of(rising, laps, laws, separation)
    found: dict[str, Trajectory] = {}
    for robot in scene.order():
        name = scene.members[robot].name
        found[name] = scene.timed(robot, laws[name].start_time)
    return found


@dataclass(frozen=True, eq=False)
class _Ascents:
    """What is timed: the ascents, and behind them the laps of all patrols, which have their laws.

    Attributes:
        members: The patrols that take off.
        plans: Their ascents.
        names: Of the patrols, in the order of the courses.
        courses: Ascents, then laps.
        crossings: Where an ascent comes near to something else.
        rides: How all of it is flown alone.
        laws: As far as they are known; they are written to.
    """

    members: tuple[FleetMember, ...]
    plans: tuple[SpatialPlan, ...]
    names: tuple[str, ...]
    courses: FleetCourses
    crossings: FleetCrossings
    rides: FleetRides
    laws: FleetLaws

    @classmethod
    def of(
        cls, rising: Sequence[tuple[FleetMember, SpatialPlan]], laps: Mapping[str, AnyPlan],
        laws: Mapping[str, Trajectory], separation: float,
    ) -> _Ascents:  # fmt: skip
        members, plans = tuple(one for one, _ in rising), tuple(plan for _, plan in rising)
        names = (*(one.name for one in members), *laps)
        paths = [fleet_path(plan, separation) for plan in plans]
        paths += [fleet_path(plan, separation, laws[name].distances) for name, plan in laps.items()]
        courses = courses_along(names, paths)
        found = crossings_of(courses, np.arange(len(plans))).packed
        own = [
            names[robot] == names[other]
            for robot, other in zip(box_owners(found).tolist(), found.other.tolist(), strict=True)
        ]
        crossings = FleetCrossings(without_boxes(found, np.array(own, np.bool_)))
        by_name = {one.name: one for one in members}
        each = [_ending(by_name.get(name), laps[name], name) for name in names]
        rides = rides_of(each, [*plans, *laps.values()], courses)
        settled = standing_laws(courses)
        for robot, name in enumerate(laps, len(plans)):
            write_law(laws[name], courses, robot, settled)
        return cls(members, plans, names, courses, crossings, rides, settled)

    def order(self) -> list[int]:
        """Who is timed before whom: by priority."""
        return sorted(range(len(self.members)), key=lambda k: (-self.members[k].priority, k))

    def timed(self, robot: int, until: float) -> Trajectory:
        """The law of an ascent that ends at a time [s], as soon as may be where that can't be."""
        soonest = float(self.rides.packed.depart[robot])
        latest = until - float(self.rides.alone[robot])
        law = self._law(robot, max(latest, soonest))
        if latest > soonest and (isinstance(law, int) or law.end_time > until + SAME_S):
            law = self._law(robot, soonest)
        if isinstance(law, int):
            who, whom = self.members[robot].name, self.names[law]
            raise GaveUpError(
                f"'{who}' finds no time to take off: '{whom}' is in its way",
                where=self.plans[robot].path.evaluate(0.0).tolist(),
                remedy=f"give '{whom}' or '{who}' a number of laps, or another route",
                tried=("taking off between the laps of all patrols",),
                obstacles=(who, whom),
            )
        return law

    def _law(self, robot: int, depart: float) -> Trajectory | int:
        """The law of an ascent from a departure [s] on, or who lets it find none."""
        packed, laws = self.courses.packed, self.laws.packed
        departs = self.rides.packed.depart.copy()
        departs[robot] = depart
        rides = replace(self.rides, packed=self.rides.packed._replace(depart=departs))
        crossings = self.crossings.packed
        laws.is_timed[robot] = False
        (box,) = timed_in_order(
            packed, crossings, passages_of(packed, crossings), rides.packed, laws,
            np.array([robot], np.int64),
        )  # fmt: skip
        if box != CLEAR:
            return int(crossings.other[box])
        static = self.plans[robot].trajectory
        return set_out(timed_trajectory(static, self.courses, rides, self.laws, robot))


def _ending(member: FleetMember | None, lap: AnyPlan, name: str) -> FleetMember:
    """A robot that flies its path once, and is in nobody's way at its end."""
    if member is None:
        member = FleetMember(name, lap.mission)
    route = member.mission.route.model_copy(update={"laps": 1})
    mission = member.mission.model_copy(update={"route": route})
    return replace(member, mission=mission, rest="leave")
