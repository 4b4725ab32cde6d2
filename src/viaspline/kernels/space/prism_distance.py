"""How far an upright cylinder is from a prism: a rounded ring times an interval of heights.

Tested through ``kernels/space/test_space_distance``.
"""

from __future__ import annotations

import math

from viaspline.kernels.jit import inlined
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.product_distance import chord_product, combined
from viaspline.kernels.world.ring_distance import crosses_eastwards, is_disc, ring_signed


@inlined
def prism_signed(space: PackedSpace, r: int, x: float, y: float, z: float, limit: float) -> float:
    """Signed distance between ring r, over its heights, and the core at a place [m]."""
    b = max(space.ring_heights[r, 0] - z, z - space.ring_heights[r, 1]) - space.core[1]
    if b >= limit:
        return limit
    a = ring_signed(space, r, x, y, math.inf) - space.core[0]
    return min(combined(a, b), limit)


@inlined
def _is_inside(space: PackedSpace, r: int, x: float, y: float) -> bool:
    """Whether (x, y) lies in the core of ring r."""
    inside = False
    for b in range(space.ring_blocks[r], space.ring_blocks[r + 1]):
        box = space.block_boxes[b]
        if box[1] <= y <= box[3] and x <= box[2]:
            for e in range(space.block_edges[b], space.block_edges[b + 1]):
                if crosses_eastwards(space.edges, e, x, y):
                    inside = not inside
    return inside


@inlined
def is_apart(a: float, d: float, low: float, high: float) -> bool:
    """Whether all of a, a + d stays outside of an interval."""
    return (a > high and a + d > high) or (a < low and a + d < low)


@inlined
def _edge_chord(
    space: PackedSpace, e: int, ax: float, ay: float, az: float, dx: float, dy: float, dz: float,
    low: float, high: float, radius: float, limit: float,
) -> float:  # fmt: skip
    """Distance between a chord and edge e, grown by a radius, over an interval of heights [m]."""
    edge = space.edges[e]
    x0, y0 = edge[0], edge[1]
    ex, ey = edge[2] - x0, edge[3] - y0
    length = math.sqrt(ex * ex + ey * ey)
    if length == 0.0:
        return chord_product(ax, ay, az, dx, dy, dz, x0, y0, x0, y0, low, high, radius, limit)
    c, s = ex / length, ey / length
    x, y = ax - x0, ay - y0
    along, across = c * x + s * y, c * y - s * x
    u, v = c * dx + s * dy, c * dy - s * dx
    reach = limit + radius
    if is_apart(across, v, -reach, reach) or is_apart(along, u, -reach, length + reach):
        return limit
    return chord_product(
        along, across, az, u, v, dz, 0.0, 0.0, length, 0.0, low, high, radius, limit
    )


@inlined
def prism_chord(
    space: PackedSpace, r: int, ax: float, ay: float, az: float, dx: float, dy: float, dz: float,
    limit: float,
) -> float:  # fmt: skip
    """Distance between ring r, over its heights, and the core along the chord from a by d [m].

    Along a chord the gap in height is convex. So it is least, among the places over the ring,
    where it is least of all, or where the chord comes to an edge.
    """
    low = space.ring_heights[r, 0] - space.core[1]
    high = space.ring_heights[r, 1] + space.core[1]
    radius = space.heads[r, 2] + space.core[0]
    if is_disc(space, r):
        x, y = space.heads[r, 0], space.heads[r, 1]
        return chord_product(ax, ay, az, dx, dy, dz, x, y, x, y, low, high, radius, limit)
    end = az + dz
    floor = max(max(low - max(az, end), min(az, end) - high), 0.0)
    if floor >= limit:
        return limit
    t = 0.0  # where the gap in height is least, or first is
    if floor > 0.0:
        t = 1.0 if (az > high) == (dz < 0.0) else 0.0
    elif az > high:
        t = (high - az) / dz
    elif az < low:
        t = (low - az) / dz
    if _is_inside(space, r, ax + t * dx, ay + t * dy):
        return floor
    best = limit
    x0, x1 = min(ax, ax + dx), max(ax, ax + dx)
    y0, y1 = min(ay, ay + dy), max(ay, ay + dy)
    for b in range(space.ring_blocks[r], space.ring_blocks[r + 1]):
        box = space.block_boxes[b]
        reach = best + radius
        if box[0] - x1 >= reach or x0 - box[2] >= reach:
            continue
        if box[1] - y1 >= reach or y0 - box[3] >= reach:
            continue
        for e in range(space.block_edges[b], space.block_edges[b + 1]):
            best = _edge_chord(space, e, ax, ay, az, dx, dy, dz, low, high, radius, best)
    return best
