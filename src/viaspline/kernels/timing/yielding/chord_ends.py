"""Where a curve is cut for chords that it hardly leaves: spans halved until they are that flat.

The length of a piece is taken for the middle of its chord's and its control polygon's, which is
right to the fourth order (Gravesen, *Adaptive subdivision and the length and energy of Bézier
curves*, 1997).

Tested through ``trajectory/yielding/test_road``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, kernel

HALVINGS = 40
"""Of a span at most."""


@inlined
def _polar(spans: Floats, i: int, j: int, u: float, v: float, w: float) -> float:
    """The polar form of coordinate j of span i: its control points are the values at a and b."""
    p0, p1, p2, p3 = spans[i, 0, j], spans[i, 1, j], spans[i, 2, j], spans[i, 3, j]
    q0, q1, q2 = p0 + u * (p1 - p0), p1 + u * (p2 - p1), p2 + u * (p3 - p2)
    r0, r1 = q0 + v * (q1 - q0), q1 + v * (q2 - q1)
    return r0 + w * (r1 - r0)


@kernel
def chord_ends(spans: Floats, miss: float, least: float) -> Floats:
    """Parameters at which a curve is cut, its joints among them.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d), d >= 2; the plane counts.
        miss: A piece is halved that may be farther from its chord [m],
        least: unless it is so short [m].

    Returns:
        Increasing (span k runs from k to k + 1), shape (n + 1,).
    """
    found, count = np.zeros(2 * spans.shape[0] + 64), 1
    stack = np.empty((HALVINGS + 2, 2))
    for i in range(spans.shape[0]):
        depth = 1
        stack[0, 0], stack[0, 1] = 0.0, 1.0
        while depth > 0:
            depth -= 1
            a, b = stack[depth, 0], stack[depth, 1]
            polygon, x, y = 0.0, _polar(spans, i, 0, a, a, a), _polar(spans, i, 1, a, a, a)
            first_x, first_y = x, y
            for k in range(3):
                v, w = b if k > 1 else a, b if k > 0 else a
                next_x, next_y = _polar(spans, i, 0, b, w, v), _polar(spans, i, 1, b, w, v)
                polygon += math.hypot(next_x - x, next_y - y)
                x, y = next_x, next_y
            chord = math.hypot(x - first_x, y - first_y)
            arc = max(0.5 * (polygon + chord), chord)
            off = math.sqrt(0.25 * (arc * arc - chord * chord) + (arc - chord) ** 2)
            if off > miss and arc > least and b - a > 0.5**HALVINGS:
                middle = 0.5 * (a + b)
                stack[depth, 0], stack[depth, 1] = middle, b
                stack[depth + 1, 0], stack[depth + 1, 1] = a, middle
                depth += 2
                continue
            if count == found.size:
                more = np.zeros(2 * count)
                for k in range(count):
                    more[k] = found[k]
                found = more
            found[count] = i + b
            count += 1
    return found[:count].copy()
