"""Where a piecewise cubic points and how it bends: unit tangents and curvature.

Both are read from Bézier control points, in which zeros are exact, and are defined by their limits
where the first derivative vanishes.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cubic import (
    first_derivative,
    second_derivative,
    speed_bound,
    third_derivative,
    wrapped,
)
from viaspline.kernels.jit import inner, kernel

REST_ROUNDING = 2e-15
NEARLY_STILL = 1e-2
"""Slower than this share of a span's largest speed, the rounding of its coordinates turns it."""


@kernel
def curvature_at(spans: Floats, k: int, w: float) -> float:
    """Curvature of span k at w in [0, 1] [1/m].

    Signed in the plane (anticlockwise positive), unsigned in space, 0 in one dimension. Where P'
    vanishes it is the limit: 0 when the span is straight there, infinite at a cusp. What is lost
    in rounding counts as straight.
    """
    dimension = spans.shape[2]
    scale = speed_bound(spans, k)
    if dimension == 1 or scale == 0.0:
        return 0.0
    aa = 0.0
    ab = 0.0
    bb = 0.0
    for axis in range(dimension):
        a = first_derivative(spans, k, axis, w)
        b = second_derivative(spans, k, axis, w)
        aa += a * a
        ab += a * b
        bb += b * b
    speed = math.sqrt(aa)
    if speed <= 1e-14 * scale:
        return _curvature_at_rest(spans, k, w, scale)
    across = 0.0
    area = 0.0
    ax = 0.0
    bx = 0.0
    for axis in range(dimension):
        a = first_derivative(spans, k, axis, w)
        b = second_derivative(spans, k, axis, w)
        area = ax * b - bx * a
        ax = a
        bx = b
        across += (b - ab / aa * a) ** 2
    if dimension > 2:
        area = math.sqrt(across) * speed
    size = scale if speed > NEARLY_STILL * scale else max(scale, _extent(spans, k))
    if abs(area) <= REST_ROUNDING * size * (speed + math.sqrt(bb)):
        return 0.0
    return area / (aa * speed)


@inner
def _extent(spans: Floats, k: int) -> float:
    """The largest coordinate of a span [m]."""
    largest = 0.0
    for j in range(4):
        for axis in range(spans.shape[2]):
            largest = max(largest, abs(spans[k, j, axis]))
    return largest


@inner
def _curvature_at_rest(spans: Floats, k: int, w: float, scale: float) -> float:
    """Limit of the curvature where P' vanishes: 0 when the two derivatives above are parallel."""
    squared = 0.0
    area = 0.0
    for j in range(spans.shape[2]):
        for i in range(j):
            area = second_derivative(spans, k, i, w) * third_derivative(spans, k, j)
            area -= second_derivative(spans, k, j, w) * third_derivative(spans, k, i)
            squared += area * area
    if math.sqrt(squared) <= 1e-12 * scale * scale:
        return 0.0
    return -np.inf if spans.shape[2] == 2 and area < 0.0 else np.inf


@kernel
def curvature(spans: Floats, u: Floats, closed: bool, left: bool, out: Floats) -> int:
    """Curvature at parameters [1/m], out (n,); arguments and answer as in ``evaluate``.

    At a joint that of the span on the right, or with ``left`` that of the span on the left.
    """
    count = spans.shape[0]
    for i in range(u.shape[0]):
        x = wrapped(u[i], count, closed)
        if math.isnan(x):
            return i
        if closed and x == (0 if left else count):
            x = count - x
        k = int(x)
        if k == count or (left and k == x and k > 0):
            k -= 1
        out[i] = curvature_at(spans, k, x - k)
    return -1


@inner
def direction_at(spans: Floats, k: int, w: float, out: Floats) -> bool:
    """Unit tangent of span k at w into ``out`` (d,); its limit where P' vanishes.

    The limit is the one from the right, at w = 1 the one from the left. False for a span that is
    a single point, which has none.
    """
    scale = speed_bound(spans, k)
    if scale == 0.0:
        for axis in range(spans.shape[2]):
            out[axis] = 0.0
        return False
    for order in range(1, 4):
        squared = 0.0
        for axis in range(spans.shape[2]):
            if order == 1:
                out[axis] = first_derivative(spans, k, axis, w)
            elif order == 2:
                out[axis] = second_derivative(spans, k, axis, w)
                if w == 1.0:
                    out[axis] = -out[axis]
            else:
                out[axis] = third_derivative(spans, k, axis)
            squared += out[axis] * out[axis]
        length = math.sqrt(squared)
        if length > 1e-13 * scale or order == 3:
            for axis in range(spans.shape[2]):
                out[axis] /= length
            return True
    return False


@kernel
def direction(spans: Floats, u: Floats, closed: bool, out: Floats) -> int:
    """Unit tangents at parameters; arguments and answer as in ``evaluate``.

    A span that is a single point takes the tangent of the next span that is not, at the end of
    the curve that of the last one; a curve that is a single point has a tangent of zero.
    """
    count = spans.shape[0]
    for i in range(u.shape[0]):
        x = wrapped(u[i], count, closed)
        if math.isnan(x):
            return i
        k = int(x)
        w = x - k
        if k == count:
            k = 0 if closed else count - 1
            w = 0.0 if closed else 1.0
        found = direction_at(spans, k, w, out[i])
        after = k + 1
        while not found and after < count:
            found = direction_at(spans, after, 0.0, out[i])
            after += 1
        before = k - 1
        while not found and before >= 0:
            found = direction_at(spans, before, 1.0, out[i])
            before -= 1
    return -1
