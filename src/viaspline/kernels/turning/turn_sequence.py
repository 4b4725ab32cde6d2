"""Straight lines and turns with ramps round a row of bends, through via points at their apexes.

What a car does: every bend of the way becomes a turn whose radius is at least that of the turning
circle, as near to what it goes round as may be. A via point is a bend of radius 0, so the turn
runs through it at its apex; it swings out to either side of it.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.jit import inner, kernel, uncounted
from viaspline.kernels.turning.guessed_lines import brought_near, guess_again, guess_lines
from viaspline.kernels.turning.settled_lines import (
    FINE,
    LEFT_OUT,
    NO_ROOM,
    RADIUS,
    ROUGHLY_SETTLED_RAD,
    SETTLED_RAD,
    needless_bend,
    settle,
)
from viaspline.kernels.turning.turn_spans import fill_ends

MIN_RAMP_RADII = 0.08  # of the radius
RAMP_SHRINK = 0.6


@uncounted
def _overlapping(lines: Floats, ends: Floats, tight: Flags) -> bool:
    """Tell the lines on which turns overlap, and whether there are any."""
    found = False
    for k in range(lines.size):
        after = (k + 1) % ends.shape[0]
        dx, dy = ends[after, 0] - ends[k, 2], ends[after, 1] - ends[k, 3]
        tight[k] = dx * math.cos(lines[k]) + dy * math.sin(lines[k]) < -1e-9
        found = found or tight[k]
    return found


@inner
def _shortened(ramps: Floats, shortest: Floats, tight: Flags, laid: Floats) -> bool:
    """Shorten the ramps of the turns at tight lines, if all of them can be shorter.

    Of two such lines behind each other only the first's: that may make room on the other. If not
    all can be, ``tight`` is left with those that can't, of two behind each other the first.
    """
    count, stuck = ramps.size, np.zeros(tight.size, np.bool_)
    for k in range(tight.size):
        after = (k + 1) % count
        least = ramps[k] <= shortest[k] and ramps[after] <= shortest[after]
        stuck[k] = tight[k] and least and not (k > 0 and stuck[k - 1])
    if stuck.any():
        for k in range(tight.size):
            tight[k] = stuck[k]
        return False
    eased = -2
    for k in range(tight.size):
        if tight[k] and k > eased + 1:
            for end in (k, (k + 1) % count):
                ramps[end] = max(RAMP_SHRINK * ramps[end], shortest[end])
                laid[end] = np.inf  # its turn is another one
            eased = k
    return True


@inner
def lay_turns(
    bends: Floats, closed: bool, ramps: Floats, lines: Floats, turns: Floats, circles: Floats,
    apexes: Floats, tight: Flags,
) -> tuple[int, bool]:  # fmt: skip
    """Lay lines and turns that have the values of a guess, with shorter ramps where room is short.

    Args:
        bends: As in ``turn_sequence``, and so is the next one.
        closed: The same.
        ramps: As long as they may be [m], (n,); changed.
        lines: [rad], (n - 1,) or (n,); changed.
        turns: [rad], (n,); changed.
        circles: What lines touch, (n, 3); changed.
        apexes: [m], (n, 2); filled.
        tight: The lines at which it failed, or the bend that is turned at most to the wrong side.

    Returns:
        What came of it, and whether the lines settled.
    """
    count = bends.shape[0]
    ends, laid = np.empty((count, 4)), np.full((count, 2), np.inf)
    shortest = MIN_RAMP_RADII * bends[:, RADIUS]
    settled = ROUGHLY_SETTLED_RAD
    while True:
        tight[:] = False
        state, moved = settle(
            bends, closed, ramps, lines, turns, circles, apexes, laid, tight, settled
        )
        has_settled = state == FINE
        needless = needless_bend(bends, closed, turns, moved)
        if needless >= 0:
            tight[:] = False
            tight[needless] = True
            return LEFT_OUT, has_settled
        if has_settled:
            fill_ends(bends, closed, ramps, lines, turns, apexes, ends)
            if _overlapping(lines, ends, tight):
                state = NO_ROOM
            elif settled > SETTLED_RAD:
                settled = SETTLED_RAD
                continue
        failed = tight.copy()
        if state == FINE or not _shortened(ramps, shortest, tight, laid):
            return state, has_settled
        settled = ROUGHLY_SETTLED_RAD
        if not has_settled:  # ramps and arcs that come and go, or lines that aren't there
            guess_again(bends, closed, failed, lines, turns, circles, laid)


@kernel
def turn_sequence(
    bends: Floats, closed: bool, ramp: float
) -> tuple[Floats, Floats, Floats, Floats, int, Ints]:
    """Lay lines and turns round a row of bends.

    Args:
        bends: (n, 6), see the columns above; start and goal among them unless closed.
        closed: Whether the last bend is followed by the first.
        ramp: Length of the ramps, in least radii; shorter where there is not as much room.

    Returns:
        Headings of the lines (n - 1,) or (n,), turns (n,) [rad], apexes (n, 2) [m] and ramps
        (n,) [m]; what came of it, and every line at which it failed (k,), or the bend that is
        turned at most to the wrong side, (1,).
    """
    bends, x, y = brought_near(bends)
    count = bends.shape[0]
    lines, turns = np.zeros(count if closed else count - 1), np.zeros(count)
    circles, apexes = np.zeros((count, 3)), np.zeros((count, 2))
    ramps, tight = ramp * bends[:, RADIUS], np.zeros(lines.size, np.bool_)
    guess_lines(bends, closed, lines, turns, circles)
    state, _ = lay_turns(bends, closed, ramps, lines, turns, circles, apexes, tight)
    for k in range(count):
        apexes[k, 0] += x
        apexes[k, 1] += y
    return lines, turns, apexes, ramps, state, np.flatnonzero(tight)
