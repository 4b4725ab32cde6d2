"""A fleet that one robot has left: nothing else is reckoned anew.

Tested through ``fleet/execution/test_changed_plans``.
"""

from __future__ import annotations

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings, box_owners
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides


def fleet_without(fleet: DrivenFleet, robot: int) -> DrivenFleet:
    """A fleet without one of its robots.

    Args:
        fleet: With it.
        robot: Its number; those after it have one less then.
    """
    courses, laws, rides = fleet.courses.packed, fleet.laws.packed, fleet.rides
    names = (*fleet.names[:robot], *fleet.names[robot + 1 :])
    nodes = np.ones(len(courses.distance), np.bool_)
    nodes[courses.first[robot] : courses.first[robot + 1]] = False
    others = np.arange(len(fleet.names)) != robot
    sizes = np.diff(courses.first)[others]
    return DrivenFleet(
        FleetCourses(
            names,
            PackedCourses(
                first=np.concatenate(([0], np.cumsum(sizes))).astype(np.int64),
                distance=courses.distance[nodes],
                place=courses.place[nodes],
                bow=courses.bow[nodes],
                reach=courses.reach[others],
            ),
            None if fleet.courses.bodies is None else fleet.courses.bodies[others],
        ),
        FleetCrossings(_crossings_without(fleet, robot)),
        FleetLaws(
            PackedLaws(
                laws.arrive[nodes], laws.leave[nodes], laws.speed[nodes], laws.is_timed[others]
            )
        ),
        PackedRides(
            square=rides.square[nodes],
            lasts=rides.lasts[nodes],
            stays=rides.stays[nodes],
            accel=rides.accel[others],
            brake=rides.brake[others],
            depart=rides.depart[others],
            keeps_pace=rides.keeps_pace[others],
            vanishes=rides.vanishes[others],
        ),
        fleet.separation,
        None if fleet.rounds is None else fleet.rounds[others],
        None if fleet.lead_ins is None else fleet.lead_ins[others],
    )


def _crossings_without(fleet: DrivenFleet, robot: int) -> PackedCrossings:
    """The crossings of the others, by their new numbers."""
    packed, first = fleet.crossings.packed, fleet.courses.packed.first
    stays = (packed.robots != robot).all(axis=1)
    kept = stays[packed.crossing]
    owner = box_owners(packed)[kept]
    number = np.cumsum(stays) - 1
    counts = np.delete(np.bincount(owner, minlength=len(fleet.names)), robot)
    gone = int(first[robot + 1] - first[robot])
    robots, other = packed.robots[stays], packed.other[kept]
    return PackedCrossings(
        robots=robots - (robots > robot),
        span=packed.span[stays],
        box_first=np.concatenate(([0], np.cumsum(counts))).astype(np.int64),
        cell=(packed.cell[kept] - gone * (owner > robot)).astype(np.int32),
        crossing=number[packed.crossing[kept]].astype(np.int32),
        other=(other - (other > robot)).astype(np.int32),
        low=packed.low[kept],
        high=packed.high[kept],
    )
