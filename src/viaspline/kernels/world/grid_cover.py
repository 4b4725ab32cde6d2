"""Which blocked cells of a grid lie inside a body, and what a taut string can lie against there.

Tested through ``kernels/clearance/test_footprint_walk``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner
from viaspline.kernels.world.grid_rows import grid_corners_near, is_blocked, to_cells, to_world
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.plane import covers
from viaspline.kernels.world.ring_features import FEATURE_RADIUS, OUT_X, OUT_Y


@inner
def grid_enclosed(
    world: PackedWorld, g: int, body: Floats, outer: float, x: float, y: float, c: float, s: float
) -> tuple[bool, float, float]:
    """Whether the middle of a blocked cell of grid g lies inside the body, and that middle [m]."""
    u, v = to_cells(world, g, x, y)
    reach = outer / world.grid_frames[g, 4]
    bottom = max(math.floor(v - reach), 0)
    top = min(math.floor(v + reach), world.grid_shapes[g, 1] - 1)
    left = max(math.floor(u - reach), 0)
    right = min(math.floor(u + reach), world.grid_shapes[g, 0] - 1)
    for row in range(bottom, top + 1):
        for column in range(left, right + 1):
            if is_blocked(world, g, row, column):
                px, py = to_world(world, g, column + 0.5, row + 0.5)
                if covers(body, x, y, c, s, px, py):
                    return True, px, py
    return False, 0.0, 0.0


@inner
def grid_features(
    world: PackedWorld, g: int, x: float, y: float, reach: float, out: Floats, count: int
) -> int:
    """Append the convex corners of grid g within ``reach`` of (x, y) [m]; see ``edge_features``."""
    before = count
    count = grid_corners_near(world, g, x, y, reach, out, count)
    for k in range(before, min(count, out.shape[0])):
        out[k, OUT_Y] = out[k, 3]
        out[k, OUT_X] = out[k, 2]
        out[k, FEATURE_RADIUS] = 0.0
    return count
