"""How steeply a curve climbs at most, from both sides.

The velocity of a piece lies in the hull of its three control vectors. So with d the direction of
the piece in plan, no place of it climbs by more than the greatest ratio of their heights to their
parts along d, if all of these go forwards; for in plan a vector is at least as long as its part
along d. What isn't settled by that is halved.

Tested through ``curve/test_climb_certificate``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.halving import halve_piece, load_span
from viaspline.kernels.jit import inlined, kernel, uncounted

MAX_DEPTH = 48  # halvings of a span
MAX_PIECES = 1_000_000  # that a bound may take
UPRIGHT = 0.5 * math.pi


@inlined
def _angle(level: float, up: float) -> float:
    """Angle of climb of a velocity [rad]; -pi / 2 where it stands still: it climbs nowhere."""
    return math.atan2(up, level) if level > 0.0 or up > 0.0 else -UPRIGHT


@uncounted
def piece_climb(piece: Floats, sign: float) -> float:
    """Bound of the angle of climb of a piece [rad], of descent with sign -1."""
    ex, ey = piece[9] - piece[0], piece[10] - piece[1]
    length = math.sqrt(ex * ex + ey * ey)
    steepest = -UPRIGHT
    for k in range(3):
        dx = piece[3 * k + 3] - piece[3 * k]
        dy = piece[3 * k + 4] - piece[3 * k + 1]
        up = sign * (piece[3 * k + 5] - piece[3 * k + 2])
        level = (dx * ex + dy * ey) / length if length > 0.0 else 0.0
        if level < 0.0:  # backwards: says nothing of the others
            return UPRIGHT
        steepest = max(steepest, _angle(level, up))
    return steepest


@kernel
def steepest_climb(spans: Floats, sign: float, tolerance: float) -> tuple[float, float, int, float]:
    """The greatest angle of climb along a curve, from both sides.

    Args:
        spans: Bézier control polygons, (m, 4, 3).
        sign: 1 for climb, -1 for descent.
        tolerance: How far apart the two bounds may be [rad].

    Returns:
        (lower, upper, span, w): the bounds [rad] and where the lower one is reached; at least 0.
        The upper one is pi / 2 where so small a tolerance takes too many pieces.
    """
    lower, upper = 0.0, 0.0
    span_at, w_at = 0, 0.0
    stack = np.empty((MAX_DEPTH, 14))
    pieces = 0
    for span in range(spans.shape[0]):
        load_span(stack, spans, span, 3)
        top = 0
        while top >= 0:
            pieces += 1
            if pieces > MAX_PIECES:
                return lower, UPRIGHT, span_at, w_at
            piece = stack[top]
            bound = piece_climb(piece, sign)
            if bound > lower + tolerance:
                dx = piece[9] + piece[6] - piece[3] - piece[0]
                dy = piece[10] + piece[7] - piece[4] - piece[1]
                up = sign * (piece[11] + piece[8] - piece[5] - piece[2])
                found = _angle(math.sqrt(dx * dx + dy * dy), up)
                if found > lower:
                    lower, span_at, w_at = found, span, 0.5 * (piece[12] + piece[13])
            if bound <= lower + tolerance or top + 2 > MAX_DEPTH:
                upper = max(upper, bound)
                top -= 1
            else:
                halve_piece(stack, top, 3)
                top += 1
    return lower, max(lower, upper), span_at, w_at
