"""A packed world on a lattice of square cells: where the middle of a disc robot may be."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Bytes, Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.world.distance import inner_signed
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.shape import is_ring, mark_obstacle, obstacle_signed


@inner
def _mark_leaf(
    world: PackedWorld, node: int, x: float, y: float, side: float, reach: float, cells: Bytes
) -> None:
    """Block the cells whose middle is nearer than ``reach`` to the obstacle in a leaf."""
    height, width = cells.shape
    box = world.boxes[node]
    first = max(0, int(np.floor((box[1] - reach - y) / side)))
    last = min(height, int(np.ceil((box[3] + reach - y) / side)))
    left = max(0, int(np.floor((box[0] - reach - x) / side)))
    right = min(width, int(np.ceil((box[2] + reach - x) / side)))
    obstacle = world.leaf[node]
    if mark_obstacle(world, obstacle, x, y, side, reach, cells):
        return
    for row in range(first, last):
        py = y + (row + 0.5) * side
        column = left
        while column < right:
            px = x + (column + 0.5) * side
            # the distance says how many cells on either side of the limit are like this one
            distance = obstacle_signed(world, obstacle, px, py, reach + 64.0 * side)
            steps = max(1, int(abs(distance - reach) / side))
            if distance < reach:
                for k in range(column, min(column + steps, right)):
                    cells[row, k] = 1
            column += steps


@kernel
def rasterized(
    world: PackedWorld,
    x: float,
    y: float,
    side: float,
    height: int,
    width: int,
    reach: float,
    blocked: Bytes,
) -> Bytes:
    """Block the cells of a lattice whose middle is nearer than ``reach`` to the world.

    Args:
        world: PackedWorld.
        x: Outer corner of cell (0, 0) [m].
        y: The same.
        side: Of a cell [m].
        height: Rows.
        width: Columns.
        reach: [m].
        blocked: Bytes that are blocked anyway, (height, width) of uint8; none if it is empty.

    Returns:
        (height, width) of uint8.
    """
    cells = np.zeros((height, width), np.uint8)
    if blocked.size == cells.size:
        for row in range(height):
            for column in range(width):
                cells[row, column] = blocked[row, column]
    for node in range(world.leaf.size):
        obstacle = world.leaf[node]
        if obstacle < 0:
            continue
        if is_ring(world, obstacle) or blocked.size == 0:
            _mark_leaf(world, node, x, y, side, reach, cells)
    if world.bounds.shape[0] == 0 and world.fence_edges.size < 2:
        return cells
    for row in range(height):
        py = y + (row + 0.5) * side
        column = 0
        while column < width:
            px = x + (column + 0.5) * side
            distance, _ = inner_signed(world, px, py, np.inf)
            steps = max(1, int(min(abs(distance - reach) / side, float(width))))
            if distance < reach:
                for k in range(column, min(column + steps, width)):
                    cells[row, k] = 1
            column += steps
    return cells


@kernel
def mark_segments(segments: Floats, x: float, y: float, side: float, cells: Bytes) -> None:
    """Block every cell that one of some segments x0, y0, x1, y1 [m] (n, 4) passes through."""
    height, width = cells.shape
    for s in range(segments.shape[0]):
        ax = (segments[s, 0] - x) / side
        ay = (segments[s, 1] - y) / side
        dx = (segments[s, 2] - x) / side - ax
        dy = (segments[s, 3] - y) / side - ay
        low = max(0, int(np.floor(min(ay, ay + dy))))
        high = min(height - 1, int(np.floor(max(ay, ay + dy))))
        for row in range(low, high + 1):
            first = 0.0
            last = 1.0
            if dy != 0.0:
                first = min(max((row - ay) / dy, 0.0), 1.0)
                last = min(max((row + 1.0 - ay) / dy, 0.0), 1.0)
            left = ax + min(first * dx, last * dx)
            right = ax + max(first * dx, last * dx)
            for column in range(
                max(0, int(np.floor(left - 1e-9))), min(width - 1, int(np.floor(right + 1e-9))) + 1
            ):
                cells[row, column] = 1
