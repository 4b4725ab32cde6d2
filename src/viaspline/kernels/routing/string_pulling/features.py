"""What a taut string can lie against: circles, and the convex corners of polygons and grids."""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner
from viaspline.kernels.world.distance import box_signed
from viaspline.kernels.world.grid_rows import grid_corners_near
from viaspline.kernels.world.packed import PackedWorld

# columns of a feature: centre and radius [m] (0: a corner), and the unit vector from a corner
# into the open (0, 0 for a circle)
FEATURE_X, FEATURE_Y, FEATURE_RADIUS, OUT_X, OUT_Y = range(5)


@inner
def _ring_features(
    edges: Floats, first: int, last: int, x: float, y: float, reach: float, out: Floats, count: int
) -> int:
    """Append the convex corners of closed rings that follow each other."""
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
        if dx * dx + dy * dy > reach * reach:
            continue
        after = edges[following]
        ux = edge[2] - edge[0]
        uy = edge[3] - edge[1]
        vx = after[2] - after[0]
        vy = after[3] - after[1]
        if ux * vy - uy * vx <= 0.0:  # free space lies to the right of every edge
            continue
        if count < out.shape[0]:
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


@inner
def _grid_features(
    world: PackedWorld, g: int, x: float, y: float, reach: float, out: Floats, count: int
) -> int:
    """Append the convex corners of a grid."""
    before = count
    count = grid_corners_near(world, g, x, y, reach, out, count)
    for k in range(before, min(count, out.shape[0])):
        out[k, OUT_Y] = out[k, 3]
        out[k, OUT_X] = out[k, 2]
        out[k, FEATURE_RADIUS] = 0.0
    return count


@inner
def features_near(world: PackedWorld, x: float, y: float, reach: float, out: Floats) -> int:
    """Write the features within ``reach`` of (x, y) [m] to ``out``, (size, 5).

    Returns:
        How many there are; where they are more than the room, the rest is left out.
    """
    count = 0
    node = 0
    while node < world.leaf.size:
        if box_signed(world.boxes, node, x, y) > reach:
            node = world.skip[node]
            continue
        obstacle = world.leaf[node]
        node += 1
        if obstacle < 0:
            continue
        slot = world.slot[obstacle]
        kind = world.kind[obstacle]
        if kind == 0:
            circle = world.circles[slot]
            if math.hypot(circle[0] - x, circle[1] - y) - circle[2] <= reach:
                if count < out.shape[0]:
                    out[count, FEATURE_X] = circle[0]
                    out[count, FEATURE_Y] = circle[1]
                    out[count, FEATURE_RADIUS] = circle[2]
                    out[count, OUT_X] = 0.0
                    out[count, OUT_Y] = 0.0
                count += 1
        elif kind == 1:
            first = world.block_edges[world.polygon_blocks[slot]]
            last = world.block_edges[world.polygon_blocks[slot + 1]]
            count = _ring_features(world.edges, first, last, x, y, reach, out, count)
        else:
            count = _grid_features(world, slot, x, y, reach, out, count)
    for f in range(world.fence_edges.size - 1):
        first = world.fence_edges[f]
        last = world.fence_edges[f + 1]
        count = _ring_features(world.fences, first, last, x, y, reach, out, count)
    return min(count, out.shape[0])
