"""The blocked cells of a map grown by a distance, on the map's own lattice."""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Bytes
from viaspline.kernels.jit import kernel


@kernel
def grow_into(blocked: Bytes, reach: float, row0: int, column0: int, cells: Bytes) -> None:
    """Block the cells of a lattice whose middle is nearer than ``reach`` to a blocked square.

    Args:
        blocked: The map's cells, nonzero where blocked, (height, width).
        reach: In cells.
        row0: Row of the lattice in which the map's row 0 lies.
        column0: The same for columns.
        cells: The lattice, written in place; of the same size of cell, and aligned.
    """
    height, width = blocked.shape
    rows, columns = cells.shape
    around = math.ceil(reach + 0.5)
    for row in range(height):
        column = 0
        while column < width:
            while column < width and blocked[row, column] == 0:
                column += 1
            first = column
            while column < width and blocked[row, column] != 0:
                column += 1
            if first == column:
                break
            for k in range(-around, around + 1):
                target = row + row0 + k
                gap = max(abs(k) - 0.5, 0.0)
                if gap >= reach or target < 0 or target >= rows:
                    continue
                aside = math.sqrt(reach * reach - gap * gap)
                low = max(0, math.floor(first + column0 - 0.5 - aside) + 1)
                high = min(columns, math.ceil(column + column0 - 0.5 + aside))
                for c in range(low, high):
                    cells[target, c] = 1
