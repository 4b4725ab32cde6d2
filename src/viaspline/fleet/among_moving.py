"""A fleet among things that move as it is known: each robot proven clear of them by its own law.

Robots are timed as if nothing moved. Those whose laws are clear of what moves keep them. Each of
the others is laid and timed anew in space and time, among what moves and the robots that have their
laws; then all laws are kept as they are. Who is late by then, for a robot that may come at another
time now, is laid anew once, among all others, if they come sooner by that all together.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.held_laws import laws_hold
from viaspline.fleet.laying.laying_work import LayingWork
from viaspline.fleet.laying.layings_with_room import layings_with_room
from viaspline.fleet.relaid_fleet import driven_alone
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.timing.time_paths import Timing
from viaspline.fleet.told_progress import FleetProgress, untold
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import Plan
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.problem.requirements import Requirements
from viaspline.spacetime.driven_body import driven_body
from viaspline.spacetime.timed_drive import TimedDrive
from viaspline.trajectory.moving_certificate import MovingCertificate, certified_moving
from viaspline.world.moving_obstacles import MovingObstacles

ENDLESS = (
    "it never ends, and nothing is proven for ever of what moves",
    "give it a number of laps, or leave the motion out",
)
"""Said of a patrol among things that move."""

LATE_S = 0.5
"""Who is as much later than alone is laid anew once those that he waits for have other laws [s]."""

Serve = Callable[[dict[int, int]], TimedFleet]
"""Times robots as if nothing moved, but for those that stand at their starts."""


def among_moving(
    fleet: Fleet, ways: FleetWays, serve: Serve, work: LayingWork, tell: FleetProgress = untold
) -> TimedFleet:
    """Time a fleet so that every robot that is served is clear of what moves.

    Args:
        fleet: What is asked for.
        ways: The paths of its robots where nothing moves.
        serve: Times robots along them.
        work: What may be spent on laying robots anew.
        tell: Told of that.
    """
    reasons = {k: ENDLESS for k, one in enumerate(ways.members) if one.mission.route.is_patrol}
    while True:
        timed = serve({k: k for k in reasons})
        plans = timed.planar_plans()
        met = [name for name, plan in plans.items() if not moving_proof(fleet, plan).holds]
        if not met:
            return replace(timed, reasons=reasons)
        found = _relaid(fleet, timed, plans, met, work, tell)
        if isinstance(found, TimedFleet):
            return replace(_sooner(fleet, found, met, work, tell), reasons=reasons)
        names = ways.courses.names
        reasons = {**reasons, **{names.index(name): why for name, why in found.items()}}


def moving_proof(fleet: Fleet, plan: Plan) -> MovingCertificate:
    """How far from all that moves a robot stays, from when it may depart until it has arrived.

    Args:
        fleet: In whose world it is.
        plan: With its law by the clock of the fleet.
    """
    requirements = Requirements.of(plan.mission, plan.tracking_error)
    moving, mission = MovingObstacles(fleet.world.moving), plan.mission
    body = driven_body(
        requirements, mission.robot, plan.path, plan.trajectory, hold=mission.route.hold_s
    )
    return certified_moving(body, moving, requirements.kept)


def proven_among(fleet: Fleet, plan: Plan) -> Plan:
    """A plan of a robot with what is proven of it and of what moves.

    Args:
        fleet: In whose world it is.
        plan: With its law by the clock of the fleet.
    """
    drive = TimedDrive(
        Solution(plan.path, plan.certificate, plan.account),
        plan.trajectory,
        moving_proof(fleet, plan),
        plan.trajectory,
    )
    mission = plan.mission.model_copy(update={"world": fleet.world})
    return replace(plan, mission=mission, timed=drive)


def _relaid(
    fleet: Fleet, timed: TimedFleet, plans: Mapping[str, Plan], met: list[str], work: LayingWork,
    tell: FleetProgress,
) -> TimedFleet | dict[str, tuple[str, str]]:  # fmt: skip
    """The fleet with other paths and laws for those that would be met; or why some have none."""
    fixed = {name: plan for name, plan in plans.items() if name not in met}
    ranks = {one.name: one.priority for one in timed.ways.members}
    names = sorted(met, key=lambda name: -ranks[name])
    failed: dict[str, tuple[str, str]] = {}
    known = dict(zip(timed.ways.courses.names, timed.ways.planar, strict=True))
    for found in layings_with_room(fleet, fixed, names, known, work, tell):
        failed = {one.name: (one.reason, one.remedy) for one in found.not_served}
        if not failed:
            kept = _as_laid(fleet, timed, fixed, found.plans)
            if kept is not None:
                return kept
    if failed:
        return failed
    return {
        names[-1]: (
            "the laws that were found among what moves and the other robots are not proven",
            "let it depart at another time, or give the robots more room",
        )
    }


def _sooner(
    fleet: Fleet, timed: TimedFleet, met: list[str], work: LayingWork, tell: FleetProgress
) -> TimedFleet:
    """The fleet with new laws for those that wait for robots with other laws now, if that helps.

    Args:
        fleet: What is asked for.
        timed: With other laws for those that would have been met.
        met: Their names.
        work: What may be spent.
        tell: Told of that.
    """
    plans, ways = timed.planar_plans(), timed.ways
    alone = dict(zip(ways.courses.names, ways.rides.alone.tolist(), strict=True))
    departs = {one.name: one.mission.route.depart_s for one in ways.members}
    late = [
        name
        for name, plan in plans.items()
        if name not in met and plan.trajectory.end_time > departs[name] + alone[name] + LATE_S
    ]
    again = _relaid(fleet, timed, plans, late, work, tell) if late else None
    if not isinstance(again, TimedFleet):
        return timed
    return min(timed, again, key=_arrivals)


def _arrivals(timed: TimedFleet) -> float:
    """When robots arrive, all together [s]."""
    return sum(plan.trajectory.end_time for plan in timed.planar_plans().values())


def _as_laid(
    fleet: Fleet, timed: TimedFleet, fixed: Mapping[str, Plan], found: Mapping[str, Plan]
) -> TimedFleet | None:
    """The fleet with the very laws that its robots have; None if they don't hold.

    Args:
        fleet: What is asked for.
        timed: As if nothing moved.
        fixed: The plans of it that stay, by name.
        found: All plans, by name, with laws by the clock of the fleet.
    """
    ways, blocked = timed.ways, timed.timing.blocked
    alone = {
        name: driven_alone(found[name]) if name in found and found[name] is not fixed.get(name)
        else plan
        for name, plan in zip(ways.courses.names, ways.planar, strict=True)
    }  # fmt: skip
    laws = {name: plan.trajectory for name, plan in found.items()}
    new = replace(ways, settled=laws).along(alone, fleet.separation_m)
    settled = new.settled_laws()
    packed = settled.packed
    packed.is_timed[list(blocked)] = True
    for robot, name in enumerate(new.courses.names):
        last = int(new.courses.packed.first[robot + 1]) - 1
        if name in found and new.rides.packed.vanishes[robot]:
            packed.leave[last] = found[name].trajectory.end_time
    if not laws_hold(new.courses, new.crossings, settled, fleet.separation_m):
        return None
    kept = TimedFleet(new, Timing(settled, dict(blocked)))
    proofs = (moving_proof(fleet, plan) for plan in kept.planar_plans().values())
    return kept if all(proof.holds for proof in proofs) else None
