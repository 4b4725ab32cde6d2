"""How many steps it is from every cell of a lattice to a goal."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Steps
from viaspline.kernels.jit import kernel

FAR = 1 << 29
"""Steps to a goal from where there is no way to it."""


@kernel
def lattice_distances(neighbours: Steps, goals: Steps) -> Steps:
    """Steps from every cell to every goal; ``FAR`` where there is no way.

    Args:
        neighbours: The cells next to each cell, -1 where there is none, (cells, k).
        goals: Cells, (n,).

    Returns:
        (n, cells).
    """
    cells, width = neighbours.shape
    distances = np.full((len(goals), cells), FAR, np.int32)
    queue = np.empty(cells, np.int32)
    for robot in range(len(goals)):
        distances[robot, goals[robot]] = 0
        queue[0] = goals[robot]
        end = 1
        for at in range(cells):
            if at == end:
                break
            cell = queue[at]
            further = distances[robot, cell] + 1
            for k in range(width):
                other = neighbours[cell, k]
                if other >= 0 and distances[robot, other] == FAR:
                    distances[robot, other] = further
                    queue[end] = other
                    end += 1
    return distances
