"""Square cells over a world, free and blocked, on which guides through it are found."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Bytes, Floats
from viaspline.kernels.routing.navmesh.polyanya import shortest_path
from viaspline.kernels.routing.navmesh.rectangles import Mesh, mesh_of
from viaspline.kernels.world.rasterize import mark_segments

MAX_ENTRY_CELLS = 6  # from a place to the free cell through which the lattice is entered


@dataclass(frozen=True)
class Lattice:
    """Square cells; the middle of the robot may be in those that are free.

    Attributes:
        x: Outer corner of cell (0, 0), its first coordinate [m].
        y: Outer corner of cell (0, 0), the other coordinate [m].
        side: Of a cell [m].
        cells: Nonzero where blocked, (height, width).
        kept: Distance from the world that all places keep which are half a cell from blocked ones,
            and the middles of free cells [m].
        is_open: Whether a way that keeps the distance leads on through free cells, so that where
            the lattice has no path there is no way.
        is_fine: Whether that is still so when a gap that is too narrow is closed, and with it the
            whole cells that the segment across it passes through.
    """

    x: float
    y: float
    side: float
    cells: Bytes
    kept: float
    is_open: bool
    is_fine: bool

    @cached_property
    def mesh(self) -> Mesh:
        """Its free space."""
        mesh: Mesh = mesh_of(self.cells)
        return mesh

    def guide(self, start: Floats, goal: Floats) -> Floats | None:
        """Through the same cells as the shortest path [m], (k, 2); None where there is none.

        Between the cells of start and goal it is nowhere nearer than half a cell to blocked ones.
        """
        a, b = ((np.asarray(end[:2]) - (self.x, self.y)) / self.side for end in (start, goal))
        middles: Floats = shortest_path(self.mesh, a, b)[1]
        if not len(middles):
            return None
        guide = middles * self.side + (self.x, self.y)
        guide[0], guide[-1] = start[:2], goal[:2]
        return guide

    def at(self, values: NDArray[Any], places: Floats) -> NDArray[Any]:
        """What is written in the cells of some places (n, 2) [m]; zero off the lattice."""
        column, row = np.floor((places - (self.x, self.y)) / self.side).astype(np.int64).T
        height, width = self.cells.shape
        inside = (row >= 0) & (row < height) & (column >= 0) & (column < width)
        found = np.zeros(len(places), values.dtype)
        found[inside] = values[row[inside], column[inside]]
        return found

    def is_free(self, place: Floats) -> bool:
        """Whether the cell that a place lies in is free; not off the lattice."""
        x, y = place[:2].tolist()
        column, row = math.floor((x - self.x) / self.side), math.floor((y - self.y) / self.side)
        height, width = self.cells.shape
        return 0 <= row < height and 0 <= column < width and not self.cells[row, column]

    def free_middles_near(self, place: Floats) -> Floats:
        """Middles of the free cells about a place, the nearest first [m], (n, 2)."""
        column, row = np.floor((place[:2] - (self.x, self.y)) / self.side).astype(np.int64)
        height, width = self.cells.shape
        low = max(0, row - MAX_ENTRY_CELLS), max(0, column - MAX_ENTRY_CELLS)
        high = min(height, row + MAX_ENTRY_CELLS + 1), min(width, column + MAX_ENTRY_CELLS + 1)
        free = np.argwhere(self.cells[low[0] : high[0], low[1] : high[1]] == 0) + low
        middles = (free[:, ::-1] + 0.5) * self.side + (self.x, self.y)
        away = np.hypot(*(middles - place[:2]).T)
        nearest: Floats = middles[np.argsort(away, kind="stable")]
        return nearest

    def without(self, segments: Floats) -> Lattice:
        """This lattice with the cells blocked that some segments (n, 4) [m] pass through."""
        cells = self.cells.copy()
        mark_segments(np.ascontiguousarray(segments), self.x, self.y, self.side, cells)
        return replace(self, cells=cells)
