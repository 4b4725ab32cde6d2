"""Spans that loop back on themselves: they cross themselves, turn back, or turn more than round.

With P(w) = a3 w³ + a2 w² + a1 w + a0, a crossing P(s) = P(t) of a planar cubic with itself is

    a3 (s² + s t + t²) + a2 (s + t) + a1 = 0,

two equations that are linear in s + t and s t. Equal s and t are a cusp.

Tested through ``curve/test_bending``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.curve.curvature_bound import is_straight, turning_point
from viaspline.kernels.jit import inner, kernel

ROUNDING_SHARE = 1e-12  # beside the span's size, what is only rounding


@inner
def _crosses_itself(a: Floats, scale: float) -> bool:
    """Whether a cubic with the coefficients a1, a2, a3 in the rows of ``a`` meets itself."""
    one = a[0, 0] * a[2, 1] - a[0, 1] * a[2, 0]
    two = a[1, 0] * a[2, 1] - a[1, 1] * a[2, 0]
    cubed = a[2, 0] * a[2, 0] + a[2, 1] * a[2, 1]
    if abs(two) <= ROUNDING_SHARE * scale * scale or cubed <= (ROUNDING_SHARE * scale) ** 2:
        return False
    total = -one / two
    product = total * total
    for k in range(2):
        product += (a[2, k] * (a[1, k] * total + a[0, k])) / cubed
    spread = total * total - 4.0 * product
    if spread < -ROUNDING_SHARE:
        return False
    apart = math.sqrt(max(spread, 0.0))
    return 0.5 * (total - apart) >= 0.0 and 0.5 * (total + apart) <= 1.0


@inner
def _heading(v: Floats, w: float, at_end: bool) -> float:
    """Heading of a span at w [rad]; where it stands still that of the next vector."""
    s = 1.0 - w
    x = s * s * v[0, 0] + 2.0 * s * w * v[1, 0] + w * w * v[2, 0]
    y = s * s * v[0, 1] + 2.0 * s * w * v[1, 1] + w * w * v[2, 1]
    if x == 0.0 and y == 0.0:
        k = 2 if at_end else 0
        for _ in range(2):
            if v[k, 0] == 0.0 and v[k, 1] == 0.0:
                k += -1 if at_end else 1
        x = v[k, 0]
        y = v[k, 1]
    return math.atan2(y, x)


@inner
def _turn_range(v: Floats) -> float:
    """How far apart a span's headings lie [rad].

    The heading is monotone between the inflections, the roots of the quadratic V × V'.
    """
    n0 = v[0, 0] * v[1, 1] - v[0, 1] * v[1, 0]
    n1 = 0.5 * (v[0, 0] * v[2, 1] - v[0, 1] * v[2, 0])
    n2 = v[1, 0] * v[2, 1] - v[1, 1] * v[2, 0]
    at = np.ones(4)
    at[0] = 0.0
    count = 1
    bend = n0 - 2.0 * n1 + n2
    square = n1 * n1 - n0 * n2
    if square > 0.0:
        root = math.sqrt(square)
        far = n0 - n1 + (root if n0 - n1 >= 0.0 else -root)
        first = far / bend if bend != 0.0 else np.inf
        second = n0 / far if far != 0.0 else np.inf
        for w in (min(first, second), max(first, second)):
            if 0.0 < w < 1.0:
                at[count] = w
                count += 1
    heading = 0.0
    low = 0.0
    high = 0.0
    for k in range(count):
        end = at[k + 1] if k + 1 < count else 1.0
        middle = 0.5 * (at[k] + end)
        s = 1.0 - middle
        sign = s * s * n0 + 2.0 * s * middle * n1 + middle * middle * n2
        turn = _heading(v, end, end == 1.0) - _heading(v, at[k], False)
        turn -= 2.0 * math.pi * math.floor(turn / (2.0 * math.pi))
        if turn > 2.0 * math.pi - 1e-9:
            turn = 0.0
        if sign < 0.0 and turn > 1e-9:
            turn -= 2.0 * math.pi
        heading += turn
        low = min(low, heading)
        high = max(high, heading)
    return high - low


@kernel
def self_loops(spans: Floats) -> Flags:
    """Which spans loop back on themselves.

    Args:
        spans: Bézier control polygons, (m, 4, d); the first two coordinates count.

    Returns:
        (m,): True for a span that meets itself, that has a cusp or turns back on a line, or whose
        headings lie more than half a turn apart.
    """
    count = spans.shape[0]
    found = np.zeros(count, np.bool_)
    v = np.empty((3, 2))
    a = np.empty((3, 2))
    for span in range(count):
        scale = 0.0
        size = 0.0
        for k in range(3):
            for i in range(2):
                v[k, i] = spans[span, k + 1, i] - spans[span, k, i]
                scale = max(scale, abs(v[k, i]))
                size = max(size, abs(spans[span, k, i]))
        if scale == 0.0:
            continue
        if is_straight(v, scale, size):
            found[span] = turning_point(v, scale) >= 0.0
            continue
        for i in range(2):
            a[0, i] = 3.0 * v[0, i]
            a[1, i] = 3.0 * (v[1, i] - v[0, i])
            a[2, i] = v[2, i] - 2.0 * v[1, i] + v[0, i]
        found[span] = _crosses_itself(a, scale) or _turn_range(v) > math.pi + 1e-9
    return found
