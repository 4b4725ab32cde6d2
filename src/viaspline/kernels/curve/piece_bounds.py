"""Bounds of how fast a piece of a cubic runs and how it bends, from its derivative's hull.

With the derivatives p_k = q^(k) / |q'|^k and the unit tangent T, the curvature is at most |p_2|,
how fast the parameter runs changes by τ = T·p_2, and |p_3| bounds how fast the curvature changes.

Tested through ``kernels/timing/test_cut_cells`` and ``machine/test_drivability``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined


@inlined
def velocity_polygon(spans: Floats, i: int, a: float, b: float, r: Floats) -> None:
    """Control vectors of the derivative of span i on [a, b] of its parameter."""
    for j in range(spans.shape[2]):
        x0 = 3.0 * (spans[i, 1, j] - spans[i, 0, j])
        x1 = 3.0 * (spans[i, 2, j] - spans[i, 1, j])
        x2 = 3.0 * (spans[i, 3, j] - spans[i, 2, j])
        p, q = x0 + a * (x1 - x0), x1 + a * (x2 - x1)
        r[0, j], r[1, j] = p + a * (q - p), p + b * (q - p)
        p, q = x0 + b * (x1 - x0), x1 + b * (x2 - x1)
        r[2, j] = p + b * (q - p)


@inlined
def shape_bounds(r: Floats, width: float) -> tuple[float, float, float, float, float]:
    """Least and largest |q'| where q' has the control vectors r; bounds of κ, |τ| and |p_3|.

    |q'|² has the Bernstein coefficients g; a polynomial lies between the least and the largest.
    """
    g0, g01, g02, g11, g12, g2, third = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    w0, w1, w2 = 0.0, 0.0, 0.0
    d = r.shape[1]
    for i in range(d):
        g0 += r[0, i] * r[0, i]
        g01 += r[0, i] * r[1, i]
        g02 += r[0, i] * r[2, i]
        g11 += r[1, i] * r[1, i]
        g12 += r[1, i] * r[2, i]
        g2 += r[2, i] * r[2, i]
        third += (r[2, i] - 2.0 * r[1, i] + r[0, i]) ** 2
        for j in range(i + 1, d):
            w0 += (r[0, i] * r[1, j] - r[0, j] * r[1, i]) ** 2
            w1 += (r[0, i] * r[2, j] - r[0, j] * r[2, i]) ** 2
            w2 += (r[1, i] * r[2, j] - r[1, j] * r[2, i]) ** 2
    mid = (g02 + 2.0 * g11) / 3.0
    low, high = min(g0, g01, mid, g12, g2), max(g0, g01, mid, g12, g2)
    if low <= 0.0:
        return 0.0, np.sqrt(high), np.inf, np.inf, np.inf
    over = 1.0 / (low * np.sqrt(low))
    k = np.sqrt(max(4.0 * w0, w1, 4.0 * w2)) / width * over
    t = max(abs(g01 - g0), abs(mid - g01), abs(g12 - mid), abs(g2 - g12)) * 2.0 / width * over
    c = 2.0 * np.sqrt(third) / (width * width) * over
    return np.sqrt(low), np.sqrt(high), k, t, c
