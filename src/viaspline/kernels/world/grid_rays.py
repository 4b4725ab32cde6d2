"""Where a beam first meets a blocked cell of an occupancy grid.

Tested through ``robot/perception/test_lidar``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner
from viaspline.kernels.world.grid_rows import is_blocked, to_cells
from viaspline.kernels.world.packed import PackedWorld


@inner
def grid_range(world: PackedWorld, g: int, x: float, y: float, ray: Floats, reach: float) -> float:
    """Distance at which a ray from (x, y) meets a blocked cell of grid g, or ``reach`` [m]."""
    width = world.grid_shapes[g, 0]
    height = world.grid_shapes[g, 1]
    u, v = to_cells(world, g, x, y)
    ahead_u, ahead_v = to_cells(world, g, x + ray[0], y + ray[1])
    du = ahead_u - u
    dv = ahead_v - v
    enter = 0.0
    leave = reach
    for place, slope, size in ((u, du, width), (v, dv, height)):
        if slope == 0.0:
            if place < 0.0 or place > size:
                return reach
            continue
        near = -place / slope
        far = (size - place) / slope
        enter = max(enter, min(near, far))
        leave = min(leave, max(near, far))
    if enter >= leave:
        return reach
    column = min(max(math.floor(u + du * enter), 0), width - 1)
    row = min(max(math.floor(v + dv * enter), 0), height - 1)
    right = 1 if du > 0.0 else -1
    up = 1 if dv > 0.0 else -1
    at = enter
    while at < leave:
        if is_blocked(world, g, row, column):
            return at
        next_u = (column + (1 if du > 0.0 else 0) - u) / du if du != 0.0 else np.inf
        next_v = (row + (1 if dv > 0.0 else 0) - v) / dv if dv != 0.0 else np.inf
        if next_u <= next_v:
            column += right
            at = next_u
        else:
            row += up
            at = next_v
        if column < 0 or column >= width or row < 0 or row >= height:
            return reach
    return reach
