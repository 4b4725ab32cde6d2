"""How far it is from some cells of a lattice to all others, round what is blocked."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Bytes, Floats, Ints
from viaspline.kernels.jit import kernel

OCTILE_EXCESS = (
    1.0824  # by how much a way of steps to eight neighbours is longer than a straight one at most
)


@kernel
def distance_field(cells: Bytes, sources: Ints) -> Floats:
    """Lengths of the shortest ways through free cells, never too long by the steps' directions.

    Dijkstra's search. There are steps of two lengths, and what is come to by either gets ever
    farther: two lines of cells that wait are in order by themselves, and need no heap.

    Args:
        cells: Nonzero where blocked, (rows, columns).
        sources: Row and column of the cells where the ways begin, free or not, (n, 2).

    Returns:
        In cells, infinite where no way leads, (rows, columns).
    """
    height, width = cells.shape
    lengths = np.full((height, width), np.inf)
    done = np.zeros((height, width), np.uint8)
    room = 4 * height * width + sources.shape[0]
    keys, nodes = np.empty((2, room)), np.empty((2, room), np.int64)
    heads, tails = np.zeros(2, np.int64), np.zeros(2, np.int64)
    for k in range(sources.shape[0]):
        row, column = sources[k, 0], sources[k, 1]
        if 0 <= row < height and 0 <= column < width:
            lengths[row, column] = 0.0
            keys[0, tails[0]], nodes[0, tails[0]] = 0.0, row * width + column
            tails[0] += 1
    while heads[0] < tails[0] or heads[1] < tails[1]:
        line = 0
        if heads[0] == tails[0] or (heads[1] < tails[1] and keys[1, heads[1]] < keys[0, heads[0]]):
            line = 1
        cell = nodes[line, heads[line]]
        heads[line] += 1
        row, column = cell // width, cell % width
        if done[row, column] != 0:
            continue
        done[row, column] = 1
        for r in range(max(0, row - 1), min(height, row + 2)):
            for c in range(max(0, column - 1), min(width, column + 2)):
                if cells[r, c] != 0 or done[r, c] != 0:
                    continue
                aside = 1 if r != row and c != column else 0
                step = math.sqrt(2.0) if aside == 1 else 1.0
                length = lengths[row, column] + step / OCTILE_EXCESS
                if length < lengths[r, c]:
                    lengths[r, c] = length
                    keys[aside, tails[aside]], nodes[aside, tails[aside]] = length, r * width + c
                    tails[aside] += 1
    return lengths
