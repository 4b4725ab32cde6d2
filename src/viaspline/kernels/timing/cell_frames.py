"""Tangent and curvature on every cell of a curve, as Bernstein coefficients of quadratics.

Tested through ``kernels/timing/test_cut_cells``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.curve.piece_bounds import velocity_polygon
from viaspline.kernels.jit import inlined, kernel
from viaspline.kernels.timing.cut_cells import FIRST, LAST, NOISE, SPAN, STRAIGHT

_GAUSS = np.array([[0.05635083268962915, 5 / 36], [0.25, 8 / 36], [0.44364916731037085, 5 / 36]])
"""Places and weights for the first half of [0, 1]; the second one mirrors them."""


@inlined
def _frame(r: Floats, u: float, width: float, frame: Floats) -> float:
    """T and K at a place in [0, 1] of a cell, into rows 0 and 1; returns |q'|."""
    square, dot, v = 0.0, 0.0, 1.0 - u
    for j in range(r.shape[1]):
        first = v * v * r[0, j] + 2.0 * u * v * r[1, j] + u * u * r[2, j]
        second = 2.0 * (v * (r[1, j] - r[0, j]) + u * (r[2, j] - r[1, j])) / width
        frame[0, j], frame[1, j] = first, second
        square += first * first
        dot += first * second
    speed = np.sqrt(square)
    over = 1.0 / square if square > 0.0 else 0.0
    for j in range(r.shape[1]):
        frame[1, j] = (frame[1, j] - dot * over * frame[0, j]) * over
        frame[0, j] *= speed * over
    return speed


@inlined
def _half_lengths(r: Floats) -> tuple[float, float]:
    """Lengths of both halves of a piece on which |q'| hardly changes, by Gauss' rule.

    |q'|² has the Bernstein coefficients g, whatever the dimension.
    """
    g0, g1, g2, g3, g4 = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(r.shape[1]):
        g0 += r[0, j] * r[0, j]
        g1 += 4.0 * r[0, j] * r[1, j]
        g2 += 2.0 * r[0, j] * r[2, j] + 4.0 * r[1, j] * r[1, j]
        g3 += 4.0 * r[1, j] * r[2, j]
        g4 += r[2, j] * r[2, j]
    first, second = 0.0, 0.0
    for k in range(3):
        u, weight = _GAUSS[k, 0], _GAUSS[k, 1]
        v = 1.0 - u
        a, b, c = u * u, u * v, v * v
        first += weight * np.sqrt(max(c * (c * g0 + b * g1 + a * g2) + a * (b * g3 + a * g4), 0.0))
        second += weight * np.sqrt(max(a * (a * g0 + b * g1 + c * g2) + c * (b * g3 + c * g4), 0.0))
    return first, second


@inlined
def _straight_length(r: Floats) -> float:
    """Length of a piece that runs straight ahead, per width of its parameter."""
    square = 0.0
    for j in range(r.shape[1]):
        mean = (r[0, j] + r[1, j] + r[2, j]) / 3.0
        square += mean * mean
    return np.sqrt(square)


@inlined
def _middle(first: float, middle: float, last: float, x: float) -> float:
    """The middle Bernstein coefficient of the quadratic with three values at 0, x and 1."""
    y = 1.0 - x
    return (middle - y * y * first - x * x * last) / (2.0 * x * y)


@inlined
def _straight_frame(spans: Floats, i: int, frame: Floats) -> float:
    """T and K of a straight span, and its length."""
    square = 0.0
    for j in range(spans.shape[2]):
        frame[0, j], frame[1, j] = spans[i, 3, j] - spans[i, 0, j], 0.0
        square += frame[0, j] * frame[0, j]
    chord = np.sqrt(square)
    for j in range(spans.shape[2]):
        frame[0, j] /= chord
    return chord


@kernel
def fill_cells(
    spans: Floats, rows: Floats, cusps: Flags
) -> tuple[Floats, Floats, Floats, Floats, Flags]:
    """Tangent and curvature on every cell.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).
        rows: Of ``cut_cells``.
        cusps: Of ``cut_cells``.

    Returns:
        Ends of the cells as distances from the first one (n + 1,); which part of each cell's
        length lies before the middle of its parameter (n,); Bernstein coefficients of T and of K
        (n, d, 3); and where the curve has a corner or a cusp (n + 1,).
    """
    n, d = rows.shape[0], spans.shape[2]
    along, shares, rests = np.zeros(n + 1), np.full(n, 0.5), np.zeros(n + 1, np.bool_)
    tangents, bends = np.empty((n, d, 3)), np.empty((n, d, 3))
    r, at, mid, end = np.empty((3, d)), np.empty((2, d)), np.empty((2, d)), np.zeros((2, d))
    now = -1
    for i in range(n):
        span, a, b = int(rows[i, SPAN]), rows[i, FIRST], rows[i, LAST]
        velocity_polygon(spans, span, a, b, r)
        straight = rows[i, STRAIGHT] > 0.0
        handle = _straight_frame(spans, span, at) if straight else _frame(r, 0.0, b - a, at)
        if span != now:
            turn, slip = 0.0, 1e-5 + rows[i, NOISE] / handle
            for j in range(d):
                turn += (at[0, j] - end[0, j]) ** 2
            rests[i] |= now >= 0 and not turn <= slip * slip
            now = span
        if straight:
            _straight_frame(spans, span, mid)
            _straight_frame(spans, span, end)
        else:
            _frame(r, 0.5, b - a, mid)
            _frame(r, 1.0, b - a, end)
        if straight:
            piece = (b - a) * _straight_length(r)
        else:
            half, rest = _half_lengths(r)
            piece = (b - a) * (half + rest)
            if piece > 0.0:
                shares[i] = half / (half + rest)
        for j in range(d):
            tangents[i, j, 0], tangents[i, j, 2] = at[0, j], end[0, j]
            tangents[i, j, 1] = _middle(at[0, j], mid[0, j], end[0, j], shares[i])
            bends[i, j, 0], bends[i, j, 2] = at[1, j], end[1, j]
            bends[i, j, 1] = _middle(at[1, j], mid[1, j], end[1, j], shares[i])
        rests[i] |= cusps[i]
        rests[i + 1] |= cusps[i]
        along[i + 1] = along[i] + piece
    return along, shares, tangents, bends, rests
