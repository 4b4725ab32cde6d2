"""What limits that couple speed and acceleration ask of v² at both ends of a stretch.

v² is linear on a stretch, so the acceleration is (w1 - w0) / 2h there. Every limit becomes
half-planes p w0 + q w1 <= g that hold for the whole stretch: tangent and curvature are quadratics
with bounded errors, what the limits bound is a polynomial in the distance, and a polynomial lies
below its largest Bernstein coefficient.

Tested through ``kernels/timing/test_reachability``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, kernel


@inlined
def _couple(
    a: Floats,
    b: Floats,
    i: int,
    miss: float,
    limit: float,
    h: float,
    planes: Floats,
    n: int,
    m: int,
) -> int:
    """Half-planes of |A(s) a + B(s) w| <= limit on a stretch, times 2h, for quadratics A and B.

    With w linear and a = (w1 - w0) / 2h the sum is a cubic in s; it is below its largest
    Bernstein coefficient, and each of the four is linear in w0 and w1.
    """
    miss, limit, double = 2.0 * h * miss, 2.0 * h * limit, 2.0 * h
    for j in range(4):
        if j == 0:
            along, p, q, e, f = a[i, 0], b[i, 0], 0.0, miss, 0.0
        elif j == 1:
            along, p, q = (a[i, 0] + 2.0 * a[i, 1]) / 3.0, 2.0 * b[i, 1] / 3.0, b[i, 0] / 3.0
            e, f = 2.0 * miss / 3.0, miss / 3.0
        elif j == 2:
            along, p, q = (2.0 * a[i, 1] + a[i, 2]) / 3.0, b[i, 2] / 3.0, 2.0 * b[i, 1] / 3.0
            e, f = miss / 3.0, 2.0 * miss / 3.0
        else:
            along, p, q, e, f = a[i, 2], 0.0, b[i, 2], 0.0, miss
        p, q = p * double, q * double
        planes[n, m, 0], planes[n, m, 1], planes[n, m, 2] = p - along + e, q + along + f, limit
        planes[n, m + 1, 0], planes[n, m + 1, 1] = along - p + e, f - q - along
        planes[n, m + 1, 2] = limit
        m += 2
    return m


@inlined
def _part(c: Floats, k: int, i: int, x: float, y: float, out: Floats, o: int) -> None:
    """Bernstein coefficients of a quadratic on [x, y]."""
    p, q = c[k, i, 0] + x * (c[k, i, 1] - c[k, i, 0]), c[k, i, 1] + x * (c[k, i, 2] - c[k, i, 1])
    out[o, 0], out[o, 1] = p + x * (q - p), p + y * (q - p)
    p, q = c[k, i, 0] + y * (c[k, i, 1] - c[k, i, 0]), c[k, i, 1] + y * (c[k, i, 2] - c[k, i, 1])
    out[o, 2] = p + y * (q - p)


@kernel
def stretch_planes(
    line: Floats,
    cell: NDArray[np.int64],
    ends: Floats,
    tops: Floats,
    caps: Floats,
    tangents: Floats,
    bends: Floats,
    yaws: Floats,
    misses: Floats,
    speeds: Floats,
    accel: float,
    brake: float,
    bound: float,
    axis_accel: Floats,
    yaw_accel: float,
) -> Floats:
    """What the limits ask of v² at both ends of every stretch.

    Args:
        line: Ends of the stretches [m], increasing, shape (n + 1,).
        cell: The cell that each lies in, shape (n,).
        ends: Which part of the cell it is, in [0, 1], shape (n, 2).
        tops: Largest v² on it [m²/s²], shape (n,).
        caps: Largest v² at the nodes, shape (n + 1,); lowered in place by ``tops`` and ``speeds``.
        tangents: Bernstein coefficients of T on every cell, shape (c, d, 3).
        bends: The same of K = dT/ds [1/m], shape (c, d, 3).
        yaws: The same of the change of the heading and of its change [1/m, 1/m²], shape
            (c, 2, 3), or (0, 2, 3) where no limit asks for them.
        misses: What these miss at most: T, K, change of heading, its change, shape (c, 4).
        speeds: Of ``cell_caps``, shape (c, 2).
        accel: [m/s²].
        brake: [m/s²].
        bound: An acceleration along the path that no limit allows to exceed [m/s²].
        axis_accel: [m/s²], shape (d,), or (0,) for no limit.
        yaw_accel: [rad/s²], inf for no limit.

    Returns:
        Half-planes p w0 + q w1 <= g, shape (n, k, 3); w0 = w1 = 0 keeps them all.
    """
    n, d, axes = tops.shape[0], tangents.shape[1], axis_accel.shape[0]
    many = 2 + 8 * axes
    if yaw_accel < np.inf:
        many += 8
    planes = np.empty((n, many, 3))
    t, b, y, z = np.empty((d, 3)), np.empty((d, 3)), np.zeros((1, 3)), np.zeros((1, 3))
    for i in range(n):
        k, h, x0, x1 = cell[i], line[i + 1] - line[i], ends[i, 0], ends[i, 1]
        for j in range(d):
            _part(tangents, k, j, x0, x1, t, j)
            _part(bends, k, j, x0, x1, b, j)
        if yaws.shape[0] > 0:
            _part(yaws, k, 0, x0, x1, y, 0)
            _part(yaws, k, 1, x0, x1, z, 0)
        for side in range(2):
            top = speeds[k, 0] + ends[i, side] * (speeds[k, 1] - speeds[k, 0])
            caps[i + side] = min(caps[i + side], top, tops[i])
        most = bound
        for j in range(axes):
            most = min(most, 0.25 * axis_accel[j] / (misses[k, 0] + 1e-300))
        if yaw_accel < np.inf:
            most = min(most, 0.25 * yaw_accel / (misses[k, 2] + 1e-300))
        planes[i, 0, 0], planes[i, 0, 1], planes[i, 0, 2] = -1.0, 1.0, 2.0 * h * min(accel, most)
        planes[i, 1, 0], planes[i, 1, 1], planes[i, 1, 2] = 1.0, -1.0, 2.0 * h * min(brake, most)
        m = 2
        for j in range(axes):
            limit = axis_accel[j] - misses[k, 0] * most
            m = _couple(t, b, j, misses[k, 1], limit, h, planes, i, m)
        if yaw_accel < np.inf:
            m = _couple(y, z, 0, misses[k, 3], yaw_accel - misses[k, 2] * most, h, planes, i, m)
    return planes
