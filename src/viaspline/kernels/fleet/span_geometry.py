"""Spans of planar paths as geometry: their parts, their lengths, what is near them.

Tested through ``fleet/laying/test_step_aside``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, inner

LOOKS_APART_M = 2.0
"""Between places on a span that are looked at for the nearest one; then it is closed in on."""
MOST_LOOKS = 64
APART = 1.0 - 1e-12
"""Of two squares of distances the one is less than this of the other: so are the distances."""
EDGE = 1e-6
"""Nearer to its end a span isn't cut."""


@inlined
def span_coordinate(span: Floats, w: float, axis: int) -> float:
    """One coordinate of a span at a parameter [m]."""
    v = 1.0 - w
    return (
        v * v * v * span[0, axis]
        + 3.0 * v * v * w * span[1, axis]
        + 3.0 * v * w * w * span[2, axis]
        + w * w * w * span[3, axis]
    )


@inner
def apart_from(span: Floats, w: float, x: float, y: float) -> float:
    """Distance of a place from a span at a parameter [m]."""
    return math.hypot(span_coordinate(span, w, 0) - x, span_coordinate(span, w, 1) - y)


@inlined
def _square_from(span: Floats, w: float, x: float, y: float) -> float:
    """The square of the distance of a place from a span at a parameter [m²]."""
    dx, dy = span_coordinate(span, w, 0) - x, span_coordinate(span, w, 1) - y
    return dx * dx + dy * dy


@inlined
def _is_no_farther(span: Floats, w: float, other: float, x: float, y: float) -> bool:
    """Whether a span is no farther from a place at one parameter than at another."""
    square, other_square = _square_from(span, w, x, y), _square_from(span, other, x, y)
    if square < APART * other_square:
        return True
    if other_square < APART * square:
        return False
    return apart_from(span, w, x, y) <= apart_from(span, other, x, y)


@inlined
def _longest_side(span: Floats) -> float:
    """The longest side of a span's polygon [m]: a third of what it may go on by its parameter."""
    longest = 0.0
    for k in range(3):
        longest = max(longest, math.hypot(span[k + 1, 0] - span[k, 0], span[k + 1, 1] - span[k, 1]))
    return longest


@inner
def nearest_on_span(span: Floats, x: float, y: float, limit: float) -> tuple[float, float]:
    """Distance of a place from a span and where on it; infinite where it is beyond a limit."""
    low_x = min(min(span[0, 0], span[1, 0]), min(span[2, 0], span[3, 0]))
    high_x = max(max(span[0, 0], span[1, 0]), max(span[2, 0], span[3, 0]))
    low_y = min(min(span[0, 1], span[1, 1]), min(span[2, 1], span[3, 1]))
    high_y = max(max(span[0, 1], span[1, 1]), max(span[2, 1], span[3, 1]))
    if x < low_x - limit or x > high_x + limit or y < low_y - limit or y > high_y + limit:
        return math.inf, 0.0
    rough = high_x - low_x + high_y - low_y
    looks = min(max(int(rough / LOOKS_APART_M) + 1, 4), MOST_LOOKS)
    best, best_square, at = math.inf, math.inf, 0.0
    for k in range(looks + 1):
        square = _square_from(span, k / looks, x, y)
        if APART * square > best_square:
            continue
        apart = apart_from(span, k / looks, x, y)
        if apart < best:
            best, best_square, at = apart, square, k / looks
    if best > limit and best - 0.5 * _longest_side(span) * 3.0 / looks > limit:
        return math.inf, 0.0
    low, high = max(at - 1.0 / looks, 0.0), min(at + 1.0 / looks, 1.0)
    for _ in range(24):
        third = (high - low) / 3.0
        if _is_no_farther(span, low + third, high - third, x, y):
            high = high - third
        else:
            low = low + third
    w = 0.5 * (low + high)
    apart = apart_from(span, w, x, y)
    return (apart, w) if apart < best else (best, at)


@inner
def span_part(span: Floats, begin: float, end: float, out: Floats) -> None:
    """The part of a span between two of its parameters, as a span."""
    width = end - begin
    for axis in range(2):
        p0, p1, p2, p3 = span[0, axis], span[1, axis], span[2, axis], span[3, axis]
        d0, d1, d2 = p1 - p0, p2 - p1, p3 - p2
        v = 1.0 - begin
        slope0 = v * v * d0 + 2.0 * v * begin * d1 + begin * begin * d2
        v = 1.0 - end
        slope1 = v * v * d0 + 2.0 * v * end * d1 + end * end * d2
        out[0, axis] = span_coordinate(span, begin, axis)
        out[3, axis] = span_coordinate(span, end, axis)
        out[1, axis] = out[0, axis] + width * slope0
        out[2, axis] = out[3, axis] - width * slope1


@inner
def keep_from(span: Floats, w: float) -> None:
    """Keep the part of a span from one of its parameters on."""
    for axis in range(2):
        p0, p1, p2, p3 = span[0, axis], span[1, axis], span[2, axis], span[3, axis]
        a, b, c = p0 + w * (p1 - p0), p1 + w * (p2 - p1), p2 + w * (p3 - p2)
        d, e = a + w * (b - a), b + w * (c - b)
        span[0, axis] = d + w * (e - d)
        span[1, axis] = e
        span[2, axis] = c


@inner
def span_length(span: Floats, begin: float, end: float) -> float:
    """About how long a span is between two of its parameters [m]."""
    steps = 8
    total = 0.0
    x, y = span_coordinate(span, begin, 0), span_coordinate(span, begin, 1)
    for k in range(1, steps + 1):
        w = begin + (end - begin) * k / steps
        to_x, to_y = span_coordinate(span, w, 0), span_coordinate(span, w, 1)
        total += math.hypot(to_x - x, to_y - y)
        x, y = to_x, to_y
    return total


@inner
def left_of_span(span: Floats, w: float, x: float, y: float) -> float:
    """How far left of a span's tangent a place is [m]."""
    part = np.empty((4, 2))
    span_part(span, 0.0, w if w > EDGE else EDGE, part)
    dx, dy = part[3, 0] - part[2, 0], part[3, 1] - part[2, 1]
    long = max(math.hypot(dx, dy), 1e-12)
    return (dx * (y - part[3, 1]) - dy * (x - part[3, 0])) / long
