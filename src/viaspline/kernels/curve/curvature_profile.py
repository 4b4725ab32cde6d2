"""How a curve bends from end to end: between neighbouring nodes its curvature only rises or falls.

Nodes are both ends of every span, every place where the curvature is stationary, where it is zero,
and where the curve is slowest, which is where a turn that is nearly a cusp is sharpest.

Tested through ``machine/test_drivability``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cubic import speed_at, speed_bound
from viaspline.kernels.curve.curvature_extrema import (
    MAX_EXTREMA,
    ExtremaRoom,
    curvature_extrema,
    extrema_room,
)
from viaspline.kernels.curve.frenet import curvature_at, direction_at
from viaspline.kernels.jit import inner, kernel

MAX_NODES = 2 + MAX_EXTREMA
"""Of a span: its ends, and where its curvature may be the largest."""

CROSSING_HALVINGS = 40
AT, VALUE, OF = 0, 1, 2
FIRST, LAST, PEAK, TURN = 0, 1, 2, 3

SMOOTH_RAD = 0.02
"""A tangent that jumps by less is steered away."""


@inner
def _sort(values: Floats, count: int) -> None:
    for i in range(1, count):
        value = values[i]
        j = i - 1
        while j >= 0 and values[j] > value:
            values[j + 1] = values[j]
            j -= 1
        values[j + 1] = value


@inner
def _nodes_of(spans: Floats, k: int, room: ExtremaRoom, out: Floats) -> int:
    """Parameters of the nodes of a span, in order; how many there are."""
    out[0] = 0.0
    out[1] = 1.0
    count = 2 + curvature_extrema(spans, k, room, out[2:MAX_NODES])
    _sort(out, count)
    return count


@kernel
def curvature_profile(spans: Floats) -> Floats:
    """The nodes of a curve.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).

    Returns:
        Rows u = span + w, the curvature there [1/m] and the span, in order, shape (n, 3): of a
        joint one for the span before it and one for the span after it. The curvature has its sign
        in the plane.
    """
    count = spans.shape[0]
    rows = np.empty((MAX_NODES * count, 3))
    room = extrema_room()
    w = np.empty(MAX_NODES)
    size = 0
    for k in range(count):
        for i in range(_nodes_of(spans, k, room, w)):
            rows[size, AT] = k + w[i]
            rows[size, VALUE] = curvature_at(spans, k, w[i])
            rows[size, OF] = k
            size += 1
    return rows[:size]


@inner
def _crossing(spans: Floats, k: int, low: float, high: float, limit: float) -> float:
    """Where |curvature| is as large as the limit between a place below it and one above it."""
    for _ in range(CROSSING_HALVINGS):
        middle = 0.5 * (low + high)
        if abs(curvature_at(spans, k, middle)) < limit:
            low = middle
        else:
            high = middle
    return high


@inner
def _tangent(spans: Floats, k: int, w: float, before: bool, out: Floats) -> None:
    """Unit tangent at w, at a cusp that just before or just after it."""
    direction_at(spans, k, w, out)
    if before and w < 1.0 and speed_at(spans, k, w) <= 1e-13 * speed_bound(spans, k):
        for axis in range(spans.shape[2]):
            out[axis] = -out[axis]


@inner
def _turn(a: Floats, b: Floats, sign: float) -> float:
    """The angle from one tangent to another [rad]; in the plane by the side that it bends to."""
    along = 0.0
    across = 0.0
    for i in range(a.shape[0]):
        along += a[i] * b[i]
        for j in range(i):
            across += (a[j] * b[i] - a[i] * b[j]) ** 2
    if a.shape[0] > 2:
        return math.atan2(math.sqrt(across), along)
    angle = math.atan2(sign * (a[0] * b[1] - a[1] * b[0]), along)
    return angle if angle > -1e-7 else angle + 2.0 * math.pi


@inner
def _goes_on(spans: Floats, k: int, before: float, after: float, limit: float) -> bool:
    """Whether a stretch goes on from the span before k into span k: to the same side, smoothly."""
    least = min(abs(before), abs(after))
    if not limit < least < np.inf or before * after < 0.0:
        return False
    a, b = np.empty(spans.shape[2]), np.empty(spans.shape[2])
    _tangent(spans, k - 1, 1.0, True, a)
    _tangent(spans, k, 0.0, False, b)
    return bool(abs(_turn(a, b, 1.0)) < SMOOTH_RAD)


@kernel
def sharp_stretches(spans: Floats, rows: Floats, limit: float) -> Floats:
    """Where a curve bends to one side by more than a limit, and how far it turns there.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).
        rows: Of ``curvature_profile``.
        limit: [1/m], above 0.

    Returns:
        Rows (n, 4): u of the first and of the last place, the largest curvature [1/m] with its
        sign, and the turn [rad]. Corners and cusps end a stretch.
    """
    found = np.zeros((rows.shape[0], 4))
    size = 0
    a, b = np.empty(spans.shape[2]), np.empty(spans.shape[2])
    is_open = False
    for i in range(rows.shape[0] - 1):
        k = int(rows[i, AT])
        first, last = rows[i, AT] - k, rows[i + 1, AT] - k
        before, after = rows[i, VALUE], rows[i + 1, VALUE]
        if last <= first:  # a joint, or a node twice
            is_open = is_open and (first > 0.0 or _goes_on(spans, k, before, after, limit))
            continue
        if max(abs(before), abs(after)) <= limit:
            is_open = False
            continue
        if abs(before) <= limit:
            first = _crossing(spans, k, first, last, limit)
        elif abs(after) <= limit:
            last = _crossing(spans, k, last, first, limit)
        peak = before if abs(before) > abs(after) else after
        _tangent(spans, k, first, False, a)
        _tangent(spans, k, last, True, b)
        if not is_open:
            found[size, FIRST] = k + first
            size += 1
        row = size - 1
        found[row, LAST] = k + last
        found[row, TURN] += _turn(a, b, math.copysign(1.0, peak))
        if abs(peak) > abs(found[row, PEAK]):
            found[row, PEAK] = peak
        is_open = limit < abs(after) < np.inf
    return found[:size]
