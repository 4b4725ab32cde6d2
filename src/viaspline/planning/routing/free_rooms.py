"""Where a via point could be moved to, so that ways lead to it.

Tested through ``planning/routing/test_leg_refusals``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Bytes, Floats, Ints
from viaspline.kernels.world.rasterize import rasterized
from viaspline.kernels.world.segment import segment_distance
from viaspline.planning.routing.lattice import Lattice
from viaspline.world.world import World

CELLS = (2**16, 2**18, 2**20)  # of the lattices that are looked at, until a place is found
HALF_DIAGONAL = math.sqrt(0.5)  # of a cell of side 1
SPARE_M = 2e-3  # of room, so that a place may be told to the millimetre
BISECTIONS = 20  # of the way back to where the via point was
NO_CELLS: Bytes = np.empty((0, 0), np.uint8)


@dataclass(frozen=True)
class FreeRooms:
    """The free space of a robot in connected parts, each of cells that have the room everywhere.

    What is connected on the lattice is connected; narrow places may be missing.

    Attributes:
        world: What is to be kept clear of.
        required: Distance to keep [m].
        lattice: Its cells.
        rooms: The number of each cell's part, from 1; 0 where it is blocked.
    """

    world: World
    required: float
    lattice: Lattice
    rooms: NDArray[Any]

    @classmethod
    def of(cls, world: World, required: float, places: Floats, cells: int) -> FreeRooms:
        """Those of a world about some places (n, 2) [m], on a lattice of so many cells."""
        from scipy.ndimage import label

        x0, y0, x1, y1 = _box(world, required, places)
        side = math.sqrt((x1 - x0) * (y1 - y0) / cells)
        shape = math.ceil((y1 - y0) / side), math.ceil((x1 - x0) / side)
        reach = required + SPARE_M + HALF_DIAGONAL * side
        blocked = rasterized(world.packed, x0, y0, side, *shape, reach, NO_CELLS)
        lattice = Lattice(x0, y0, side, blocked, required, is_open=False, is_fine=False)
        return cls(world, required, lattice, label(blocked == 0)[0])

    def about(self, place: Floats) -> Ints:
        """The numbers of the parts that a straight way leads to from a place, (k,)."""
        middles = self.lattice.free_middles_near(place)
        seen = [self._is_clear(place, middle) for middle in middles]
        return np.unique(self.lattice.at(self.rooms, middles[seen]))

    def nearest_place(self, place: Floats, rooms: Ints) -> Floats | None:
        """The place in some parts that is nearest to another [m], (2,), as near as can be seen."""
        free = np.argwhere(np.isin(self.rooms, rooms) & (self.rooms > 0))
        if not len(free):
            return None
        lattice = self.lattice
        middles = (free[:, ::-1] + 0.5) * lattice.side + (lattice.x, lattice.y)
        found: Floats = middles[np.argmin(np.hypot(*(middles - place[:2]).T))]
        low, high = 0.0, 1.0
        for _ in range(BISECTIONS):
            part = 0.5 * (low + high)
            if self._is_clear(found, found + part * (place[:2] - found), SPARE_M):
                low = part
            else:
                high = part
        nearer: Floats = found + low * (place[:2] - found)
        return nearer

    def _is_clear(self, a: Floats, b: Floats, spare: float = 0.0) -> bool:
        room = segment_distance(self.world.packed, a[0], a[1], b[0], b[1], np.inf)[0]
        return bool(room >= self.required + spare)


def places_reached(
    wanted: Sequence[tuple[Floats, Sequence[Floats]]], world: World, required: float
) -> list[Floats | None]:
    """Places near others that ways lead to from some, or to them.

    Args:
        wanted: Near what place each is sought [m], at least (2,), and from where all it is to be
            reached.
        world: What is to be kept clear of.
        required: Distance to keep [m].

    Returns:
        Each of shape (2,) [m]; None where none was found on the first lattice with any, or on all.
    """
    ends = np.array([place[:2] for near, others in wanted for place in (near, *others)])
    found: list[Floats | None] = [None] * len(wanted)
    for cells in CELLS:
        rooms = FreeRooms.of(world, required, ends, cells)
        for k, (near, others) in enumerate(wanted):
            common = rooms.about(others[0])
            for other in others[1:]:
                common = np.intersect1d(common, rooms.about(other))
            found[k] = rooms.nearest_place(near, common)
        if any(place is not None for place in found):
            break
    return found


def are_joined(places: Sequence[Floats], world: World, required: float) -> bool:
    """Whether some places, each at least (2,) [m], are seen to lie in one part of the free space.

    Args:
        places: The places.
        world: What is to be kept clear of.
        required: Distance to keep [m].
    """
    ends = np.array([place[:2] for place in places])
    for cells in CELLS:
        rooms = FreeRooms.of(world, required, ends, cells)
        common = rooms.about(ends[0])
        for place in ends[1:]:
            common = np.intersect1d(common, rooms.about(place))
        if common.size:
            return True
    return False


def _box(world: World, required: float, places: Floats) -> tuple[float, float, float, float]:
    """What the lattice has to cover [m]."""
    if world.bounds is not None:
        return world.bounds
    low, high = places.min(axis=0), places.max(axis=0)
    if len(world):
        box = world.packed.boxes[0]
        low, high = np.minimum(low, box[:2]), np.maximum(high, box[2:])
    margin = 4.0 * required + 0.05 * float(np.max(high - low))
    (x0, y0), (x1, y1) = (low - margin).tolist(), (high + margin).tolist()
    return x0, y0, x1, y1
