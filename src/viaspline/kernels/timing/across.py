"""The largest acceleration across a path, and the largest yaw rate, along a time law.

Of every piece of the law, cut at the joints of the curve, speed and curvature have bounds; what
they don't settle is halved, until nothing is left that could exceed what is attained by more than
a small part of it.

Tested through ``machine/test_drivability``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cubic import speed_at
from viaspline.kernels.curve.frenet import curvature_at
from viaspline.kernels.curve.piece_bounds import shape_bounds, velocity_polygon
from viaspline.kernels.jit import inner, kernel

ACROSS_TOLERANCE = 1e-4
"""By how much of itself the largest value may be larger than what is found."""

NEGLIGIBLE = 1e-6
"""Nobody needs to know more of what is less [m/s²], [rad/s]; on straight lines it is rounding."""

MIN_PIECE = 2.0**-40
MAX_DEPTH = 64
_GAUSS_AT = np.array([0.1127016653792583, 0.5, 0.8872983346207417])
_GAUSS_WEIGHT = np.array([5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0])


@inner
def _curvature_bound(spans: Floats, k: int, a: float, b: float, r: Floats) -> float:
    """No curvature on [a, b] of a span is larger; infinite where the curve may stand still."""
    velocity_polygon(spans, k, a, b, r)
    _, _, bound, _, _ = shape_bounds(r, b - a)
    return bound


@inner
def _length(spans: Floats, k: int, a: float, b: float) -> float:
    total = 0.0
    for i in range(3):
        w = a + (b - a) * _GAUSS_AT[i]
        total += _GAUSS_WEIGHT[i] * speed_at(spans, k, w)
    return (b - a) * total


@inner
def _halfway(spans: Floats, k: int, a: float, b: float, first: float, last: float) -> float:
    """How far into a piece of a law the middle of a part of a span lies [m].

    Args:
        spans: Bézier control polygons [m].
        k: The span.
        a: Where the part begins, local parameter.
        b: Where it ends.
        first: How far into the piece of the law it begins [m].
        last: How far it ends [m].
    """
    middle = 0.5 * (a + b)
    part = _length(spans, k, a, middle)
    whole = part + _length(spans, k, middle, b)
    return first + (last - first) * part / max(whole, 1e-300)


@inner
def _square(law: Floats, i: int, x: float) -> float:
    """v² at a distance into a piece of a law [m²/s²]."""
    v, width = law[i, SPEED], law[i, WIDTH]
    if law[i, JERK] > 0.0:
        away = width - x if v > 0.0 else x
        stroke = (6.0 * max(away, 0.0) / law[i, JERK]) ** (1.0 / 3.0)
        return (0.5 * law[i, JERK] * stroke * stroke) ** 2
    return max(v * v + (2.0 * law[i, ACCEL] + law[i, CHANGE] * x) * x, 0.0)


@inner
def _square_bound(law: Floats, i: int, first: float, last: float) -> float:
    """No v² between two distances into a piece is larger."""
    most = max(_square(law, i, first), _square(law, i, last))
    if law[i, CHANGE] < 0.0:
        top = -law[i, ACCEL] / law[i, CHANGE]
        if first < top < last:
            most = max(most, _square(law, i, top))
    return most


SPEED, ACCEL, CHANGE, JERK, WIDTH = 0, 1, 2, 3, 4
PIECE, FROM, TO, START = 0, 1, 2, 3


@inner
def _value(spans: Floats, k: int, w: float, square: float, power: float) -> float:
    if square <= 0.0:
        return 0.0
    return abs(curvature_at(spans, k, w)) * square**power


@kernel
def largest_across(
    spans: Floats, bends: Floats, law: Floats, cells: Floats, power: float, slip: float
) -> tuple[float, float]:
    """The largest |curvature| v^(2 power) along a time law.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).
        bends: The largest curvature of each span [1/m], shape (m,).
        law: Pieces of the law, shape (p, 5): speed at the beginning [m/s], acceleration there
            [m/s²], its change with distance [1/s²], with time [m/s³], and the piece's length [m].
        cells: Parts of spans that lie on one piece each, shape (n, 5): the piece, u of both ends,
            and their distances into the piece [m].
        power: 1 for the acceleration across the path [m/s²], 0.5 for the yaw rate [rad/s].
        slip: v² is no better known than this [m²/s²], as a place isn't.

    Returns:
        The largest value that is attained, which none exceeds by more than ``ACROSS_TOLERANCE`` of
        it, and u there.
    """
    best, where = 0.0, 0.0
    r = np.empty((3, spans.shape[2]))
    for c in range(cells.shape[0]):
        i = int(cells[c, PIECE])
        u = 0.5 * (cells[c, FROM] + cells[c, TO])
        k = int(u)
        x = _halfway(
            spans, k, cells[c, FROM] - k, cells[c, TO] - k, cells[c, START], cells[c, START + 1]
        )
        square = _square(law, i, x) - slip
        here = _value(spans, k, u - k, square, power)
        if here > best:
            best, where = here, u
    stack = np.empty((MAX_DEPTH, 4))
    for c in range(cells.shape[0]):
        i = int(cells[c, PIECE])
        k = int(0.5 * (cells[c, FROM] + cells[c, TO]))
        for j in range(4):
            stack[0, j] = cells[c, FROM + j] - (k if j < 2 else 0.0)
        depth = 1
        while depth > 0:
            depth -= 1
            a, b = stack[depth, 0], stack[depth, 1]
            first, last = stack[depth, 2], stack[depth, 3]
            most = _square_bound(law, i, first, last) - slip
            limit = max(best, NEGLIGIBLE) * (1.0 + ACROSS_TOLERANCE)
            if most <= 0.0 or bends[k] * most**power <= limit:
                continue
            if _curvature_bound(spans, k, a, b, r) * most**power <= limit:
                continue
            for end in range(2):
                w, x = stack[depth, end], stack[depth, 2 + end]
                here = _value(spans, k, w, _square(law, i, x) - slip, power)
                if here > best and here < np.inf:
                    best, where = here, k + w
            if b - a <= MIN_PIECE or depth + 2 > MAX_DEPTH:
                continue
            middle = 0.5 * (a + b)
            x = _halfway(spans, k, a, b, first, last)
            stack[depth, 0], stack[depth, 1] = middle, b
            stack[depth, 2], stack[depth, 3] = x, last
            stack[depth + 1, 0], stack[depth + 1, 1] = a, middle
            stack[depth + 1, 2], stack[depth + 1, 3] = first, x
            depth += 2
    return best, where
