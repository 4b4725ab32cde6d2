"""A fleet with the path of one robot more, or with another one of a robot; what changes by it.

Tested through ``fleet/execution/test_grown_orders`` and ``fleet/execution/test_changed_plans``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from viaspline.fleet.courses import AnyPlan, FleetCourses, courses_of
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.renewed_crossings import patched_crossings
from viaspline.fleet.timing.rides import rides_of
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.mission.fleet.fleet import FleetMember

Value = TypeVar("Value", bound=np.generic)

NO_LAWS = FleetLaws(PackedLaws(np.empty(0), np.empty(0), np.empty(0), np.empty(0, np.bool_)))
"""Of robots of which none is timed yet."""


@dataclass(frozen=True, eq=False)
class RobotPlace:
    """Where a robot is put into arrays of a fleet: in place of one, or behind the last one.

    Attributes:
        robot: Its number.
        begin: The node before which others are kept.
        end: The node from which on they are.
    """

    robot: int
    begin: int
    end: int

    def by_node(self, before: NDArray[Value], new: NDArray[Value]) -> NDArray[Value]:
        """An array of values at nodes."""
        return np.concatenate((before[: self.begin], new, before[self.end :]))

    def by_robot(self, before: NDArray[Value], new: NDArray[Value]) -> NDArray[Value]:
        """An array of values of robots."""
        return np.concatenate((before[: self.robot], new, before[self.robot + 1 :]))


@dataclass(frozen=True, eq=False)
class GrownFleet:
    """A fleet with a robot that has a new path.

    Attributes:
        fleet: With that path, and without any laws until the robot is timed.
        at: Where the robot is in it.
        fresh: The crossings of the fleet, with no boxes but those of the robot's own.
        number: The number that each crossing from before has now; -1 if it isn't there any more,
            (c,).
    """

    fleet: DrivenFleet
    at: RobotPlace
    fresh: PackedCrossings
    number: Ints

    @property
    def robot(self) -> int:
        """The number of the robot."""
        return self.at.robot

    def crossed(self) -> tuple[Ints, Floats, Floats]:
        """Who crosses its path, (k,); from where to where, along its own and along theirs [m]."""
        mine = _takes_part(self.fresh.robots, self.robot)
        robots, spans = self.fresh.robots[mine], self.fresh.span[mine].reshape(-1, 2, 2)
        side = (robots[:, 1] == self.robot).astype(np.int64)
        each = np.arange(len(robots))
        return robots[each, 1 - side], spans[each, side], spans[each, 1 - side]

    def among(self, laws: PackedLaws) -> PackedLaws:
        """Laws of the others, by the nodes that they had before, and none of the robot.

        They are arrays of their own.
        """
        nodes = np.diff(self.fleet.courses.packed.first)[self.robot]
        never, nothing = np.full(nodes, np.inf), np.zeros(nodes)
        return PackedLaws(
            arrive=self.at.by_node(laws.arrive, never),
            leave=self.at.by_node(laws.leave, never),
            speed=self.at.by_node(laws.speed, nothing),
            is_timed=self.at.by_robot(laws.is_timed, np.zeros(1, np.bool_)),
        )


def grown_fleet(
    fleet: DrivenFleet, member: FleetMember, plan: AnyPlan, off_start: float = 0.0
) -> GrownFleet:
    """A fleet with one robot more, or with one that has another path; no robot has a law in it yet.

    Args:
        fleet: Before.
        member: The robot; one of its name is replaced.
        plan: Its path, with the law that it would drive alone; it departs when its mission says.
        off_start: How far from its start it may be until it is on its way [m].
    """
    fresh = courses_of({member.name: plan}, fleet.separation)
    fresh.packed.bow[0] += off_start  # it may be so far beside its first cell
    old, count = fleet.courses.packed, len(fleet.names)
    is_new = member.name not in fleet.names
    robot = count if is_new else fleet.names.index(member.name)
    at = RobotPlace(robot, int(old.first[robot]), int(old.first[min(robot + 1, count)]))
    courses = _joined_courses(at, fleet.courses, fresh)
    found = crossings_of(courses, np.array([robot])).packed
    changed = np.array([robot])
    crossings = patched_crossings(fleet.crossings, fleet.courses, courses, changed, found)
    rides = _joined_rides(at, fleet.rides, rides_of([member], [plan], fresh).packed)
    rounds, lead_ins = (
        None if one is None else at.by_robot(one, np.zeros(1))
        for one in (fleet.rounds, fleet.lead_ins)
    )
    was, now = fleet.crossings.robots, crossings.robots
    is_fresh = _takes_part(now, robot)
    number = np.full(len(was), -1)
    number[~_takes_part(was, robot)] = np.flatnonzero(~is_fresh)
    own = found._replace(
        robots=now,
        span=crossings.span,
        crossing=np.flatnonzero(is_fresh)[found.crossing].astype(np.int32),
    )
    grown = DrivenFleet(courses, crossings, NO_LAWS, rides, fleet.separation, rounds, lead_ins)
    return GrownFleet(grown, at, own, number)


def _takes_part(robots: Ints, robot: int) -> Flags:
    """Whether a robot is one of the two of each crossing, (c,)."""
    takes_part: Flags = (robots[:, 0] == robot) | (robots[:, 1] == robot)
    return takes_part


def _joined_courses(at: RobotPlace, before: FleetCourses, fresh: FleetCourses) -> FleetCourses:
    """The courses of a fleet with that of one robot more, or with another one."""
    old, mine = before.packed, fresh.packed
    sizes = at.by_robot(np.diff(old.first), np.diff(mine.first))
    is_new = at.robot == len(before.names)
    bodies = None
    if before.bodies is not None and fresh.bodies is not None:  # in space
        bodies = at.by_robot(before.bodies, fresh.bodies)
    return FleetCourses(
        (*before.names, *fresh.names) if is_new else before.names,
        PackedCourses(
            first=np.concatenate(([0], np.cumsum(sizes))).astype(np.int64),
            distance=at.by_node(old.distance, mine.distance),
            place=at.by_node(old.place, mine.place),
            bow=at.by_node(old.bow, mine.bow),
            reach=at.by_robot(old.reach, mine.reach),
        ),
        bodies,
    )


def _joined_rides(at: RobotPlace, before: PackedRides, new: PackedRides) -> PackedRides:
    """How robots drive alone, with one of them more, or another."""
    return PackedRides(
        square=at.by_node(before.square, new.square),
        lasts=at.by_node(before.lasts, new.lasts),
        stays=at.by_node(before.stays, new.stays),
        accel=at.by_robot(before.accel, new.accel),
        brake=at.by_robot(before.brake, new.brake),
        depart=at.by_robot(before.depart, new.depart),
        keeps_pace=at.by_robot(before.keeps_pace, new.keeps_pace),
        vanishes=at.by_robot(before.vanishes, new.vanishes),
    )
