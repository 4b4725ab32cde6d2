"""Distance of a segment to the blocked cells of an occupancy grid.

Of every row that the segment comes near to, the part within reach is taken run by run: blocked
cells that follow each other are one rectangle, and free ones are stepped over at once.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.distance import squared_point_segment
from viaspline.kernels.grid import nearest_cell, to_cells
from viaspline.kernels.jit import inner
from viaspline.kernels.packed import PackedWorld

NARROW = 4.0  # cells; within so little no time is lost by looking everywhere


@inner
def _squared_point_box(
    x: float, y: float, left: float, low: float, right: float, high: float
) -> float:
    dx = max(max(left - x, x - right), 0.0)
    dy = max(max(low - y, y - high), 0.0)
    return dx * dx + dy * dy


@inner
def squared_segment_box(
    ax: float, ay: float, bx: float, by: float, left: float, low: float, right: float, high: float
) -> float:
    """Squared distance between the segment a-b and a box; 0 where they touch.

    They are apart along x, along y or across the segment, if they are apart at all; then an end of
    the segment is nearest, or the corner of the box that is nearest to the segment's line.
    """
    dx = bx - ax
    dy = by - ay
    middle = dx * (0.5 * (low + high) - ay) - dy * (0.5 * (left + right) - ax)
    spread = 0.5 * (abs(dx) * (high - low) + abs(dy) * (right - left))
    overlap = max(ax, bx) >= left and min(ax, bx) <= right
    if overlap and max(ay, by) >= low and min(ay, by) <= high and abs(middle) <= spread:
        return 0.0
    corner_x = right if (dy > 0.0) == (middle > 0.0) else left
    corner_y = low if (dx > 0.0) == (middle > 0.0) else high
    return min(
        squared_point_segment(corner_x, corner_y, ax, ay, bx, by),
        min(
            _squared_point_box(ax, ay, left, low, right, high),
            _squared_point_box(bx, by, left, low, right, high),
        ),
    )


@inner
def _row_gap(
    world: PackedWorld,
    g: int,
    row: int,
    au: float,
    av: float,
    bu: float,
    bv: float,
    slope: float,
    spare: float,
    best: float,
) -> float:
    """Distance between the segment a-b and the blocked cells of one row [cells], at most ``best``.

    Args:
        world: PackedWorld.
        g: The grid.
        row: The row.
        au: Column of a.
        av: Row of a.
        bu: Column of b.
        bv: Row of b, not below a.
        slope: Columns that the segment goes for one row upwards, or 0 to look at all of it.
        spare: Bound of the rounding in that [cells].
        best: What is known.
    """
    west = min(au, bu)
    east = max(au, bu)
    if slope != 0.0:  # only the part that is near to the row
        enters = au + (max(row - best, av) - av) * slope
        leaves = au + (min(row + 1.0 + best, bv) - av) * slope
        west = min(enters, leaves)
        east = max(enters, leaves)
    width = world.grid_shapes[g, 0]
    first = world.grid_shapes[g, 2] + row * width
    column = int(max(west - best - spare, 0.0))
    last = math.floor(min(east + best + spare, width - 1.0))
    while column <= last:
        steps = int(world.to_right[first + column])
        if steps > 0:
            column += steps
            continue
        end = min(column - steps, width)
        squared = squared_segment_box(
            au, av, bu, bv, float(column), float(row), float(end), row + 1.0
        )
        if squared < best * best:
            best = math.sqrt(squared)
        column = end
    return best


@inner
def grid_segment(
    world: PackedWorld, g: int, ax: float, ay: float, bx: float, by: float, limit: float
) -> float:
    """Distance between the segment a-b and the blocked cells of grid g [m]; 0 where they touch."""
    au, av = to_cells(world, g, ax, ay)
    bu, bv = to_cells(world, g, bx, by)
    if av > bv:
        au, av, bu, bv = bu, bv, au, av
    within = limit / world.grid_frames[g, 4]
    best = within
    if best > NARROW:
        best = nearest_cell(world, g, 0.5 * (au + bu), 0.5 * (av + bv), 1, best)
        if best == np.inf:
            return limit
    slope = 0.0
    if bv - av > 1.0:
        slope = (bu - au) / (bv - av)
    spare = 1e-9 + 1e-15 * (max(abs(au), abs(bu)) + abs(slope) * max(abs(av), abs(bv)))
    height = world.grid_shapes[g, 1]
    low = math.floor(min(max(av, 0.0), float(height)))
    high = math.floor(min(max(bv, -1.0), height - 1.0))
    for row in range(low, high + 1):
        if best <= 0.0:
            break
        best = _row_gap(world, g, row, au, av, bu, bv, slope, spare, best)
    for row in range(high + 1, height):
        if row - bv >= best:
            break
        best = _row_gap(world, g, row, au, av, bu, bv, slope, spare, best)
    for row in range(low - 1, -1, -1):
        if av - row - 1.0 >= best:
            break
        best = _row_gap(world, g, row, au, av, bu, bv, slope, spare, best)
    return min(limit, best * world.grid_frames[g, 4]) if best < within else limit
