"""Faults in map files.

Tested through ``maps/test_map_server``, ``maps/test_movingai``, ``maps/test_svg`` and
``maps/test_esri_ascii``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

import numpy as np

from viaspline.errors import Fault, MissionError
from viaspline.kernels.arrays import Floats
from viaspline.maps.grid import MOST_CELLS_ASIDE
from viaspline.maps.terrain import MOST_NODES_ASIDE
from viaspline.maps.voxels import MOST_VOXELS_ASIDE

MOST_NODES: Final = 50_000_000
"""How many heights of a terrain are read at most: 0.4 GB of them."""
MOST_HEIGHT_M: Final = 1e9
"""The farthest from 0 that a height may be, as all coordinates of a mission."""
MOST_CUBES: Final = 1_000_000_000
"""How many voxels are read at most: 1 GB of them."""


def refusal(
    source: str | Path,
    problem: str,
    remedy: str,
    *,
    key: str = "",
    at: tuple[int, int] | None = None,
) -> MissionError:
    """An error with a single fault.

    Args:
        source: The file.
        problem: What is wrong.
        remedy: What would be right.
        key: Where in the file, in its own words.
        at: Line and column, from 1; None where it has none.
    """
    line, column = at if at is not None else (None, None)
    return MissionError([Fault(key, problem, remedy, str(source), line, column)])


def check_size(source: str | Path, width: int, height: int) -> None:
    """Refuse a map without cells and one that is too large, before anything is made for it.

    Raises:
        MissionError: It has no cell, or too many aside.
    """
    if width < 1 or height < 1:
        raise refusal(source, f"the map has {width} x {height} cells", "give at least one")
    if max(width, height) > MOST_CELLS_ASIDE:
        problem = f"the map has {width} x {height} cells"
        raise refusal(source, problem, f"cut it: at most {MOST_CELLS_ASIDE} aside are read")


def check_heights(source: str | Path, heights: Floats) -> None:
    """Refuse heights that nothing on earth has: mostly a mark of "no data" that isn't declared.

    Args:
        source: The file.
        heights: All of them, NaN where none is known [m].

    Raises:
        MissionError: There is one.
    """
    absurd = heights[np.abs(heights) > MOST_HEIGHT_M]
    if absurd.size:
        problem = f"a height is {absurd[0]:g} m"
        raise refusal(source, problem, "say that it is the nodata value, or correct it")


def check_nodes(source: str | Path, columns: int, rows: int) -> None:
    """Refuse a terrain of less than a patch and one that is too large, before it is read.

    Raises:
        MissionError: It has fewer than two heights aside, or too many.
    """
    size = f"the terrain has {columns} x {rows} heights"
    if min(columns, rows) < 2:
        raise refusal(source, size, "give at least 2 x 2")
    if max(columns, rows) > MOST_NODES_ASIDE or columns * rows > MOST_NODES:
        remedy = "cut it, or take every second height: at most"
        raise refusal(source, size, f"{remedy} {MOST_NODES_ASIDE} aside, {MOST_NODES} in all")


def check_cubes(source: str | Path, shape: tuple[int, int, int]) -> None:
    """Refuse voxels that are none and those that are too many, before anything is made for them.

    Raises:
        MissionError: There is no voxel, or there are too many.
    """
    nx, ny, nz = shape
    size = f"the file has {nx} x {ny} x {nz} voxels"
    if min(shape) < 1:
        raise refusal(source, size, "give at least one")
    if max(shape) > MOST_VOXELS_ASIDE or nx * ny * nz > MOST_CUBES:
        remedy = "cut it, or make its cubes larger: at most"
        raise refusal(source, size, f"{remedy} {MOST_VOXELS_ASIDE} aside, {MOST_CUBES} in all")
