"""Two robots of a fleet of which it is proven that not both can be served.

Tested through ``fleet/test_unserved_fleets``.
"""

from __future__ import annotations

from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.unserved.passing_proof import PassingRobot, cannot_both_arrive
from viaspline.mission.fleet.fleet import Fleet


def cannot_both_be_served(fleet: Fleet, timed: TimedFleet, robot: int, other: int) -> bool:
    """Whether it is proven that one of two robots can't be served.

    Args:
        fleet: What is asked for.
        timed: The fleet, of which neither was timed among the others.
        robot: One of them.
        other: The other one.
    """
    plans = timed.ways.planar[robot], timed.ways.planar[other]
    if any(plan.path.dimension != 2 for plan in plans):
        return False
    one, two = (_passing(fleet, timed, k) for k in (robot, other))
    return cannot_both_arrive(plans[0].world, one, two)


def _passing(fleet: Fleet, timed: TimedFleet, robot: int) -> PassingRobot:
    """A robot as the proof takes it: with no more than is asked for."""
    plan, member = timed.ways.plans[robot], timed.ways.members[robot]
    asked, route = plan.mission.robot, plan.mission.route
    points = [via.at[:2] for _, via in route.points()]
    if route.closed:
        points.append(route.start.at[:2])
    # The reference point of a footprint may lie beside the body.
    inner = asked.radius_m if asked.footprint is None else -asked.outer_radius
    return PassingRobot(
        points=tuple((x, y) for x, y in points),
        kept=inner + asked.clearance_m,
        reach=asked.outer_radius + 0.5 * fleet.separation_m,
        leaves=member.rest == "leave",
    )
