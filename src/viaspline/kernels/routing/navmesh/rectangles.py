"""Free space of a lattice as rectangles and the portals between them.

Every rectangle is as wide as a run of free cells and as high as that run goes on unchanged, so it
has walls to its left and right and portals only above and below. Portals stand in the order of
their height, then from left to right: those of one side of a rectangle follow each other.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from viaspline.kernels.arrays import Bytes, Ints
from viaspline.kernels.growable import new_ints, sized_ints
from viaspline.kernels.jit import inlined, inner, kernel

CELL_EDGE_SLACK = 1e-9  # within which a place is in a cell [cells]
# columns of a rectangle, and of a portal
LEFT, RIGHT, BOTTOM, TOP, PIECE = range(5)
HEIGHT, UNDER, OVER, TURN_LEFT, TURN_RIGHT = range(2, 7)
# columns of the two ranges of a rectangle's portals
FIRST_BELOW, LAST_BELOW, FIRST_ABOVE, LAST_ABOVE = range(4)


class Mesh(NamedTuple):
    """Rectangles of free cells; lengths are in cells.

    Attributes:
        rectangles: x_min, x_max, y_min, y_max, and the piece of free space that it belongs to:
            from one piece no path leads to another, (r, 5).
        doors: Portals ``doors[r, 0]:doors[r, 1]`` lead out of rectangle r downwards,
            ``doors[r, 2]:doors[r, 3]`` upwards, (r, 4).
        portals: x_min, x_max, y, the rectangle below, the one above, and whether a shortest path
            can turn at the left and at the right end: 1 where one of the two rectangles goes on
            beyond it, else 0, (p, 7).
        rows: Rectangles whose lowest row is j are ``rows[j]:rows[j + 1]``, (height + 1, 1).
    """

    rectangles: Ints
    doors: Ints
    portals: Ints
    rows: Ints


@inlined
def _next_run(blocked: Bytes, row: int, column: int) -> tuple[int, int]:
    """The next run of free cells of a row from a column on; an empty one at its end."""
    width = blocked.shape[1]
    first = column
    while first < width and blocked[row, first]:
        first += 1
    last = first
    while last < width and not blocked[row, last]:
        last += 1
    return first, last


@inlined
def _most(blocked: Bytes) -> tuple[int, int]:
    """How many runs of free cells there are, and how many pairs of runs above each other."""
    height, width = blocked.shape
    runs = 0
    pairs = 0
    for row in range(height):
        under = max(row - 1, 0)
        for column in range(width):
            before = max(column - 1, 0)
            opens = (column == 0) | (blocked[row, before] != 0)
            is_free = blocked[row, column] == 0
            runs += is_free & opens
            opens |= blocked[under, before] != 0
            pairs += is_free & (blocked[under, column] == 0) & opens
    return runs, pairs


@inlined
def _add_portals(
    rectangles: Ints, portals: Ints, count: int, this: int, runs: Ints, k: int, size: int
) -> int:
    """Append the portals from rectangle ``this`` to those of the row below from ``runs[k]`` on."""
    left = rectangles[this, LEFT]
    right = rectangles[this, RIGHT]
    while k < size and rectangles[runs[k], LEFT] < right:
        under = runs[k]
        portals[count, LEFT] = max(left, rectangles[under, LEFT])
        portals[count, RIGHT] = min(right, rectangles[under, RIGHT])
        portals[count, HEIGHT] = rectangles[this, BOTTOM]
        portals[count, UNDER] = under
        portals[count, OVER] = this
        portals[count, TURN_LEFT] = 1 if left != rectangles[under, LEFT] else 0
        portals[count, TURN_RIGHT] = 1 if right != rectangles[under, RIGHT] else 0
        count += 1
        k += 1
    return count


@kernel
def mesh_of(blocked: Bytes) -> Mesh:
    """The free cells of a lattice (height, width) of uint8, nonzero where blocked, as a mesh."""
    height, width = blocked.shape
    most_runs, most_pairs = _most(blocked)
    rectangles = new_ints(most_runs, 5)
    portals = new_ints(most_pairs, 7)
    rows = new_ints(height + 1, 1)
    runs = new_ints(2, width // 2 + 1)  # rectangles of the runs of a row and of the one below
    lower_size = 0
    count = 0
    doors = 0
    for row in range(height):
        rows[row, 0] = count
        lower = runs[row & 1]
        upper = runs[1 - (row & 1)]
        size = 0
        k = 0
        first, last = _next_run(blocked, row, 0)
        while first < last:
            while k < lower_size and rectangles[lower[k], RIGHT] <= first:
                k += 1
            this = lower[k] if k < lower_size else -1
            if this < 0 or rectangles[this, LEFT] != first or rectangles[this, RIGHT] != last:
                this = count
                count += 1
                rectangles[this, LEFT] = first
                rectangles[this, RIGHT] = last
                rectangles[this, BOTTOM] = row
                doors = _add_portals(rectangles, portals, doors, this, lower, k, lower_size)
            rectangles[this, TOP] = row + 1
            upper[size] = this
            size += 1
            first, last = _next_run(blocked, row, last)
        lower_size = size
    rows[height, 0] = count
    rectangles = sized_ints(rectangles, count, count)
    portals = sized_ints(portals, doors, doors)
    _mark_pieces(rectangles, portals)
    return Mesh(rectangles, _doors(rectangles, portals), portals, rows)


@inner
def _doors(rectangles: Ints, portals: Ints) -> Ints:
    """Each rectangle's portals below and above."""
    doors = new_ints(rectangles.shape[0], 4)
    for r in range(doors.shape[0]):
        for k in range(4):
            doors[r, k] = 0
    for p in range(portals.shape[0]):
        under = portals[p, UNDER]
        over = portals[p, OVER]
        if doors[under, LAST_ABOVE] == 0:
            doors[under, FIRST_ABOVE] = p
        doors[under, LAST_ABOVE] = p + 1
        if doors[over, LAST_BELOW] == 0:
            doors[over, FIRST_BELOW] = p
        doors[over, LAST_BELOW] = p + 1
    return doors


@inlined
def _mark_pieces(rectangles: Ints, portals: Ints) -> None:
    """Write the smallest rectangle of its piece to every rectangle."""
    for r in range(rectangles.shape[0]):
        rectangles[r, PIECE] = r
    for p in range(portals.shape[0]):
        under = _first_of(rectangles, portals[p, UNDER])
        over = _first_of(rectangles, portals[p, OVER])
        rectangles[max(under, over), PIECE] = min(under, over)
    for r in range(rectangles.shape[0]):
        rectangles[r, PIECE] = _first_of(rectangles, r)


@inlined
def _first_of(rectangles: Ints, r: int) -> int:
    while rectangles[r, PIECE] != r:
        rectangles[r, PIECE] = rectangles[rectangles[r, PIECE], PIECE]
        r = rectangles[r, PIECE]
    return r


@inlined
def rectangle_at(mesh: Mesh, x: float, y: float) -> int:
    """The rectangle that holds a place, borders included; -1 where there is none.

    A place on the border of a free cell belongs to it, whichever side the rest of the world is.
    """
    height = mesh.rows.shape[0] - 1
    for j in (math.floor(y), math.ceil(y) - 1):
        row = min(max(j, 0), height - 1)
        if abs(row + 0.5 - y) > 0.5 + CELL_EDGE_SLACK:
            continue
        # the rectangle may have begun in any row below
        for r in range(mesh.rows[row + 1, 0] - 1, -1, -1):
            box = mesh.rectangles[r]
            in_width = box[LEFT] - CELL_EDGE_SLACK <= x <= box[RIGHT] + CELL_EDGE_SLACK
            if in_width and box[BOTTOM] - CELL_EDGE_SLACK <= y <= box[TOP] + CELL_EDGE_SLACK:
                return r
    return -1
