"""A world as a lattice of free and blocked cells, on which guides through it are found."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Bytes, Floats
from viaspline.kernels.routing.navmesh.dilate import grow_into
from viaspline.kernels.routing.navmesh.polyanya import shortest_path
from viaspline.kernels.routing.navmesh.rectangles import Mesh, mesh_of
from viaspline.kernels.world.rasterize import mark_segments, rasterized
from viaspline.maps.grid import Grid
from viaspline.world.world import World

Box = tuple[float, float, float, float]

HALF_DIAGONAL = math.sqrt(0.5)  # of a cell of side 1
CELLS_WANTED, MAX_CELLS = 2**16, 2**20  # of a lattice of obstacles without maps
MAX_MAP_CELLS = 2**27  # of a lattice with maps
MAX_LATTICES = 3  # each with cells half as wide as those of the one before
MISALIGNMENT = 1e-9  # what a map may lie off the lattice, in cells
NO_CELLS: Bytes = np.empty((0, 0), np.uint8)


@dataclass(frozen=True)
class Lattice:
    """Square cells; the middle of the robot may be in those that are free.

    Attributes:
        x: Outer corner of cell (0, 0), its first coordinate [m].
        y: Outer corner of cell (0, 0), the other coordinate [m].
        side: Of a cell [m].
        cells: Nonzero where blocked, (height, width).
        is_open: Whether every place with the room that is required lies in a free cell, so that
            where the lattice has no path there is none at all.
    """

    x: float
    y: float
    side: float
    cells: Bytes
    is_open: bool

    @cached_property
    def mesh(self) -> Mesh:
        """Its free space."""
        mesh: Mesh = mesh_of(self.cells)
        return mesh

    def guide(self, start: Floats, goal: Floats) -> Floats | None:
        """The shortest path through free cells [m], (k, 2); None where there is none."""
        a, b = (self._cell(place) for place in (start, goal))
        path: Floats = shortest_path(self.mesh, a, b)
        if not len(path):
            return None
        guide = path * self.side + (self.x, self.y)
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

    def without(self, segments: Floats) -> Lattice:
        """This lattice with the cells blocked that some segments (n, 4) [m] pass through."""
        cells = self.cells.copy()
        mark_segments(np.ascontiguousarray(segments), self.x, self.y, self.side, cells)
        return Lattice(self.x, self.y, self.side, cells, self.is_open)

    def _cell(self, place: Floats) -> Floats:
        cell: Floats = (np.asarray(place[:2]) - (self.x, self.y)) / self.side
        return cell


def lattices(world: World, required: float, places: Floats) -> Iterator[Lattice]:
    """Lattices of a world for a robot that needs ``required`` [m] around its middle, ever finer.

    Args:
        world: What to keep clear of.
        required: [m].
        places: Where the robot has to get to [m], (n, 2).
    """
    x0, y0, x1, y1 = _box(world, required, places)
    grids = [obstacle.grid for obstacle in world.obstacles if obstacle.grid is not None]
    area = (x1 - x0) * (y1 - y0)
    native = _native(world, required, (x0, y0, x1, y1))
    if native is not None:
        yield native
        return
    wanted = required / (2.0 * HALF_DIAGONAL)
    if grids:
        finest = min(grid.resolution for grid in grids)
        side = finest / max(1.0, math.ceil(finest / wanted - 1e-9))
        side = max(side, math.sqrt(area / MAX_MAP_CELLS))
        x0, y0 = (
            _snapped(low, at, side) for low, at in zip((x0, y0), grids[0].origin, strict=False)
        )
    else:
        side = min(wanted, math.sqrt(area / CELLS_WANTED))
        side = max(side, math.sqrt(area / MAX_CELLS))
    for _ in range(MAX_LATTICES):
        if area / side**2 > 2 * MAX_MAP_CELLS:
            return
        yield _rasterized(world, required, (x0, y0, x1, y1), side)
        side *= 0.5


def _rasterized(world: World, required: float, box: Box, side: float) -> Lattice:
    x0, y0, x1, y1 = box
    height, width = math.ceil((y1 - y0) / side - 1e-9), math.ceil((x1 - x0) / side - 1e-9)
    reach = max(required - HALF_DIAGONAL * side, HALF_DIAGONAL * side)
    grown = _grown_maps(world, reach, (x0, y0), side, (height, width))
    cells = rasterized(world.packed, x0, y0, side, height, width, reach, grown)
    return Lattice(x0, y0, side, cells, reach <= required - HALF_DIAGONAL * side + 1e-12)


def _grown_maps(
    world: World, reach: float, low: tuple[float, float], side: float, shape: tuple[int, int]
) -> Bytes:
    """The maps' cells grown by ``reach``; nothing unless all of them lie on the lattice."""
    grids = [obstacle.grid for obstacle in world.obstacles if obstacle.grid is not None]
    places = [_place_on(grid, low, side) for grid in grids]
    if not grids or None in places:
        return NO_CELLS
    cells = np.zeros(shape, np.uint8)
    for grid, place in zip(grids, places, strict=True):
        assert place is not None
        row, column, parts = place
        blocked = grid.blocked.astype(np.uint8)
        if parts > 1:
            blocked = blocked.repeat(parts, axis=0).repeat(parts, axis=1)
        grow_into(blocked, reach / side, row, column, cells)
    return cells


def _place_on(grid: Grid, low: tuple[float, float], side: float) -> tuple[int, int, int] | None:
    """Row and column of a lattice where a map's first cell begins, and its cells aside in one.

    None if it lies across them.
    """
    x, y, yaw = grid.origin
    numbers = np.array([(y - low[1]) / side, (x - low[0]) / side, grid.resolution / side])
    whole = np.round(numbers)
    if yaw != 0.0 or whole[2] < 1 or (np.abs(numbers - whole) > MISALIGNMENT * whole[2]).any():
        return None
    row, column, parts = whole.astype(int).tolist()
    return row, column, parts


def _native(world: World, required: float, box: Box) -> Lattice | None:
    """A map's own cells, and free ones round them as far as the box goes.

    None unless a robot that needs ``required`` gets through wherever free cells of a lone map meet.
    """
    grid = world.obstacles[0].grid if len(world) == 1 and not world.enclosures else None
    if grid is None or grid.origin[2] != 0.0 or required >= 0.5 * grid.resolution:
        return None
    low, high = np.array(grid.extent).reshape(2, 2)
    beyond = np.array((low - box[:2], box[2:] - high)) / grid.resolution
    cells = np.round(beyond) if world.bounds is not None else np.ceil(beyond)
    is_cut = world.bounds is not None and (np.abs(beyond - cells) > MISALIGNMENT).any()
    width, height = (high - low) / grid.resolution + cells.sum(axis=0)
    if is_cut or (cells < 0).any() or width * height > MAX_MAP_CELLS:
        return None
    (left, down), (right, up) = cells.astype(int).tolist()
    free = np.pad(grid.blocked.astype(np.uint8), ((down, up), (left, right)))
    x, y = low - (left, down) * np.array(grid.resolution)
    return Lattice(float(x), float(y), grid.resolution, free, is_open=True)


def _snapped(low: float, at: float, side: float) -> float:
    """The lattice line through multiples of ``side`` from ``at`` on, at ``low`` or just below."""
    return at + math.floor((low - at) / side + 1e-9) * side


def _box(world: World, required: float, places: Floats) -> Box:
    """What the lattice has to cover [m]: the bounds, or everything with a way round it."""
    if world.bounds is not None:
        return world.bounds
    low, high = places.min(axis=0), places.max(axis=0)
    if world.enclosures:
        ring = np.concatenate([np.array(fence) for fence in world.enclosures])
        return (*np.minimum(low, ring.min(axis=0)), *np.maximum(high, ring.max(axis=0)))
    if len(world):
        box = world.packed.boxes[0]
        low, high = np.minimum(low, box[:2]), np.maximum(high, box[2:])
    margin = 4.0 * required + 0.01 * float(np.max(high - low))
    return (*(low - margin), *(high + margin))
