"""A string's tangents and turns, and which of its rows it does not bend round.

Tested through ``kernels/routing/string_pulling/test_pull``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined
from viaspline.kernels.routing.string_pulling.string_rows import remove
from viaspline.kernels.routing.tangent_arcs import (
    BEND_RADIUS,
    BEND_X,
    BEND_Y,
    HEADING_IN,
    SIDE,
    TURN,
)


@inlined
def _missing_tangent(rows: Floats, count: int) -> int:
    """Write the headings of the tangents; the first row from which none leads on, or -1."""
    for k in range(count - 1):
        dx = rows[k + 1, BEND_X] - rows[k, BEND_X]
        dy = rows[k + 1, BEND_Y] - rows[k, BEND_Y]
        gap = math.hypot(dx, dy)
        offset = rows[k + 1, SIDE] * rows[k + 1, BEND_RADIUS]
        offset -= rows[k, SIDE] * rows[k, BEND_RADIUS]
        if count > 2 and gap <= abs(offset):
            return k
        rows[k + 1, HEADING_IN] = math.atan2(dy, dx)
        if offset != 0.0:
            rows[k + 1, HEADING_IN] -= math.asin(offset / gap)
    return -1


@inlined
def _slack(rows: Floats, count: int) -> int:
    """Write the turns; the first row that the string does not bend round, or -1."""
    for k in range(1, count - 1):
        turn = rows[k, SIDE] * (rows[k + 1, HEADING_IN] - rows[k, HEADING_IN])
        turn -= math.tau * math.floor((turn - rows[k, TURN] + math.pi) / math.tau)
        if turn < -1e-12:
            return k
        rows[k, TURN] = turn
    return -1


@inlined
def slacken(rows: Floats, count: int) -> tuple[int, int]:
    """Leave out rows that the string does not bend round, until all that are left are needed.

    Returns:
        (count, gap): -1, or the row from which no tangent leads to the next because they have to
        be passed on different sides and stand too close together.
    """
    while True:
        dropped = _missing_tangent(rows, count)
        if dropped >= 0:
            if rows[dropped, SIDE] * rows[dropped + 1, SIDE] < 0.0:
                return count, dropped
            if rows[dropped, BEND_RADIUS] >= rows[dropped + 1, BEND_RADIUS]:
                dropped += 1  # the one that lies within the other
            dropped = min(max(dropped, 1), count - 2)
        else:
            dropped = _slack(rows, count)
            if dropped < 0:
                return count, -1
        count = remove(rows, count, dropped)
