"""Cusps inside of spans: where a curve stands still and goes back the way it came.

The derivative is a quadratic. Where it is zero, it goes through zero along the second derivative,
so the tangent turns by half a turn; unless the second derivative is zero as well, and it doesn't.

Tested through ``machine/test_turns_on_spot``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cubic import first_derivative, speed_at, speed_bound
from viaspline.kernels.jit import inner, kernel

STANDSTILL = 1e-9
"""A derivative that is smaller beside the largest of its span is zero."""

SAME_CUSP = 1e-6
"""Parameters nearer than this are one cusp."""


@inner
def turns_back(spans: Floats, k: int, w: float) -> bool:
    """Whether the derivative is zero there and opposite a little before and a little after."""
    if speed_at(spans, k, w) > STANDSTILL * speed_bound(spans, k):
        return False
    across = 0.0
    for axis in range(spans.shape[2]):
        before = first_derivative(spans, k, axis, w - SAME_CUSP)
        across += before * first_derivative(spans, k, axis, w + SAME_CUSP)
    return across < 0.0


@inner
def _roots_of_axis(spans: Floats, k: int, axis: int, out: Floats) -> int:
    """Where one coordinate of the derivative is zero, or nearest to that."""
    a = spans[k, 1, axis] - spans[k, 0, axis]
    b = spans[k, 2, axis] - spans[k, 1, axis]
    c = spans[k, 3, axis] - spans[k, 2, axis]
    square, slope = a - 2.0 * b + c, b - a  # square w² + 2 slope w + a
    root = math.sqrt(max(slope * slope - square * a, 0.0))
    far = -(slope + math.copysign(root, slope))
    count = 0
    if square != 0.0:
        out[count] = far / square
        count += 1
    if far != 0.0:
        out[count] = a / far
        count += 1
    return count


@kernel
def cusps(spans: Floats) -> Floats:
    """Parameters of the cusps inside of spans, in order.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).

    Returns:
        u = span + w with w in (0, 1), shape (k,).
    """
    count = spans.shape[0]
    found = np.empty(2 * count)
    total = 0
    roots = np.empty(2)
    for k in range(count):
        first = total
        for axis in range(spans.shape[2]):
            for i in range(_roots_of_axis(spans, k, axis, roots)):
                w = roots[i]
                if not SAME_CUSP < w < 1.0 - SAME_CUSP:
                    continue
                if not turns_back(spans, k, w):
                    continue
                known = False
                for j in range(first, total):
                    known = known or abs(found[j] - k - w) < SAME_CUSP
                if not known and total < first + 2:
                    found[total] = k + w
                    total += 1
        if total == first + 2 and found[first] > found[first + 1]:
            found[first], found[first + 1] = found[first + 1], found[first]
    return found[:total]
