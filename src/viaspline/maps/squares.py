"""Exact distances to the squares of a grid, and the ground that they cover.

The blocked ground is the union of the blocked squares, their edges with it; what is outside of the
grid's rectangle is free. Only the squares near a place are looked at.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Flags
from viaspline.maps.grid import Grid

MOST_CELLS_DRAWN: Final = 256
"""Squares aside from which on the ground of a window is drawn coarser than it is."""

_FIRST_REACH_CELLS: Final = 8.0  # squares


def signed_distance(grid: Grid, place: Sequence[float], reach: float) -> float:
    """How far a place is from the blocked ground.

    Args:
        grid: The grid.
        place: x, y [m].
        reach: How far to look [m].

    Returns:
        The distance [m]; inside, less than 0: how far it is to the way out. Infinite if nothing
        is in reach.

    >>> grid = Grid([[0, 0, 0], [0, 1, 0], [0, 0, 0]], resolution=1.0)
    >>> [signed_distance(grid, place, 9) for place in [(0, 0), (1.5, 1.75), (4, 1.5)]]
    [1.4142135623730951, -0.25, 2.0]
    """
    u, v = grid.to_cells([place])[0].tolist()
    outside = _nearest(grid.blocked, True, u, v, reach / grid.resolution)
    if outside > 0:
        return outside * grid.resolution
    to_edge: float = max(min(u, grid.width - u, v, grid.height - v), 0.0)
    look = _FIRST_REACH_CELLS
    while (way_out := _nearest(grid.blocked, False, u, v, look)) > look < to_edge:
        look *= 2
    return -min(way_out, to_edge) * grid.resolution


def _nearest(blocked: Flags, wanted: bool, u: float, v: float, reach: float) -> float:
    """The distance of the nearest square of a kind, in squares; infinite if out of reach."""
    import shapely

    height, width = blocked.shape
    bottom, top = max(math.ceil(v - reach) - 1, 0), min(math.floor(v + reach) + 1, height)
    left, right = max(math.ceil(u - reach) - 1, 0), min(math.floor(u + reach) + 1, width)
    if bottom >= top or left >= right:
        return math.inf
    rows, starts, ends = _runs(blocked[bottom:top, left:right] == wanted)
    runs = shapely.box(left + starts, bottom + rows, left + ends, bottom + rows + 1)
    nearest = float(shapely.distance(runs, shapely.Point(u, v)).min(initial=math.inf))
    return nearest if nearest <= reach else math.inf


def is_unknown(grid: Grid, place: Sequence[float]) -> bool:
    """Whether a place lies in a square that nothing is known of."""
    if grid.unknown is None:
        return False
    column, row = np.floor(grid.to_cells([place])[0]).astype(int).tolist()
    is_inside = 0 <= column < grid.width and 0 <= row < grid.height
    return is_inside and bool(grid.unknown[row, column])


def blocked_ground(grid: Grid, box: Sequence[float]) -> Any:
    """The blocked ground in and round a box, as a geometry of shapely.

    In a box of many squares it is drawn with larger ones: somewhat more is blocked then, never
    less.

    Args:
        grid: The grid.
        box: x_min, y_min, x_max, y_max [m].
    """
    import shapely

    x0, y0, x1, y1 = box
    cells = grid.to_cells([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
    left, bottom = np.maximum(np.floor(cells.min(axis=0)), 0).astype(int).tolist()
    limit = (grid.width, grid.height)
    right, top = np.minimum(np.ceil(cells.max(axis=0)), limit).astype(int).tolist()
    if left >= right or bottom >= top:
        return shapely.GeometryCollection()
    window = grid.blocked[bottom:top, left:right]
    size = -(-max(window.shape) // MOST_CELLS_DRAWN)
    rows, starts, ends = _runs(_coarser(window, size))
    low = np.column_stack((left + starts * size, bottom + rows * size))
    high = np.column_stack((left + ends * size, bottom + (rows + 1) * size))
    corners = [low, np.column_stack((high[:, 0], low[:, 1])), high]
    corners.append(np.column_stack((low[:, 0], high[:, 1])))
    rings = np.stack([grid.to_world(corner) for corner in corners], axis=1)
    return shapely.union_all(shapely.polygons(rings))


def _coarser(window: Flags, size: int) -> Flags:
    """Larger squares, each blocked where one of those that it is made of is."""
    if size == 1:
        return window
    height, width = window.shape
    padded = np.pad(window, ((0, -height % size), (0, -width % size)))
    blocks = padded.reshape(len(padded) // size, size, -1, size)
    return np.asarray(blocks.any(axis=(1, 3)))


def _runs(window: Flags) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
    """Row, first column and column after the last of every run of blocked squares."""
    closed = np.pad(window.astype(np.int8), ((0, 0), (1, 1)))
    change = np.diff(closed, axis=1)
    rows, starts = np.nonzero(change == 1)
    _, ends = np.nonzero(change == -1)
    return rows, starts, ends
