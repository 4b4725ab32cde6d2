"""Other paths for those robots that can't be timed along theirs.

Each is laid in space and time among the robots that are timed. Then all are timed anew along the
paths that came of it: the orders are those of timing, whose proof and whose grants hold.

Tested through ``fleet/test_plan_fleet``.
"""

from __future__ import annotations

from dataclasses import replace

from viaspline.fleet.laying.relay_paths import relay_paths
from viaspline.fleet.timed_fleet import FleetWays, TimedFleet
from viaspline.fleet.timing.timed_trajectory import timed_trajectory
from viaspline.machine.machine_limits import limits_of
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import Plan
from viaspline.trajectory.retime import retime
from viaspline.whole_plan import stations

MOST_RELAID = 24
"""So many robots are laid anew at most."""
MOST_AMONG = 120
"""Among so many, each of which is a moving obstacle to those that are laid."""


def relaid_ways(fleet: Fleet, timed: TimedFleet) -> FleetWays | None:
    """The ways of a fleet with other paths for those that are blocked.

    Args:
        fleet: What is asked for.
        timed: With robots that are blocked.

    Returns:
        None where there are too many, or no path was found for any of them.
    """
    ways, blocked = timed.ways, timed.timing.blocked
    if len(blocked) > MOST_RELAID or len(ways.members) > MOST_AMONG:
        return None
    fixed = {
        member.name: replace(
            plan,
            trajectory=timed_trajectory(
                plan.trajectory, ways.courses, ways.rides, timed.timing.laws, k
            ),
        )
        for k, (member, plan) in enumerate(zip(ways.members, ways.plans, strict=True))
        if k not in blocked
    }
    wanted = sorted(blocked, key=lambda k: (-ways.members[k].priority, k))
    names = [ways.members[k].name for k in wanted]
    found = relay_paths(fleet, fixed, names).plans
    if not any(name in found for name in names):
        return None
    plans = {
        member.name: plan
        if found.get(member.name) is fixed.get(member.name)
        else _alone(found.get(member.name, plan))
        for member, plan in zip(ways.members, ways.plans, strict=True)
    }
    return ways.along(plans, fleet.separation_m)


def _alone(plan: Plan) -> Plan:
    """A plan with the law that its robot would drive along its path if it were alone."""
    robot, zones = plan.mission.robot, plan.mission.world.speed_zones
    law = retime(plan.path, limits_of(robot), stations(plan.path, robot), zones=zones)
    return replace(plan, trajectory=law, timed=None)
