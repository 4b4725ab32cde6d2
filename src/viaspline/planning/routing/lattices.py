"""The lattices of a world, in the order in which they are tried.

What a cell stands for is one of three things. On a map's *own cells* a robot that is slimmer than
half of one passes wherever two free ones have a side in common, and nowhere else. *Closed* cells
are blocked where any place in them may lack the room: a path through them has the room, but gaps
are lost that are less than a cell or two wider than the robot. *Open* cells are free where any
place in them may have the room: no way is lost, and what leads through gaps that are too narrow is
closed by the segments across those. A segment blocks whole cells; as they are small beside the
robot, a way that passes near to it can pass a little farther off.

Tested through ``planning/routing/test_lattice``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from viaspline.kernels.arrays import Bytes, Floats
from viaspline.kernels.routing.navmesh.dilate import grow_into
from viaspline.kernels.routing.navmesh.map_gaps import close_gaps
from viaspline.kernels.world.rasterize import rasterized
from viaspline.maps.grid import Grid
from viaspline.planning.routing.lattice import Lattice
from viaspline.world.world import World

Box = tuple[float, float, float, float]

HALF_DIAGONAL = math.sqrt(0.5)  # of a cell of side 1
OPEN_CELL_RADII, PROOF_CELL_RADII = 0.5, 0.25  # side of open cells, in required distances
CELLS_WANTED, CELLS_QUICK = 2**16, 2**20  # of the lattice that is tried first without maps
CELLS_SHORTEST = 2**22  # the most of it where it is the length that counts,
CELLS_FINE = 2**24  # and of the one that is tried beside it there
MAX_CELLS = 2**25  # of any lattice
MORE_ABOUT_IT = 1.005  # of what cells have to cover, aside, for a robot that needs more
# Of a lattice on a map's lines, and if that is more, in cells of the maps: beyond, what lies about
# a small map has more of its cells than fit in memory, and the lattice lies across them.
MAX_ON_MAP_LINES, MAX_OF_MAP = 4 * MAX_CELLS, 2.0
MAX_PARTS = 4  # of a map's cell aside, where other things stand beside the map
MISALIGNMENT = 1e-9  # what a map may lie off the lattice, in cells
NO_CELLS: Bytes = np.empty((0, 0), np.uint8)


def lattices(
    world: World, required: float, floor: float, places: Floats, most_cells: int = CELLS_QUICK
) -> Iterator[Lattice]:
    """Lattices of a world for a robot that needs ``required`` [m] around its middle, ever finer.

    Args:
        world: What to keep clear of.
        required: [m].
        floor: A little less, which is what is proven [m].
        places: Where the robot has to get to [m], (n, 2).
        most_cells: Of the lattice that is tried first, for a robot much slimmer than its cells. A
            slim robot may find a long way on it where one that is less slim finds none, and a short
            one on the next.
    """
    box = _box(world, required, places)
    own = _own_cells(world, required, box)
    if own is not None:
        yield own
        if own.is_open:
            return
        yield _maps_alone(own, world, required)
    for side in _sides(world, required, box, most_cells):
        yield _cells(world, required, floor, box, side)


def fine_lattice(
    world: World, required: float, floor: float, places: Floats, most_cells: int = CELLS_FINE
) -> Lattice | None:
    """The finest lattice of use with no more than so many cells; None if there is none.

    The coarser cells are, the more may the shortest path through them be another way round than the
    shortest way. Of a map they have to be open: closed cells of one shut what is a cell wide.

    Args:
        world: What to keep clear of.
        required: [m].
        floor: A little less, which is what is proven [m].
        places: Where the robot has to get to [m], (n, 2).
        most_cells: How many.
    """
    box, resolution = _box(world, required, places), _resolution(world)
    area = _area(box)
    if math.isinf(resolution):
        side = max(PROOF_CELL_RADII * required, math.sqrt(area / most_cells))
        return _cells(world, required, floor, box, side)
    for radii in (PROOF_CELL_RADII, OPEN_CELL_RADII):
        side = _on_map_lines(radii * required, resolution)
        if area <= most_cells * side**2:
            return _cells(world, required, floor, box, side)
    return None


def least_required(world: World, required: float, places: Floats) -> float:
    """What a robot needs at least for cells to be small beside it [m]; 0 with maps.

    Args:
        world: What to keep clear of.
        required: By a slimmer one [m].
        places: Where it has to get to [m], (n, 2).
    """
    if not math.isinf(_resolution(world)):
        return 0.0
    finest = math.sqrt(_area(_box(world, required, places)) / MAX_CELLS)
    return MORE_ABOUT_IT * finest / OPEN_CELL_RADII


def _cells(world: World, required: float, floor: float, box: Box, side: float) -> Lattice:
    """Open cells where they are small beside the robot, else closed ones."""
    if side <= OPEN_CELL_RADII * required * (1.0 + 1e-9):
        return _open_cells(world, required, floor, box, side)
    return _closed_cells(world, required, box, side)


def _sides(world: World, required: float, box: Box, most_cells: int) -> Iterator[float]:
    """Sides of cells [m], ever smaller; the last ones prove that there is no way."""
    area, resolution = _area(box), _resolution(world)
    counts = CELLS_WANTED, most_cells, MAX_CELLS
    first, quickest, finest = (math.sqrt(area / n) for n in counts)
    open_side, last_side = OPEN_CELL_RADII * required, PROOF_CELL_RADII * required
    wanted = [max(open_side, finest), max(last_side, finest)]
    if math.isinf(resolution):
        wanted.insert(0, max(min(open_side, first), quickest))
    most = max(MAX_ON_MAP_LINES, MAX_OF_MAP * _cells_of_maps(world, resolution))
    least = math.sqrt(area / most)
    before = math.inf
    for side in wanted:
        on_map = _on_map_lines(side, resolution)
        side = on_map if on_map >= least else side
        if side < before:
            yield side
            before = side


def _on_map_lines(side: float, resolution: float) -> float:
    """A side [m] no longer than this of which a whole number make one of a map's cells."""
    if math.isinf(resolution):
        return side
    return resolution / max(1.0, math.ceil(resolution / side - 1e-9))


def _resolution(world: World) -> float:
    """The side of the maps' smallest cells [m]; inf without maps."""
    return min((grid.resolution for grid in _grids(world)), default=math.inf)


def _area(box: Box) -> float:
    return (box[2] - box[0]) * (box[3] - box[1])


def _cells_of_maps(world: World, resolution: float) -> float:
    """How many cells of this side [m] the maps cover."""
    return sum(grid.blocked.size * (grid.resolution / resolution) ** 2 for grid in _grids(world))


def _open_cells(world: World, required: float, floor: float, box: Box, side: float) -> Lattice:
    """Cells that are free where any place in them may have the room."""
    reach = floor - HALF_DIAGONAL * side
    x, y, shape = _frame(world, box, side)
    grown = _grown_maps(world, reach, (x, y), side, shape)
    cells = rasterized(world.packed, x, y, side, *shape, reach, grown)
    if grown.size:
        for grid in _grids(world):
            row, column, parts = _place_on(grid, (x, y), side) or (0, 0, 1)
            blocked = grid.blocked.astype(np.uint8)
            close_gaps(blocked, 2.0 * floor / grid.resolution, row, column, parts, cells)
    is_fine = side <= PROOF_CELL_RADII * required * (1.0 + 1e-9)
    return Lattice(x, y, side, cells, reach - HALF_DIAGONAL * side, is_fine, is_fine)


def _closed_cells(world: World, required: float, box: Box, side: float) -> Lattice:
    """Cells that are blocked where any place in them may lack the room."""
    reach = required + HALF_DIAGONAL * side
    x, y, shape = _frame(world, box, side)
    grown = _grown_maps(world, reach, (x, y), side, shape)
    cells = rasterized(world.packed, x, y, side, *shape, reach, grown)
    return Lattice(x, y, side, cells, required, is_open=False, is_fine=False)


def _own_cells(world: World, required: float, box: Box) -> Lattice | None:
    """A map's own cells, or equal parts of them where other things stand beside the map.

    None unless a robot that needs ``required`` gets through wherever free ones meet.
    """
    grids = _grids(world)
    if not grids or 2.0 * required >= min(grid.resolution for grid in grids):
        return None
    resolution = min(grid.resolution for grid in grids)
    is_alone = len(world) == 1 and not world.enclosures
    area = (box[2] - box[0]) * (box[3] - box[1])
    parts = 1 if is_alone else min(MAX_PARTS, int(0.5 * resolution / required))
    while parts > 1 and area * parts**2 > MAX_CELLS * resolution**2:
        parts -= 1
    side = resolution / parts
    x, y, shape = _frame(world, box, side)
    if shape[0] * shape[1] > 4 * MAX_CELLS:
        return None
    cells = _grown_maps(world, 0.0, (x, y), side, shape)
    if not cells.size:
        return None
    is_cut = _cut_to_bounds(world, cells, (x, y), side)
    rest = World(
        [obstacle for obstacle in world.obstacles if obstacle.grid is None],
        fences=world.fences, corridor=world.corridor,
    )  # fmt: skip
    if len(rest) or rest.enclosures:
        reach = required + HALF_DIAGONAL * side
        cells = np.maximum(cells, rasterized(rest.packed, x, y, side, *shape, reach, NO_CELLS))
    return Lattice(x, y, side, cells, 0.5 * side, is_alone and not is_cut, is_fine=False)


def _maps_alone(own: Lattice, world: World, required: float) -> Lattice:
    """The maps' own cells without what else there is: where they are shut, so is the world."""
    shape = own.cells.shape
    cells = _grown_maps(world, 0.0, (own.x, own.y), own.side, (shape[0], shape[1]))
    return Lattice(own.x, own.y, own.side, cells, 0.1 * required, is_open=True, is_fine=False)


def _cut_to_bounds(world: World, cells: Bytes, low: tuple[float, float], side: float) -> bool:
    """Block the cells that the bounds cut or leave out; whether they cut any."""
    if world.bounds is None:
        return False
    slack = MISALIGNMENT * max(cells.shape)
    lines = (np.array(world.bounds).reshape(2, 2) - low) / side
    (left, down), (right, up) = np.stack(
        (np.ceil(lines[0] - slack), np.floor(lines[1] + slack))
    ).clip(0).astype(int).tolist()  # fmt: skip
    cells[:down] = cells[up:] = 1
    cells[:, :left] = cells[:, right:] = 1
    return bool((np.abs(lines - np.round(lines)) > slack).any())


def _grids(world: World) -> list[Grid]:
    maps = (world.obstacles[i].grid for i in np.flatnonzero(world.are_maps).tolist())
    return [grid for grid in maps if grid is not None]


def _frame(world: World, box: Box, side: float) -> tuple[float, float, tuple[int, int]]:
    """The outer corner of a lattice over a box, on the first map's lines, and its rows, columns."""
    low = [box[0], box[1]]
    for grid in _grids(world)[:1]:
        low = [_snapped(at, line, side) for at, line in zip(low, grid.origin, strict=False)]
    return low[0], low[1], _shape(box, low, side)


def _shape(box: Box, low: list[float], side: float) -> tuple[int, int]:
    """Rows and columns of the cells that it takes to cover a box from a corner on."""
    rows, columns = (math.ceil((box[k + 2] - low[k]) / side - 1e-6) for k in (1, 0))
    return max(1, rows), max(1, columns)


def _grown_maps(
    world: World, reach: float, low: tuple[float, float], side: float, shape: tuple[int, int]
) -> Bytes:
    """The maps' cells grown by ``reach``; nothing unless all of them lie on the lattice."""
    grids = _grids(world)
    places = [_place_on(grid, low, side) for grid in grids]
    if not grids or None in places:
        return NO_CELLS
    cells = np.zeros(shape, np.uint8)
    for grid, place in zip(grids, places, strict=True):
        assert place is not None
        row, column, parts = place
        blocked = grid.blocked.astype(np.uint8)
        grow_into(blocked, max(reach / side, 1e-9), row, column, parts, cells)
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
