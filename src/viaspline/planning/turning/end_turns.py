"""Turns into headings that are given at the ends of a path: to which side, and how wide.

Either side of a heading may be the sooner one. A robot that stands at an end is slow beside it: a
turn as wide as full speed asks for is only longer there.

Tested through ``planning/turning/test_end_turns``.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viaspline.planning.checking.driving_time import leg_time
from viaspline.planning.problem.path_pace import Pace
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.turning.bend_row import HEADING, Bends
from viaspline.planning.turning.turn_path import TurnPath, with_sides
from viaspline.planning.turning.wide_turns import GENTLE_SHARE, WideTurns
from viaspline.world.world import World

NARROWER = (math.inf, 0.5, 0.25, 0.125, 0.0625, 0.0)
"""Turns that are tried beside a rest: at most so wide, in radii of the turn at full speed."""


def soonest_end_turns(
    turns: WideTurns,
    bends: Bends,
    world: World,
    requirements: Requirements,
    rests: tuple[bool, bool],
) -> TurnPath | None:
    """The turn path that is driven soonest; of those that are as good as that, the widest.

    Args:
        turns: What turns should be like.
        bends: The row.
        world: What to keep clear of.
        requirements: What to keep.
        rests: Whether the robot stands where the row begins, and where it ends.

    Returns:
        None where not even the least turns are clear.
    """
    sided, caps = tuple(with_sides(bends)), _caps(turns.pace, bends, rests)
    if len(sided) == len(caps) == 1:
        row = _capped(bends, caps[0], rests)
        return turns.narrowed(row, world, requirements) or turns.pushed(bends, world, requirements)
    laid: dict[tuple[int, int], TurnPath] = {}
    times: dict[tuple[int, int], float] = {}

    def lay(cap: int, side: int) -> None:
        row = _capped(sided[side], caps[cap], rests)
        found = turns.narrowed(row, world, requirements)
        if found is not None:
            laid[cap, side] = found
            times[cap, side] = leg_time(found.spans, turns.pace, rests)

    narrowest = len(caps) - 1
    for cap in sorted({0, narrowest}):
        for side in range(len(sided)):
            lay(cap, side)
    if not laid:
        return turns.pushed(bends, world, requirements)
    if len(laid) > 1:
        _, side = min(times, key=lambda tried: (times[tried], tried))
        for cap in range(1, narrowest):
            lay(cap, side)
    most = (1.0 + GENTLE_SHARE) * min(times.values())
    good = [(cap, times[cap, side], side) for cap, side in laid if times[cap, side] <= most]
    cap, _, side = min(good)
    return laid[cap, side]


def _caps(pace: Pace, bends: Bends, rests: tuple[bool, bool]) -> tuple[float, ...]:
    """How wide turns into given headings may be at most where the robot rests, [m], falling."""
    given = np.isfinite(bends.rows[[0, -1], HEADING])
    widest = pace.widest_radius
    if bends.closed or not (given & np.array(rests)).any() or not 0.0 < widest < math.inf:
        return (math.inf,)
    return tuple(share * widest for share in NARROWER)


def _capped(bends: Bends, cap: float, rests: tuple[bool, bool]) -> Bends:
    """A row whose turns into headings at rests are no wider than a radius [m]."""
    if cap == math.inf:
        return bends
    swings = bends.swings.copy()
    for k, stands in zip((0, -1), rests, strict=True):
        if stands and np.isfinite(bends.rows[k, HEADING]):
            swings[k] = min(swings[k], cap)
    return replace(bends, swings=swings)
