"""Robots laid anew farther apart than they must be, with more or less room each time.

The boxes of crossings, which are half a metre long, tell who passes first if there is room. Who
finds no path with little room finds none with more; where that isn't it, more may help.

Tested through ``fleet/test_plan_fleet``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from viaspline.fleet.laying.laying_work import LayingWork
from viaspline.fleet.laying.relay_paths import RelaidPaths, relay_paths
from viaspline.fleet.told_progress import FleetProgress, untold
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import Plan

ROOM_M = 0.3
"""So much farther apart than they must be robots are laid at first [m]."""
NEXT_ROOMS_M = {(0.3, True): 0.6, (0.3, False): 0.0, (0.0, True): 0.15}
"""How much farther apart then [m], after such a room in which all could be laid, or not all."""


def layings_with_room(
    fleet: Fleet, fixed: Mapping[str, Plan], names: Sequence[str], known: Mapping[str, Plan],
    work: LayingWork, tell: FleetProgress = untold,
) -> Iterator[RelaidPaths]:  # fmt: skip
    """What comes of laying robots anew, with one room after the other.

    Args:
        fleet: What is asked for.
        fixed: Plans of robots that are timed, by name, with laws by the clock of the fleet.
        names: The others that are to be served, the most important first.
        known: Other plans of these, by name.
        work: What may be spent, half of what is left with each room; where nothing is, what was
            laid before is still known.
        tell: Told what of it is spent, each time that a robot is laid.
    """
    room: float | None = ROOM_M
    while room is not None:
        wider = fleet.model_copy(update={"separation_m": fleet.separation_m + room})
        with work.share(2) as part:
            relaid = relay_paths(wider, fixed, names, known, part, _share_told(work, part, tell))
        yield relaid
        room = NEXT_ROOMS_M.get((room, not relaid.not_served))


def _share_told(work: LayingWork, part: LayingWork, tell: FleetProgress) -> Callable[[], None]:
    """Tells what of the work is spent once what is spent of a part of it is added."""
    whole = work.budget

    def told() -> None:
        spent = whole.spent + part.budget.spent
        tell("laying paths past others", min(spent / whole.limit, 1.0) if whole.limit else 1.0)

    return told
