"""Places in a grid of square cells, which may move: each cell is a list that is linked both ways.

Tested through ``fleet/test_swerved_fleet``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.growable import new_ints
from viaspline.kernels.jit import inlined, inner, kernel, uncounted

NONE = -1
NEXT, BEFORE, CELL = 0, 1, 2
MOST_CELLS = 1 << 24
"""A grid has no more cells; they are wider than asked for where it would."""


class LinkedGrid(NamedTuple):
    """Which places are in which cell. What lies beyond the grid counts to its outermost cells.

    Attributes:
        frame: x and y of its corner, and how wide cells are [m], (3,).
        counts: Columns and rows, (2,).
        head: The first place in each cell, or ``NONE``, (columns * rows,).
        links: Of each place: the next one in its cell, the one before, the cell, (n, 3).
    """

    frame: Floats
    counts: Ints
    head: Ints
    links: Ints


@inlined
def column_of(grid: LinkedGrid, axis: int, at: float) -> int:
    """The column of cells, or the row, in which a coordinate lies [m]."""
    k = int(np.floor((at - grid.frame[axis]) / grid.frame[2]))
    return min(max(k, 0), grid.counts[axis] - 1)


@uncounted
def put_place(grid: LinkedGrid, k: int, x: float, y: float) -> None:
    """Put place k, which is in no cell, where it is [m]."""
    cell = column_of(grid, 0, x) * grid.counts[1] + column_of(grid, 1, y)
    after = grid.head[cell]
    grid.links[k, NEXT], grid.links[k, BEFORE], grid.links[k, CELL] = after, NONE, cell
    if after != NONE:
        grid.links[after, BEFORE] = k
    grid.head[cell] = k


@uncounted
def take_place(grid: LinkedGrid, k: int) -> None:
    """Take place k out of its cell."""
    before, after = grid.links[k, BEFORE], grid.links[k, NEXT]
    if before == NONE:
        grid.head[grid.links[k, CELL]] = after
    else:
        grid.links[before, NEXT] = after
    if after != NONE:
        grid.links[after, BEFORE] = before


@inner
def _widest(places: Floats, axis: int) -> tuple[float, float]:
    """The least and the greatest coordinate of places [m]."""
    low, high = np.inf, -np.inf
    for k in range(places.shape[0]):
        low, high = min(low, places[k, axis]), max(high, places[k, axis])
    return low, high


@kernel
def new_linked_grid(places: Floats, width: float) -> LinkedGrid:
    """A grid that holds places.

    Args:
        places: [m], (n, 2).
        width: Of a cell, at least [m].
    """
    frame, counts = np.zeros(3), np.ones(2, np.int64)
    frame[2] = width
    if places.shape[0] > 0:
        low_x, high_x = _widest(places, 0)
        low_y, high_y = _widest(places, 1)
        frame[0], frame[1] = low_x, low_y
        while ((high_x - low_x) / frame[2] + 1.0) * (
            (high_y - low_y) / frame[2] + 1.0
        ) > MOST_CELLS:
            frame[2] *= 2.0
        counts[0] = int((high_x - low_x) / frame[2]) + 1
        counts[1] = int((high_y - low_y) / frame[2]) + 1
    head = np.full(counts[0] * counts[1], NONE)
    grid = LinkedGrid(frame, counts, head, new_ints(places.shape[0], 3))
    for k in range(places.shape[0]):
        put_place(grid, k, places[k, 0], places[k, 1])
    return grid
