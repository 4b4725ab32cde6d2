"""Cells of a curve: pieces so short that quadratics of the distance give tangent and curvature.

On every cell the unit tangent T(s) and the curvature vector K(s) = dT/ds are quadratics in the
distance s, with proven bounds of what they miss. With the derivatives p_k = q^(k) / |q'|^k and
τ = T·p_2, a cubic has T' = K = p_2 - τT, K' = p_3⊥ - 3τK - κ²T, p_3' = -3τp_3 and
τ' = κ² + T·p_3 - 2τ². So bounds of κ, |τ| and |p_3| on a cell bound all that follow.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.curve.piece_bounds import shape_bounds, velocity_polygon
from viaspline.kernels.curve.straight_span import runs_straight, span_rounding
from viaspline.kernels.jit import inlined, kernel

_QUADRATIC = 0.00802
"""Largest |x (x - 1/2) (x - 1)| / 6 on [0, 1]: what a quadratic through three points misses."""

SPAN, FIRST, LAST, MISS_T, MISS_K, MISS_TURN, MISS_CHANGE, NOISE, STRAIGHT = range(9)
"""Columns of the rows of ``cut_cells``."""


@inlined
def _bounds(k: float, t: float, c: float) -> tuple[float, float]:
    """Bounds of |K''| and |K'''| where κ <= k, |τ| <= t and |p_3| <= c."""
    k1 = c + 3.0 * t * k + k * k
    t1 = k * k + c + 2.0 * t * t
    kk1 = k * c + 3.0 * t * k * k
    c1 = 3.0 * t * c + 2.0 * k * c
    t2 = 2.0 * kk1 + k * c + 3.0 * t * c + 4.0 * t * t1
    k2 = c1 + 3.0 * t1 * k + 3.0 * t * k1 + 2.0 * kk1 + k * k * k
    k3 = 3.0 * t1 * c + 3.0 * t * c1
    k3 += k1 * c + 3.0 * t * k * c + k * k * c
    k3 += (k * c + 3.0 * t * c) * k + c * k1
    k3 += 3.0 * (t2 * k + t1 * k1) + 3.0 * (t1 * k1 + t * k2)
    k3 += 2.0 * (k1 * k1 + k * k2) + 4.0 * kk1 * k + k * k * k1
    return k2, k3


@kernel
def cut_cells(
    spans: Floats, longest: float, least: float, accel: float, square: float, axis: float,
    yaw: float,
) -> tuple[Floats, Flags]:  # fmt: skip
    """Cut a curve into cells that are fine enough for the limits.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d). Those that are no longer than rounding
            have no cells, unless all are so.
        longest: No cell is longer [m].
        least: A cell that is shorter is fine enough for every limit [m].
        accel: Bound of the acceleration along the curve [m/s²].
        square: Bound of v² [m²/s²].
        axis: The least acceleration that an axis allows [m/s²], inf if there is no limit.
        yaw: Largest yaw acceleration [rad/s²], inf if there is no limit.

    Returns:
        Rows (n, 9): span; first and last parameter in it; what the quadratics of T [-], of K [1/m]
        and of the curvature [1/m], and the line of the curvature's change [1/m²], miss at most;
        what rounding does to the derivative [m]; 1 on a straight piece. And whether the cell is a
        cusp, (n,): too short to be halved, or so slow in its parameter that all is rounding.
    """
    m, d = spans.shape[0], spans.shape[2]
    size = 2 * m + 64
    rows, cusps = np.zeros((size, 9)), np.zeros(size, np.bool_)
    r, stack = np.empty((3, d)), np.empty((64, 2))
    count = 0
    for i in range(m):
        noise = span_rounding(spans, i)
        straight = runs_straight(spans, i, noise)
        velocity_polygon(spans, i, 0.0, 1.0, r)
        is_point = shape_bounds(r, 1.0)[1] <= noise and (count > 0 or i < m - 1)
        depth = 1 if noise >= 0.0 and not is_point else 0
        stack[0, 0], stack[0, 1] = 0.0, 1.0
        while depth > 0:
            depth -= 1
            a, b = stack[depth, 0], stack[depth, 1]
            width = b - a
            velocity_polygon(spans, i, a, b, r)
            low, high, k, t, c = shape_bounds(r, width)
            h = high * width
            fine, miss_t, miss_k, miss_y, miss_z = False, 0.0, 0.0, 0.0, 0.0
            if straight:
                fine = h <= longest
            elif low > noise and high <= 1.5 * low:
                k2, k3 = _bounds(k, t, c)
                miss_y = 2.0 * k * k2 + k3
                miss_z = 0.125 * h * h * miss_y
                cube = 1.3 * _QUADRATIC * h * h * h
                miss_t, miss_k, miss_y = cube * k2, cube * k3, cube * miss_y
                fine = h <= longest and h * k <= 0.1
                if axis < np.inf and k > 0.0:
                    fine &= miss_t * accel + miss_k * min(square, axis / k) <= 0.004 * axis
                if yaw < np.inf and k > 0.0:
                    fine &= miss_y * accel <= 0.01 * yaw
                    fine &= miss_z * min(square, yaw / (c + k * k)) <= 0.02 * yaw
                fine |= h <= least and h * k <= 0.3
            cusp = not fine and (width < 1e-9 or high <= 2.0 * noise)
            if not (fine or cusp):
                middle = 0.5 * (a + b)
                stack[depth, 0], stack[depth, 1] = middle, b
                stack[depth + 1, 0], stack[depth + 1, 1] = a, middle
                depth += 2
                continue
            if count == size:
                more, flags = np.zeros((2 * size, 9)), np.zeros(2 * size, np.bool_)
                for row in range(size):
                    flags[row] = cusps[row]
                    for j in range(9):
                        more[row, j] = rows[row, j]
                rows, cusps, size = more, flags, 2 * size
            rows[count, SPAN], rows[count, FIRST], rows[count, LAST] = i, a, b
            rows[count, MISS_T], rows[count, MISS_K] = miss_t, miss_k
            rows[count, MISS_TURN], rows[count, MISS_CHANGE] = miss_y, miss_z
            rows[count, NOISE], rows[count, STRAIGHT] = noise, 1.0 if straight else 0.0
            cusps[count] = cusp
            count += 1
    return rows[:count], cusps[:count]
