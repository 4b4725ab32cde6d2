"""Gaps between the cells of a map that are too narrow, closed on a finer lattice of its own.

A path crosses the shortest segment between two blocked cells only where half of its length is
room enough: all of its places are nearer than that to one of its ends. Where all segments that
are too short are closed, what still can be reached is just what the robot can reach.

Tested through ``planning/routing/test_lattice_route``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Bytes
from viaspline.kernels.jit import inlined, kernel


@inlined
def _is_covered(cells: Bytes, x: float, y: float) -> bool:
    """Whether all cells round a place are blocked."""
    height, width = cells.shape
    for row in range(max(0, int(y) - 1), min(height, int(y) + 2)):
        for column in range(max(0, int(x) - 1), min(width, int(x) + 2)):
            if cells[row, column] == 0:
                return False
    return True


@inlined
def _close(cells: Bytes, ax: float, ay: float, bx: float, by: float) -> None:
    """Block the cells that a segment passes through, a-b in cells."""
    height, width = cells.shape
    steps = max(1, math.ceil(4.0 * max(abs(bx - ax), abs(by - ay))))
    last = -1
    for k in range(steps + 1):
        column = min(max(int(ax + (bx - ax) * k / steps), 0), width - 1)
        row = min(max(int(ay + (by - ay) * k / steps), 0), height - 1)
        cells[row, column] = 1
        if last >= 0 and last != row * width + column:  # no way leads between two corners
            cells[last // width, column] = 1
        last = row * width + column


@kernel
def close_gaps(
    blocked: Bytes, width: float, row0: int, column0: int, parts: int, cells: Bytes
) -> None:
    """Close the gaps of a map that are narrower than ``width``.

    Args:
        blocked: The map's cells, nonzero where blocked, (height, width).
        width: In the map's cells.
        row0: Row of the lattice in which the map's row 0 begins.
        column0: The same for columns.
        parts: Cells of the lattice aside in one of the map's.
        cells: The lattice, written in place; what is nearer to the map than half of ``width``, but
            for a cell or so, is blocked already.
    """
    rows, columns = blocked.shape
    most = math.ceil(width)
    for row in range(rows):
        for column in range(columns):
            if blocked[row, column] == 0:
                continue
            for dy in range(most):
                other = row + 1 + dy
                if other >= rows:
                    break
                for dx in range(-most, most + 1):
                    aside = max(abs(dx) - 1, 0)  # free columns between the two
                    if aside * aside + dy * dy >= width * width:
                        continue
                    partner = column + dx
                    if not 0 <= partner < columns or blocked[other, partner] == 0:
                        continue
                    x = column + 0.5 if dx == 0 else float(column + (1 if dx > 0 else 0))
                    across = x + (aside if dx > 0 else -aside)
                    ax = column0 + parts * x
                    ay = row0 + parts * (row + 1.0)
                    bx = column0 + parts * across
                    by = ay + parts * dy
                    if not _is_covered(cells, 0.5 * (ax + bx), 0.5 * (ay + by)):
                        _close(cells, ax, ay, bx, by)
            for dx in range(1, most + 1):  # in the same row
                if dx < width and column + 1 + dx < columns and blocked[row, column + 1 + dx] != 0:
                    ax = column0 + parts * (column + 1.0)
                    ay = row0 + parts * (row + 0.5)
                    if not _is_covered(cells, ax + 0.5 * parts * dx, ay):
                        _close(cells, ax, ay, ax + parts * dx, ay)
