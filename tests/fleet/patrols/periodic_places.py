"""Where the robots of a fleet are, by nothing but the first period of each patrol."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.kernels.arrays import Floats
from viaspline.mission.fleet.fleet import FleetMember


def places(plan: FleetPlan, member: FleetMember, times: Floats) -> Floats:
    """Of a robot that is served [m], (t, 2); not a number where it has left."""
    one = plan.plans[member.name]
    law = one.trajectory
    if member.mission.route.is_patrol:
        assert plan.patrols is not None
        begin, period = plan.patrols.begins[member.name], plan.patrols.period
        phases = np.where(times < begin, begin, begin + (times - begin) % period)
        found = np.asarray(one.path.at_distance(law.distance_at(phases)))[:, :2].copy()
    else:
        found = np.asarray(one.path.at_distance(law.distance_at(times)))[:, :2].copy()
        if member.rest == "leave":
            found[times > law.end_time] = np.nan
    return found


def nearest(plan: FleetPlan, periods: int = 4, step: float = 0.01) -> float:
    """The least free space between two bodies that samples meet, over several periods [m]."""
    end = max(one.trajectory.end_time for one in plan.plans.values())
    if plan.patrols is not None:
        end = plan.patrols.repeats_from + periods * plan.patrols.period
    times = np.arange(0.0, end, step)
    members = [one for one in plan.fleet.members if one.name in plan.plans]
    where = {one.name: places(plan, one, times) for one in members}
    least = np.inf
    for one, two in combinations(members, 2):
        apart = np.hypot(*(where[one.name] - where[two.name]).T)
        bodies = one.mission.robot.outer_radius + two.mission.robot.outer_radius
        least = min(least, float(np.nanmin(apart, initial=np.inf)) - bodies)
    return least
