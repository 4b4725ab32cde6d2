"""Segments of evenly changing curvature: lines, arcs and ramps in one form.

Tested through ``kernels/turning/test_connect``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.jit import inner

_AT, _WEIGHT = np.polynomial.legendre.leggauss(8)


@inner
def along_bend(first: float, last: float, length: float, s: float) -> tuple[float, float, float]:
    """Where a segment of evenly changing curvature from the origin along x is after a distance.

    Args:
        first: Curvature at its start [1/m].
        last: The same at its end.
        length: [m].
        s: [m], with a turn of at most about 1 rad unless the curvature stays the same.

    Returns:
        x, y [m] and the heading [rad].
    """
    if first == last:
        turn = first * s
        if abs(turn) < 1e-9:
            return s, 0.5 * s * turn, turn
        half = math.sin(0.5 * turn)
        return math.sin(turn) / first, 2.0 * half * half / first, turn
    x = 0.0
    y = 0.0
    slope = (last - first) / length
    for k in range(8):
        at = 0.5 * s * (1.0 + _AT[k])
        heading = at * (first + 0.5 * slope * at)
        x += _WEIGHT[k] * math.cos(heading)
        y += _WEIGHT[k] * math.sin(heading)
    return 0.5 * s * x, 0.5 * s * y, s * (first + 0.5 * slope * s)
