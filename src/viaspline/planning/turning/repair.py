"""Pushing a turn path away from what it comes too close to.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.planning.checking.conflicts import CLEAR, body_conflicts, is_clear
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import turn_path_s
from viaspline.planning.turning.bend_row import DETOUR, KEPT, RADIUS, SIDE, Bends, bend
from viaspline.planning.turning.tightest_place import tightest_place
from viaspline.planning.turning.turn_path import (
    RAMP,
    NoTurnPath,
    TurnPath,
    count_of_sides,
    turn_path_on_sides,
    turn_path_round,
    turned_otherwise,
    with_sides,
)
from viaspline.world.world import World

MAX_PUSH_ROUNDS = 12
BEND_SLACK_M = 2e-3  # what a bend keeps beyond what is required
RAMP_SHORTENING = 0.5  # of the ramps' length from one round to another
LEAST_RAMP = 0.08  # length of a ramp, in radii
SAME_BEND = 0.25  # bends nearer to each other than this, in required distances, are one


@dataclass(frozen=True)
class Stuck:
    """A turn path that could not be pushed clear.

    Attributes:
        places: Finds the places where it got stuck, with what may be spent on that: of each the
            leg, and what its taut path goes by there [m], (2,). A later step of a search has a
            budget of its own.
        vias: Finds the via points about all such places.
    """

    places: Callable[[Requirements], tuple[tuple[int, Floats], ...]]
    vias: Callable[[Requirements], frozenset[int]]


def clear_turn_path(
    bends: Bends, world: World, requirements: Requirements, ramp: float = RAMP
) -> TurnPath | None:
    """The shortest clear turn path, to any sides of given headings, pushed away from what is near.

    Args:
        bends: The row.
        world: What to keep clear of.
        requirements: What to keep.
        ramp: Length of the ramps, in radii; shorter where that is needed.
    """
    found = clear_turn_path_or_why(bends, world, requirements, ramp)
    return found if isinstance(found, TurnPath) else None


def clear_turn_path_or_why(
    bends: Bends, world: World, requirements: Requirements, ramp: float = RAMP
) -> TurnPath | Stuck:
    """The shortest clear turn path, or where it got stuck; see ``clear_turn_path``.

    Being pushed makes a turn path no shorter, but for what shorter ramps save: sides that are
    longer than what is clear already are left as they are. Where none can be cleared, via points
    are turned at to the other side as well.
    """
    best: TurnPath | None = None
    choices = list(with_sides(bends))
    laid = [_as_laid(each, ramp, requirements) for each in choices]
    for first in sorted(laid, key=_length):
        if best is not None and best.length <= _length(first):
            break
        found = _once_pushed(first, world, requirements, ramp)
        if isinstance(found, TurnPath) and (best is None or found.length < best.length):
            best = found
    if best is not None:
        return best
    otherwise = (_as_laid(each, ramp, requirements) for each in turned_otherwise(bends, None))
    for first in sorted(otherwise, key=_length):
        found = _once_pushed(first, world, requirements, ramp)
        if isinstance(found, TurnPath):
            return found
    return _once_pushed(laid[0], world, requirements, ramp)


def _as_laid(bends: Bends, ramp: float, requirements: Requirements) -> TurnPath | NoTurnPath:
    """See ``_laid``."""
    return requirements.recalled(
        ("laid", bends.key, ramp), partial(_laid, bends, ramp, requirements)
    )


def _length(laid: TurnPath | NoTurnPath) -> float:
    """[m]; inf where there is none."""
    return laid.length if isinstance(laid, TurnPath) else math.inf


def _once_pushed(
    laid: TurnPath | NoTurnPath, world: World, requirements: Requirements, ramp: float
) -> TurnPath | Stuck:
    """See ``_pushed_clear``."""
    return requirements.recalled(
        ("pushed clear", laid.bends.key, ramp, world),
        partial(_pushed_clear, laid, world, requirements, ramp),
    )


def turn_path_if_clear(bends: Bends, world: World, requirements: Requirements) -> TurnPath | None:
    """The shortest turn path to any sides of given headings, if it is clear as it is."""
    return requirements.recalled(
        ("as it is", bends.key, world), partial(_if_clear, bends, world, requirements)
    )


def _if_clear(bends: Bends, world: World, requirements: Requirements) -> TurnPath | None:
    """See ``turn_path_if_clear``."""
    requirements.spend(turn_path_s(len(bends.rows)) * count_of_sides(bends))
    turn_path = turn_path_round(bends)
    if isinstance(turn_path, NoTurnPath) or not is_clear(world, turn_path.spans, requirements):
        return None
    return turn_path


def _pushed_clear(
    turn_path: TurnPath | NoTurnPath, world: World, requirements: Requirements, ramp: float
) -> TurnPath | Stuck:
    """A turn path pushed clear, to the same sides, or where it got stuck."""
    for left in reversed(range(MAX_PUSH_ROUNDS)):
        spent = requirements.spent
        if isinstance(turn_path, NoTurnPath):
            return Stuck(partial(_between, turn_path), partial(_vias_between, turn_path))
        close = body_conflicts(world, turn_path.spans, requirements)
        if (close == CLEAR).all():
            return turn_path
        wider = _pushed(turn_path, close, world, requirements)
        pushed = _laid(wider, ramp, requirements)
        rows = turn_path.bends.rows
        if isinstance(pushed, TurnPath) and np.array_equal(pushed.bends.rows, rows):
            ramp *= RAMP_SHORTENING  # the lines are far enough off, the ramps cut the corner
            pushed = _laid(turn_path.bends, ramp, requirements)
        elif isinstance(pushed, TurnPath) and _are_one(pushed, turn_path):
            cost = requirements.spent - spent
            for _ in range(left):  # no round would do more; each is paid for, and not gone
                requirements.spend(cost)
            break
        if isinstance(pushed, NoTurnPath) or ramp < LEAST_RAMP:
            return _too_close(turn_path, close, world)
        turn_path = pushed
    assert isinstance(turn_path, TurnPath)
    close = body_conflicts(world, turn_path.spans, requirements)
    if (close == CLEAR).all():
        return turn_path
    return _too_close(turn_path, close, world)


def _too_close(turn_path: TurnPath, close: NDArray[np.int64], world: World) -> Stuck:
    """Where some spans of a turn path are too close."""
    where = partial(_first_too_close, turn_path, close, world)
    return Stuck(where, partial(_vias_too_close, turn_path, close, world))


def _are_one(first: TurnPath, second: TurnPath) -> bool:
    """Whether two turn paths are the same."""
    same_bends = first.bends.key == second.bends.key
    return same_bends and np.array_equal(first.spans, second.spans)


def _laid(bends: Bends, ramp: float, requirements: Requirements) -> TurnPath | NoTurnPath:
    """The turn path to the sides that are set; it is laid once more for each bend it leaves out."""
    requirements.spend(turn_path_s(len(bends.rows)))
    found = turn_path_on_sides(bends, ramp)
    requirements.spend((len(bends.rows) - len(found.bends.rows)) * turn_path_s(len(bends.rows)))
    return found


def _between(failed: NoTurnPath, _: Requirements) -> tuple[tuple[int, Floats], ...]:
    """Where two bends leave no room for their turns."""
    line = int(failed.lines[0])
    rows = (line, (line + 1) % len(failed.bends.rows))
    return tuple(
        (failed.bends.leg_of(row), failed.bends.rows[row, :2])
        for row in rows
        if failed.bends.vias[row] == DETOUR
    )


def _first_too_close(
    turn_path: TurnPath, close: NDArray[np.int64], world: World, requirements: Requirements
) -> tuple[tuple[int, Floats], ...]:
    """Where the first run of spans is too close."""
    tight = tightest_place(turn_path.spans, _runs(close)[0], world, requirements)
    return ((turn_path.bends.leg_of(_row_before(turn_path, tight.u)), tight.wall),)


def _vias_between(failed: NoTurnPath, _: Requirements) -> frozenset[int]:
    """The via points about the lines on which there is no room for turns."""
    return frozenset().union(*map(failed.bends.vias_about, failed.lines.tolist()))


def _vias_too_close(
    turn_path: TurnPath, close: NDArray[np.int64], world: World, requirements: Requirements
) -> frozenset[int]:
    """The via points about the tightest place of each run of spans that is too close."""
    places = (tightest_place(turn_path.spans, run, world, requirements) for run in _runs(close))
    return frozenset().union(*(turn_path.vias_about(tight.u) for tight in places))


def _runs(close: NDArray[np.int64]) -> list[NDArray[np.intp]]:
    """The spans that are too close, those as one that follow each other."""
    hit = np.flatnonzero(close != CLEAR)
    return np.split(hit, np.flatnonzero(np.diff(hit) > 1) + 1)


def _pushed(
    turn_path: TurnPath, close: NDArray[np.int64], world: World, requirements: Requirements
) -> Bends:
    """The bends with one more, or a wider one, for every run of spans that is too close."""
    bends = turn_path.bends
    for run in reversed(_runs(close)):  # from the end, so that the earlier indices stay
        bends = _push(bends, turn_path, run, world, requirements)
    return bends


def _push(
    bends: Bends, turn_path: TurnPath, run: NDArray[np.int64], world: World,
    requirements: Requirements,
) -> Bends:  # fmt: skip
    tight = tightest_place(turn_path.spans, run, world, requirements)
    left = np.array([-tight.along[1], tight.along[0]])
    side = 1.0 if tight.into @ left > 0.0 else -1.0
    row = _row_before(turn_path, tight.u) + 1
    for near in (row - 1, row % len(bends.rows)):
        if bends.vias[near] == DETOUR and bends.rows[near, SIDE] == side:
            off = float(np.linalg.norm(bends.rows[near, :2] - tight.wall))
            same = SAME_BEND * requirements.required
            if off < max(same, bends.rows[near, KEPT] - same):
                return bends.widened(near, 1.1 * tight.missing + BEND_SLACK_M)
    x, y = tight.wall.tolist()
    radius = float(bends.rows[[row - 1, row % len(bends.rows)], RADIUS].min())
    return bends.with_bend(row, bend(x, y, tight.kept + BEND_SLACK_M, side, radius))


def _row_before(turn_path: TurnPath, u: float) -> int:
    """The bend whose apex comes before a parameter of the curve."""
    return int(np.searchsorted(turn_path.begins[: len(turn_path.bends.rows)], u, side="right")) - 1
