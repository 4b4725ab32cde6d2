"""Turns of the shortest path: round what it goes round as tightly as its length tells.

A ramp leads into an arc from further out, so that a path with ramps is longer than the taut one.
Here they are made so short that all of them together cost no more than a small part of the length:
a thinner robot's taut path is no longer than a fatter one's, and so neither is its path.

Tested through ``planning/test_optimise_length``.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import turn_path_s
from viaspline.planning.turning.bend_row import KEPT, RADIUS, SIDE, Bends, X, Y
from viaspline.planning.turning.repair import LEAST_RAMP, clear_turn_path
from viaspline.planning.turning.turn_path import RAMP, NoTurnPath, TurnPath, turn_path_on_sides
from viaspline.world.world import World

RAMPS_SHARE: Final = 8e-5
"""Of the length, that ramps may cost."""

RAMP_MOVES_OUT: Final = 24.0
"""A ramp of length l into an arc of radius R moves that out by l² / R over this."""


SHORTER: Final = 0.25
"""By how much ramps get shorter where there is no room for them."""

LEAST_ROOMY_RAMP: Final = 1e-3
"""The shortest of them, in radii: the two corners of a wall may be a millimetre apart."""


def short_turn_path(bends: Bends, world: World, requirements: Requirements) -> TurnPath | None:
    """The shortest clear turn path, with ramps that cost no more than a part of its length.

    Where there is no room for them, or only for turns that were pushed out for it, they are
    shorter: between what is hardly wider apart than the robot lines from turn to turn are short.

    Args:
        bends: The row.
        world: What to keep clear of.
        requirements: What to keep.

    Returns:
        The path; with the shortest ramps there are where even they cost more. None where none is
        clear.
    """
    ramp = short_ramp(bends)
    best = clear_turn_path(bends, world, requirements, ramp)
    requirements.spend(turn_path_s(len(bends.rows)))
    tightest = turn_path_on_sides(bends, LEAST_ROOMY_RAMP)
    if isinstance(tightest, NoTurnPath):
        return best
    enough = (1.0 + RAMPS_SHARE) * tightest.length
    while (best is None or best.length > enough) and ramp > LEAST_ROOMY_RAMP:
        ramp = max(SHORTER * ramp, LEAST_ROOMY_RAMP)
        found = clear_turn_path(bends, world, requirements, ramp)
        if found is not None and (best is None or found.length < best.length):
            best = found
    return best


def short_ramp(bends: Bends) -> float:
    """The length of ramps that cost no more than ``RAMPS_SHARE``, in radii of their turns.

    Example:
        >>> from viaspline.planning.turning.bend_row import bend
        >>> rows = np.array([bend(0, 0), bend(50, 3, kept=3.0, side=-1.0, radius=1.5), bend(99, 0)])
        >>> round(short_ramp(Bends.free(rows, np.array([0, -1, 1]))), 3)
        1.0
        >>> rows[1, Y] = 40.0
        >>> round(short_ramp(Bends.free(rows, np.array([0, -1, 1]))), 3)
        0.473
    """
    rows = bends.rows
    around = np.vstack((rows, rows[:1])) if bends.closed else rows
    offsets, signed = np.diff(around[:, [X, Y]], axis=0), np.diff(_signed(around))
    gaps = np.hypot(*offsets.T)
    length = float(gaps.sum())
    if length == 0.0:
        return RAMP
    lines = np.arctan2(offsets[:, 1], offsets[:, 0])
    lines -= np.arcsin(np.clip(signed / np.maximum(gaps, np.abs(signed)), -1.0, 1.0))
    turns = np.zeros(len(rows))
    if bends.closed:
        turns[:] = lines - np.roll(lines, 1)
    else:
        turns[1:-1] = np.diff(lines)
    turns = np.abs(np.remainder(turns + math.pi, math.tau) - math.pi)
    radii = np.maximum(rows[:, KEPT], np.maximum(rows[:, RADIUS], np.finfo(float).tiny))
    longer = turns * (RAMP * rows[:, RADIUS]) ** 2 / (RAMP_MOVES_OUT * radii)
    share = float(longer.sum()) / length
    return RAMP if share <= RAMPS_SHARE else max(RAMP * math.sqrt(RAMPS_SHARE / share), LEAST_RAMP)


def _signed(rows: Floats) -> Floats:
    """How far left of the lines that touch it each circle's centre lies [m], (n,)."""
    signed: Floats = rows[:, SIDE] * rows[:, KEPT]
    return signed
