"""A window of a world, made ready for searches through poses in both directions.

Tested through ``planning/turning/hybrid_astar/test_pose_search``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from viaspline.kernels.arrays import Bytes, Floats, Ints
from viaspline.kernels.routing.distance_field import distance_field
from viaspline.kernels.turning.collision_cache import (
    COARSE_CELLS,
    HALF_DIAGONAL_CELLS,
    KEPT,
    CollisionCache,
    is_clear,
)
from viaspline.kernels.turning.hybrid_astar.pose_nodes import Ahead
from viaspline.kernels.world.rasterize import mark_segments, rasterized
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.turning.hybrid_astar.disc_cover import covering_discs
from viaspline.world.world import World

Box = tuple[float, float, float, float]

HEURISTIC_WEIGHT = 1.3  # by how much what is still to come counts more than what has been
FINE_CELL_RADII = 0.25  # side of a cell of a fine lattice, in distances that the body keeps: where
# a gap that is too narrow looks open, a search sees all before it before it turns round
MAX_CELLS_ALONG = 400  # of the lattice, along a window's longer side
MAX_TABLE_CELLS_ALONG = 1000  # of the table of distances, along it too
LOOKED_AT_SPACING = 0.02  # between places that are looked at, in half widths of the body,
FINEST_SPACING = 2e-4  # and in least radii, for a body that is no more than a point
NO_GROWN_MAPS: Bytes = np.empty((0, 0), np.uint8)


@dataclass(frozen=True)
class SearchArea:
    """Where a search may go.

    Attributes:
        box: x_min, y_min, x_max, y_max [m].
        is_whole: Whether that is everywhere.
    """

    box: Box
    is_whole: bool


def search_areas(world: World, reach: float, places: Floats, margin: float) -> Iterator[SearchArea]:
    """Windows round some places, ever greater, the last one everywhere.

    Args:
        world: What to keep clear of.
        reach: How far the body reaches from its reference point [m].
        places: (n, 2) [m].
        margin: Round the places in the first window [m].
    """
    whole = _everywhere(world, reach + margin, places)
    low, high = places.min(axis=0), places.max(axis=0)
    for wider in (margin, 3.0 * margin + 0.5 * float(np.max(high - low))):
        box = _box(np.maximum(low - wider, whole[:2]), np.minimum(high + wider, whole[2:]))
        if _area(box) > 0.6 * _area(whole):
            break
        yield SearchArea(box, False)
    yield SearchArea(whole, True)


def _area(box: Box) -> float:
    return (box[2] - box[0]) * (box[3] - box[1])


def _everywhere(world: World, margin: float, places: Floats) -> Box:
    """What there is, with a way round it; the bounds or the fences if there are any."""
    if world.bounds is not None:
        return world.bounds
    low, high = places.min(axis=0), places.max(axis=0)
    if world.fences:
        ring = np.concatenate([np.array(fence) for fence in world.fences])
        low, high = np.minimum(low, ring.min(axis=0)), np.maximum(high, ring.max(axis=0))
        return _box(low, high)
    if len(world):
        box = world.packed.boxes[0]
        low, high = np.minimum(low, box[:2]), np.maximum(high, box[2:])
    return _box(low - margin, high + margin)


def _box(low: Floats, high: Floats) -> Box:
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])


@dataclass(frozen=True)
class Body:
    """A body as searches see it.

    Attributes:
        discs: That cover it with what is kept round it: x, y, radius, (n, 3) [m].
        inner: Distance that the reference point itself keeps at least [m].
        width: The greater of half the body's width and what is kept round it; of a disc both
            together [m].
    """

    discs: Floats
    inner: float
    width: float

    @classmethod
    def of(cls, requirements: Requirements, overhang: float) -> Body:
        """The required body; its discs jut out by a share ``overhang`` of its half width."""
        if requirements.footprint is None:
            return cls(
                np.array([[0.0, 0.0, requirements.required]]),
                requirements.required,
                requirements.required,
            )
        half = 0.5 * float(np.ptp(np.array(requirements.footprint), axis=0).min())
        width = max(half, requirements.kept)
        discs = covering_discs(tuple(requirements.footprint), overhang * width).copy()
        discs[:, 2] += requirements.kept
        return cls(discs, requirements.required, width)

    @property
    def reach(self) -> float:
        """How far it reaches from the reference point [m]."""
        return float(np.max(np.hypot(self.discs[:, 0], self.discs[:, 1]) + self.discs[:, 2]))

    def _held(self) -> Floats:
        """The discs after one that holds them all."""
        if len(self.discs) == 1:
            return self.discs
        low, high = self.discs[:, :2].min(axis=0), self.discs[:, :2].max(axis=0)
        middle = 0.5 * (low + high)
        radius = np.max(np.linalg.norm(self.discs[:, :2] - middle, axis=1) + self.discs[:, 2])
        return np.vstack((np.append(middle, radius), self.discs))

    def rows(self, rho: float, taut_path: float) -> Floats:
        """Rows of discs of the kernels, for a robot that drives forwards (1) or backwards (-1)."""
        x, y, kept = self._held().T
        speed = np.hypot(1.0 + np.abs(y) / rho, x / rho)
        return np.ascontiguousarray(np.column_stack((taut_path * x, taut_path * y, kept, speed)))


@dataclass(frozen=True)
class SearchWindow:
    """A window of a world for a body.

    Attributes:
        world: What to keep clear of.
        area: Where the reference point may be.
        body: The body.
        rho: The least radius [m].
        cell: Side of a cell of the lattice that is wanted [m].
        care: How near to the start and the goal longer moves take more room, and how much more [m].
        barriers: Segments that the reference point must not cross [m], (b, 4).
        narrow_gaps: Segments across gaps that it doesn't get through [m], (n, 4).
    """

    world: World
    area: SearchArea
    body: Body
    rho: float
    cell: float
    care: tuple[float, float]
    barriers: Floats = field(default_factory=lambda: np.empty((0, 4)))
    narrow_gaps: Floats = field(default_factory=lambda: np.empty((0, 4)))

    def closed_by(self, barriers: Floats) -> SearchWindow:
        """This window with barriers instead of those that it has; it shares what is known of it."""
        if not len(barriers) and not len(self.barriers):
            return self
        window = replace(self, barriers=np.ascontiguousarray(barriers))
        cache = self.cache._replace(barriers=window.barriers)
        shared = {"cells": self.cells, "cache": cache}
        vars(window).update(shared)  # what ``cached_property`` would find out anew
        return window

    @cached_property
    def side(self) -> float:
        """Side of a cell of the lattice [m]."""
        x0, y0, x1, y1 = self.area.box
        wanted = min(self.cell, FINE_CELL_RADII * self.body.inner)
        return max(wanted, max(x1 - x0, y1 - y0) / MAX_CELLS_ALONG)

    @cached_property
    def is_fine(self) -> bool:
        """Whether a way that passes near to a blocked cell of the lattice can pass beside it."""
        return self.side <= FINE_CELL_RADII * self.body.inner * (1.0 + 1e-9)

    @cached_property
    def pace(self) -> float:
        """Distance between places of a path that are looked at [m]."""
        return max(LOOKED_AT_SPACING * self.body.width, FINEST_SPACING * self.rho)

    @cached_property
    def cells(self) -> Bytes:
        """The lattice: cells where the reference point surely can't be are not 0."""
        x0, y0, x1, y1 = self.area.box
        height, width = math.ceil((y1 - y0) / self.side), math.ceil((x1 - x0) / self.side)
        near = max(self.body.inner - HALF_DIAGONAL_CELLS * self.side, 0.0)
        cells: Bytes = rasterized(
            self.world.packed, x0, y0, self.side, height, width, near, NO_GROWN_MAPS
        )
        return cells

    @cached_property
    def walls(self) -> Floats:
        """All segments that no way leads across [m], (n, 4)."""
        return np.concatenate((self.barriers, self.narrow_gaps))

    @cached_property
    def walled(self) -> Bytes:
        """The lattice with the cells blocked that walls pass through."""
        if not len(self.walls):
            return self.cells
        cells = self.cells.copy()
        x0, y0 = self.area.box[:2]
        mark_segments(self.walls, x0, y0, self.side, cells)
        return cells

    @cached_property
    def cache(self) -> CollisionCache:
        """Where the body may be, for a robot that drives forwards."""
        x0, y0, x1, y1 = self.area.box
        reach = self.body.reach
        size = max(x1 - x0, y1 - y0) + 2.0 * reach
        side = max(size / MAX_TABLE_CELLS_ALONG, 0.12 * self.body.width)
        shape = (
            math.ceil((y1 - y0 + 2.0 * reach) / side),
            math.ceil((x1 - x0 + 2.0 * reach) / side),
        )
        frame = np.array([x0 - reach, y0 - reach, side, self.pace])
        return CollisionCache(
            self.world.packed,
            frame,
            np.zeros(shape),
            np.zeros([math.ceil(count / COARSE_CELLS) for count in shape]),
            self.body.rows(self.rho, 1.0),
            self.barriers,
            np.zeros(2, np.int64),
        )

    @cached_property
    def cache_back(self) -> CollisionCache:
        """Where the body may be if it drives backwards; it shares the table of distances."""
        return self.cache._replace(discs=self.body.rows(self.rho, -1.0))

    def rooms(self, steps: Floats) -> Floats:
        """Distances of the body's middle to the world from which on moves are so long [m].

        Args:
            steps: Lengths of moves on ever greater scales [m], (k,).
        """
        held = self.body.rows(self.rho, 1.0)[0, KEPT]
        share = np.arange(len(steps)) / max(1, len(steps) - 1)
        rooms: Floats = self.body.inner + share * (held - self.body.inner) + np.roll(steps, 1)
        rooms[0] = 0.0
        return rooms

    def has_room(self, x: float, y: float, heading: float) -> bool:
        """Whether the body may stand in a pose [m, rad]."""
        nothing = np.empty((0, 3))
        return bool(is_clear(self.cache, float(x), float(y), float(heading), nothing, 0))

    def ahead(self, places: Floats) -> Ahead:
        """How far it is to some places (n, 2) from everywhere."""
        x0, y0 = self.area.box[:2]
        found = np.floor((places[:, ::-1] - (y0, x0)) / self.side).astype(np.int64)
        lengths = distance_field(self.cells, np.ascontiguousarray(found))
        if len(self.walls):
            lengths = self._round_walls(lengths, np.ascontiguousarray(found))
        return Ahead(np.array([x0, y0, self.side, HEURISTIC_WEIGHT]), lengths)

    def _round_walls(self, lengths: Floats, found: Ints) -> Floats:
        """The lengths of ways round the walls too, where cells can tell them.

        Args:
            lengths: Those without walls.
            found: Row and column of the places that the ways lead to, (n, 2).
        """
        longer = distance_field(self.walled, found)
        longer = np.where(self.walled != self.cells, _least_beside(longer), longer)
        if self.is_fine and not self.area.is_whole:
            return longer  # what it doesn't tell, a greater window does
        return np.where(np.isfinite(longer), longer, lengths)


def _least_beside(lengths: Floats) -> Floats:
    """The least of every cell and the eight round it, (rows, columns).

    A barrier's cells lie on both of its sides: a state in one of them is as near as can be.
    """
    padded = np.pad(lengths, 1, constant_values=np.inf)
    rows, columns = lengths.shape
    shifted = [padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)]
    least: Floats = np.minimum.reduce(shifted)
    return least
