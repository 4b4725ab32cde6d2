"""Distance of a segment to the blocked cells of an occupancy grid.

Of every row that the segment comes near to, the part within reach is taken run by run: blocked
cells that follow each other are one rectangle, and free ones are stepped over at once.

Tested through ``kernels/world/test_grid_rows``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Columns
from viaspline.kernels.jit import inlined, uncounted
from viaspline.kernels.world.grid_rows import entry, nearest_cell, to_cells
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.plane import squared_point_segment

NARROW_CELLS = 4.0  # cells; within so little no time is lost by looking everywhere


@uncounted
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
    corner = squared_point_segment(corner_x, corner_y, ax, ay, bx, by)
    a_x = max(max(left - ax, ax - right), 0.0)
    a_y = max(max(low - ay, ay - high), 0.0)
    b_x = max(max(left - bx, bx - right), 0.0)
    b_y = max(max(low - by, by - high), 0.0)
    return min(corner, min(a_x * a_x + a_y * a_y, b_x * b_x + b_y * b_y))


@uncounted
def _row_gap(
    to_right: Columns,
    first: int,
    width: int,
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
        to_right: As in PackedWorld.
        first: Where the row's first cell stands in it.
        width: Columns.
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
    column = int(max(west - best - spare, 0.0))
    last = math.floor(min(east + best + spare, width - 1.0))
    while column <= last:
        steps = entry(to_right, first + column)
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


@inlined
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
    to_right = world.to_right
    width = world.grid_shapes[g, 0]
    height = world.grid_shapes[g, 1]
    first = world.grid_shapes[g, 2]
    if best > NARROW_CELLS:
        u = 0.5 * (au + bu)
        v = 0.5 * (av + bv)
        best = nearest_cell(to_right, world.to_left, first, width, height, u, v, 1, best)
        if best == np.inf:
            return limit
    slope = 0.0
    if bv - av > 1.0:
        slope = (bu - au) / (bv - av)
    spare = 1e-9 + 1e-15 * (max(abs(au), abs(bu)) + abs(slope) * max(abs(av), abs(bv)))
    low = int(min(max(av, 0.0), float(height)))
    for step in range(1, -2, -2):  # the segment's rows and on upwards, then those below
        row = low if step > 0 else low - 1
        while 0 <= row < height and max(max(row - bv, av - row - 1.0), 0.0) < best:
            start = first + row * width
            best = _row_gap(to_right, start, width, row, au, av, bu, bv, slope, spare, best)
            row += step
    return min(limit, best * world.grid_frames[g, 4]) if best < within else limit
