"""How wide what stands in a lane is, along it or across it.

Of a map that is what stands together about the place where the lane is blocked: a shelf in a hall
is an island, a wall of the hall is as wide as anything that is looked for.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.maps.grid import Grid
from viaspline.planning.turning.lane import Lane
from viaspline.world.world import World

SQUARES = 96  # on each side of a place on a map, that are looked at: cells, or blocks of cells


def width_in(world: World, lane: Lane, place: Floats, index: int, reach: float) -> float:
    """Of what blocks a lane at a place, along the lane or across it, whichever is more [m].

    Args:
        world: What stands there.
        lane: The lane.
        place: On it [m], (2,).
        index: Of the obstacle there, as ``World.nearest`` says it.
        reach: How far off a map is looked at [m]; infinite where something goes on beyond.

    Returns:
        0 of bounds and fences, of which only a part can be in the way.
    """
    if index < 0:
        return 0.0
    obstacle = world.obstacles[index]
    if obstacle.ring is not None:
        extents = np.ptp(lane.seen(obstacle.ring.vertices), axis=0)
        return float(extents.max()) + 2.0 * obstacle.ring.radius
    assert obstacle.grid is not None
    return _width_on_map(obstacle.grid, lane, place, reach)


def _width_on_map(grid: Grid, lane: Lane, place: Floats, reach: float) -> float:
    from scipy.ndimage import label

    cells, first, size = _about(grid, place, reach)
    labels: NDArray[Any] = label(cells, structure=np.ones((3, 3)))[0]
    blocked = np.argwhere(cells)[:, ::-1]  # column, row
    if not len(blocked):
        return 0.0
    middle = grid.to_cells(place[None, :])[0]
    off = first + size * (blocked + 0.5) - middle
    column, row = blocked[np.argmin(np.sum(off * off, axis=1))].tolist()
    island = np.argwhere(labels == labels[row, column])[:, ::-1]
    ends = np.vstack((island.min(axis=0), island.max(axis=0)))
    if ends.min() == 0 or (ends[1] == np.array(cells.shape)[::-1] - 1).any():
        return math.inf
    corners = np.vstack([island + off for off in ((0, 0), (0, 1), (1, 0), (1, 1))])
    return float(np.ptp(lane.seen(grid.to_world(first + size * corners)), axis=0).max())


def _about(
    grid: Grid, place: Floats, reach: float
) -> tuple[NDArray[np.bool_], NDArray[np.int64], int]:
    """The blocked squares about a place, a rim of free ones where the map ends.

    Returns:
        Which of them are blocked, (rows, columns); column and row of the first cell; and how many
        cells a square has along its side.
    """
    half = max(math.ceil(reach / grid.resolution), 1)
    size = math.ceil(half / SQUARES)
    count = 2 * math.ceil(half / size) + 1
    middle = np.floor(grid.to_cells(place[None, :])[0]).astype(np.int64)
    first = middle - size * (count // 2) - size // 2
    cells = np.zeros((size * count, size * count), np.bool_)
    low = np.clip(first, 0, (grid.width, grid.height))
    high = np.clip(first + size * count, 0, (grid.width, grid.height))
    at, to = low - first, high - first
    cells[at[1] : to[1], at[0] : to[0]] = grid.blocked[low[1] : high[1], low[0] : high[0]]
    squares = np.logical_or.reduce(cells.reshape(count, size, count, size), axis=(1, 3))
    return squares, first, size
