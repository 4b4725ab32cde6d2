"""Where a vertex of a way is best put between its neighbours, beyond the planes that it touches.

Each solid next to the way is on the other side of a plane. Under these planes alone the best place
is known: on the straight line between the neighbours, or else on the line in which the two planes
meet that cut it off. That line is the edge which the way turns at.

Tested through ``kernels/space/routing/test_pull_taut``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, inner
from viaspline.kernels.space.routing.route_protocol import NORMAL_X, NORMAL_Y, NORMAL_Z, OFFSET
from viaspline.kernels.space.routing.travel_norm import travel

_SLACK = 1e-9
_PARALLEL = 1e-9
_NARROWINGS = 40
_GOLDEN = 0.6180339887498949
_TIE = 0.02  # of the length, beside a time: of ways that take equally long the shortest


@inlined
def pulled_cost(norm: Floats, dx: float, dy: float, dz: float) -> float:
    """Cost of a straight way, with a share of its length where it is a time."""
    if norm[0] <= 0.0:
        return travel(norm, dx, dy, dz)
    length = math.sqrt(dx * dx + dy * dy + dz * dz)
    return travel(norm, dx, dy, dz) + _TIE * length / norm[0]


@inlined
def cost_through(
    norm: Floats, rows: Floats, before: int, after: int, x: float, y: float, z: float
) -> float:
    """Cost of the way from one row to another through a place."""
    first = pulled_cost(norm, x - rows[before, 0], y - rows[before, 1], z - rows[before, 2])
    last = pulled_cost(norm, rows[after, 0] - x, rows[after, 1] - y, rows[after, 2] - z)
    return first + last


@inlined
def beyond_plane(planes: Floats, k: int, x: float, y: float, z: float) -> float:
    """How far a place lies on the free side of a plane [m]."""
    along = planes[k, NORMAL_X] * x + planes[k, NORMAL_Y] * y + planes[k, NORMAL_Z] * z
    return along - planes[k, OFFSET]


@inner
def _best_on_line(
    norm: Floats, rows: Floats, before: int, after: int, line: Floats, low: float, high: float
) -> float:
    """Where on a line, row 0 and direction row 1, a way between two rows is cheapest."""
    if norm[0] <= 0.0:  # as if unfolded about the line
        sa = 0.0
        sc = 0.0
        ha = 0.0
        hc = 0.0
        for axis in range(3):
            sa += (rows[before, axis] - line[0, axis]) * line[1, axis]
            sc += (rows[after, axis] - line[0, axis]) * line[1, axis]
        for axis in range(3):
            ha += (rows[before, axis] - line[0, axis] - sa * line[1, axis]) ** 2
            hc += (rows[after, axis] - line[0, axis] - sc * line[1, axis]) ** 2
        ha = math.sqrt(ha)
        hc = math.sqrt(hc)
        best = sa + (sc - sa) * (ha / (ha + hc) if ha + hc > 0.0 else 0.5)
        return min(max(best, low), high)
    for _ in range(_NARROWINGS):
        s = high - _GOLDEN * (high - low)
        t = low + _GOLDEN * (high - low)
        at_s = cost_through(
            norm,
            rows,
            before,
            after,
            line[0, 0] + s * line[1, 0],
            line[0, 1] + s * line[1, 1],
            line[0, 2] + s * line[1, 2],
        )
        at_t = cost_through(
            norm,
            rows,
            before,
            after,
            line[0, 0] + t * line[1, 0],
            line[0, 1] + t * line[1, 1],
            line[0, 2] + t * line[1, 2],
        )
        if at_s <= at_t:
            high = t
        else:
            low = s
    return 0.5 * (low + high)


@inner
def _meeting_line(planes: Floats, k: int, m: int, rows: Floats, here: int, line: Floats) -> bool:
    """Write the line in which two planes meet, from next to a row on; False for parallel planes."""
    ax = planes[k, NORMAL_X]
    ay = planes[k, NORMAL_Y]
    az = planes[k, NORMAL_Z]
    bx = planes[m, NORMAL_X]
    by = planes[m, NORMAL_Y]
    bz = planes[m, NORMAL_Z]
    cx = ay * bz - az * by
    cy = az * bx - ax * bz
    cz = ax * by - ay * bx
    square = cx * cx + cy * cy + cz * cz
    if square < _PARALLEL:
        return False
    size = 1.0 / math.sqrt(square)
    line[1, 0] = cx * size
    line[1, 1] = cy * size
    line[1, 2] = cz * size
    both = ax * bx + ay * by + az * bz
    x = rows[here, 0]
    y = rows[here, 1]
    z = rows[here, 2]
    short_k = -beyond_plane(planes, k, x, y, z)
    short_m = -beyond_plane(planes, m, x, y, z)
    u = (short_k - both * short_m) / square
    v = (short_m - both * short_k) / square
    line[0, 0] = x + u * ax + v * bx
    line[0, 1] = y + u * ay + v * by
    line[0, 2] = z + u * az + v * bz
    return True


@inner
def _on_meeting_line(
    norm: Floats, rows: Floats, here: int, planes: Floats, count: int, k: int, m: int, best: Floats
) -> bool:
    """Write the best place on the line in which two planes meet, as far as the others allow."""
    line = np.empty((2, 3))
    if not _meeting_line(planes, k, m, rows, here, line):
        return False
    high = 0.0
    for axis in range(3):
        high += abs(rows[here - 1, axis] - line[0, axis]) + abs(
            rows[here + 1, axis] - line[0, axis]
        )
    low = -high
    for other in range(count):
        if other in (k, m):
            continue
        at = beyond_plane(planes, other, line[0, 0], line[0, 1], line[0, 2]) + _SLACK
        slope = planes[other, NORMAL_X] * line[1, 0]
        slope += planes[other, NORMAL_Y] * line[1, 1]
        slope += planes[other, NORMAL_Z] * line[1, 2]
        if abs(slope) <= _PARALLEL:
            if at < 0.0:
                return False
        elif slope > 0.0:
            low = max(low, -at / slope)
        else:
            high = min(high, -at / slope)
    if low > high:
        return False
    s = _best_on_line(norm, rows, here - 1, here + 1, line, low, high)
    for axis in range(3):
        best[axis] = line[0, axis] + s * line[1, axis]
    return True


@inner
def best_place(
    norm: Floats, rows: Floats, here: int, planes: Floats, count: int, best: Floats
) -> bool:
    """Write where a row is best put between the rows before and after it.

    Args:
        norm: See ``travel_norm``.
        rows: The way [m], (n, 3).
        here: Which row.
        planes: That it has to be beyond, (m, 5).
        count: How many of them there are.
        best: The place [m], (3,).

    Returns:
        Whether there is a place.
    """
    low = 0.0
    high = 1.0
    at_low = -1
    at_high = -1
    for k in range(count):
        first = beyond_plane(planes, k, rows[here - 1, 0], rows[here - 1, 1], rows[here - 1, 2])
        last = beyond_plane(planes, k, rows[here + 1, 0], rows[here + 1, 1], rows[here + 1, 2])
        first += _SLACK
        last += _SLACK
        if first >= 0.0 and last >= 0.0:
            continue
        if first < 0.0 and last < 0.0:
            return False
        t = first / (first - last)
        if first < 0.0 and t > low:
            low = t
            at_low = k
        elif last < 0.0 and t < high:
            high = t
            at_high = k
    if low > high:
        return _on_meeting_line(norm, rows, here, planes, count, at_low, at_high, best)
    along = 0.0
    square = 0.0
    for axis in range(3):
        d = rows[here + 1, axis] - rows[here - 1, axis]
        along += (rows[here, axis] - rows[here - 1, axis]) * d
        square += d * d
    t = min(max(along / square if square > 0.0 else 0.0, low), high)
    for axis in range(3):
        best[axis] = rows[here - 1, axis] + t * (rows[here + 1, axis] - rows[here - 1, axis])
    return True
