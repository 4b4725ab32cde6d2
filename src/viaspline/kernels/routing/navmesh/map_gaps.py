"""Gaps between the cells of a map that are too narrow, closed on a finer lattice of its own.

A path crosses the shortest segment between two blocked cells only where half of its length is
room enough: all of its places are nearer than that to one of its ends. Where all segments that
are too short are closed, what still can be reached is just what the robot can reach.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Bytes, Ints
from viaspline.kernels.jit import inlined, inner, kernel


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


@inner
def _open_up_to(cells: Bytes, rows: int, columns: int, row0: int, column0: int, parts: int) -> Ints:
    """How many of the map's cells up to a row and a column aren't covered all over.

    Returns:
        Shape (rows + 1, columns + 1).
    """
    total = np.zeros((rows + 1, columns + 1), np.int64)
    for row in range(rows):
        in_row = 0
        for column in range(columns):
            is_open = False
            for k in range(parts * parts):
                x = column0 + parts * column + k % parts
                y = row0 + parts * row + k // parts
                if not _is_covered(cells, float(x), float(y)):
                    is_open = True
                    break
            in_row += int(is_open)
            total[row + 1, column + 1] = total[row, column + 1] + in_row
    return total


@inner
def _next_blocked(blocked: Bytes) -> Ints:
    """The first blocked column from each place of a row on; beyond all columns without one."""
    rows, columns = blocked.shape
    found = np.full((rows, columns + 1), columns)
    for row in range(rows):
        for column in range(columns - 1, -1, -1):
            found[row, column] = found[row, column + 1] if blocked[row, column] == 0 else column
    return found


@kernel
def close_gaps(
    blocked: Bytes, width: float, row0: int, column0: int, parts: int, cells: Bytes
) -> None:
    """Close the gaps of a map that are narrower than ``width``.

    Cells round about which all is covered close none, and are most of a map's.

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
    half = most // 2 + 2  # of the map's cells: no middle of a gap lies farther off
    total = _open_up_to(cells, rows, columns, row0, column0, parts)
    following = _next_blocked(blocked)
    for row in range(rows):
        low = min(row + half, rows)
        for column in range(columns):
            if blocked[row, column] == 0:
                continue
            left, right = max(column - half, 0), min(column + half + 1, columns)
            if total[low, right] - total[row, right] - total[low, left] + total[row, left] == 0:
                continue
            for dy in range(most):
                other = row + 1 + dy
                if other >= rows:
                    break
                partner = following[other, max(column - most, 0)]
                while partner <= min(column + most, columns - 1):
                    dx = partner - column
                    aside = max(abs(dx) - 1, 0)  # free columns between the two
                    partner = following[other, partner + 1]
                    if aside * aside + dy * dy >= width * width:
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
