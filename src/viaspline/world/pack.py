"""From obstacles as people write them to the arrays that kernels take.

Tested through ``kernels/world/test_distance``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate, pairwise
from weakref import WeakKeyDictionary

import numpy as np

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Columns, Floats, Ints
from viaspline.kernels.world.box_tree import ring_boxes
from viaspline.kernels.world.grid_rows import row_tables
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.rings import pack_rings
from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import KINDS, Obstacle
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.world.tree_growth import grown, leaf_boxes, tree_over

Rings = Sequence[Sequence[tuple[float, float]]]
Grids = tuple[Floats, Ints, Columns, Columns]

_TABLES: WeakKeyDictionary[Grid, tuple[Columns, Columns]] = WeakKeyDictionary()
"""The tables of every grid that is still in use: worlds of the same map share them."""


def pack(
    obstacles: Sequence[Obstacle], bounds: Sequence[float] | None, fences: Sequence[Rings]
) -> PackedWorld:
    """Pack obstacles, and what the robot stays inside of: each fence a ring and its holes."""
    count = len(obstacles)
    slot = np.empty(count, np.int64)
    rings: list[RoundedRing] = []
    grids: list[Grid] = []
    for i, obstacle in enumerate(obstacles):
        ring = obstacle.ring
        if ring is not None:
            slot[i] = len(rings)
            rings.append(ring)
        elif obstacle.grid is not None:
            slot[i] = -1 - len(grids)
            grids.append(obstacle.grid)
        elif obstacle.is_spatial:
            raise GeometryError(f"obstacle {i} is a solid, and a World is flat: leave it out")
        else:
            shapes = " or ".join((*KINDS, "grid"))
            raise GeometryError(f"obstacle {i} has no shape: give it a {shapes}")
    edges, ring_blocks, block_edges = edges_of([ring.loops for ring in rings])
    ring_edges = block_edges[ring_blocks]
    radii = np.array([ring.radius for ring in rings], np.float64)
    heads = np.column_stack((edges[ring_edges[:-1], :2], radii, np.diff(ring_edges)))
    fence_edges, fence_starts = fences_of(fences)
    boxes = np.empty((count, 4))
    if rings:
        grown = radii[:, None] * np.array([-1.0, -1.0, 1.0, 1.0])
        boxes[slot >= 0] = ring_boxes(edges, ring_edges) + grown
    if grids:
        boxes[slot < 0] = [grid.extent for grid in grids]
    return PackedWorld(
        slot, heads, ring_edges, ring_blocks, block_edges, ring_boxes(edges, block_edges), edges,
        *_grids(grids),
        np.array([] if bounds is None else bounds, np.float64).reshape(-1, 4),
        fence_starts, fence_edges, *tree_over(boxes),
    )  # fmt: skip


def pack_discs(discs: Floats) -> PackedWorld:
    """Pack discs that are arrays already: as ``pack`` does, without looking at each.

    Args:
        discs: x, y and radius of each [m], shape (n, 3).
    """
    numbers = np.arange(len(discs) + 1)
    x, y, radii = discs.T
    edges = np.column_stack((x, y, x, y))
    boxes = edges + radii[:, None] * np.array([-1.0, -1.0, 1.0, 1.0])
    fence_edges, fence_starts = fences_of(())
    return PackedWorld(
        numbers[:-1], np.column_stack((discs, np.ones(len(discs)))), numbers, numbers, numbers,
        edges.copy(), edges, *_grids(()), np.empty((0, 4)), fence_starts, fence_edges,
        *tree_over(boxes),
    )  # fmt: skip


def discs_at_end(world: PackedWorld, indices: Ints, sided: Sequence[int]) -> tuple[Floats, int]:
    """Of some obstacles the last ones that are discs without a side of their own.

    A lidar's are hundreds: as arrays they are packed without a look at each.

    Args:
        world: Where they are.
        indices: Of obstacles in it, (n,).
        sided: Indices of those that ask for a side.

    Returns:
        (x, y and radius of each of the last [m], (k, 3); how many stand before them).
    """
    slot = world.slot[indices]
    are_others = np.isin(indices, sided) | (slot < 0)
    are_others[~are_others] |= world.heads[slot[~are_others], 3] != 1.0
    others = np.flatnonzero(are_others)
    first = int(others[-1]) + 1 if others.size else 0
    return world.heads[slot[first:], :3].copy(), first


def _grids(grids: Sequence[Grid]) -> Grids:
    """Frames, shapes and tables of grids, as in PackedWorld."""
    frames = [
        (*grid.origin[:2], math.cos(grid.origin[2]), math.sin(grid.origin[2]), grid.resolution)
        for grid in grids
    ]
    starts = accumulate((grid.width * grid.height for grid in grids), initial=0)
    shapes = [(grid.width, grid.height, start) for grid, start in zip(grids, starts, strict=False)]
    tables = [_tables(grid) for grid in grids]
    return (
        np.array(frames, np.float64).reshape(-1, 5),
        np.array(shapes, np.int64).reshape(-1, 3),
        _together([right for right, _ in tables]),
        _together([left for _, left in tables]),
    )


def _tables(grid: Grid) -> tuple[Columns, Columns]:
    found = _TABLES.get(grid)
    if found is None:
        found = _TABLES[grid] = row_tables(grid.blocked)
    return found


def _together(tables: Sequence[Columns]) -> Columns:
    """Tables behind each other; one alone is not copied."""
    tables = [table for table in tables if table.size]
    if len(tables) == 1:
        return tables[0]
    return np.concatenate(tables) if tables else np.empty(0, np.int16)


def fences_of(areas: Sequence[Rings]) -> tuple[Floats, Ints]:
    """Edges of fences, clockwise and anticlockwise round holes, and where each fence starts."""
    edges, ring_blocks, block_edges = edges_of(areas)
    starts = block_edges[ring_blocks]
    for first, last in pairwise(starts.tolist()):
        edges[first:last] = edges[first:last][::-1, [2, 3, 0, 1]]
    return edges, starts


def _distinct(ring: Sequence[tuple[float, float]]) -> Sequence[tuple[float, float]]:
    """A ring without vertices that repeat the one before."""
    if len(set(ring)) == len(ring):
        return ring
    return [
        vertex for vertex, before in zip(ring, (ring[-1], *ring), strict=False) if vertex != before
    ]


def edges_of(rings: Sequence[Rings]) -> tuple[Floats, Ints, Ints]:
    """Edges of rings, each with its holes, and their blocks, as ``pack_rings`` gives them."""
    if not rings:
        return np.empty((0, 4)), np.zeros(1, np.int64), np.zeros(1, np.int64)
    loops = [loop if len(loop) < 3 else _distinct(loop) for ring in rings for loop in ring]
    vertices = [vertex for loop in loops for vertex in loop]
    packed: tuple[Floats, Ints, Ints] = pack_rings(
        np.array(vertices, np.float64).reshape(-1, 2),
        np.cumsum([0, *map(len, loops)], dtype=np.int64),
        np.cumsum([0, *map(len, rings)], dtype=np.int64),
    )
    return packed


def join(first: PackedWorld, second: PackedWorld, settled: int) -> tuple[PackedWorld, int]:
    """The obstacles of both worlds inside the bounds of the first.

    Args:
        first: A world.
        second: What comes to it: its obstacles come after the first's.
        settled: How many of the first's obstacles are in its large tree (``tree_growth``).

    Returns:
        (all of them, how many of them are in its large tree).
    """
    if not second.leaf.size:
        return first, settled
    tree, now = grown(first, settled, leaf_boxes(second))
    rings, grids = len(first.heads), len(first.grid_frames)
    shapes = second.grid_shapes.copy()
    shapes[:, 2] += first.to_right.size
    joined = PackedWorld(
        slot=np.concatenate(
            (first.slot, np.where(second.slot >= 0, second.slot + rings, second.slot - grids))
        ),
        heads=np.concatenate((first.heads, second.heads)),
        ring_edges=_chain(first.ring_edges, second.ring_edges),
        ring_blocks=_chain(first.ring_blocks, second.ring_blocks),
        block_edges=_chain(first.block_edges, second.block_edges),
        block_boxes=np.concatenate((first.block_boxes, second.block_boxes)),
        edges=np.concatenate((first.edges, second.edges)),
        grid_frames=np.concatenate((first.grid_frames, second.grid_frames)),
        grid_shapes=np.concatenate((first.grid_shapes, shapes)),
        to_right=_together((first.to_right, second.to_right)),
        to_left=_together((first.to_left, second.to_left)),
        bounds=first.bounds,
        fence_edges=first.fence_edges,
        fences=first.fences,
        **tree._asdict(),
    )
    return joined, now


def _chain(first: Ints, second: Ints) -> Ints:
    return np.concatenate((first, second[1:] + first[-1]))
