"""What a straight way touches in a packed space, solid by solid.

Tested through ``kernels/space/routing/test_shape_moves``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner
from viaspline.kernels.space.ground_pyramid import has_terrain, patch_top
from viaspline.kernels.space.packed_space import LINE, PRISM, PackedSpace
from viaspline.kernels.space.routing.planes import add_plane
from viaspline.kernels.space.routing.shape_touch import touch_line, touch_product
from viaspline.kernels.space.voxel_distance import cut
from viaspline.kernels.space.voxel_words import is_blocked, to_voxels
from viaspline.kernels.world.ring_distance import is_disc, ring_signed

_PIECE = 2.0  # cubes, or patches: a way is looked at in pieces of this length


@inner
def touch_edge(
    edges: Floats, e: int, ax: float, ay: float, az: float, dx: float,
    dy: float, dz: float, low: float, high: float, grown: float, near: float, radius: float,
    planes: Floats, count: int, frame: Floats,
) -> int:  # fmt: skip
    """Add the plane of an edge that stands upright between two heights."""
    ex = edges[e, 2] - edges[e, 0]
    ey = edges[e, 3] - edges[e, 1]
    length = math.hypot(ex, ey)
    frame[0] = edges[e, 0]
    frame[1] = edges[e, 1]
    frame[2] = ex / length if length > 0.0 else 1.0
    frame[3] = ey / length if length > 0.0 else 0.0
    frame[4] = length
    frame[5] = 0.0
    frame[6] = low
    frame[7] = high
    frame[8] = grown
    return touch_product(ax, ay, az, dx, dy, dz, frame, near, radius, planes, count)


@inner
def _touch_prism(
    space: PackedSpace, r: int, ax: float, ay: float, az: float, dx: float, dy: float, dz: float,
    near: float, radius: float, planes: Floats, count: int, frame: Floats,
) -> int:  # fmt: skip
    """Add the planes of a prism's edges, and those of its roof and floor where the way is there."""
    low = space.ring_heights[r, 0] - space.core[1]
    high = space.ring_heights[r, 1] + space.core[1]
    grown = space.heads[r, 2] + space.core[0]
    for b in range(space.ring_blocks[r], space.ring_blocks[r + 1]):
        for e in range(space.block_edges[b], space.block_edges[b + 1]):
            count = touch_edge(
                space.edges, e, ax, ay, az, dx, dy, dz, low, high, grown, near, radius,
                planes, count, frame,
            )  # fmt: skip
    if is_disc(space, r):
        return count
    for end in range(2):  # over the midst of a roof an end is lowest
        x = ax + end * dx
        y = ay + end * dy
        z = az + end * dz
        if high < z < high + near and ring_signed(space, r, x, y, np.inf) <= space.core[0]:
            count = add_plane(planes, count, 0.0, 0.0, 1.0, high + radius, float(end))
        elif low - near < z < low and ring_signed(space, r, x, y, np.inf) <= space.core[0]:
            count = add_plane(planes, count, 0.0, 0.0, -1.0, radius - low, float(end))
    return count


@inner
def _touch_voxels(
    space: PackedSpace, g: int, ax: float, ay: float, az: float, dx: float, dy: float, dz: float,
    near: float, radius: float, planes: Floats, count: int, frame: Floats,
) -> int:  # fmt: skip
    """Add the planes of cubes next to the way."""
    side = space.voxel_frames[g, 5]
    flat = not math.isnan(space.voxel_frames[g, 6])  # one layer of squares
    base = space.voxel_frames[g, 2]
    wide = (near + space.core[0]) / side
    tall = (near + space.core[1]) / side
    c, s = space.voxel_frames[g, 3], space.voxel_frames[g, 4]
    level = space.voxel_levels[space.voxel_starts[g]]
    length = math.sqrt(dx * dx + dy * dy + dz * dz) / side
    pieces = max(1, math.ceil(length / _PIECE))
    for piece in range(pieces):
        p = piece / pieces
        q = (piece + 1) / pieces
        u0, v0, w0 = to_voxels(space, g, ax + p * dx, ay + p * dy, az + p * dz)
        u1, v1, w1 = to_voxels(space, g, ax + q * dx, ay + q * dy, az + q * dz)
        if flat:
            w0 = 0.5
            w1 = 0.5
        k1 = min(4 * level[2] - 1, math.floor(max(w0, w1) + tall))
        j1 = min(4 * level[1] - 1, math.floor(max(v0, v1) + wide))
        i1 = min(4 * level[0] - 1, math.floor(max(u0, u1) + wide))
        for k in range(max(0, math.floor(min(w0, w1) - tall)), k1 + 1):
            for j in range(max(0, math.floor(min(v0, v1) - wide)), j1 + 1):
                for i in range(max(0, math.floor(min(u0, u1) - wide)), i1 + 1):
                    if not is_blocked(space, g, i, j, k):
                        continue
                    frame[0] = space.voxel_frames[g, 0] + side * (c * i - s * j)
                    frame[1] = space.voxel_frames[g, 1] + side * (s * i + c * j)
                    frame[2] = c
                    frame[3] = s
                    frame[4] = side
                    frame[5] = side
                    low = space.voxel_frames[g, 6] if flat else float(k)
                    high = space.voxel_frames[g, 7] if flat else k + 1.0
                    frame[6] = base + side * low
                    frame[7] = base + side * high
                    frame[6] -= space.core[1]
                    frame[7] += space.core[1]
                    frame[8] = space.core[0]
                    count = touch_product(
                        ax, ay, az, dx, dy, dz, frame, near, radius, planes, count
                    )
    return count


@inner
def touch_solid(
    space: PackedSpace, i: int, ax: float, ay: float, az: float, dx: float, dy: float, dz: float,
    near: float, radius: float, planes: Floats, count: int, frame: Floats,
) -> int:  # fmt: skip
    """Add the planes between a way and solid i."""
    row = space.rows[i]
    if space.kinds[i] == PRISM:
        return _touch_prism(space, row, ax, ay, az, dx, dy, dz, near, radius, planes, count, frame)
    if space.kinds[i] == LINE:
        return touch_line(
            space.lines, space.core, row, ax, ay, az, dx, dy, dz, near, radius, planes, count
        )
    return _touch_voxels(space, row, ax, ay, az, dx, dy, dz, near, radius, planes, count, frame)


@inner
def touch_ground(
    space: PackedSpace, ax: float, ay: float, az: float, dx: float, dy: float, dz: float,
    near: float, radius: float, planes: Floats, count: int, frame: Floats,
) -> int:  # fmt: skip
    """Add the planes of the ground below: of flat ground, or of the columns next to the way."""
    if not has_terrain(space):
        level = space.ground_frame[3] + space.core[1] + radius
        return add_plane(planes, count, 0.0, 0.0, 1.0, level, 1.0)
    side = space.ground_frame[2]
    wide = near + space.core[0]
    pieces = max(1, math.ceil(math.hypot(dx, dy) / (side * _PIECE)))
    columns = space.heights.shape[1] - 1
    rows = space.heights.shape[0] - 1
    for piece in range(pieces):
        p = piece / pieces
        q = (piece + 1) / pieces
        x0 = ax + p * dx - space.ground_frame[0]
        x1 = ax + q * dx - space.ground_frame[0]
        y0 = ay + p * dy - space.ground_frame[1]
        y1 = ay + q * dy - space.ground_frame[1]
        lowest = min(az + p * dz, az + q * dz)
        i1 = min(columns - 1, math.floor((max(x0, x1) + wide) / side))
        j1 = min(rows - 1, math.floor((max(y0, y1) + wide) / side))
        for j in range(max(0, math.floor((min(y0, y1) - wide) / side)), j1 + 1):
            for i in range(max(0, math.floor((min(x0, x1) - wide) / side)), i1 + 1):
                top = patch_top(space, i, j) + space.core[1]
                if not lowest - top < near:
                    continue
                frame[0] = space.ground_frame[0] + side * i
                frame[1] = space.ground_frame[1] + side * j
                frame[2] = 1.0
                frame[3] = 0.0
                frame[4] = side
                frame[5] = side
                frame[6] = -np.inf
                frame[7] = top
                frame[8] = space.core[0]
                count = touch_product(ax, ay, az, dx, dy, dz, frame, near, radius, planes, count)
    return count


@inner
def touch_bounds(
    space: PackedSpace, ax: float, ay: float, az: float, dx: float, dy: float, dz: float,
    near: float, radius: float, planes: Floats, count: int, frame: Floats,
) -> int:  # fmt: skip
    """Add the planes of the bounds, and of the fences next to the way."""
    kept = radius + space.core[0]
    if space.bounds.shape[0] > 0:
        count = add_plane(planes, count, 1.0, 0.0, 0.0, space.bounds[0, 0] + kept, 1.0)
        count = add_plane(planes, count, 0.0, 1.0, 0.0, space.bounds[0, 1] + kept, 1.0)
        count = add_plane(planes, count, -1.0, 0.0, 0.0, kept - space.bounds[0, 2], 1.0)
        count = add_plane(planes, count, 0.0, -1.0, 0.0, kept - space.bounds[0, 3], 1.0)
    for e in range(space.fences.shape[0]):
        count = touch_edge(
            space.fences, e, ax, ay, az, dx, dy, dz, -np.inf, np.inf, space.core[0], near,
            radius, planes, count, frame,
        )  # fmt: skip
    return count


@inner
def is_by_box(
    space: PackedSpace, node: int, ax: float, ay: float, az: float, dx: float, dy: float,
    dz: float, near: float,
) -> bool:  # fmt: skip
    """Whether a way comes nearer than that to the box of a node of the tree."""
    box = space.boxes[node]
    wide, tall = near + space.core[0], near + space.core[1]
    t, far = cut(0.0, 1.0, ax, dx, box[0] - wide, box[3] + wide)
    t, far = cut(t, far, ay, dy, box[1] - wide, box[4] + wide)
    t, far = cut(t, far, az, dz, box[2] - tall, box[5] + tall)
    return t <= far
