"""Distance between an occupancy grid and a rounded ring or another grid.

Tested through ``kernels/world/test_grid_rows``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.jit import inner
from viaspline.kernels.world.grid_rows import entry, to_cells, to_world
from viaspline.kernels.world.grid_segment import grid_segment
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.ring_distance import radius_of
from viaspline.kernels.world.shape import grid_of, is_ring, obstacle_signed


@inner
def _cells_near(world: PackedWorld, g: int, i: int, far: float) -> tuple[int, int, int, int]:
    """First and last column, first and last row of grid g within ``far`` cells of obstacle i's box.

    Of a rounded ring the box of its core counts.
    """
    u0 = np.inf
    v0 = np.inf
    u1 = -np.inf
    v1 = -np.inf
    first = 0
    last = 4
    if is_ring(world, i):
        first = world.ring_edges[world.slot[i]]
        last = world.ring_edges[world.slot[i] + 1]
    for k in range(first, last):
        if is_ring(world, i):
            x = world.edges[k, 0]
            y = world.edges[k, 1]
        else:
            other = grid_of(world, i)
            right = world.grid_shapes[other, 0] if k % 2 == 1 else 0
            top = world.grid_shapes[other, 1] if k >= 2 else 0
            x, y = to_world(world, other, float(right), float(top))
        u, v = to_cells(world, g, x, y)
        u0 = min(u0, u)
        v0 = min(v0, v)
        u1 = max(u1, u)
        v1 = max(v1, v)
    width = float(world.grid_shapes[g, 0])
    height = float(world.grid_shapes[g, 1])
    return (
        math.floor(min(max(u0 - far, 0.0), width)),
        math.floor(max(min(u1 + far, width - 1.0), -1.0)),
        math.floor(min(max(v0 - far, 0.0), height)),
        math.floor(max(min(v1 + far, height - 1.0), -1.0)),
    )


@inner
def _reaches_inside(world: PackedWorld, i: int, j: int) -> bool:
    """Whether blocked cells of grid i lie inside obstacle j.

    One cell of a run tells it for all where the outlines are known to be apart.
    """
    g = grid_of(world, i)
    first, last, low, high = _cells_near(world, g, j, 0.0)
    for row in range(low, high + 1):
        place = world.grid_shapes[g, 2] + row * world.grid_shapes[g, 0]
        column = first
        while column <= last:
            steps = entry(world.to_right, place + column)
            if steps < 0:
                x, y = to_world(world, g, column + 0.5, row + 0.5)
                if obstacle_signed(world, j, x, y, 0.0) < 0.0:
                    return True
            column += abs(steps)
    return False


@inner
def grid_gap(world: PackedWorld, i: int, j: int, limit: float) -> float:
    """Distance between the grid i and the rounded ring j [m]; not above 0 where they overlap."""
    g = grid_of(world, i)
    r = world.slot[j]
    reach = limit + radius_of(world, r)
    best = reach
    for e in range(world.ring_edges[r], world.ring_edges[r + 1]):
        edge = world.edges[e]
        best = grid_segment(world, g, edge[0], edge[1], edge[2], edge[3], best)
    if best < reach:
        return best - radius_of(world, r)
    return 0.0 if _reaches_inside(world, i, j) else limit


@inner
def _sides_gap(
    world: PackedWorld, g: int, other: int, row: int, start: int, end: int, limit: float
) -> float:
    """Distance between the four sides of a run of cells of grid g and grid ``other`` [m]."""
    best = limit
    u = float(start)
    v = float(row)
    for side in range(4):
        ax, ay = to_world(world, g, u, v)
        if side % 2 == 0:
            u = float(end) if side == 0 else float(start)
        else:
            v = row + 1.0 if side == 1 else float(row)
        bx, by = to_world(world, g, u, v)
        best = grid_segment(world, other, ax, ay, bx, by, best)
    return best


@inner
def grids_gap(world: PackedWorld, i: int, j: int, limit: float) -> float:
    """Distance between the grids i and j [m]; 0 where they touch."""
    best = limit
    g = grid_of(world, i)
    other = grid_of(world, j)
    first, last, low, high = _cells_near(world, g, j, limit / world.grid_frames[g, 4] + 1.0)
    for row in range(low, high + 1):
        place = world.grid_shapes[g, 2] + row * world.grid_shapes[g, 0]
        column = first
        while column <= last:
            steps = entry(world.to_right, place + column)
            end = min(column + abs(steps), world.grid_shapes[g, 0])
            if steps < 0:
                best = _sides_gap(world, g, other, row, column, end, best)
            column = end
    if best > 0.0 and (_reaches_inside(world, i, j) or _reaches_inside(world, j, i)):
        return 0.0
    return best
