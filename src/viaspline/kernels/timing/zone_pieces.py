"""The pieces of a curve that may lie in areas: halved until each is inside, outside or tiny.

A piece of a span lies in the hull of its control points. One whose hull meets no edge of an area
is inside or outside as a whole, which one point of it tells.

Tested through ``trajectory/test_slow_zones``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inlined, inner, kernel

OUTSIDE, INSIDE, ACROSS, ALONG = range(4)
"""How a hull lies to an area: apart from it, in it, across its edge, or wholly upon one edge."""

SMALL = 0.3
"""A piece with sides shorter than this part of what counts as upon an edge isn't halved."""

_SEGMENTS = np.array(((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)))
"""Between the control points: the edges of their hull, and its diagonals."""

_TRIANGLES = np.array(((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)))


@inlined
def _turn(ax: float, ay: float, bx: float, by: float, cx: float, cy: float) -> float:
    """Above 0 where a, b and c turn left, 0 on a line [m²]."""
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


@inlined
def _is_upon(hull: Floats, ax: float, ay: float, bx: float, by: float, edge: float) -> bool:
    """Whether all of a hull is as near to an edge as that."""
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    for k in range(4):
        px, py = hull[k, 0] - ax, hull[k, 1] - ay
        share = 0.0 if square == 0.0 else min(max((px * dx + py * dy) / square, 0.0), 1.0)
        if (px - share * dx) ** 2 + (py - share * dy) ** 2 > edge * edge:
            return False
    return True


@inner
def _meets(hull: Floats, ax: float, ay: float, bx: float, by: float) -> bool:
    """Whether an edge meets the hull's own edges, or touches them."""
    for k in range(6):
        i, j = _SEGMENTS[k, 0], _SEGMENTS[k, 1]
        cx, cy, dx, dy = hull[i, 0], hull[i, 1], hull[j, 0], hull[j, 1]
        if min(cx, dx) > max(ax, bx) or max(cx, dx) < min(ax, bx):
            continue
        if min(cy, dy) > max(ay, by) or max(cy, dy) < min(ay, by):
            continue
        one, two = _turn(ax, ay, bx, by, cx, cy), _turn(ax, ay, bx, by, dx, dy)
        if (one > 0.0 and two > 0.0) or (one < 0.0 and two < 0.0):
            continue
        one, two = _turn(cx, cy, dx, dy, ax, ay), _turn(cx, cy, dx, dy, bx, by)
        if not ((one > 0.0 and two > 0.0) or (one < 0.0 and two < 0.0)):
            return True
    return False


@inner
def _holds(hull: Floats, x: float, y: float) -> bool:
    """Whether a hull holds a point: one of its triangles does."""
    for k in range(4):
        a, b, c = _TRIANGLES[k, 0], _TRIANGLES[k, 1], _TRIANGLES[k, 2]
        one = _turn(hull[a, 0], hull[a, 1], hull[b, 0], hull[b, 1], x, y)
        two = _turn(hull[b, 0], hull[b, 1], hull[c, 0], hull[c, 1], x, y)
        three = _turn(hull[c, 0], hull[c, 1], hull[a, 0], hull[a, 1], x, y)
        if (one > 0.0 and two > 0.0 and three > 0.0) or (one < 0.0 and two < 0.0 and three < 0.0):
            return True
    return False


@inner
def _box(points: Floats, first: int, last: int) -> tuple[float, float, float, float]:
    """The box about points from first to before last: left, low, right, high [m]."""
    left, low = points[first, 0], points[first, 1]
    right, high = left, low
    for k in range(first + 1, last):
        left, right = min(left, points[k, 0]), max(right, points[k, 0])
        low, high = min(low, points[k, 1]), max(high, points[k, 1])
    return left, low, right, high


@inner
def _how_it_lies(hull: Floats, corners: Floats, first: int, last: int, edge: float) -> int:
    """How a hull lies to the area with corners from first to before last."""
    left, low, right, high = _box(hull, 0, 4)
    inside, across = False, False
    ax, ay = corners[last - 1, 0], corners[last - 1, 1]
    for k in range(first, last):
        bx, by = corners[k, 0], corners[k, 1]
        near = min(ax, bx) <= right and max(ax, bx) >= left
        near = near and min(ay, by) <= high and max(ay, by) >= low
        if near and _meets(hull, ax, ay, bx, by):
            if _is_upon(hull, ax, ay, bx, by, edge):
                return ALONG
            across = True
        if (ay > hull[0, 1]) != (by > hull[0, 1]):
            turn = _turn(ax, ay, bx, by, hull[0, 0], hull[0, 1])
            if (turn > 0.0) == (by > ay):
                inside = not inside
        ax, ay = bx, by
    if across:
        return ACROSS
    if inside:
        return INSIDE
    return ACROSS if _holds(hull, corners[first, 0], corners[first, 1]) else OUTSIDE


@inlined
def _cut(spans: Floats, i: int, a: float, b: float, hull: Floats) -> None:
    """The control points, in the plane, of the piece of a span from a to b."""
    for j in range(2):
        p0, p1, p2, p3 = spans[i, 0, j], spans[i, 1, j], spans[i, 2, j], spans[i, 3, j]
        for k in range(4):
            u = a if k < 3 else b  # the polar form at (a, a, a), (a, a, b), (a, b, b), (b, b, b)
            v = a if k < 2 else b
            w = a if k < 1 else b
            q0, q1, q2 = p0 + u * (p1 - p0), p1 + u * (p2 - p1), p2 + u * (p3 - p2)
            r0, r1 = q0 + v * (q1 - q0), q1 + v * (q2 - q1)
            hull[k, j] = r0 + w * (r1 - r0)


@kernel
def zone_pieces(spans: Floats, corners: Floats, ends: Ints, edge: float, halvings: int) -> Floats:
    """The parts of a curve that may lie in areas, in order of area and place.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d), d >= 2.
        corners: Of all areas, one behind the other [m], shape (c, 2).
        ends: Where each area's corners end, shape (z,).
        edge: What is no farther from an edge than this may count as inside [m].
        halvings: Of a span at most; what is left then is taken as inside.

    Returns:
        Rows (n, 3): first and last parameter (span k runs from k to k + 1), and which area.
    """
    rows, count = np.empty((16, 3)), 0
    hull, stack = np.empty((4, 2)), np.empty((2 * halvings + 2, 2))
    for z in range(ends.size):
        first = 0 if z == 0 else ends[z - 1]
        left, low, right, high = _box(corners, first, ends[z])
        since = count
        for i in range(spans.shape[0]):
            _cut(spans, i, 0.0, 1.0, hull)
            x0, y0, x1, y1 = _box(hull, 0, 4)
            if x0 > right or x1 < left or y0 > high or y1 < low:
                continue
            depth = 1
            stack[0, 0], stack[0, 1] = 0.0, 1.0
            while depth > 0:
                depth -= 1
                a, b = stack[depth, 0], stack[depth, 1]
                _cut(spans, i, a, b, hull)
                lies = _how_it_lies(hull, corners, first, ends[z], edge)
                if lies == OUTSIDE:
                    continue
                if lies == ACROSS and b - a > 0.5**halvings:
                    longest = 0.0
                    for k in range(3):
                        for j in range(2):
                            longest = max(longest, abs(hull[k + 1, j] - hull[k, j]))
                    if longest >= SMALL * edge:
                        middle = 0.5 * (a + b)
                        stack[depth, 0], stack[depth, 1] = middle, b
                        stack[depth + 1, 0], stack[depth + 1, 1] = a, middle
                        depth += 2
                        continue
                if count > since and rows[count - 1, 1] == i + a:
                    rows[count - 1, 1] = i + b
                    continue
                if count == len(rows):
                    more = np.empty((2 * count, 3))
                    for k in range(count):
                        for j in range(3):
                            more[k, j] = rows[k, j]
                    rows = more
                rows[count, 0], rows[count, 1], rows[count, 2] = i + a, i + b, z
                count += 1
    return rows[:count]
