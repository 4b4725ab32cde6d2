"""Robots that join a fleet under way: only where they cross others is anything reckoned.

Tested through ``fleet/execution/test_replanned_fleets`` and ``fleet/execution/test_changed_plans``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from viaspline.errors import GaveUpError
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.grown_fleet import GrownFleet
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.yielding_ride import CLEAR, timed_in_order

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


def joined_fleet(grown: GrownFleet, laws: PackedLaws, let_in: LetIn) -> GrownFleet:
    """A fleet whose robot with a new path is timed along it.

    It is timed among the others, none of whose laws changes, and so that it passes nobody before
    one who was let in already. Among patrols that never end it is out of their way before the last
    period of their laps that are laid out begins there: what comes after that comes again.

    Args:
        grown: With the path.
        laws: Of those that it crosses, and of patrols: when they are expected where, by the nodes
            that they had before.
        let_in: Where the others may be already.

    Raises:
        GaveUpError: It can't be timed along its path.
    """
    fleet, robot = grown.fleet, grown.robot
    others, own, theirs = grown.crossed()
    may_be_in = let_in.until[others] >= theirs[:, 0]
    may_be_in &= let_in.since[others] <= theirs[:, 1]
    for k in np.flatnonzero(may_be_in & let_in.stands[others]).tolist():
        raise _in_the_way(fleet, robot, int(others[k]), float(own[k, 0]))
    inside = np.flatnonzero(may_be_in).tolist()
    depart = float(fleet.rides.depart[robot])
    boxes = _own_boxes(grown.fresh, robot)
    passages = passages_of(fleet.courses.packed, boxes)
    among = grown.among(laws)
    for _ in range(MAX_ROUNDS):
        timed = _timed(fleet, among, robot, depart, boxes, passages)
        wait = 0.0
        for k in inside:
            leaves = _goes(timed, int(others[k]), float(theirs[k, 1]))
            late = leaves - _comes(timed, robot, float(own[k, 0]))
            if late > 0.0 and (own[k, 0] <= 0.0 or late == np.inf):
                raise _in_the_way(fleet, robot, int(others[k]), float(own[k, 0]))
            wait = max(wait, late)
        if wait <= 0.0:
            _check_rounds(timed, robot, others, own, theirs)
            return replace(grown, fleet=timed)
        depart += wait
    raise _in_the_way(fleet, robot, int(others[inside[0]]), float(own[inside[0], 0]))


def _check_rounds(
    fleet: DrivenFleet, robot: int, others: Ints, own: Floats, theirs: Floats
) -> None:
    """Refuse a robot that isn't out of a patrol's way when its last period begins there.

    All that comes after what is laid out has the order of that period, and then it has passed
    already. Nor may it arrive after that: patrols go on when all others have arrived.

    Args:
        fleet: With its law.
        robot: Its number.
        others: Whom it crosses, (k,).
        own: From where to where along its path [m], (k, 2).
        theirs: The same along theirs.
    """
    if fleet.rounds is None:
        return
    last = int(fleet.courses.packed.first[robot + 1]) - 1
    arrives = float(fleet.laws.packed.arrive[last] + fleet.rides.stays[last])
    endless = (fleet.rounds > 0.0) & fleet.laws.packed.is_timed
    for patrol in np.flatnonzero(endless).tolist():
        if arrives > _comes(fleet, patrol, float(fleet.lengths[patrol])):
            raise _in_the_way(fleet, robot, patrol, float(fleet.lengths[robot]))
    begins = fleet.lengths - fleet.rounds
    for k in np.flatnonzero(endless[others] & (theirs[:, 1] > begins[others])).tolist():
        patrol, meets = int(others[k]), max(float(theirs[k, 0]), float(begins[others[k]]))
        if _goes(fleet, robot, float(own[k, 1])) > _comes(fleet, patrol, meets):
            raise _in_the_way(fleet, robot, patrol, float(own[k, 0]))


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
    fleet: DrivenFleet, laws: PackedLaws, robot: int, depart: float, crossings: PackedCrossings,
    passages: PackedPassages,
) -> DrivenFleet:  # fmt: skip
    """The fleet with the law of a robot that sets out at some time, as early as it can.

    Args:
        fleet: In which it has no law.
        laws: Of the others; that of the robot is written to.
        robot: Its number.
        depart: When it sets out [s].
        crossings: With its boxes.
        passages: Of these.
    """
    departs = fleet.rides.depart.copy()
    departs[robot] = depart
    rides, courses = fleet.rides._replace(depart=departs), fleet.courses.packed
    laws.is_timed[robot] = False  # whatever it was timed before
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
