"""Other paths for those robots that can't be timed along theirs.

Each is laid in space and time among the robots that are timed. Then all are timed anew along the
paths that came of it; where that leaves some blocked, the laws with which the paths were laid are
kept, if they are proven apart and give every crossing an order.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from viaspline.fleet.courses import courses_of
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.fleet_laws import FleetLaws, static_laws
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.held_laws import laws_hold
from viaspline.fleet.laying.laying_work import LayingWork
from viaspline.fleet.laying.layings_with_room import layings_with_room
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.timing.rides import rides_of
from viaspline.fleet.timing.time_paths import Timing
from viaspline.fleet.told_progress import FleetProgress, untold
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import Plan
from viaspline.whole_plan import fastest_law, stations


def relaid_fleet(
    fleet: Fleet, timed: TimedFleet, work: LayingWork, tell: FleetProgress = untold
) -> TimedFleet | None:
    """A fleet timed along other paths for those that are blocked.

    Args:
        fleet: What is asked for.
        timed: With robots that are blocked.
        work: What may be spent.
        tell: Told what of that is spent, each time that a robot is laid.

    Returns:
        None where no more are served by it.
    """
    ways, blocked = timed.ways, timed.timing.blocked
    fixed = timed.planar_plans()
    wanted = [k for k in blocked if not ways.members[k].mission.route.is_patrol]
    wanted.sort(key=lambda k: (-ways.members[k].priority, k))
    names = [ways.members[k].name for k in wanted]
    known = dict(zip(ways.courses.names, ways.planar, strict=True))
    best: TimedFleet | None = None
    for relaid in layings_with_room(fleet, fixed, names, known, work, tell):
        if len(relaid.plans) <= len(fixed):
            continue
        again = _along(fleet, ways, fixed, relaid.plans)
        if len(again.blocked) < len((best or timed).blocked):
            best = again
        if not again.blocked:
            break
    return best


def _along(
    fleet: Fleet, ways: FleetWays, fixed: Mapping[str, Plan], found: Mapping[str, Plan]
) -> TimedFleet:
    """A fleet along paths of which some were laid anew: timed anew, or else as they were laid."""
    plans = {
        member.name: plan
        if found.get(member.name) is fixed.get(member.name)
        else driven_alone(found.get(member.name, plan))
        for member, plan in zip(ways.members, ways.planar, strict=True)
    }
    again = TimedFleet.by_priority(ways.along(plans, fleet.separation_m))
    if again.blocked and len(found) == len(ways.members):
        laid = _as_laid(ways, {one.name: found[one.name] for one in ways.members}, plans, fleet)
        return again if laid is None else laid
    return again


def _as_laid(
    ways: FleetWays, found: Mapping[str, Plan], alone: Mapping[str, Plan], fleet: Fleet
) -> TimedFleet | None:
    """A fleet with the very laws with which its paths were laid; None if they don't hold.

    Args:
        ways: Of the same robots.
        found: Their plans, with laws by the clock of the fleet.
        alone: These with the laws of robots that are alone.
        fleet: What is asked for.
    """
    courses = courses_of(found, fleet.separation_m)
    crossings = crossings_of(courses)
    plans = tuple(replace(plan, timed=None) for plan in found.values())  # others are no obstacles
    rides = rides_of(ways.members, plans, courses)
    packed = static_laws(courses, [plan.trajectory for plan in plans]).packed
    for robot, plan in enumerate(plans):
        if rides.packed.vanishes[robot]:
            packed.leave[courses.packed.first[robot + 1] - 1] = plan.trajectory.end_time
    laws = FleetLaws(packed)
    if not laws_hold(courses, crossings, laws, fleet.separation_m):
        return None
    durations = np.array([plan.trajectory.duration for plan in alone.values()])
    led = FleetWays(ways.members, plans, courses, crossings, replace(rides, alone=durations))
    return TimedFleet(led, Timing(laws, {}))


def driven_alone(plan: Plan) -> Plan:
    """A plan with the law that its robot would drive along its path if it were alone.

    Args:
        plan: With whatever law.
    """
    law = fastest_law(plan.path, plan.mission, stations(plan.path, plan.mission.robot))
    return replace(plan, trajectory=law, timed=None)
