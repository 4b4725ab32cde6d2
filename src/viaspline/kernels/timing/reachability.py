"""The fastest v² under limits that couple speed and acceleration: reachability on a grid.

Source: H. Pham and Q.-C. Pham, "A new approach to time-optimal path parameterization based on
reachability analysis", IEEE Transactions on Robotics 34 (2018).
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, kernel


@inlined
def _lowest(planes: Floats, n: int, m: int, w0: float) -> tuple[float, int]:
    """The least w1 >= 0 that goes with w0, and the half-plane that says so, or m."""
    low, lower = 0.0, m
    for r in range(m):
        slope = planes[n, r, 1]
        if slope <= 0.0:
            room = planes[n, r, 2] - planes[n, r, 0] * w0
            if room < slope * low:
                low, lower = (room / slope if slope < 0.0 else np.inf), r
    return low, lower


@inlined
def _highest(planes: Floats, n: int, m: int, w0: float, top: float) -> tuple[float, int]:
    """The largest w1 <= top that goes with w0, and the half-plane that says so, or m."""
    high, upper = top, m
    for r in range(m):
        slope = planes[n, r, 1]
        if slope > 0.0:
            room = planes[n, r, 2] - planes[n, r, 0] * w0
            if room < slope * high:
                high, upper = room / slope, r
    return high, upper


@inlined
def _meeting(planes: Floats, n: int, m: int, upper: int, lower: int, top: float) -> float:
    """The largest w0 that two half-planes allow, one that bounds w1 above and one below."""
    p, q, g, a, b, c = 0.0, 1.0, top, 0.0, -1.0, 0.0
    if upper < m:
        p, q, g = planes[n, upper, 0], planes[n, upper, 1], planes[n, upper, 2]
    if lower < m:
        a, b, c = planes[n, lower, 0], planes[n, lower, 1], planes[n, lower, 2]
    across = a * q - p * b
    if q <= 0.0 or b > 0.0 or across <= 0.0:
        return np.inf
    return max((c * q - g * b) / across, 0.0)


@inlined
def _largest_first(
    planes: Floats, n: int, m: int, top0: float, top1: float, upper: int, lower: int
) -> tuple[float, int, int]:
    """The largest w0 in [0, top0] for which some w1 in [0, top1] keeps every half-plane.

    The room for w1 is concave in w0. From above Newton's method comes down to where it ends: every
    two half-planes allow at least as much as all of them.

    Args:
        planes: Those of all stretches.
        n: Which stretch.
        m: Number of half-planes.
        top0: Largest w0.
        top1: Largest w1.
        upper: A guess of the half-plane that bounds w1 above at the optimum.
        lower: Of the one that bounds it below.

    Returns:
        w0, and the two half-planes at the optimum.
    """
    w0 = min(top0, _meeting(planes, n, m, upper, lower, top1))
    for _ in range(m + 2):
        high, above = _highest(planes, n, m, w0, top1)
        low, below = _lowest(planes, n, m, w0)
        if low <= high:
            break
        upper, lower = above, below
        less = _meeting(planes, n, m, upper, lower, top1)
        if less >= w0:
            break
        w0 = less
    return w0, upper, lower


@kernel
def reachable_profile(
    line: Floats, planes: Floats, caps: Floats, brake: float, first: float
) -> tuple[Floats, float, float]:
    """The fastest v² at the nodes: controllable sets from the end, then greedily from the start.

    Every controllable set is [0, back]: a robot that stands may go on standing.

    Args:
        line: Nodes [m], increasing, shape (n + 1,).
        planes: Of ``stretch_planes``, shape (n, k, 3).
        caps: Largest v² at the nodes, 0 where the robot rests, shape (n + 1,).
        brake: With this the robot brakes while it is faster than it may be [m/s²].
        first: v² at the start.

    Returns:
        v² at the nodes; the distance up to which it is above what the limits allow (the start if
        it never is); the first place where it can't come to rest as it should (nan if none).
    """
    n, m = planes.shape[0], planes.shape[1]
    back, squares = np.empty(n + 1), np.empty(n + 1)
    back[n], upper, lower = caps[n], m, m
    for i in range(n - 1, -1, -1):
        back[i] = 0.0
        if caps[i] > 0.0:
            most, upper, lower = _largest_first(planes, i, m, caps[i], back[i + 1], upper, lower)
            back[i] = most * (1.0 - 1e-12)
    slip = 1e-12 + 1e-14 * brake * abs(line[n])
    is_over = first > back[0] * (1.0 + 1e-9) + slip + 4e-6 * brake  # 2 µm of braking
    squares[0] = first if is_over else min(first, back[0])
    over, missed = line[0], np.nan
    if is_over and caps[0] == 0.0:
        missed = line[0]
    for i in range(n):
        if not is_over:
            squares[i + 1] = max(_highest(planes, i, m, squares[i], back[i + 1])[0], 0.0)
            continue
        over = line[i + 1]
        squares[i + 1] = squares[i] - 2.0 * brake * (line[i + 1] - line[i])
        is_over = squares[i + 1] > back[i + 1] * (1.0 + 1e-9) + slip
        if not is_over:
            squares[i + 1] = back[i + 1]
        elif np.isnan(missed) and (caps[i + 1] == 0.0 or i == n - 1):
            missed = line[i + 1]
    return squares, over, missed
