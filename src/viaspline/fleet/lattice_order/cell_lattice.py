"""A square lattice over free space, on which the starts and goals of robots lie."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from viaspline.fleet.lattice_order.no_lattice_order import NoLatticeOrder
from viaspline.kernels.arrays import Flags, Floats, Steps
from viaspline.kernels.fleet.clear_segments import clear_segments
from viaspline.world.world import World

MOST_CELLS = 4_000_000
"""In a lattice's rectangle."""
FINEST = 6
"""Into so many cells the gap between two starts or goals is divided at most."""
MOST_GAPS = 8
"""Gaps between starts and goals that are tried."""
BORDER = 2
"""Rings of cells round all starts and goals, where the world has no bounds."""
SAME = 1e-9
"""Of a cell: places that are no farther apart are one."""


@dataclass(frozen=True, eq=False)
class CellLattice:
    """Places that robots may stand at, each a straight drive from its neighbours.

    Attributes:
        places: In the plane [m], (cells, 2).
        neighbours: The cells next to each cell, -1 where there is none or the way isn't free,
            (cells, 4).
        cell: Distance of neighbours [m].
        starts: The cell of each robot's start, (n,).
        goals: The cell of each robot's goal, (n,).
    """

    places: Floats
    neighbours: Steps
    cell: float
    starts: Steps
    goals: Steps


def lattice_over(
    world: World, starts: Floats, goals: Floats, apart: float, kept: float
) -> CellLattice | NoLatticeOrder:
    """The finest lattice that all starts and goals lie on, with room for a robot in each cell.

    Where one robot goes to a cell that another one leaves round a corner, the two get as near as
    the lattice's spacing over the square root of 2; that has to be enough.

    Args:
        world: What stands.
        starts: [m], (n, 2).
        goals: [m], (n, 2).
        apart: What the centres of two robots are to be apart [m].
        kept: What a centre keeps of the world [m].

    Returns:
        The lattice; or why there is none, or why it is of no use.

    Example:
        >>> ends = np.array([[0.0, 0.0], [4.0, 0.0]])
        >>> lattice = lattice_over(World(), ends, ends[::-1], apart=1.0, kept=0.5)
        >>> lattice.cell, lattice.places[lattice.goals].tolist()
        (2.0, [[4.0, 0.0], [0.0, 0.0]])
    """
    ends = np.vstack([starts, goals])
    spacing = _spacing(ends, apart)
    if spacing is None:
        return NoLatticeOrder(
            "gave up",
            "starts and goals lie on no square lattice with room for a robot in each cell",
            "put them on one, or farther apart",
        )
    cell, origin = spacing
    box = np.array(_box(world, ends, cell)).reshape(2, 2)
    low = np.ceil((box[0] - origin) / cell - SAME)
    columns, rows = (np.floor((box[1] - origin) / cell + SAME) - low + 1).astype(int).tolist()
    if rows * columns > MOST_CELLS:
        return NoLatticeOrder(
            "gave up", f"a lattice would have {rows * columns} cells", "give a smaller world"
        )
    x, y = (origin[k] + cell * (low[k] + np.arange(n)) for k, n in enumerate((columns, rows)))
    grid = np.stack(np.meshgrid(x, y), axis=-1)
    free = world.distance(grid.reshape(-1, 2)).reshape(rows, columns) >= kept
    numbers = np.full((rows + 2, columns + 2), -1, np.int32)
    numbers[1:-1, 1:-1][free] = np.arange(free.sum(), dtype=np.int32)
    at = np.rint((ends - origin) / cell - low).astype(np.int64) + 1
    cells = numbers[at[:, 1].clip(0, rows + 1), at[:, 0].clip(0, columns + 1)]
    parts = cells[: len(starts)], cells[len(starts) :]
    if (cells < 0).any() or any(np.unique(part).size < part.size for part in parts):
        return NoLatticeOrder(
            "gave up", "a start or goal has no cell of its own", "give robots more room there"
        )
    places = grid[free]
    return CellLattice(places, _neighbours(world, numbers, places, kept), cell, *parts)


def _spacing(ends: Floats, apart: float) -> tuple[float, Floats] | None:
    """The distance of neighbours, and a place of the lattice; None if there is no such lattice."""
    best: tuple[float, Floats] | None = None
    for tried in _candidates(ends, apart):
        cell, origin, off = _fitted(ends, tried)
        fits = cell / math.sqrt(2.0) >= apart + 2.0 * off
        if fits and (best is None or cell < best[0]):
            best = cell, origin
    return best


def _candidates(ends: Floats, apart: float) -> Iterator[float]:
    """Gaps between coordinates, divided into cells; the least ones first."""
    least = math.sqrt(2.0) * apart
    gaps = np.concatenate([np.diff(np.sort(ends[:, axis])) for axis in range(2)])
    wide = np.unique(gaps[gaps >= least])
    if wide.size == 0:
        yield 2.0 * least
        return
    chosen = np.unique(np.linspace(0, wide.size - 1, MOST_GAPS).astype(int))
    for gap in wide[chosen].tolist():
        for parts in range(1, FINEST + 1):
            if gap / parts >= least:
                yield gap / parts


def _fitted(ends: Floats, cell: float) -> tuple[float, Floats, float]:
    """The lattice nearest to one: its spacing, its place, and how far an end is off it [m]."""
    steps = np.rint((ends - ends[0]) / cell)
    middle = steps - steps.mean(axis=0)
    square = float((middle**2).sum())
    if square > 0.0:
        fitted = float((middle * (ends - ends.mean(axis=0))).sum() / square)
        cell = cell if abs(fitted - cell) <= SAME * cell else fitted
    off = ends - ends[0] - cell * steps
    shift = off.mean(axis=0)
    shift[np.abs(shift) <= SAME * cell] = 0.0
    return cell, ends[0] + shift, float(np.hypot(*(off - shift).T).max())


def _box(world: World, ends: Floats, cell: float) -> tuple[float, float, float, float]:
    """Where the lattice lies: in the world's bounds, else round all starts and goals."""
    if world.bounds is not None:
        return world.bounds
    low, high = ends.min(axis=0) - BORDER * cell, ends.max(axis=0) + BORDER * cell
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])


def _neighbours(world: World, numbers: Steps, places: Floats, kept: float) -> Steps:
    """The neighbours of every free cell to which the straight way is free."""
    free: Flags = numbers[1:-1, 1:-1] >= 0
    beside = [numbers[1:-1, 2:], numbers[2:, 1:-1], numbers[1:-1, :-2], numbers[:-2, 1:-1]]
    found = np.stack([part[free] for part in beside], axis=-1)
    for way in (0, 1):
        has = np.flatnonzero(found[:, way] >= 0)
        other = found[has, way]
        clear = clear_segments(world.packed, np.hstack([places[has], places[other]]), kept)
        found[has[~clear], way] = -1
        found[other[~clear], way + 2] = -1
    return np.ascontiguousarray(found)
