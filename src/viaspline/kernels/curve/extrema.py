"""Roots of polynomials in Bernstein form, and by them the nearest point of a piecewise cubic.

 Where the signs of its coefficients don't change
there is no root; elsewhere it is halved. So every candidate is found, none by luck of a sample.

Polynomials are kept in the scaled form ``sum a_i v^(n-i) w^i`` with v = 1 - w, in which a product
is a convolution; ``a_i`` over the binomial (n, i) is the Bernstein coefficient.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel

MIN_BRACKET = 2.0**-26
MAX_ROOT_DEPTH = 32


@inner
def add_product(a: Floats, b: Floats, factor: float, out: Floats) -> None:
    """Add ``factor * a * b`` to ``out``; all in the scaled form."""
    for i in range(a.shape[0]):
        for j in range(b.shape[0]):
            out[i + j] += factor * a[i] * b[j]


@inner
def slope_of(a: Floats, out: Floats) -> None:
    """Derivative in the scaled form."""
    degree = a.shape[0] - 1
    for i in range(degree):
        out[i] = (i + 1) * a[i + 1] - (degree - i) * a[i]


@inner
def to_bernstein(a: Floats) -> None:
    """From the scaled form to Bernstein coefficients, in place."""
    degree = a.shape[0] - 1
    binomial = 1.0
    for i in range(degree + 1):
        a[i] /= binomial
        binomial = binomial * (degree - i) / (i + 1)


@inner
def _changes_sign(coefficients: Floats) -> bool:
    low = coefficients[0]
    high = coefficients[0]
    for i in range(1, coefficients.shape[0]):
        low = min(low, coefficients[i])
        high = max(high, coefficients[i])
    return bool(low < 0.0 < high)


@kernel
def roots(coefficients: Floats, stack: Floats, out: Floats) -> int:
    """Roots of a Bernstein polynomial inside (0, 1), to ``MIN_BRACKET``; not those at 0 and 1.

    Args:
        coefficients: (n + 1,).
        stack: Room, (DEPTH, n + 3).
        out: (8 n,), the roots in order.

    Returns:
        How many there are; a multiple root may stand there several times.
    """
    size = coefficients.shape[0]
    found = 0
    for i in range(size):
        stack[0, i] = coefficients[i]
    stack[0, size] = 0.0
    stack[0, size + 1] = 1.0
    top = 0
    while top >= 0 and found < out.shape[0]:
        if not _changes_sign(stack[top, :size]):
            top -= 1
            continue
        start = stack[top, size]
        width = stack[top, size + 1]
        if width <= MIN_BRACKET:
            out[found] = start + 0.5 * width
            found += 1
            top -= 1
            continue
        right = stack[top]
        left = stack[top + 1]
        for i in range(size):
            left[i] = right[0]
            for j in range(size - 1 - i):
                right[j] = 0.5 * (right[j] + right[j + 1])
        left[size] = start
        left[size + 1] = 0.5 * width
        right[size] = start + 0.5 * width
        right[size + 1] = 0.5 * width
        if right[0] == 0.0 and found < out.shape[0]:
            out[found] = right[size]
            found += 1
        top += 1
    return found


@inner
def _moved(spans: Floats, k: int, point: Floats, out: Floats) -> float:
    """Control points of span k seen from a point into ``out``, and a bound: distance squared."""
    bound = 0.0
    for axis in range(point.shape[0]):
        low = np.inf
        high = -np.inf
        for j in range(4):
            value = spans[k, j, axis] - point[axis]
            out[j, axis] = value
            low = min(low, value)
            high = max(high, value)
        gap = max(0.0, low, -high)
        bound += gap * gap
    return bound


@inner
def _squared(control: Floats, w: float) -> float:
    """Squared distance of a span from the origin at w."""
    v = 1.0 - w
    total = 0.0
    for axis in range(control.shape[1]):
        value = v * v * (v * control[0, axis] + 3.0 * w * control[1, axis])
        value += w * w * (3.0 * v * control[2, axis] + w * control[3, axis])
        total += value * value
    return total


@inner
def _polished(control: Floats, w: float) -> float:
    """Newton steps on P . P' = 0 as long as they come nearer."""
    for _ in range(4):
        v = 1.0 - w
        value = 0.0
        slope = 0.0
        for axis in range(control.shape[1]):
            p0, p1, p2, p3 = control[0, axis], control[1, axis], control[2, axis], control[3, axis]
            p = v * v * (v * p0 + 3.0 * w * p1) + w * w * (3.0 * v * p2 + w * p3)
            first = 3.0 * (v * v * (p1 - p0) + 2.0 * v * w * (p2 - p1) + w * w * (p3 - p2))
            second = 6.0 * (v * (p2 - 2.0 * p1 + p0) + w * (p3 - 2.0 * p2 + p1))
            value += p * first
            slope += first * first + p * second
        if slope <= 0.0:
            return w
        better = min(max(w - value / slope, 0.0), 1.0)
        if better == w or abs(better - w) > 4.0 * MIN_BRACKET:
            return w
        w = better
    return w


@kernel
def nearest_parameter(
    spans: Floats, point: Floats, start: float, end: float
) -> tuple[float, float]:
    """The nearest point of a piecewise cubic, of all of it.

    The candidates are the ends of spans and the roots of (P(w) - point) . P'(w), of degree 5;
    spans whose box of control points is farther away than the best so far are passed over.

    Args:
        spans: (m, 4, d) [m].
        point: (d,) [m].
        start: First parameter that counts.
        end: Last parameter that counts.

    Returns:
        (u, distance [m]); of several nearest ones the first.
    """
    count, _, dimension = spans.shape
    control = np.empty((4, dimension))
    first = min(int(start), count - 1)
    last = min(int(end), count - 1)
    best = np.inf
    at = start
    for k in range(first, last + 1):
        _moved(spans, k, point, control)
        low = max(start - k, 0.0)
        high = min(end - k, 1.0)
        here = _squared(control, low)
        if here < best:
            best, at = here, k + low
        if k == last or high < 1.0:
            here = _squared(control, high)
            if here < best:
                best, at = here, k + high
    stack = np.empty((MAX_ROOT_DEPTH, 8))
    found = np.empty(40)
    position = np.empty(4)
    velocity = np.empty(3)
    product = np.empty(6)
    for k in range(first, last + 1):
        if _moved(spans, k, point, control) >= best:
            continue
        for j in range(6):
            product[j] = 0.0
        for axis in range(dimension):
            for j in range(4):
                position[j] = control[j, axis] * (3.0 if 0 < j < 3 else 1.0)
            for j in range(3):
                velocity[j] = (control[j + 1, axis] - control[j, axis]) * (2.0 if j == 1 else 1.0)
            add_product(position, velocity, 1.0, product)
        to_bernstein(product)
        for i in range(roots(product, stack, found)):
            w = min(max(_polished(control, found[i]), start - k), end - k)
            here = _squared(control, w)
            if here < best or (here == best and k + w < at):
                best, at = here, k + w
    return at, math.sqrt(best)
