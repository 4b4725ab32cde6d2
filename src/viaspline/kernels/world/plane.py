"""Distances in the plane between points, segments and boxes.

Tested through ``kernels/world/test_distance``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, uncounted


@uncounted
def squared_point_segment(x: float, y: float, ax: float, ay: float, bx: float, by: float) -> float:
    """Squared distance from (x, y) to the segment a-b [m²]."""
    dx = bx - ax
    dy = by - ay
    squared = dx * dx + dy * dy
    w = 0.0
    if squared > 0.0:
        w = ((x - ax) * dx + (y - ay) * dy) / squared
        w = min(1.0, max(0.0, w))
    across = x - ax - w * dx
    along = y - ay - w * dy
    return across * across + along * along


@uncounted
def point_segment(x: float, y: float, ax: float, ay: float, bx: float, by: float) -> float:
    """Distance from (x, y) to the segment a-b [m]."""
    return math.sqrt(squared_point_segment(x, y, ax, ay, bx, by))


@uncounted
def _orientation(ax: float, ay: float, bx: float, by: float, cx: float, cy: float) -> float:
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


@uncounted
def segment_segment(
    ax: float, ay: float, bx: float, by: float, cx: float, cy: float, dx: float, dy: float
) -> float:
    """Distance between the segments a-b and c-d [m]; 0 where they cross."""
    if _orientation(ax, ay, bx, by, cx, cy) * _orientation(ax, ay, bx, by, dx, dy) < 0.0 and (
        _orientation(cx, cy, dx, dy, ax, ay) * _orientation(cx, cy, dx, dy, bx, by) < 0.0
    ):
        return 0.0
    return min(
        min(point_segment(ax, ay, cx, cy, dx, dy), point_segment(bx, by, cx, cy, dx, dy)),
        min(point_segment(cx, cy, ax, ay, bx, by), point_segment(dx, dy, ax, ay, bx, by)),
    )


@inlined
def box_signed(boxes: Floats, b: int, x: float, y: float) -> float:
    """Signed distance from (x, y) to box b: a lower bound for all that lies in the box."""
    left = max(boxes[b, 0] - x, x - boxes[b, 2])
    down = max(boxes[b, 1] - y, y - boxes[b, 3])
    if left <= 0.0 or down <= 0.0:
        return max(left, down)
    return math.sqrt(left * left + down * down)


@inlined
def box_gap(boxes: Floats, b: int, x0: float, y0: float, x1: float, y1: float) -> float:
    """Distance between box b and the box (x0, y0)-(x1, y1); 0 where they overlap."""
    gap_x = max(max(boxes[b, 0] - x1, x0 - boxes[b, 2]), 0.0)
    gap_y = max(max(boxes[b, 1] - y1, y0 - boxes[b, 3]), 0.0)
    return math.sqrt(gap_x * gap_x + gap_y * gap_y)


@uncounted
def is_within(body: Floats, x: float, y: float) -> bool:
    """Whether (x, y) in the robot's frame lies inside the outline (k, 2)."""
    inside = False
    before = body.shape[0] - 1
    for k in range(body.shape[0]):
        y0 = body[before, 1]
        y1 = body[k, 1]
        if (y0 > y) != (y1 > y):
            x0 = body[before, 0]
            if x < x0 + (y - y0) / (y1 - y0) * (body[k, 0] - x0):
                inside = not inside
        before = k
    return inside


@uncounted
def covers(body: Floats, x: float, y: float, c: float, s: float, px: float, py: float) -> bool:
    """Whether the point (px, py) of the world lies inside the body in a pose."""
    dx = px - x
    dy = py - y
    return is_within(body, c * dx + s * dy, c * dy - s * dx)
