"""The blocked cells of a map grown by a distance, on a lattice of its cells or of parts of them."""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Bytes
from viaspline.kernels.jit import inlined, kernel


@inlined
def _grow_run(cells: Bytes, first: int, last: int, bottom: int, top: int, reach: float) -> None:
    """Block the cells whose middle is nearer than ``reach`` to a box first:last, bottom:top."""
    rows, columns = cells.shape
    around = math.ceil(reach + 0.5)
    for row in range(max(0, bottom - around), min(rows, top + around)):
        gap = max(max(bottom - row - 0.5, row + 0.5 - top), 0.0)
        if gap >= reach:
            continue
        aside = math.sqrt(reach * reach - gap * gap)
        low = max(0, math.floor(first - 0.5 - aside) + 1)
        high = min(columns, math.ceil(last - 0.5 + aside))
        for column in range(low, high):
            cells[row, column] = 1


@kernel
def grow_into(
    blocked: Bytes, reach: float, row0: int, column0: int, parts: int, cells: Bytes
) -> None:
    """Block the cells of a lattice whose middle is nearer than ``reach`` to a blocked square.

    Args:
        blocked: The map's cells, nonzero where blocked, (height, width).
        reach: In cells of the lattice.
        row0: Row of the lattice in which the map's row 0 begins.
        column0: The same for columns.
        parts: Cells of the lattice aside in one of the map's.
        cells: The lattice, written in place.
    """
    height, width = blocked.shape
    for row in range(height):
        bottom = row0 + parts * row
        column = 0
        while column < width:
            while column < width and blocked[row, column] == 0:
                column += 1
            first = column
            while column < width and blocked[row, column] != 0:
                column += 1
            if first < column:
                left = column0 + parts * first
                right = column0 + parts * column
                _grow_run(cells, left, right, bottom, bottom + parts, reach)
