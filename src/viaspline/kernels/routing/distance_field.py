"""How far it is from some cells of a lattice to all others, round what is blocked."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Bytes, Floats, Ints
from viaspline.kernels.heap import Heap, pop, push
from viaspline.kernels.jit import kernel

OCTILE_EXCESS = (
    1.0824  # by how much a way of steps to eight neighbours is longer than a straight one at most
)


@kernel
def distance_field(cells: Bytes, sources: Ints) -> Floats:
    """Lengths of the shortest ways through free cells, never too long by the steps' directions.

    Args:
        cells: Nonzero where blocked, (rows, columns).
        sources: Row and column of the cells where the ways begin, free or not, (n, 2).

    Returns:
        In cells, infinite where no way leads, (rows, columns).
    """
    height, width = cells.shape
    lengths = np.full((height, width), np.inf)
    done = np.zeros((height, width), np.uint8)
    room = 8 * height * width + sources.shape[0]
    heap = Heap(np.empty(room), np.empty(room, np.int64), np.zeros(1, np.int64))
    for k in range(sources.shape[0]):
        row, column = sources[k, 0], sources[k, 1]
        if 0 <= row < height and 0 <= column < width:
            lengths[row, column] = 0.0
            push(heap, 0.0, row * width + column)
    while heap.size[0] > 0:
        cell = pop(heap)
        row, column = cell // width, cell % width
        if done[row, column] != 0:
            continue
        done[row, column] = 1
        for r in range(max(0, row - 1), min(height, row + 2)):
            for c in range(max(0, column - 1), min(width, column + 2)):
                if cells[r, c] != 0 or done[r, c] != 0:
                    continue
                step = math.sqrt(2.0) if r != row and c != column else 1.0
                length = lengths[row, column] + step / OCTILE_EXCESS
                if length < lengths[r, c]:
                    lengths[r, c] = length
                    push(heap, length, r * width + c)
    return lengths
