"""Piecewise cubics in any dimension: evaluation, derivatives, subdivision, bounds.

A curve is an array of Bézier control polygons ``spans`` (m, 4, d). For evaluation it is turned
into ``rows`` (m + 1, 4, d), the Taylor coefficients about the start of each span and, in the last
row, about the end of the curve, so that every parameter in [0, m] has a row of its own.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, inner, kernel

FINE, NOT_FINITE, APART = range(3)
MAX_COORDINATE_M = 1e100  # coordinates beyond this would overflow where they are squared [m]
JOINT_TOLERANCE_M = 1e-9  # [m], beside a few units in the last place


@kernel
def prepare(spans: Floats, closed: bool) -> tuple[Floats, int, int]:
    """Check spans, close the rounding gaps between them, and give their Taylor coefficients.

    Args:
        spans: (m, 4, d) [m]; where adjoining points differ by rounding the later one is changed.
        closed: Whether the last span ends where the first starts.

    Returns:
        (rows (m + 1, 4, d), fault, index): the fault is FINE, NOT_FINITE (span ``index``), or
        APART (span ``index`` does not start where the one before it ends).
    """
    count, _, dimension = spans.shape
    rows = np.empty((count + 1, 4, dimension))
    for k in range(count):
        for j in range(4):
            for axis in range(dimension):
                if not abs(spans[k, j, axis]) <= MAX_COORDINATE_M:
                    return rows, NOT_FINITE, k
    for k in range(0 if closed else 1, count):
        before = k - 1 if k > 0 else count - 1
        for axis in range(dimension):
            there = spans[before, 3, axis]
            gap = abs(spans[k, 0, axis] - there)
            if gap > JOINT_TOLERANCE_M + 1e-15 * abs(there):
                return rows, APART, k
            if k > 0:
                spans[k, 0, axis] = there
            else:
                spans[before, 3, axis] = spans[0, 0, axis]
    for k in range(count):
        for axis in range(dimension):
            first = spans[k, 1, axis] - spans[k, 0, axis]
            second = spans[k, 2, axis] - spans[k, 1, axis]
            third = spans[k, 3, axis] - spans[k, 2, axis]
            rows[k, 0, axis] = spans[k, 0, axis]
            rows[k, 1, axis] = 3.0 * first
            rows[k, 2, axis] = 3.0 * (second - first)
            rows[k, 3, axis] = (third - second) - (second - first)
            if k == count - 1:
                rows[count, 0, axis] = spans[k, 3, axis]
                rows[count, 1, axis] = 3.0 * third
                rows[count, 2, axis] = 3.0 * (third - second)
                rows[count, 3, axis] = rows[k, 3, axis]
                if closed:
                    for j in range(4):
                        rows[count, j, axis] = rows[0, j, axis]
    return rows, FINE, -1


@kernel
def wrapped(u: float, count: int, closed: bool) -> float:
    """The parameter within [0, count]; NaN outside the domain of an open curve."""
    if 0.0 <= u <= count:
        return u
    if closed and abs(u) < np.inf:
        return min(max(u - count * math.floor(u / count), 0.0), float(count))
    return np.nan


@kernel
def evaluate(rows: Floats, u: Floats, closed: bool, out: Floats) -> int:
    """Values of the polynomials at parameters.

    Args:
        rows: (m + 1, 4, d), see the module.
        u: Parameters in [0, m], (n,); a closed curve takes any.
        closed: Whether parameters outside wrap.
        out: (n, d), filled up to the first parameter that is outside.

    Returns:
        The index of the first parameter that is outside or not a number; -1 when there is none.
    """
    count = rows.shape[0] - 1
    dimension = rows.shape[2]
    if dimension == 2 and _in_runs(u):
        return _evaluate_runs(rows, u, closed, out)
    for i in range(u.shape[0]):
        x = u[i]
        if not 0.0 <= x <= count:
            x = wrapped(x, count, closed)
            if math.isnan(x):
                return i
        k = int(x)
        w = x - k
        if dimension == 2:  # loops of a known length are unrolled
            for axis in range(2):
                c = rows[k, 2, axis] + w * rows[k, 3, axis]
                out[i, axis] = rows[k, 0, axis] + w * (rows[k, 1, axis] + w * c)
        elif dimension == 3:
            for axis in range(3):
                c = rows[k, 2, axis] + w * rows[k, 3, axis]
                out[i, axis] = rows[k, 0, axis] + w * (rows[k, 1, axis] + w * c)
        else:
            for axis in range(dimension):
                c = rows[k, 2, axis] + w * rows[k, 3, axis]
                out[i, axis] = rows[k, 0, axis] + w * (rows[k, 1, axis] + w * c)
    return -1


@inner
def _in_runs(u: Floats) -> bool:
    """Whether neighbours mostly lie less than half a span apart, by a look at 64 of them."""
    step = max(1, u.shape[0] // 64)
    near = 0
    for i in range(1, u.shape[0], step):
        near += 1 if abs(u[i] - u[i - 1]) < 0.5 else -1
    return near > 0


@inner
def _evaluate_runs(rows: Floats, u: Floats, closed: bool, out: Floats) -> int:
    """``evaluate`` in two dimensions; the span stays in registers while parameters stay on it."""
    count = rows.shape[0] - 1
    start = np.nan
    ax = ay = bx = by = cx = cy = dx = dy = 0.0
    for i in range(u.shape[0]):
        w = u[i] - start
        if not abs(w - 0.5) < 0.5:
            x = u[i]
            if not 0.0 <= x <= count:
                x = wrapped(x, count, closed)
                if math.isnan(x):
                    return i
            k = int(x)
            start = float(k)
            w = x - start
            if k == count:  # nothing lies beyond the end
                start = np.nan
            ax, ay = rows[k, 0, 0], rows[k, 0, 1]
            bx, by = rows[k, 1, 0], rows[k, 1, 1]
            cx, cy = rows[k, 2, 0], rows[k, 2, 1]
            dx, dy = rows[k, 3, 0], rows[k, 3, 1]
        out[i, 0] = ax + w * (bx + w * (cx + w * dx))
        out[i, 1] = ay + w * (by + w * (cy + w * dy))
    return -1


@inlined
def first_derivative(spans: Floats, k: int, axis: int, w: float) -> float:
    """One coordinate of P'(w) on span k, in Bernstein form: exact zeros stay exact."""
    v = 1.0 - w
    first = spans[k, 1, axis] - spans[k, 0, axis]
    second = spans[k, 2, axis] - spans[k, 1, axis]
    third = spans[k, 3, axis] - spans[k, 2, axis]
    return float(3.0 * (v * v * first + 2.0 * v * w * second + w * w * third))


@inlined
def second_derivative(spans: Floats, k: int, axis: int, w: float) -> float:
    """One coordinate of P''(w) on span k."""
    first = spans[k, 1, axis] - spans[k, 0, axis]
    second = spans[k, 2, axis] - spans[k, 1, axis]
    third = spans[k, 3, axis] - spans[k, 2, axis]
    return float(6.0 * ((1.0 - w) * (second - first) + w * (third - second)))


@inlined
def third_derivative(spans: Floats, k: int, axis: int) -> float:
    """One coordinate of P''' on span k."""
    first = spans[k, 1, axis] - spans[k, 0, axis]
    second = spans[k, 2, axis] - spans[k, 1, axis]
    third = spans[k, 3, axis] - spans[k, 2, axis]
    return float(6.0 * ((third - second) - (second - first)))


@inlined
def speed_at(spans: Floats, k: int, w: float) -> float:
    """|P'(w)| on span k [m per unit of the parameter]."""
    squared = 0.0
    for axis in range(spans.shape[2]):
        squared += first_derivative(spans, k, axis, w) ** 2
    return math.sqrt(squared)


@inlined
def speed_bound(spans: Floats, k: int) -> float:
    """Upper bound of |P'(w)| on span k: the longest control vector of the derivative [m]."""
    largest = 0.0
    for j in range(3):
        squared = 0.0
        for axis in range(spans.shape[2]):
            step = spans[k, j + 1, axis] - spans[k, j, axis]
            squared += step * step
        largest = max(largest, squared)
    return 3.0 * math.sqrt(largest)


@kernel
def subspan(span: Floats, start: float, end: float, out: Floats) -> None:
    """The part [start, end] of a span, by de Casteljau's construction (blossoms).

    Args:
        span: (4, d).
        start: Local parameter in [0, 1].
        end: Local parameter in [0, 1].
        out: (4, d); equals ``span`` bit by bit for [0, 1].
    """
    for axis in range(span.shape[1]):
        for j in range(4):
            a = start if j < 3 else end
            b = start if j < 2 else end
            c = start if j < 1 else end
            p0 = (1.0 - a) * span[0, axis] + a * span[1, axis]
            p1 = (1.0 - a) * span[1, axis] + a * span[2, axis]
            p2 = (1.0 - a) * span[2, axis] + a * span[3, axis]
            q0 = (1.0 - b) * p0 + b * p1
            q1 = (1.0 - b) * p1 + b * p2
            out[j, axis] = (1.0 - c) * q0 + c * q1
