"""A fleet in space timed past what moves as it is known, each robot proven clear of it.

Tested through ``fleet/space/test_ways_past_moving``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Final

from viaspline.errors import GaveUpError
from viaspline.fleet.among_moving import ENDLESS
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.space.ways_past_moving import WaysPastMoving, hold_of
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.timed_past import WATCHED_S, WATCHED_SHARE, proven_beside
from viaspline.space.spatial_plan import SpatialPlan

MOST_WATCHED: Final = 4
"""How often what moves is looked at for twice as long, where robots wait longer than that."""

Serve = Callable[[FleetWays, dict[int, int]], TimedFleet]
"""Times robots along their ways, but for those that stand at their starts, each with one that is in
its way."""


def timed_past_moving(ways: FleetWays, serve: Serve) -> TimedFleet:
    """Time a fleet so that every robot that is served is clear of what moves.

    Args:
        ways: The paths of its robots, and how these are flown if nothing moves.
        serve: Times robots along them.
    """
    reasons = {k: ENDLESS for k, one in enumerate(ways.members) if one.mission.route.is_patrol}
    departs = ways.rides.packed.depart
    begin = float(departs.min())
    ends = float((departs + WATCHED_SHARE * ways.rides.alone).max())
    watched = ends + max(hold_of(one) for one in ways.members) - begin + WATCHED_S
    for _ in range(MOST_WATCHED):
        moving = MovingSolid.all_of(ways.members[0].mission, begin, begin + watched)
        timed = _proven(WaysPastMoving.past(ways, moving), serve, reasons)
        if timed is not None:
            return replace(timed, reasons=reasons)
        watched *= 2.0
    raise GaveUpError(
        "robots of the fleet wait for what moves for longer than that is looked at",
        where=ways.plans[0].path.evaluate(0.0).tolist(),
        remedy="let fewer things move, or let robots depart at other times",
        tried=(f"{watched / 2.0:g} s of what moves",),
    )


def _proven(ways: WaysPastMoving, serve: Serve, out: Mapping[int, object]) -> TimedFleet | None:
    """Robots timed, all of them proven clear; None if somebody flies longer than is looked at."""
    watched = min(float(one.times[-1]) for one in ways.moving)
    left_out = {k: k for k in out}
    while True:
        timed = serve(ways, left_out)
        members = {one.name: k for k, one in enumerate(ways.members)}
        for name, plan in timed.plans().items():
            member = ways.members[members[name]]
            assert isinstance(plan, SpatialPlan)
            if plan.trajectory.end_time + hold_of(member) > watched:
                return None
            proof = past_moving(member, plan).moving
            assert proof is not None
            if not proof.holds:
                names = [one.name for one in ways.moving]
                left_out[members[name]] = len(members) + names.index(proof.obstacle or names[0])
        if not set(left_out) - set(timed.timing.blocked):
            return timed


def sooner_past_moving(
    timed: TimedFleet, seconds: float, progress: Callable[[float], None]
) -> TimedFleet:
    """A fleet with sooner laws, if all of it is proven clear of what moves with them.

    Args:
        timed: It.
        seconds: For so much work [s on the reference machine].
        progress: Called with the share of it that is done.
    """
    ways, sooner = timed.ways, timed.improved(seconds, progress)
    assert isinstance(ways, WaysPastMoving)
    members = {one.name: one for one in ways.members}
    for name, plan in sooner.plans().items():
        assert isinstance(plan, SpatialPlan)
        proof = past_moving(members[name], plan).moving
        if proof is None or not proof.holds:
            return timed
    return sooner


def past_moving(member: FleetMember, plan: SpatialPlan) -> SpatialPlan:
    """A robot's plan with what is proven of it and of what moves.

    Args:
        member: The robot.
        plan: With its law by the clock of the fleet.
    """
    law, hold = plan.trajectory, hold_of(member)
    moving = MovingSolid.all_of(plan.mission, law.start_time, law.end_time + hold)
    return replace(plan, moving=proven_beside(plan.path, law, hold, plan.mission, moving))
