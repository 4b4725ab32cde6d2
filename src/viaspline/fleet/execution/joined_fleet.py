"""Robots that join a fleet under way: only where they cross others is anything reckoned.

Tested through ``fleet/execution/test_replanned_fleets`` and ``fleet/execution/test_changed_plans``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from viaspline.errors import GaveUpError
from viaspline.fleet.courses import AnyPlan, FleetCourses, courses_of
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.renewed_crossings import renewed_crossings
from viaspline.fleet.timing.rides import rides_of
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.yielding_ride import CLEAR, timed_in_order
from viaspline.mission.fleet.fleet import FleetMember

Value = TypeVar("Value", bound=np.generic)
MAX_ROUNDS = 20
"""How often a robot sets out later because others were let into its way already."""


@dataclass(frozen=True, eq=False)
class LetIn:
    """Where robots under way may be, whatever they are told from now on.

    Attributes:
        since: How far each has come at least [m]; infinite: it has left the world, (n,).
        until: How far each may go [m], (n,).
        stands: Whether it never gets on any more, (n,).
    """

    since: Floats
    until: Floats
    stands: Flags


def joined_fleet(
    fleet: DrivenFleet, laws: PackedLaws, let_in: LetIn, member: FleetMember, plan: AnyPlan,
    off_start: float = 0.0,
) -> DrivenFleet:  # fmt: skip
    """A fleet with one robot more, or with one that has another path.

    The robot is timed among the others, none of whose laws changes, and so that it passes nobody
    before one who was let in already. Among patrols that never end it arrives before the last
    period of their laps that are laid out begins: what comes after that comes again.

    Args:
        fleet: Before.
        laws: When its robots are expected where.
        let_in: Where they may be already.
        member: The robot; one of its name is replaced.
        plan: Its path, with the law that it would drive alone; it departs when its mission says.
        off_start: How far from its start it may be until it is on its way [m].

    Raises:
        GaveUpError: It can't be timed along its path.
    """
    grown = _grown(fleet, laws, member, plan, off_start)
    robot = grown.names.index(member.name)
    others, own, theirs = _crossed(grown, robot)
    may_be_in = let_in.until[others] >= theirs[:, 0]
    may_be_in &= let_in.since[others] <= theirs[:, 1]
    for k in np.flatnonzero(may_be_in & let_in.stands[others]).tolist():
        raise _in_the_way(grown, robot, int(others[k]), float(own[k, 0]))
    inside = np.flatnonzero(may_be_in).tolist()
    depart = float(grown.rides.depart[robot])
    boxes = _own_boxes(grown.crossings.packed, robot)
    passages = passages_of(grown.courses.packed, boxes)
    for _ in range(MAX_ROUNDS):
        timed = _timed(grown, robot, depart, boxes, passages)
        wait = 0.0
        for k in inside:
            leaves = _goes(timed, int(others[k]), float(theirs[k, 1]))
            late = leaves - _comes(timed, robot, float(own[k, 0]))
            if late > 0.0 and (own[k, 0] <= 0.0 or late == np.inf):
                raise _in_the_way(grown, robot, int(others[k]), float(own[k, 0]))
            wait = max(wait, late)
        if wait <= 0.0:
            _check_rounds(timed, robot)
            return timed
        depart += wait
    raise _in_the_way(grown, robot, int(others[inside[0]]), float(own[inside[0], 0]))


def _check_rounds(fleet: DrivenFleet, robot: int) -> None:
    """Refuse a robot that arrives when the last period of a patrol has begun.

    All that comes after what is laid out has the order of that period, and then it stands already.
    """
    if fleet.rounds is None:
        return
    last = int(fleet.courses.packed.first[robot + 1]) - 1
    arrives = float(fleet.laws.packed.arrive[last] + fleet.rides.stays[last])
    begins = fleet.lengths - fleet.rounds
    for patrol in np.flatnonzero((fleet.rounds > 0.0) & fleet.laws.packed.is_timed).tolist():
        if arrives > _comes(fleet, patrol, float(begins[patrol])):
            raise _in_the_way(fleet, robot, patrol, float(fleet.lengths[robot]))


def _crossed(fleet: DrivenFleet, robot: int) -> tuple[Ints, Floats, Floats]:
    """Who crosses a robot's path, (k,); from where to where, along its own and along theirs [m]."""
    packed = fleet.crossings.packed
    mine = (packed.robots == robot).any(axis=1)
    robots, spans = packed.robots[mine], packed.span[mine].reshape(-1, 2, 2)
    side = (robots[:, 1] == robot).astype(np.int64)
    each = np.arange(len(robots))
    return robots[each, 1 - side], spans[each, side], spans[each, 1 - side]


def _in_the_way(grown: DrivenFleet, robot: int, other: int, place: float) -> GaveUpError:
    """What is told of a robot that can't be timed along its path."""
    name, in_its_way = grown.names[robot], grown.names[other]
    return GaveUpError(
        f"'{name}' can't be timed among those that drive: '{in_its_way}' is in its way at "
        f"{place:.1f} m",
        where=grown.place_at(robot, place),
        remedy=f"send it another way, or when '{in_its_way}' has passed",
        obstacles=(in_its_way,),
        tried=("joining",),
    )


@dataclass(frozen=True, eq=False)
class _Place:
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


def _grown(
    fleet: DrivenFleet, laws: PackedLaws, member: FleetMember, plan: AnyPlan, off_start: float
) -> DrivenFleet:
    """The fleet with the robot's path, which has no law yet; see ``joined_fleet``."""
    fresh = courses_of({member.name: plan}, fleet.separation)
    fresh.packed.bow[0] += off_start  # it may be so far beside its first cell
    mine, old, count = fresh.packed, fleet.courses.packed, len(fleet.names)
    is_new = member.name not in fleet.names
    robot = count if is_new else fleet.names.index(member.name)
    at = _Place(robot, int(old.first[robot]), int(old.first[min(robot + 1, count)]))
    sizes = at.by_robot(np.diff(old.first), np.diff(mine.first))
    courses = FleetCourses(
        (*fleet.names, member.name) if is_new else fleet.names,
        PackedCourses(
            first=np.concatenate(([0], np.cumsum(sizes))).astype(np.int64),
            distance=at.by_node(old.distance, mine.distance),
            place=at.by_node(old.place, mine.place),
            bow=at.by_node(old.bow, mine.bow),
            reach=at.by_robot(old.reach, mine.reach),
        ),
        _joined_bodies(at, fleet.courses.bodies, fresh.bodies),
    )
    crossings = renewed_crossings(fleet.crossings, fleet.courses, courses, np.array([robot]))
    never, nothing = np.full(len(mine.distance), np.inf), np.zeros(len(mine.distance))
    none = PackedLaws(
        arrive=at.by_node(laws.arrive, never),
        leave=at.by_node(laws.leave, never),
        speed=at.by_node(laws.speed, nothing),
        is_timed=at.by_robot(laws.is_timed, np.zeros(1, np.bool_)),
    )
    rides = _joined_rides(at, fleet.rides, rides_of([member], [plan], fresh).packed)
    rounds, lead_ins = (
        None if one is None else at.by_robot(one, np.zeros(1))
        for one in (fleet.rounds, fleet.lead_ins)
    )
    return DrivenFleet(
        courses, crossings, FleetLaws(none), rides, fleet.separation, rounds, lead_ins
    )


def _joined_bodies(at: _Place, before: Floats | None, new: Floats | None) -> Floats | None:
    """What robots take up in space, with one of them more, or another; None in the plane."""
    return None if before is None or new is None else at.by_robot(before, new)


def _joined_rides(at: _Place, before: PackedRides, new: PackedRides) -> PackedRides:
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


def _own_boxes(crossings: PackedCrossings, robot: int) -> PackedCrossings:
    """Crossings with no other boxes than a robot's: it is timed by these alone."""
    begin, end = crossings.box_first[robot : robot + 2].tolist()
    return crossings._replace(
        box_first=np.clip(crossings.box_first - begin, 0, end - begin),
        cell=crossings.cell[begin:end], crossing=crossings.crossing[begin:end],
        other=crossings.other[begin:end], low=crossings.low[begin:end],
        high=crossings.high[begin:end],
    )  # fmt: skip


def _timed(
    fleet: DrivenFleet, robot: int, depart: float, crossings: PackedCrossings,
    passages: PackedPassages,
) -> DrivenFleet:  # fmt: skip
    """The fleet with the law of a robot that sets out at some time, as early as it can.

    Args:
        fleet: In which it has no law.
        robot: Its number.
        depart: When it sets out [s].
        crossings: With its boxes.
        passages: Of these.
    """
    departs = fleet.rides.depart.copy()
    departs[robot] = depart
    rides, old = fleet.rides._replace(depart=departs), fleet.laws.packed
    laws = PackedLaws(old.arrive.copy(), old.leave.copy(), old.speed.copy(), old.is_timed.copy())
    courses = fleet.courses.packed
    (box,) = timed_in_order(courses, crossings, passages, rides, laws, np.array([robot]))
    if box != CLEAR:
        place = float(courses.distance[crossings.cell[box]])
        raise _in_the_way(fleet, robot, int(crossings.other[box]), place)
    return replace(fleet, laws=FleetLaws(laws), rides=rides)


def _comes(fleet: DrivenFleet, robot: int, place: float) -> float:
    """When a robot comes to a place, or a little earlier [s]."""
    along, first = fleet.course(robot)[0], int(fleet.courses.packed.first[robot])
    k = max(int(np.searchsorted(along, place, side="right")) - 1, 0)
    return float(fleet.laws.packed.arrive[first + k])


def _goes(fleet: DrivenFleet, robot: int, place: float) -> float:
    """When a robot goes on from a place, or a little later [s]."""
    along, first = fleet.course(robot)[0], int(fleet.courses.packed.first[robot])
    k = min(int(np.searchsorted(along, place)), len(along) - 1)
    return float(fleet.laws.packed.leave[first + k])
