"""Where lines and turns round a row of bends begin, before they settle.

Tested through ``kernels/turning/test_turn_sequence``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.jit import inner, uncounted
from viaspline.kernels.turning.settled_lines import KEPT, SIDE, X, Y, touching_line, wrapped

GUESSED_ABOUT = 2  # lines before and after one at which it failed, that are guessed again with it
# A turn between the middles of bends, to a bend's side, beyond which that may be a whole turn more
# than the tangents make: each lies up to a quarter turn off the line between the middles [rad].
SURE_TURN_RAD = 0.5 * math.pi
MIDDLE_TURN_RAD = 0.75 * math.pi  # of those that are looked for between tangents
FAR_OFF_M = 1e4  # places so far from the origin are reckoned from one that is nearer to them


@inner
def brought_near(bends: Floats) -> tuple[Floats, float, float]:
    """Bends about a place that is near to them, and that place [m].

    Lines settle to the last digit of a heading, and in UTM a millionth of a millimetre is the last
    digit of a place.
    """
    x = FAR_OFF_M * np.floor(bends[0, X] / FAR_OFF_M + 0.5)
    y = FAR_OFF_M * np.floor(bends[0, Y] / FAR_OFF_M + 0.5)
    near = bends.copy()
    for k in range(near.shape[0]):
        near[k, X] -= x
        near[k, Y] -= y
    return near, x, y


@uncounted
def guess_lines(bends: Floats, closed: bool, lines: Floats, turns: Floats, circles: Floats) -> None:
    """Begin with the polyline through the bends' middles, and circles of what is kept.

    Where that turns far, the tangents of these circles say whether it goes right round one.
    """
    count, last = bends.shape[0], lines.shape[0]
    for k in range(last):
        lines[k] = _middles_line(bends, k)
    for k in range(count):
        _guess_turn(bends, closed, k, lines, turns, circles)
    for k in range(count):
        _turn_back(bends, closed, k, lines, turns, circles)
    for k in range(count):
        _touch_where_far(bends, closed, k, lines, turns, circles)


@uncounted
def guess_again(
    bends: Floats, closed: bool, tight: Flags, lines: Floats, turns: Floats, circles: Floats,
    laid: Floats,
) -> None:  # fmt: skip
    """Begin anew about lines that are tight, and leave the others where they settled.

    Args:
        bends: As in ``turn_sequence``, and so is the next one.
        closed: The same.
        tight: Of which lines, (m,).
        lines: [rad], (m,); changed.
        turns: [rad], (n,); changed.
        circles: What lines touch, (n, 3); changed.
        laid: As in ``_lay``; changed.
    """
    count, last = bends.shape[0], lines.shape[0]
    for k in range(last):
        if not tight[k]:
            continue
        for i in range(k - GUESSED_ABOUT, k + GUESSED_ABOUT + 1):
            if closed or 0 <= i < last:
                lines[i % last] = _middles_line(bends, i % last)
    for k in range(last):
        if not tight[k]:
            continue
        for i in range(k - GUESSED_ABOUT, k + GUESSED_ABOUT + 2):
            if closed or 0 <= i < count:
                _guess_turn(bends, closed, i % count, lines, turns, circles)
                laid[i % count] = np.inf
    for k in range(last):
        if not tight[k]:
            continue
        for i in range(k - GUESSED_ABOUT, k + GUESSED_ABOUT + 2):
            if closed or 0 <= i < count:
                _turn_back(bends, closed, i % count, lines, turns, circles)
    for k in range(last):
        if not tight[k]:
            continue
        for i in range(k - GUESSED_ABOUT, k + GUESSED_ABOUT + 2):
            if closed or 0 <= i < count:
                _touch_where_far(bends, closed, i % count, lines, turns, circles)


@uncounted
def _turn_back(
    bends: Floats, closed: bool, k: int, lines: Floats, turns: Floats, circles: Floats
) -> None:
    """Turn to the other side at a bend to no side, if it is that of the lesser turn of tangents.

    From round an obstacle to a via point and back round it, middles turn by just half a turn: to
    which side is told by rounding then, and a turn stays on the side where it is.
    """
    count, last = bends.shape[0], lines.shape[0]
    is_inside = closed or 0 < k < count - 1
    if not is_inside or bends[k, SIDE] != 0.0 or abs(turns[k]) <= SURE_TURN_RAD:
        return
    before = touching_line(circles, (k - 1) % last, k)
    after = touching_line(circles, k, (k + 1) % count)
    turn = wrapped(after - before, 0.0)
    if turn * turns[k] < 0.0:  # not where there is no tangent
        turns[k] += math.copysign(2.0 * math.pi, turn)


@uncounted
def _touch_where_far(
    bends: Floats, closed: bool, k: int, lines: Floats, turns: Floats, circles: Floats
) -> None:
    """Guess the lines at a bend by tangents, where those between middles turn far at it."""
    count, last = bends.shape[0], lines.shape[0]
    is_inside = closed or 0 < k < count - 1
    if not is_inside or bends[k, SIDE] * turns[k] <= SURE_TURN_RAD:
        return
    for i in range(k - 1, k + 1):
        line = touching_line(circles, i % last, (i + 1) % count)
        if not math.isnan(line):
            lines[i % last] = line
    turns[k] = bends[k, SIDE] * MIDDLE_TURN_RAD
    for i in range(k - 1, k + 2):
        if closed or 0 < i < count - 1:
            at = i % count
            turns[at] = wrapped(lines[at % last] - lines[(at - 1) % last], turns[at])


@uncounted
def _middles_line(bends: Floats, k: int) -> float:
    """Heading from the middle of a bend to that of the next."""
    after = (k + 1) % bends.shape[0]
    return math.atan2(bends[after, Y] - bends[k, Y], bends[after, X] - bends[k, X])


@uncounted
def _guess_turn(
    bends: Floats, closed: bool, k: int, lines: Floats, turns: Floats, circles: Floats
) -> None:
    """The turn of a bend between guessed lines, round a circle of what is kept."""
    count, last = bends.shape[0], lines.shape[0]
    circles[k, 0], circles[k, 1] = bends[k, X], bends[k, Y]
    circles[k, 2] = bends[k, SIDE] * bends[k, KEPT]
    turns[k] = 0.0
    if closed or 0 < k < count - 1:
        turns[k] = wrapped(lines[k % last] - lines[(k - 1) % last], bends[k, SIDE])
    elif bends[k, SIDE] != 0.0:
        turns[k] = bends[k, SIDE]
