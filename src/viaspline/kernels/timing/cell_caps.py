"""What limits of speeds allow on the cells of a curve: whatever lies below a line.

Tested through ``trajectory/test_coupled``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, kernel


@inlined
def _squared_peak(a: Floats, i: int, miss: float, c0: float, c1: float) -> float:
    """A bound of A² w on a stretch on which w is linear from c0 to c1."""
    p1, p3 = a[i, 0] * a[i, 1], a[i, 1] * a[i, 2]
    p0, p4 = a[i, 0] * a[i, 0], a[i, 2] * a[i, 2]
    p2 = (a[i, 0] * a[i, 2] + 2.0 * a[i, 1] * a[i, 1]) / 3.0
    peak = max(p0 * c0, p4 * c1)
    peak = max(peak, 0.2 * (4.0 * p1 * c0 + p0 * c1), 0.2 * (3.0 * p2 * c0 + 2.0 * p1 * c1))
    peak = max(peak, 0.2 * (2.0 * p3 * c0 + 3.0 * p2 * c1), 0.2 * (p4 * c0 + 4.0 * p3 * c1))
    most = max(abs(a[i, 0]), abs(a[i, 1]), abs(a[i, 2]))
    return peak + miss * (2.0 * most + miss) * max(c0, c1)


@inlined
def _bend_peak(b: Floats, miss: float, c0: float, c1: float) -> float:
    """A bound of |K| w on a stretch on which w is linear from c0 to c1."""
    peak = 0.0
    for j in range(4):
        square = 0.0
        for i in range(b.shape[0]):
            if j == 0:
                x = b[i, 0] * c0
            elif j == 1:
                x = (2.0 * b[i, 1] * c0 + b[i, 0] * c1) / 3.0
            elif j == 2:
                x = (b[i, 2] * c0 + 2.0 * b[i, 1] * c1) / 3.0
            else:
                x = b[i, 2] * c1
            square += x * x
        peak = max(peak, square)
    return np.sqrt(peak) + miss * np.sqrt(float(b.shape[0])) * max(c0, c1)


@inlined
def _speed_caps(
    t: Floats,
    b: Floats,
    y: Floats,
    misses: Floats,
    k: int,
    h: float,
    top: float,
    accel: float,
    axis_speed: Floats,
    lateral: float,
    yaw_rate: float,
) -> tuple[float, float]:
    """Largest v² at both ends of a stretch for which the line between them keeps every speed."""
    c0, c1 = top, top
    for i in range(axis_speed.shape[0]):
        v = axis_speed[i] * axis_speed[i]
        c0 = min(c0, v / (t[i, 0] * t[i, 0] + 1e-300))
        c1 = min(c1, v / (t[i, 2] * t[i, 2] + 1e-300))
    if lateral < np.inf:
        k0, k1 = 0.0, 0.0
        for i in range(b.shape[0]):
            k0 += b[i, 0] * b[i, 0]
            k1 += b[i, 2] * b[i, 2]
        c0, c1 = min(c0, lateral / np.sqrt(k0 + 1e-300)), min(c1, lateral / np.sqrt(k1 + 1e-300))
    if yaw_rate < np.inf:
        v = yaw_rate * yaw_rate
        c0, c1 = min(c0, v / (y[0, 0] * y[0, 0] + 1e-300)), min(c1, v / (y[0, 2] ** 2 + 1e-300))
    c0, c1 = min(c0, c1 + 2.0 * accel * h), min(c1, c0 + 2.0 * accel * h)
    share = 1.0
    for i in range(axis_speed.shape[0]):
        peak = _squared_peak(t, i, misses[k, 0], c0, c1)
        share = min(share, axis_speed[i] * axis_speed[i] / (peak + 1e-300))
    if lateral < np.inf:
        share = min(share, lateral / (_bend_peak(b, misses[k, 1], c0, c1) + 1e-300))
    if yaw_rate < np.inf:
        peak = _squared_peak(y, 0, misses[k, 2], c0, c1)
        share = min(share, yaw_rate * yaw_rate / (peak + 1e-300))
    return c0 * share, c1 * share


@kernel
def cell_caps(
    along: Floats,
    tangents: Floats,
    bends: Floats,
    yaws: Floats,
    misses: Floats,
    square: float,
    bound: float,
    axis_speed: Floats,
    lateral: float,
    yaw_rate: float,
) -> Floats:
    """What limits of speeds allow for v² on every cell: whatever lies below a line.

    Args:
        along: Ends of the cells [m], shape (c + 1,).
        tangents: Bernstein coefficients of T on every cell, shape (c, d, 3).
        bends: The same of K = dT/ds [1/m], shape (c, d, 3).
        yaws: The same of the change of the heading and of its change, shape (c, 2, 3), or
            (0, 2, 3) where no limit asks for them.
        misses: What these miss at most, shape (c, 4).
        square: Largest v² anywhere [m²/s²].
        bound: An acceleration along the path that no limit allows to exceed [m/s²].
        axis_speed: [m/s], shape (d,), or (0,) for no limit.
        lateral: [m/s²], inf for no limit.
        yaw_rate: [rad/s], inf for no limit.

    Returns:
        The line at both ends of each cell [m²/s²], shape (c, 2).
    """
    n, d = tangents.shape[0], tangents.shape[1]
    caps = np.empty((n, 2))
    t, b, y = np.empty((d, 3)), np.empty((d, 3)), np.zeros((1, 3))
    for k in range(n):
        for c in range(3):
            for j in range(d):
                t[j, c], b[j, c] = tangents[k, j, c], bends[k, j, c]
            if yaws.shape[0] > 0:
                y[0, c] = yaws[k, 0, c]
        h = along[k + 1] - along[k]
        caps[k, 0], caps[k, 1] = _speed_caps(
            t, b, y, misses, k, h, square, bound, axis_speed, lateral, yaw_rate
        )
    return caps
