"""Free space of a lattice as rectangles and the portals between them.

Every rectangle is as wide as a run of free cells and as high as that run goes on unchanged, so it
has walls to its left and right and portals only above and below. Portals stand in the order of
their height, then from left to right: those of one side of a rectangle follow each other.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.packed import Ints

Cells = NDArray[np.uint8]


class Mesh(NamedTuple):
    """Rectangles of free cells; lengths are in cells.

    Attributes:
        rectangles: x_min, x_max, y_min, y_max, (r, 4).
        below: Portals ``below[r, 0]:below[r, 1]`` lead out of rectangle r downwards, (r, 2).
        above: The same upwards, (r, 2).
        portals: x_min, x_max, y, lower rectangle, upper rectangle, (p, 5).
        turns: Whether a shortest path can turn at the left and at the right end, (p, 2): 1 where
            one of the two rectangles goes on beyond it, else 0.
        rows: Rectangles whose lowest row is j are ``rows[j]:rows[j + 1]``, (height + 1,).
    """

    rectangles: Ints
    below: Ints
    above: Ints
    portals: Ints
    turns: Ints
    rows: Ints


@inner
def _grown(rows: Ints) -> Ints:
    """A copy with twice the room."""
    larger = np.zeros((2 * rows.shape[0], rows.shape[1]), np.int64)
    for i in range(rows.shape[0]):
        for k in range(rows.shape[1]):
            larger[i, k] = rows[i, k]
    return larger


@inner
def _next_run(blocked: Cells, row: int, column: int) -> tuple[int, int]:
    """The next run of free cells of a row from a column on; an empty one at its end."""
    width = blocked.shape[1]
    first = column
    while first < width and blocked[row, first]:
        first += 1
    last = first
    while last < width and not blocked[row, last]:
        last += 1
    return first, last


@kernel
def mesh_of(blocked: Cells) -> Mesh:
    """The free cells of a lattice (height, width) of uint8, nonzero where blocked, as a mesh."""
    height, width = blocked.shape
    rectangles = np.zeros((256, 4), np.int64)
    portals = np.zeros((256, 5), np.int64)
    rows = np.zeros(height + 1, np.int64)
    lower = np.zeros(width // 2 + 2, np.int64)  # rectangles of the runs of the row below
    upper = np.zeros(width // 2 + 2, np.int64)
    lower_count = 0
    count = 0
    doors = 0
    for row in range(height):
        rows[row] = count
        upper_count = 0
        k = 0
        first, last = _next_run(blocked, row, 0)
        while first < last:
            while k < lower_count and rectangles[lower[k], 1] <= first:
                k += 1
            goes_on = (
                k < lower_count
                and rectangles[lower[k], 0] == first
                and rectangles[lower[k], 1] == last
            )
            if goes_on:
                this = lower[k]
            else:
                if count == rectangles.shape[0]:
                    rectangles = _grown(rectangles)
                this = np.int64(count)
                rectangles[this, 0] = first
                rectangles[this, 1] = last
                rectangles[this, 2] = row
                count += 1
                other = k
                while other < lower_count and rectangles[lower[other], 0] < last:
                    if doors == portals.shape[0]:
                        portals = _grown(portals)
                    portals[doors, 0] = max(first, rectangles[lower[other], 0])
                    portals[doors, 1] = min(last, rectangles[lower[other], 1])
                    portals[doors, 2] = row
                    portals[doors, 3] = lower[other]
                    portals[doors, 4] = this
                    doors += 1
                    other += 1
            rectangles[this, 3] = row + 1
            upper[upper_count] = this
            upper_count += 1
            first, last = _next_run(blocked, row, last)
        lower, upper = upper, lower
        lower_count = upper_count
    rows[height] = count
    rectangles = rectangles[:count].copy()
    portals = portals[:doors].copy()
    below, above, turns = _doors(rectangles, portals)
    return Mesh(rectangles, below, above, portals, turns, rows)


@inner
def _doors(rectangles: Ints, portals: Ints) -> tuple[Ints, Ints, Ints]:
    """Each rectangle's portals below and above, and where paths can turn."""
    below = np.zeros((rectangles.shape[0], 2), np.int64)
    above = np.zeros((rectangles.shape[0], 2), np.int64)
    turns = np.zeros((portals.shape[0], 2), np.int64)
    for p in range(portals.shape[0]):
        under = portals[p, 3]
        over = portals[p, 4]
        if above[under, 1] == 0:
            above[under, 0] = p
        above[under, 1] = p + 1
        if below[over, 1] == 0:
            below[over, 0] = p
        below[over, 1] = p + 1
        for side in range(2):
            turns[p, side] = 1 if rectangles[under, side] != rectangles[over, side] else 0
    return below, above, turns


@kernel
def rectangle_at(mesh: Mesh, x: float, y: float) -> int:
    """The rectangle that holds a place, borders included; -1 where there is none.

    A place on the border of a free cell belongs to it, whichever side the rest of the world is.
    """
    height = mesh.rows.size - 1
    for j in (int(np.floor(y)), int(np.ceil(y)) - 1):
        row = min(max(j, 0), height - 1)
        if abs(row + 0.5 - y) > 0.5 + 1e-9:
            continue
        # the rectangle may have begun in any row below
        for r in range(mesh.rows[row + 1] - 1, -1, -1):
            box = mesh.rectangles[r]
            if box[0] - 1e-9 <= x <= box[1] + 1e-9 and box[2] - 1e-9 <= y <= box[3] + 1e-9:
                return r
    return -1
