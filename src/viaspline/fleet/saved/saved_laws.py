"""Courses and laws of a saved fleet, held against the paths and laws of its robots.

Tested through ``fleet/saved/test_load_fleet_plan`` and ``fleet/saved/test_fleet_file``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np

from viaspline.bounded_file import FileKind, read_bytes
from viaspline.errors import SavedPlanError
from viaspline.fleet.courses import FleetCourses, courses_along, path_cut_at
from viaspline.fleet.fleet_laws import static_laws
from viaspline.fleet.patrols.driven_laps import on_nodes, stops_on_laps
from viaspline.fleet.patrols.take_off_first import law_of_patrol_in_space
from viaspline.fleet.relaid_fleet import driven_alone
from viaspline.fleet.saved.course_record import CourseRecord
from viaspline.fleet.timing.rides import rides_of
from viaspline.fleet.timing.time_paths import standing_laws
from viaspline.kernels.arrays import Floats
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.planner import Plan
from viaspline.saved_plans.law_within_limits import PROVEN_OFF_M
from viaspline.saved_plans.plan_file import REMEDY
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.timing.retime_in_space import retime_in_space
from viaspline.whole_plan import fastest_law

COURSE_FILE: Final = FileKind("courses.npz", 2_000_000_000, "plan the fleet again")
SAME: Final = 1e-6
"""Places [m] and times [s] that differ by no more are one, but for how they were reckoned."""


@dataclass(frozen=True)
class SavedLaws:
    """The courses and laws of a fleet that was saved.

    Attributes:
        file: Where they stand.
        record: They.
    """

    file: Path
    record: CourseRecord

    @classmethod
    def read(cls, file: Path) -> SavedLaws:
        """Read them.

        Raises:
            MissionError: There is no such file, or it can't be read.
            SavedPlanError: It is none.
        """
        try:
            return cls(file, CourseRecord.from_bytes(read_bytes(file, COURSE_FILE)))
        except ValueError as error:
            raise SavedPlanError(file, f"{error}; {REMEDY}") from None

    def check(self, fleet: Fleet, plans: Mapping[str, Plan | SpatialPlan]) -> None:
        """See that they are those of a fleet's plans, and that the others stand at their starts.

        Raises:
            SavedPlanError: They aren't, or some robot would drive faster than it can.
        """
        members = {one.name: one for one in fleet.members}
        names = self.record.courses.names
        if len(set(names)) < len(names) or not set(plans) <= set(names) <= set(members):
            raise self._wrong("has courses of other robots than the fleet")
        for robot, name in enumerate(names):
            if name in plans:
                self._check_driven(robot, members[name], plans[name], fleet.separation_m)
            else:
                self._check_standing(robot, members[name])

    def _check_driven(
        self, robot: int, member: FleetMember, plan: Plan | SpatialPlan, separation: float
    ) -> None:
        """One that is served: its course is cut anew, and its laws are looked up at the nodes."""
        nodes, name, courses = self._nodes(robot), member.name, self.record.courses.packed
        along = courses.distance[nodes]
        fresh = courses_along([name], [path_cut_at(plan, separation, along)])
        cut = fresh.packed
        if cut.distance.shape != along.shape or not _near(cut.distance, along):
            raise self._wrong(f"the course of '{name}' isn't cut as its path is")
        if not _near(cut.place, courses.place[nodes]):
            raise self._wrong(f"the course of '{name}' isn't on its path")
        if (courses.bow[nodes] < cut.bow - PROVEN_OFF_M).any():
            raise self._wrong(f"the course of '{name}' is more curved than is said")
        bodies = self.record.courses.bodies
        body = fresh.bodies
        same_body = (body is None) == (bodies is None)
        if body is not None and bodies is not None:
            same_body = _near(body[0], bodies[robot])
        if not same_body or not _near(cut.reach[0], courses.reach[robot]):
            raise self._wrong(f"'{name}' takes up more room than is said")
        self._check_law(robot, plan, fresh)
        self._check_ride(robot, member, plan, fresh)

    def _check_law(self, robot: int, plan: Plan | SpatialPlan, fresh: FleetCourses) -> None:
        """See that the law at the nodes is that of the robot's plan."""
        nodes, laws = self._nodes(robot), self.record.laws.packed
        law, name = _on_nodes(plan, fresh).trajectory, fresh.names[0]
        said = static_laws(fresh, [law]).packed
        leaves = bool(self.record.rides.packed.vanishes[robot])
        if leaves:
            said.leave[-1] = law.end_time
        columns = ("arrive", "leave", "speed")
        if not laws.is_timed[robot] or not all(
            _near(getattr(said, one), getattr(laws, one)[nodes]) for one in columns
        ):
            raise self._wrong(f"the law of '{name}' isn't that of its plan")

    def _check_ride(
        self, robot: int, member: FleetMember, plan: Plan | SpatialPlan, fresh: FleetCourses
    ) -> None:
        """See that a robot alone isn't faster than it can be, and can do what is said of it."""
        found = rides_of([member], [_on_nodes(_alone(member, plan), fresh)], fresh)
        packed, own, nodes = self.record.rides.packed, found.packed, self._nodes(robot)
        same = all(
            getattr(packed, one)[robot] == getattr(own, one)[0]
            for one in ("accel", "brake", "keeps_pace", "vanishes")
        )
        slower = (packed.square[nodes] <= own.square * (1.0 + SAME) + SAME).all()
        slower &= (packed.lasts[nodes] >= own.lasts - SAME).all()
        stays = (packed.stays[nodes] >= own.stays - SAME).all()
        later = packed.depart[robot] >= own.depart[0] - SAME
        if not (same and slower and stays and later):
            raise self._wrong(f"'{member.name}' alone is faster than its limits allow")

    def _check_standing(self, robot: int, member: FleetMember) -> None:
        """One that has a path and no law: it stands at its start."""
        courses, nodes = self.record.courses, self._nodes(robot)
        start = np.array(member.mission.route.start.at, np.float64)
        place = courses.packed.place[nodes][0]
        laws, stands = self.record.laws.packed, standing_laws(courses).packed
        same = all(
            np.array_equal(getattr(laws, one)[nodes], getattr(stands, one)[nodes])
            for one in ("arrive", "leave", "speed")
        )
        if not (same and laws.is_timed[robot]) or math.dist(place[:2], start[:2]) > SAME:
            raise self._wrong(f"'{member.name}' has no plan, and doesn't stand at its start")

    def _nodes(self, robot: int) -> slice:
        first = self.record.courses.packed.first
        return slice(int(first[robot]), int(first[robot + 1]))

    def _wrong(self, problem: str) -> SavedPlanError:
        return SavedPlanError(self.file, f"{problem}; {REMEDY}")


def _near(one: Floats, other: Floats) -> bool:
    return np.allclose(one, other, rtol=0.0, atol=SAME)


def _on_nodes(plan: Plan | SpatialPlan, course: FleetCourses) -> Plan | SpatialPlan:
    """A plan whose law changes at nodes of its course alone, as it does but for rounding."""
    return replace(plan, trajectory=on_nodes(plan.trajectory, course.packed.distance))


def _alone(member: FleetMember, plan: Plan | SpatialPlan) -> Plan | SpatialPlan:
    """A plan with the law that its robot would drive if it were alone."""
    zones = plan.mission.world.speed_zones
    if isinstance(plan, SpatialPlan):
        if member.mission.route.is_patrol:
            return replace(plan, trajectory=law_of_patrol_in_space(plan))
        stops = plan.trajectory.stations
        law = retime_in_space(plan.path, plan.limits, stops, plan.yaw, zones=zones)
    elif member.mission.route.is_patrol:
        law = fastest_law(plan.path, plan.mission, stops_on_laps(plan.path, plan.mission))
    else:
        return driven_alone(plan)
    return replace(plan, trajectory=law)
