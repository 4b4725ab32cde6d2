"""Cusps inside of spans: where a curve stands still and goes back the way it came.

The derivative is a quadratic. Where it is zero, it goes through zero along the second derivative,
so the tangent turns by half a turn; unless the second derivative is zero as well, and it doesn't.

What turns by more than a right angle within three millimetres of its way is as good as a cusp: a
robot can't but stand there and turn.

Tested through ``machine/test_turns_on_spot``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cubic import (
    first_derivative,
    second_derivative,
    speed_at,
    speed_bound,
    third_derivative,
)
from viaspline.kernels.jit import inner, kernel

STANDSTILL = 1e-9
"""A derivative that is smaller beside the largest of its span is zero."""

SAME_CUSP = 1e-6
"""Parameters nearer than this are one cusp."""

ROUND_M, ROUND_SHARE = 1e-3, 1e-4
"""A way within which nothing turns but on the spot [m]; and of the longest leg of a span's polygon,
for what is as small as that."""

ROUNDS = 4
"""Of Newton's method for where a span is slowest: it begins near to that."""


@inner
def _goes_back(spans: Floats, k: int, w: float, beside: float) -> bool:
    """Whether a span turns by more than a right angle from before a parameter to behind it."""
    along = 0.0
    for axis in range(spans.shape[2]):
        before = first_derivative(spans, k, axis, w - beside)
        along += before * first_derivative(spans, k, axis, w + beside)
    return along < 0.0


@inner
def turns_back(spans: Floats, k: int, w: float) -> bool:
    """Whether the derivative is zero there and opposite a little before and a little after."""
    if speed_at(spans, k, w) > STANDSTILL * speed_bound(spans, k):
        return False
    return _goes_back(spans, k, w, SAME_CUSP)


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


@inner
def turned_within(spans: Floats, k: int) -> float:
    """A way on span k within which nothing turns but on the spot [m]."""
    return min(ROUND_M, ROUND_SHARE * speed_bound(spans, k) / 3.0)


@inner
def _beside(spans: Floats, k: int, w: float) -> float:
    """How far in the parameter such a way reaches to either side of where a span is slowest."""
    squared = 0.0
    for axis in range(spans.shape[2]):
        squared += second_derivative(spans, k, axis, w) ** 2
    return math.sqrt(turned_within(spans, k) / math.sqrt(squared)) if squared > 0.0 else np.inf


@inner
def _slowest(spans: Floats, k: int, w: float) -> float:
    """Where a span is slowest near to a parameter."""
    for _ in range(ROUNDS):
        slope, bend = 0.0, 0.0
        for axis in range(spans.shape[2]):
            first = first_derivative(spans, k, axis, w)
            second = second_derivative(spans, k, axis, w)
            slope += first * second
            bend += second * second + first * third_derivative(spans, k, axis)
        if bend <= 0.0:
            return w
        w -= slope / bend
    return w


@inner
def _nearly_turns_back(spans: Floats, k: int, w: float) -> bool:
    """Whether a span turns by more than a right angle within so short a way about a parameter."""
    beside = _beside(spans, k, w)
    if not beside < w < 1.0 - beside or speed_at(spans, k, w) * beside > turned_within(spans, k):
        return False
    return _goes_back(spans, k, w, beside)


@kernel
def beside_cusps(spans: Floats, at: Floats) -> Floats:
    """How far before and after cusps the path looks the way it comes and goes.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).
        at: From ``cusps``, shape (k,).

    Returns:
        In the parameter, shape (k,).
    """
    found = np.empty(at.size)
    for i in range(at.size):
        k = int(at[i])
        w = at[i] - k
        found[i] = SAME_CUSP if turns_back(spans, k, w) else _beside(spans, k, w)
    return found


@kernel
def cusps(spans: Floats) -> Floats:
    """Parameters of the cusps inside of spans, and of what is as good as one, in order.

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
        for nearly in (False, True):
            for axis in range(spans.shape[2]):
                for i in range(_roots_of_axis(spans, k, axis, roots)):
                    w = _slowest(spans, k, roots[i]) if nearly else roots[i]
                    if not SAME_CUSP < w < 1.0 - SAME_CUSP:
                        continue
                    if not (_nearly_turns_back(spans, k, w) if nearly else turns_back(spans, k, w)):
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
