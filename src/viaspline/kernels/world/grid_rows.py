"""Occupancy grids: tables of their rows, the signed distance of a point, and their corners.

A grid is the union of its blocked cells, closed squares; what is outside of its rectangle is free.
Queries are answered in the grid's own frame, in columns u and rows v as real numbers: cell (r, c)
is the square from (c, r) to (c + 1, r + 1). The tables tell how far from a cell its row stays what
it is, so a row costs the same however wide it is, and distances are exact to the squares.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Columns, Flags, Floats
from viaspline.kernels.jit import inlined, kernel, uncounted
from viaspline.kernels.world.packed import PackedWorld

NO_COLUMN = 32767  # columns to where there is nothing: more than a grid may have


@kernel
def _fill(blocked: Flags, to_right: Columns, to_left: Columns) -> None:
    """Write the tables run by run: cells of a kind that follow each other in a row."""
    width = blocked.shape[1]
    for r in range(blocked.shape[0]):
        first = r * width
        start = 0
        while start < width:
            kind = blocked[r, start]
            end = start + 1
            while end < width and blocked[r, end] == kind:
                end += 1
            sign = -1 if kind else 1
            nowhere = -NO_COLUMN - 1 if kind else NO_COLUMN
            for c in range(start, end):
                to_right[first + c] = sign * (end - c) if end < width else nowhere
                to_left[first + c] = sign * (c - start + 1) if start > 0 else nowhere
            start = end


def row_tables(blocked: Flags) -> tuple[Columns, Columns]:
    """The tables of a grid, cells row by row; they take 4 bytes a cell and nothing in between.

    Args:
        blocked: (height, width).

    Returns:
        (to_right, to_left), (height * width,), as in PackedWorld.
    """
    to_right = np.empty(blocked.size, np.int16)
    to_left = np.empty(blocked.size, np.int16)
    _fill(blocked, to_right, to_left)
    return to_right, to_left


@inlined
def entry(table: Columns, place: int) -> int:
    """An entry in 64 bits; ``int`` by itself leaves it in 16, where -32768 has no opposite."""
    return int(np.int64(table[place]))


@inlined
def to_cells(world: PackedWorld, g: int, x: float, y: float) -> tuple[float, float]:
    """From the world [m] to grid g's columns and rows."""
    frame = world.grid_frames[g]
    dx = x - frame[0]
    dy = y - frame[1]
    u = (frame[2] * dx + frame[3] * dy) / frame[4]
    v = (frame[2] * dy - frame[3] * dx) / frame[4]
    return u, v


@uncounted
def to_world(world: PackedWorld, g: int, u: float, v: float) -> tuple[float, float]:
    """From grid g's columns and rows to the world [m]."""
    frame = world.grid_frames[g]
    x = frame[0] + frame[4] * (frame[2] * u - frame[3] * v)
    y = frame[1] + frame[4] * (frame[3] * u + frame[2] * v)
    return x, y


@uncounted
def is_blocked(world: PackedWorld, g: int, row: int, column: int) -> bool:
    """Whether a cell of grid g is blocked; cells outside of the grid are not."""
    width = world.grid_shapes[g, 0]
    if row < 0 or row >= world.grid_shapes[g, 1] or column < 0 or column >= width:
        return False
    return world.to_right[world.grid_shapes[g, 2] + row * width + column] < 0


@inlined
def _aside(
    to_right: Columns, to_left: Columns, place: int, column: int, u: float, sign: int
) -> float:
    """How far to either side the nearest cell sought is, in the row of the cell at ``place``."""
    right = sign * entry(to_right, place)
    if right < 0:
        return max(max(column - u, u - column - 1.0), 0.0)
    aside = np.inf
    if right < NO_COLUMN:
        aside = column + right - u
    left = sign * entry(to_left, place)
    if left < NO_COLUMN:
        aside = min(aside, u - (column - left + 1))
    return aside


@uncounted
def nearest_cell(
    to_right: Columns,
    to_left: Columns,
    first: int,
    width: int,
    height: int,
    u: float,
    v: float,
    sign: int,
    limit: float,
) -> float:
    """Distance from (u, v) to the nearest cell of a grid that is blocked, or free [cells].

    Rows are looked at from the nearest to either side, until no other can be nearer.

    Args:
        to_right: As in PackedWorld.
        to_left: The same.
        first: Where the grid's first cell stands in the tables.
        width: Columns.
        height: Rows.
        u: Column.
        v: Row.
        sign: 1 for blocked cells, -1 for free ones.
        limit: The answer where none is nearer [cells].
    """
    column = int(min(max(u, 0.0), width - 1.0))
    above = int(min(max(v, 0.0), height - 1.0))
    below = above - 1
    squared = limit * limit
    while True:
        rise = max(max(above - v, v - above - 1.0), 0.0)
        fall = v - below - 1.0
        up = above < height and rise * rise < squared
        down = below >= 0 and fall * fall < squared
        if up:
            aside = _aside(to_right, to_left, first + above * width + column, column, u, sign)
            squared = min(squared, rise * rise + aside * aside)
        if down:
            aside = _aside(to_right, to_left, first + below * width + column, column, u, sign)
            squared = min(squared, fall * fall + aside * aside)
        if not (up or down):
            return math.sqrt(squared)
        above += 1
        below -= 1


@inlined
def grid_signed(world: PackedWorld, g: int, x: float, y: float, limit: float) -> float:
    """Signed distance from (x, y) to the blocked cells of grid g [m]; negative inside."""
    u, v = to_cells(world, g, x, y)
    side = world.grid_frames[g, 4]
    width = world.grid_shapes[g, 0]
    height = world.grid_shapes[g, 1]
    first = world.grid_shapes[g, 2]
    to_right = world.to_right
    to_left = world.to_left
    sign = 1
    within = limit / side
    rim = min(min(u, width - u), min(v, height - v))
    if rim > 0.0 and to_right[first + int(v) * width + int(u)] < 0:
        sign = -1
        within = rim
    distance = nearest_cell(to_right, to_left, first, width, height, u, v, sign, within)
    if sign < 0:
        return -side * distance
    return min(limit, side * distance) if distance < within else limit


@uncounted
def _write_corner(
    frame: Floats, u: int, v: int, east: int, north: int, out: Floats, count: int
) -> int:
    """Write the corner at a lattice point that is free towards the quadrant (east, north)."""
    if count < out.shape[0]:
        half = math.sqrt(0.5)
        out[count, 0] = frame[0] + frame[4] * (frame[2] * u - frame[3] * v)
        out[count, 1] = frame[1] + frame[4] * (frame[3] * u + frame[2] * v)
        out[count, 2] = half * (frame[2] * east - frame[3] * north)
        out[count, 3] = half * (frame[3] * east + frame[2] * north)
    return count + 1


@uncounted
def grid_corners_near(
    world: PackedWorld, g: int, x: float, y: float, reach: float, out: Floats, count: int
) -> int:
    """Append the convex corners of grid g within ``reach`` of (x, y) [m] to ``out``.

    A lattice point is a convex corner where one of the four cells round it is blocked, or two that
    face each other diagonally; the latter are two corners, free on either side.

    Args:
        world: PackedWorld.
        g: The grid.
        x: Where to look [m].
        y: The same.
        reach: How far [m].
        out: Room for them: x, y [m] and the unit vector that points away from what is blocked, or
            into the free quadrant, (size, 4).
        count: Rows that are taken.

    Returns:
        The new count; where it is more than the room there is, call again with more.
    """
    u, v = to_cells(world, g, x, y)
    width = world.grid_shapes[g, 0]
    height = world.grid_shapes[g, 1]
    to_right = world.to_right
    frame = world.grid_frames[g]
    far = reach / frame[4]
    top = math.floor(min(v + far, float(height)))
    for line in range(math.ceil(max(v - far, 0.0)), top + 1):
        across = math.sqrt(max(far * far - (line - v) * (line - v), 0.0))
        column = math.ceil(max(u - across, 0.0))
        last = math.floor(min(u + across, float(width)))
        if column > last:
            continue
        upper = world.grid_shapes[g, 2] + line * width
        lower = upper - width
        nw = column > 0 and line < height and to_right[upper + column - 1] < 0
        sw = column > 0 and line > 0 and to_right[lower + column - 1] < 0
        while column <= last:
            within = column < width
            above = entry(to_right, upper + column) if within and line < height else NO_COLUMN
            below = entry(to_right, lower + column) if within and line > 0 else NO_COLUMN
            ne = above < 0
            se = below < 0
            blocked = int(nw) + int(ne) + int(sw) + int(se)
            if blocked == 1:
                east = -1 if ne or se else 1
                north = -1 if nw or ne else 1
                count = _write_corner(frame, column, line, east, north, out, count)
            elif blocked == 2 and nw == se:
                turn = -1 if nw else 1
                count = _write_corner(frame, column, line, -turn, 1, out, count)
                count = _write_corner(frame, column, line, turn, -1, out, count)
            column += min(min(abs(above), abs(below)), max(width - column, 1))
            nw = ne
            sw = se
    return count
