"""Where a piecewise cubic bends most: the stationary places of its curvature, none by luck.

They are the roots of a polynomial of degree 7, to a bracket of 1.5e-8. A curve that nearly stands
still turns within much less than that: its peak lies where it is slowest, at a root of P' . P'',
which Newton's steps give to the last digit. Of a peak that is wider, the bracket's middle has the
curvature to a millionth, of one that is narrower the slowest place has it.

Tested through ``curve/test_measured``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cubic import (
    first_derivative,
    second_derivative,
    speed_bound,
    third_derivative,
)
from viaspline.kernels.curve.cusps import turns_back
from viaspline.kernels.curve.extrema import (
    MAX_ROOT_DEPTH,
    MIN_BRACKET,
    add_product,
    roots,
    slope_of,
    to_bernstein,
)
from viaspline.kernels.curve.frenet import curvature_at
from viaspline.kernels.jit import inner, kernel

MAX_EXTREMA = 32
"""Of a span: room for the roots of both polynomials, multiple ones several times."""

MAX_SLOWEST = 8
NEWTON_STEPS = 4


class ExtremaRoom(NamedTuple):
    """Arrays for the polynomials of a span and for the search of their roots."""

    slope: Floats
    speed: Floats
    slope_stack: Floats
    speed_stack: Floats


@inner
def extrema_room() -> ExtremaRoom:
    """Room for ``curvature_extrema``."""
    return ExtremaRoom(
        np.empty(8), np.empty(4), np.empty((MAX_ROOT_DEPTH, 10)), np.empty((MAX_ROOT_DEPTH, 6))
    )


@inner
def curvature_slope(spans: Floats, k: int, scale: float, out: Floats) -> None:
    """Bernstein coefficients of Y' q - 3 Y q', whose sign is that of the slope of curvature.

    With Y = |P' x P''|^2 and q = |P'|^2 curvature squared is Y / q^3. With the differences d of
    the control points, P' x P'' = 18 (v^2 d0 x d1 + v w d0 x d2 + w^2 d1 x d2).
    """
    dimension = spans.shape[2]
    step = np.empty((3, dimension))
    for j in range(3):
        for axis in range(dimension):
            step[j, axis] = 3.0 * (spans[k, j + 1, axis] - spans[k, j, axis]) / scale
    q = np.zeros(5)
    y = np.zeros(5)
    factor = np.empty(3)
    for i in range(dimension):
        factor[0] = step[0, i]
        factor[1] = 2.0 * step[1, i]
        factor[2] = step[2, i]
        add_product(factor, factor, 1.0, q)
        for j in range(i):
            factor[0] = step[0, i] * step[1, j] - step[0, j] * step[1, i]
            factor[1] = step[0, i] * step[2, j] - step[0, j] * step[2, i]
            factor[2] = step[1, i] * step[2, j] - step[1, j] * step[2, i]
            add_product(factor, factor, 1.0, y)
    slope = np.empty(4)
    for j in range(8):
        out[j] = 0.0
    slope_of(y, slope)
    add_product(slope, q, 1.0, out)
    slope_of(q, slope)
    add_product(y, slope, -3.0, out)
    to_bernstein(out)


@inner
def _slowest(spans: Floats, k: int, out: Floats) -> None:
    """Bernstein coefficients (4,) of P' . P'', whose roots are where the speed is stationary."""
    for j in range(4):
        out[j] = 0.0
    for axis in range(spans.shape[2]):
        a = spans[k, 1, axis] - spans[k, 0, axis]
        b = spans[k, 2, axis] - spans[k, 1, axis]
        c = spans[k, 3, axis] - spans[k, 2, axis]
        out[0] += a * (b - a)
        out[1] += (a * (c - b) + 2.0 * b * (b - a)) / 3.0
        out[2] += (c * (b - a) + 2.0 * b * (c - b)) / 3.0
        out[3] += c * (c - b)


@inner
def _polished(spans: Floats, k: int, w: float) -> float:
    """Newton's steps on P' . P'' = 0, as long as they stay about the root's bracket."""
    at = w
    for _ in range(NEWTON_STEPS):
        value = 0.0
        slope = 0.0
        for axis in range(spans.shape[2]):
            first = first_derivative(spans, k, axis, at)
            second = second_derivative(spans, k, axis, at)
            value += first * second
            slope += second * second + first * third_derivative(spans, k, axis)
        if slope <= 0.0:
            return w
        at = min(max(at - value / slope, 0.0), 1.0)
        if abs(at - w) > 4.0 * MIN_BRACKET:
            return w
    return at


@inner
def curvature_extrema(spans: Floats, k: int, room: ExtremaRoom, out: Floats) -> int:
    """Parameters inside of a span where its curvature may be the largest, in no order.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).
        k: The span.
        room: Of ``extrema_room``.
        out: The parameters, shape (``MAX_EXTREMA``,).

    Returns:
        How many there are.
    """
    scale = speed_bound(spans, k)
    if scale == 0.0 or spans.shape[2] < 2:
        return 0
    _slowest(spans, k, room.speed)
    count = roots(room.speed, room.speed_stack, out[:MAX_SLOWEST])
    for i in range(count):
        out[i] = _polished(spans, k, out[i])
    curvature_slope(spans, k, scale, room.slope)
    return count + roots(room.slope, room.slope_stack, out[count:MAX_EXTREMA])


@kernel
def sharpest(spans: Floats) -> tuple[float, int, float]:
    """The largest curvature of a piecewise cubic, both sides of every joint included.

    Args:
        spans: (m, 4, d) [m].

    Returns:
        (curvature without sign [1/m], span, w); the first of several, and infinite at a cusp.
    """
    room = extrema_room()
    found = np.empty(2 + MAX_EXTREMA)
    largest = -1.0
    span_at = 0
    w_at = 0.0
    for k in range(spans.shape[0]):
        found[0] = 0.0
        count = 1 + curvature_extrema(spans, k, room, found[1 : 1 + MAX_EXTREMA])
        found[count] = 1.0
        for i in range(count + 1):
            value = abs(curvature_at(spans, k, found[i]))
            if value < np.inf and 0 < i < count and turns_back(spans, k, found[i]):
                value = np.inf
            if value > largest:
                largest, span_at, w_at = value, k, found[i]
    return largest, span_at, w_at
