"""How each robot of a fleet drives where it is alone: the law that timing delays.

Tested through ``fleet/timing/test_time_paths``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.fleet_laws import FleetLaws, static_laws
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.machine.machine_limits import limits_of
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.planner import Plan
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.timing.retime_in_space import along_limits
from viaspline.trajectory.coupled import is_coupled
from viaspline.trajectory.limits import Limits


@told_in_lines
@dataclass(frozen=True, eq=False)
class FleetRides(ComparedByValue):
    """The fastest law of every robot where it is alone.

    Attributes:
        packed: As kernels see them.
        alone: How long each takes [s], (n,).
        laws: When each would be where, if it set out when it departs [s].
    """

    packed: PackedRides
    alone: Floats
    laws: FleetLaws


def rides_of(
    members: Sequence[FleetMember], plans: Sequence[Plan | SpatialPlan], courses: FleetCourses
) -> FleetRides:
    """How robots drive where they are alone.

    A robot whose limits couple speed and acceleration, or of whose jerk there is a limit, can't be
    slowed down by a simple rule: it waits where it stands anyway, at home and at its stations.

    Args:
        members: The robots, in the order of the courses.
        plans: Their plans, whose laws are those of robots that are alone.
        courses: Their paths, cut into cells.
    """
    laws = static_laws(courses, [plan.trajectory for plan in plans]).packed
    first = courses.packed.first
    ends = first[1:] - 1
    stays = laws.leave - laws.arrive
    stays[ends] = [plan.trajectory.end_time for plan in plans] - laws.arrive[ends]
    lasts = np.zeros_like(stays)
    lasts[:-1] = laws.arrive[1:] - laws.leave[:-1]
    lasts[ends] = 0.0
    depart = np.array([member.mission.route.depart_s for member in members], float)
    later = np.repeat(depart - laws.arrive[first[:-1]], np.diff(first))
    by_clock = laws._replace(arrive=laws.arrive + later, leave=laws.leave + later)
    limits = [_limits(plan) for plan in plans]
    paced = [
        one.max_jerk is not None or is_coupled(one, plan.path.dimension)
        for one, plan in zip(limits, plans, strict=True)
    ]
    return FleetRides(
        PackedRides(
            square=laws.speed**2,
            lasts=lasts,
            stays=stays,
            accel=np.array([one.max_accel for one in limits]),
            brake=np.array([one.brake for one in limits]),
            depart=depart,
            keeps_pace=np.array(paced, np.bool_),
            vanishes=np.array([_leaves(member) for member in members], np.bool_),
        ),
        np.array([plan.trajectory.duration for plan in plans]),
        FleetLaws(by_clock),
    )


def goal_stays(courses: FleetCourses, rides: FleetRides) -> Floats:
    """How long each robot has to stand at its goal until it has arrived [s], (n,)."""
    return rides.packed.stays[courses.packed.first[1:] - 1]


def _limits(plan: Plan | SpatialPlan) -> Limits:
    """Of a robot along its path."""
    if isinstance(plan, SpatialPlan):
        return along_limits(plan.limits)
    return limits_of(plan.mission.robot)


def _leaves(member: FleetMember) -> bool:
    """Whether a robot leaves the world at its goal; a patrol has none, whatever it says."""
    return member.rest == "leave" and not member.mission.route.is_patrol
