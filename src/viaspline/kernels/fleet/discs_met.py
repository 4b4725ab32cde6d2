"""Which discs a curve comes into, decided exactly.

The squared distance of a cubic from a place is a polynomial of degree 6. Less the square of a
radius it has seven Bernstein coefficients: where all are positive the piece is outside of the disc,
where one at an end isn't, it is inside; what neither settles is halved.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.jit import inner, kernel

MAX_HALVINGS = 40
_BINOMIALS = np.array([1.0, 3.0, 3.0, 1.0])
_SIXTH = np.array([1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0])


@inner
def _set_coefficients(span: Floats, x: float, y: float, radius: float, out: Floats) -> None:
    """The Bernstein coefficients of the squared distance less the squared radius [m²], (7,)."""
    for k in range(7):
        total = 0.0
        for i in range(max(0, k - 3), min(3, k) + 1):
            j = k - i
            dot = (span[i, 0] - x) * (span[j, 0] - x) + (span[i, 1] - y) * (span[j, 1] - y)
            total += _BINOMIALS[i] * _BINOMIALS[j] * dot
        out[k] = total / _SIXTH[k] - radius * radius


@inner
def _is_met(stack: Floats) -> bool:
    """Whether a polynomial gets below 0; its coefficients are the first row of the stack."""
    top = 0
    while top >= 0:
        piece = stack[top]
        if piece[0] < 0.0 or piece[6] < 0.0:
            return True
        if piece.min() >= 0.0:
            top -= 1
            continue
        if top + 2 > MAX_HALVINGS:
            return True
        for k in range(7):
            stack[top + 1, k] = piece[k]
        for level in range(1, 7):  # de Casteljau: the left half above the right one
            for k in range(6, level - 1, -1):
                stack[top + 1, k] = 0.5 * (stack[top + 1, k] + stack[top + 1, k - 1])
            for k in range(7 - level):
                piece[k] = 0.5 * (piece[k] + piece[k + 1])
        top += 1
    return False


@inner
def _in_box(spans: Floats, discs: Floats, grown: float) -> Ints:
    """The discs that the box round a curve comes near to, (k,)."""
    low_x, high_x, low_y, high_y = np.inf, -np.inf, np.inf, -np.inf
    for k in range(spans.shape[0]):
        for i in range(4):
            low_x, high_x = min(low_x, spans[k, i, 0]), max(high_x, spans[k, i, 0])
            low_y, high_y = min(low_y, spans[k, i, 1]), max(high_y, spans[k, i, 1])
    found, count = np.empty(discs.shape[0], np.int64), 0
    for i in range(discs.shape[0]):
        x, y, radius = discs[i, 0], discs[i, 1], discs[i, 2] + grown
        beside = x < low_x - radius or x > high_x + radius
        if not (beside or y < low_y - radius or y > high_y + radius):
            found[count] = i
            count += 1
    return found[:count]


@kernel
def discs_met(spans: Floats, discs: Floats, grown: float) -> Flags:
    """Which discs a curve comes into.

    Args:
        spans: Bézier control polygons [m], (m, 4, d); of a curve in space its ground track counts.
        discs: x, y and radius of each [m], (n, 3).
        grown: By how much each of them is larger [m].

    Returns:
        (n,). To touch one is decided by rounding.

    Example:
        >>> line = np.array([[[0.0, 0.0], [3.0, 0.0], [6.0, 0.0], [9.0, 0.0]]])
        >>> discs_met(line, np.array([[4.0, 1.9, 1.0], [6.0, -2.1, 1.0]]), 1.0).tolist()
        [True, False]
    """
    met = np.zeros(discs.shape[0], np.bool_)
    in_box = _in_box(spans, discs, grown)
    stack = np.empty((MAX_HALVINGS + 1, 7))
    for k in range(spans.shape[0]):
        span = spans[k]
        low_x, high_x = span[0, 0], span[0, 0]
        low_y, high_y = span[0, 1], span[0, 1]
        for i in range(1, 4):
            low_x, high_x = min(low_x, span[i, 0]), max(high_x, span[i, 0])
            low_y, high_y = min(low_y, span[i, 1]), max(high_y, span[i, 1])
        for i in in_box:
            x, y, radius = discs[i, 0], discs[i, 1], discs[i, 2] + grown
            beside = x < low_x - radius or x > high_x + radius
            if met[i] or beside or y < low_y - radius or y > high_y + radius:
                continue
            _set_coefficients(span, x, y, radius, stack[0])
            met[i] = _is_met(stack)
    return met
