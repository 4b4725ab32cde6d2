"""What a taut string can lie against on a rounded ring: discs about its convex vertices.

A vertex of a polygon is a disc of radius 0, which has a direction that leads into the open.

Tested through ``kernels/world/test_shape``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import uncounted
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.ring_distance import is_disc, radius_of

# columns of a feature: centre and radius [m] (0: a corner), and the unit vector from a corner
# into the open (0, 0 for a disc)
FEATURE_X, FEATURE_Y, FEATURE_RADIUS, OUT_X, OUT_Y = range(5)


@uncounted
def _write_disc(out: Floats, count: int, x: float, y: float, radius: float) -> None:
    out[count, FEATURE_X] = x
    out[count, FEATURE_Y] = y
    out[count, FEATURE_RADIUS] = radius
    out[count, OUT_X] = 0.0
    out[count, OUT_Y] = 0.0


@uncounted
def edge_features(
    edges: Floats, first: int, last: int, radius: float, x: float, y: float, reach: float,
    out: Floats, count: int,
) -> int:  # fmt: skip
    """Append the convex corners of closed rings that follow each other, each with a radius.

    Args:
        edges: x0, y0, x1, y1 [m], free space on the right, (e, 4).
        first: The first of the rings' edges.
        last: The one after their last.
        radius: Of the disc about each corner [m].
        x: Where to look [m].
        y: Where to look [m].
        reach: How far [m].
        out: Room for features, (size, 5).
        count: Rows that are taken.

    Returns:
        The new count; rows beyond the room are counted and not written.
    """
    ring = first
    for e in range(first, last):
        edge = edges[e]
        if edge[2] == edges[ring, 0] and edge[3] == edges[ring, 1]:
            following = ring
            ring = e + 1
        else:
            following = e + 1
        dx = edge[2] - x
        dy = edge[3] - y
        if dx * dx + dy * dy > (reach + radius) * (reach + radius):
            continue
        after = edges[following]
        ux = edge[2] - edge[0]
        uy = edge[3] - edge[1]
        vx = after[2] - after[0]
        vy = after[3] - after[1]
        turn = ux * vy - uy * vx  # free space lies to the right of every edge
        if turn < 0.0 or (turn == 0.0 and ux * vx + uy * vy >= 0.0):  # 0 and back: a capsule's end
            continue
        if radius > 0.0:
            if count < out.shape[0]:
                _write_disc(out, count, edge[2], edge[3], radius)
        elif count < out.shape[0]:
            long_u = math.hypot(ux, uy)
            long_v = math.hypot(vx, vy)
            nx = uy / long_u + vy / long_v
            ny = -ux / long_u - vx / long_v
            size = math.hypot(nx, ny)
            if size < 1e-9:  # a spike: straight on
                nx = ux
                ny = uy
                size = long_u
            out[count, FEATURE_X] = edge[2]
            out[count, FEATURE_Y] = edge[3]
            out[count, FEATURE_RADIUS] = 0.0
            out[count, OUT_X] = nx / size
            out[count, OUT_Y] = ny / size
        count += 1
    return count


@uncounted
def ring_features(
    world: PackedWorld, r: int, x: float, y: float, reach: float, out: Floats, count: int
) -> int:
    """Append the features of ring r within ``reach`` of (x, y) [m]; see ``edge_features``."""
    radius = radius_of(world, r)
    if not is_disc(world, r):
        first = world.ring_edges[r]
        last = world.ring_edges[r + 1]
        return edge_features(world.edges, first, last, radius, x, y, reach, out, count)
    center = world.heads[r]
    if math.hypot(center[0] - x, center[1] - y) - radius <= reach:
        if count < out.shape[0]:
            _write_disc(out, count, center[0], center[1], radius)
        count += 1
    return count
