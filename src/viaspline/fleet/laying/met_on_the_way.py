"""Does a robot that was laid come too near to one that it was laid without?

This says among whom it is to be laid again. It proves nothing: it looks at instants.

Tested through ``fleet/laying/test_relay``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.fleet.member_spec import Rest
from viaspline.planner import Plan

LOOK_S = 0.05
"""Between instants that are looked at [s]."""


def comes_too_near(fleet: Fleet, member: FleetMember, found: Plan, name: str, plan: Plan) -> bool:
    """Whether a robot comes nearer to another one than it may, at instants that are looked at.

    Args:
        fleet: What is asked for.
        member: The robot.
        found: Its plan.
        name: The other one,
        plan: and its plan, both with laws by the clock of the fleet.
    """
    rests = {one.name: one.rest for one in fleet.members}
    bodies = sum(one.mission.robot.outer_radius + one.tracking_error for one in (found, plan))
    needed = bodies + fleet.separation_m
    low, high = _box(found)
    other_low, other_high = _box(plan)
    if (low > other_high + needed).any() or (other_low > high + needed).any():
        return False
    end = max(found.trajectory.end_time, plan.trajectory.end_time)
    times = np.append(np.arange(0.0, end, LOOK_S), end)
    own, its = _places(found, times, member.rest), _places(plan, times, rests[name])
    apart = np.hypot(*(own - its).T)
    return bool((apart < needed).any())  # who has left is nowhere: no number compares


def _box(plan: Plan) -> tuple[Floats, Floats]:
    spans = plan.path.spans[..., :2]
    return spans.min(axis=(0, 1)), spans.max(axis=(0, 1))


def _places(plan: Plan, times: Floats, rest: Rest) -> Floats:
    """Where a robot is [m], (k, 2); not a number once it has left."""
    law = plan.trajectory
    places: Floats = np.array(plan.path.at_distance(law.distance_at(times)))[:, :2]
    if rest == "leave":
        places[times > law.end_time] = np.nan
    return places
