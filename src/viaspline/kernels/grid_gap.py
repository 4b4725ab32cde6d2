"""Distance between an occupancy grid and a disc, a polygon or another grid."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.distance import obstacle_signed
from viaspline.kernels.grid import entry, grid_signed, to_cells, to_world
from viaspline.kernels.grid_segment import grid_segment
from viaspline.kernels.jit import inner
from viaspline.kernels.packed import PackedWorld


@inner
def _box_in_cells(world: PackedWorld, g: int, i: int) -> tuple[float, float, float, float]:
    """Box of obstacle i, a polygon or a grid, in grid g's columns and rows."""
    u0 = np.inf
    v0 = np.inf
    u1 = -np.inf
    v1 = -np.inf
    slot = world.slot[i]
    first = 0
    last = 4
    if world.kind[i] == 1:
        first = world.block_edges[world.polygon_blocks[slot]]
        last = world.block_edges[world.polygon_blocks[slot + 1]]
    for k in range(first, last):
        if world.kind[i] == 1:
            x = world.edges[k, 0]
            y = world.edges[k, 1]
        else:
            width = world.grid_shapes[slot, 0] if k % 2 == 1 else 0
            height = world.grid_shapes[slot, 1] if k >= 2 else 0
            x, y = to_world(world, slot, float(width), float(height))
        u, v = to_cells(world, g, x, y)
        u0 = min(u0, u)
        v0 = min(v0, v)
        u1 = max(u1, u)
        v1 = max(v1, v)
    return u0, v0, u1, v1


@inner
def _run_gap(
    world: PackedWorld, g: int, other: int, row: int, start: int, end: int, limit: float
) -> float:
    """Distance between the sides of a run of cells of grid g and grid ``other`` [m]."""
    ax, ay = to_world(world, g, float(start), float(row))
    bx, by = to_world(world, g, float(end), float(row))
    cx, cy = to_world(world, g, float(end), row + 1.0)
    dx, dy = to_world(world, g, float(start), row + 1.0)
    best = grid_segment(world, other, ax, ay, bx, by, limit)
    best = grid_segment(world, other, bx, by, cx, cy, best)
    best = grid_segment(world, other, cx, cy, dx, dy, best)
    return grid_segment(world, other, dx, dy, ax, ay, best)


@inner
def _runs_gap(world: PackedWorld, i: int, j: int, sides: bool, limit: float) -> float:
    """Distance between the runs of grid i and obstacle j [m], at most ``limit``.

    Args:
        world: PackedWorld.
        i: A grid.
        j: A grid or a polygon.
        sides: Whether to measure from the runs' sides to grid j. Otherwise only runs inside of j
            count, with 0; that is all that there can be where its outline is known to be farther
            away.
        limit: What is known [m].
    """
    best = limit
    g = world.slot[i]
    width = world.grid_shapes[g, 0]
    u0, v0, u1, v1 = _box_in_cells(world, g, j)
    far = best / world.grid_frames[g, 4] + 1.0 if sides else 0.0
    low = math.floor(max(v0 - far, 0.0))
    high = math.floor(min(v1 + far, world.grid_shapes[g, 1] - 1.0))
    first = math.floor(max(u0 - far, 0.0))
    last = math.floor(min(u1 + far, width - 1.0))
    for row in range(low, high + 1):
        column = first
        place = world.grid_shapes[g, 2] + row * width
        while column <= last:
            steps = entry(world.to_right, place + column)
            if steps > 0:
                column += steps
                continue
            end = min(column - steps, width)
            x, y = to_world(world, g, column + 0.5, row + 0.5)
            if obstacle_signed(world, j, x, y, 0.0) < 0.0:
                return 0.0
            if sides:
                best = _run_gap(world, g, world.slot[j], row, column, end, best)
            column = end
    return best


@inner
def grid_gap(world: PackedWorld, i: int, j: int, limit: float) -> float:
    """Distance between the grid i and obstacle j [m], at most ``limit``; not above 0 on touch."""
    g = world.slot[i]
    slot = world.slot[j]
    if world.kind[j] == 0:
        circle = world.circles[slot]
        distance = grid_signed(world, g, circle[0], circle[1], limit + circle[2])
        return distance - circle[2] if distance < limit + circle[2] else limit
    if world.kind[j] == 2:
        best = _runs_gap(world, i, j, True, limit)
        return _runs_gap(world, j, i, False, best)
    best = limit
    first = world.block_edges[world.polygon_blocks[slot]]
    last = world.block_edges[world.polygon_blocks[slot + 1]]
    for e in range(first, last):
        edge = world.edges[e]
        best = grid_segment(world, g, edge[0], edge[1], edge[2], edge[3], best)
    return _runs_gap(world, i, j, False, best)
