"""Robots without which all others are served, as few as are soon found.

In a full corridor hardly any single change helps. But by priority along the paths that there are a
fleet is timed in milliseconds, so robots that are in the way can be left out one after the other
until that serves all others.

Tested through ``fleet/test_unserved_fleets``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Set

from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.rerouted_fleet import BOXES_A_S
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.planning.problem.work_budget import WorkBudget

LOOK_S = 0.02
"""What timing the fleet once costs anyway [s of the reference machine]."""


def left_out_for(
    timed: TimedFleet, robot: int, separation: float, work: WorkBudget
) -> tuple[int, ...] | None:
    """Robots that, if they are left out, let a robot and all others be served by priority.

    Args:
        timed: A fleet, some of whose robots aren't served; all end.
        robot: One of these; it stays.
        separation: Free space between any two bodies [m].
        work: What may be spent on it.

    Returns:
        Their numbers, at least one and fewer than aren't served, none of which could be put back;
        None: it wasn't found.
    """
    every = range(len(timed.ways.members))
    out: list[int] = []
    if work.left <= 0.0:
        return None
    while blocked := _blocked(timed, set(every) - set(out), separation, work):
        among = Counter(k for pair in blocked.items() for k in pair if k != robot)
        if work.left <= 0.0 or not among:
            return None
        if len(out) + 1 >= len(timed.timing.blocked):
            return None
        out.append(max(among, key=lambda k: (k in timed.timing.blocked, among[k], k)))
    for one in list(out):
        fewer = [k for k in out if k != one]
        if not _blocked(timed, set(every) - set(fewer), separation, work):
            out = fewer
    return tuple(sorted(out)) if out and work.left > 0.0 else None


def _blocked(
    timed: TimedFleet, robots: Set[int], separation: float, work: WorkBudget
) -> dict[int, int]:
    """Who of some robots can't be timed if the others aren't there, and who is in its way."""
    ways, chosen = timed.ways, sorted(robots)
    work.spent += LOOK_S + len(ways.crossings.packed.cell) / BOXES_A_S
    members = [ways.members[k] for k in chosen]
    plans = {ways.members[k].name: ways.plans[k] for k in chosen}
    found = TimedFleet.by_priority(FleetWays.laid(members, plans, separation))
    return {chosen[k]: chosen[other] for k, other in found.timing.blocked.items()}
