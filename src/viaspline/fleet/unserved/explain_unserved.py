"""What there is to say of robots that have a path, but no law among the others.

Refused is only what is proven: that two robots can't both get to where they have to. Else it is
said that the planner gave up. A remedy is named once it was tried: with it the robot is served, and
everybody who was served without it.

Tested through ``fleet/test_unserved_fleets``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from viaspline.errors import ViasplineError
from viaspline.fleet.crossing_paths import CrossingPaths, crossing_paths
from viaspline.fleet.laying.lay_round_stretch import laying_cost
from viaspline.fleet.laying.laying_work import LayingWork
from viaspline.fleet.not_served import NotServed, Outcome
from viaspline.fleet.rerouted_fleet import BOXES_A_S
from viaspline.fleet.served_fleet import TRIAL_RELAY_S, TRIAL_REROUTE_S, served_fleet
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.told_progress import FleetProgress, untold
from viaspline.fleet.unserved.blocked_stretch import blocked_stretches
from viaspline.fleet.unserved.fleet_changes import FleetChange, fleet_changes, leaving_out
from viaspline.fleet.unserved.left_out_robots import left_out_for
from viaspline.fleet.unserved.pair_refusal import cannot_both_be_served
from viaspline.fleet.unserved.unserved_words import Blocking, reason_of
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planning.problem.work_budget import WorkBudget

TRIAL_S = 1.0
"""What a trial costs beside its paths and their timing [s of the reference machine]."""
PROOF_S = 2.0
"""What it costs to try a proof that two can't pass [s of the reference machine]."""
LEFT_OUT_SHARE = 0.3
"""Of what may be spent so much at most is for robots without which all others are served,"""
MANY_UNSERVED = 3
"""which are sought where so many aren't; of fewer each other one is left out by itself anyway."""


def explain_unserved(
    fleet: Fleet, paths: CrossingPaths, timed: TimedFleet, budget: float,
    tell: FleetProgress = untold,
) -> tuple[NotServed, ...]:  # fmt: skip
    """Why robots couldn't be timed, and what would help.

    Args:
        fleet: What is asked for.
        paths: That were laid for it.
        timed: What came of it.
        budget: What may be spent on proofs and on trying what would help [s of the reference
            machine].
        tell: Told what of that is spent.

    Returns:
        One for each robot that has a path and no law, in their order.
    """
    blocked = sorted(timed.timing.blocked.items())
    told = _with_spent(0.0, budget, tell)
    told(0.0)
    work = WorkBudget(LEFT_OUT_SHARE * budget)
    without = _without_others(fleet, paths, timed, work) if len(blocked) >= MANY_UNSERVED else {}
    found, left = [], budget - work.spent
    tried: dict[str, frozenset[str]] = {}
    for robot, other in blocked:
        told = _with_spent(budget - left, budget, tell)
        one, helps, spent = _explained(fleet, paths, timed, robot, other, left, tried, told)
        left -= spent
        if not helps and robot in without:
            one = replace(one, remedy=without[robot])
        found.append(one)
    return tuple(found)


def _explained(
    fleet: Fleet, paths: CrossingPaths, timed: TimedFleet, robot: int, other: int, budget: float,
    tried: dict[str, frozenset[str]], told: Callable[[float], None],
) -> tuple[NotServed, bool, float]:  # fmt: skip
    """Why a robot couldn't be timed, what would, whether it does, and what that cost [s].

    What comes of changes that are tried is added to those that were. What it has cost is told as it
    goes on.
    """
    told(0.0)
    ways = timed.ways
    stretches = [] if robot == other else blocked_stretches(timed, robot, other)
    names = ways.courses.names
    if not stretches:
        return (
            NotServed(
                names[robot], "gave up",
                "the order in which all robots pass each other could not be kept",
                "give the robots more room, or take some out",
            ),
            False,
            0.0,
        )  # fmt: skip
    blocking = Blocking(names[robot], names[other], other in timed.timing.blocked, stretches[0])
    where = stretches[0].ends[0]
    spent, is_proven = 0.0, False
    if budget >= PROOF_S:
        spent, is_proven = PROOF_S, cannot_both_be_served(fleet, timed, robot, other)
    cost = _trial_cost(timed)
    served = {one for k, one in enumerate(names) if k not in timed.timing.blocked}
    remedy: str | None = None
    helps = False
    for change in fleet_changes(fleet, timed, stretches):
        if change.words not in tried:
            spent += cost if change.lays_all else TRIAL_S
        if spent > budget:
            remedy = f"move '{names[other]}' out of the way, or leave it out (this wasn't tried)"
            break
        if change.words not in tried:
            work = LayingWork.of(min(TRIAL_RELAY_S, budget - spent))
            told(spent)
            tried[change.words] = _served_with(
                change, fleet, paths, work, partial(_again, told, spent)
            )
            spent += work.budget.spent
        kept = {one.name for one in change.fleet.members}
        if (served & kept) | {names[robot]} <= tried[change.words]:
            remedy, helps = change.words, True
            break
    if remedy is None:
        remedy = f"leave '{names[robot]}' out: it isn't served without '{names[other]}' either"
    outcome: Outcome = "refused" if is_proven else "gave up"
    reason = reason_of(blocking, is_proven=is_proven)
    return NotServed(names[robot], outcome, reason, remedy, (names[other],), where), helps, spent


def _without_others(
    fleet: Fleet, paths: CrossingPaths, timed: TimedFleet, work: WorkBudget
) -> dict[int, str]:
    """For robots that aren't served whom to leave out, in words, so that all others are served.

    More have to be served by it than are so without.

    Args:
        fleet: What is asked for.
        paths: That were laid for it.
        timed: What came of it.
        work: What may be spent.
    """
    names, cost = timed.ways.courses.names, _trial_cost(timed)
    found: dict[int, str] = {}
    for robot in sorted(timed.timing.blocked):
        if robot in found:
            continue
        out = left_out_for(timed, robot, fleet.separation_m, work)
        left = set() if out is None else {names[k] for k in out}
        while 0 < len(left) < len(timed.timing.blocked) and names[robot] not in left:
            change = leaving_out(fleet, [name for name in names if name in left])
            if change is None or work.left < cost:
                break
            work.spent += cost
            served = _served_with(change, fleet, paths, LayingWork.of(0.0), untold)
            others = set(names) - left - served
            if not others:
                here = [k for k in timed.timing.blocked if names[k] not in left]
                found = dict.fromkeys(here, change.words) | found
                break
            left |= others  # along the paths that they have without the first ones they aren't
    return found


def _with_spent(before: float, budget: float, tell: FleetProgress) -> Callable[[float], None]:
    """Tells what is spent, with what one robot has taken of it so far [s]."""

    def told(spent: float) -> None:
        share = (before + spent) / budget if budget > 0.0 else 1.0
        tell("looking for what would help", min(share, 1.0))

    return told


def _again(told: Callable[[float], None], spent: float, _stage: str, _share: float) -> None:
    """Tells, at every step of a trial, what was spent when that began [s]."""
    told(spent)


def _trial_cost(timed: TimedFleet) -> float:
    """What it costs to plan the fleet once more [s of the reference machine]."""
    plans = timed.ways.planar
    laying = len(plans) * max(laying_cost(plan) for plan in plans)
    return TRIAL_S + laying + len(timed.ways.crossings.packed.cell) / BOXES_A_S


def _served_with(
    change: FleetChange, fleet: Fleet, paths: CrossingPaths, work: LayingWork, tell: FleetProgress
) -> frozenset[str]:
    """The robots that are served with a change, if so much may be spent on laying them anew."""
    try:
        then = crossing_paths(change.fleet, before=_reusable(change, fleet, paths))
        tried = served_fleet(change.fleet, then, TRIAL_REROUTE_S, work, tell)
    except ViasplineError:
        return frozenset()
    return frozenset(tried.ways.courses.names) - frozenset(tried.blocked)


def _reusable(change: FleetChange, fleet: Fleet, paths: CrossingPaths) -> CrossingPaths | None:
    """The paths that there are, as far as they hold for a fleet of the same robots."""
    names = [one.name for one in fleet.members]
    is_same = names == [one.name for one in change.fleet.members]
    return paths if is_same and fleet.separation_m == change.fleet.separation_m else None
