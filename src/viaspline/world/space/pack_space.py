"""From solids and ground as values to the arrays that kernels take.

Tested through ``kernels/space/test_space_distance``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.space.ground_pyramid import fill_pyramid
from viaspline.kernels.space.packed_space import LINE, PRISM, VOXELS, PackedSpace
from viaspline.kernels.space.voxel_words import fill_words
from viaspline.kernels.world.box_tree import ring_boxes
from viaspline.maps.grid import Grid
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.solids import GridPrism, Prism, RoundedSegment, Solid
from viaspline.world.pack import Rings, edges_of, fences_of
from viaspline.world.space.space_tree import space_tree

Words = tuple[Ints, Ints]
Pyramid = tuple[Ints, Floats, Floats]

_WORDS: WeakKeyDictionary[Voxels | Grid, Words] = WeakKeyDictionary()
"""The words of all voxels that are still in use: worlds of the same map share them."""

_PYRAMIDS: WeakKeyDictionary[Terrain, dict[float, Pyramid]] = WeakKeyDictionary()
"""The pyramid of every terrain that is still in use, for each height of what isn't known."""


def pack_space(
    solids: Sequence[Solid],
    ground: Terrain | float | None,
    unknown: float,
    bounds: Sequence[float] | None,
    fences: Sequence[Rings],
    core: tuple[float, float],
    height_limits: Sequence[float],
) -> PackedSpace:
    """Pack solids, ground and what the robot stays inside of; see ``PackedSpace``."""
    prisms = [one for one in solids if isinstance(one, Prism)]
    lines = [one for one in solids if isinstance(one, RoundedSegment)]
    blocks = [one for one in solids if isinstance(one, Voxels | GridPrism)]
    kinds = np.array([_kind_of(one) for one in solids], np.int64)
    rows = np.empty(len(solids), np.int64)
    for kind in (PRISM, LINE, VOXELS):
        rows[kinds == kind] = np.arange(int((kinds == kind).sum()))
    fence_edges, fence_starts = fences_of(fences)
    boxes, skip, leaf = space_tree(
        np.array([_box_of(one) for one in solids], np.float64).reshape(-1, 6)
    )
    return PackedSpace(
        kinds=kinds, rows=rows,
        **_rings(prisms),
        lines=np.array(
            [(*one.first, *one.last, one.radius) for one in lines], np.float64
        ).reshape(-1, 7),
        **_voxels(blocks),
        **_ground(ground, unknown),
        height_limits=np.array(height_limits, np.float64),
        core=np.array(core, np.float64),
        bounds=np.array([] if bounds is None else bounds, np.float64).reshape(-1, 4),
        fence_edges=fence_starts, fences=fence_edges, boxes=boxes, skip=skip, leaf=leaf,
    )  # fmt: skip


def _kind_of(solid: Solid) -> int:
    if isinstance(solid, Prism):
        return PRISM
    return LINE if isinstance(solid, RoundedSegment) else VOXELS


def _box_of(solid: Solid) -> tuple[float, ...]:
    return solid.extent if isinstance(solid, Voxels) else solid.box


def _rings(prisms: Sequence[Prism]) -> dict[str, Any]:
    edges, ring_blocks, block_edges = edges_of([prism.ring.loops for prism in prisms])
    ring_edges = block_edges[ring_blocks]
    radii = np.array([prism.ring.radius for prism in prisms], np.float64)
    return {
        "heads": np.column_stack((edges[ring_edges[:-1], :2], radii, np.diff(ring_edges))),
        "ring_heights": np.array([(one.low, one.high) for one in prisms], float).reshape(-1, 2),
        "ring_blocks": ring_blocks,
        "block_edges": block_edges,
        "block_boxes": ring_boxes(edges, block_edges),
        "edges": edges,
    }


def _voxels(blocks: Sequence[Voxels | GridPrism]) -> dict[str, Any]:
    frames = np.empty((len(blocks), 8))
    maps: list[Voxels | Grid] = []
    for row, block in zip(frames, blocks, strict=True):
        if isinstance(block, Voxels):
            row[:] = (*block.origin, 1.0, 0.0, block.cell, math.nan, math.nan)
            maps.append(block)
        else:
            x, y, yaw = block.grid.origin
            side = block.grid.resolution
            heights = (block.low / side, block.high / side)
            row[:] = (x, y, 0.0, math.cos(yaw), math.sin(yaw), side, *heights)
            maps.append(block.grid)
    found = [_words_of(one) for one in maps]
    starts = list(accumulate((words.size for _, words in found), initial=0))
    levels = [
        np.column_stack((level[:, :3], level[:, 3] + start))
        for (level, _), start in zip(found, starts, strict=False)
    ]
    words = [one for _, one in found]
    return {
        "voxel_frames": frames,
        "voxel_levels": np.concatenate((np.empty((0, 4), np.int64), *levels)),
        "voxel_starts": np.cumsum([0, *map(len, levels)], dtype=np.int64),
        "voxel_words": words[0] if len(words) == 1 else np.concatenate((np.empty(0, int), *words)),
    }


def _words_of(block: Voxels | Grid) -> Words:
    """The levels of a block and their words; see ``kernels/space/voxel_words``."""
    found = _WORDS.get(block)
    if found is None:
        blocked = block.blocked if isinstance(block, Voxels) else block.blocked.T[:, :, None]
        shape, start = blocked.shape, 0
        rows: list[tuple[int, ...]] = []
        while not rows or shape != (1, 1, 1):
            shape = tuple(-(-side // 4) for side in shape)
            rows.append((*shape, start))
            start += math.prod(shape)
        levels, words = np.array(rows, np.int64), np.zeros(start, np.int64)
        cubes = np.ascontiguousarray(blocked)
        cubes.flags.writeable = False  # numba compiles writable arrays once more
        fill_words(cubes, levels, words)
        found = _WORDS[block] = (levels, words)
    return found


def _ground(ground: Terrain | float | None, unknown: float) -> dict[str, Any]:
    flat = -math.inf if ground is None or isinstance(ground, Terrain) else float(ground)
    heights = np.empty((0, 0))
    heights.flags.writeable = False
    frame = (0.0, 0.0, 1.0, flat, unknown)
    levels, tops, planes = np.empty((0, 3), np.int64), np.empty(0), np.empty((0, 5))
    if isinstance(ground, Terrain):
        heights = ground.heights
        frame = (*ground.origin, ground.cell, flat, unknown)
        levels, tops, planes = _pyramid_of(ground, unknown)
    return {
        "heights": heights,
        "ground_frame": np.array(frame, np.float64),
        "ground_levels": levels,
        "ground_tops": tops,
        "ground_planes": planes,
    }


def _pyramid_of(terrain: Terrain, unknown: float) -> Pyramid:
    """The levels of a terrain's pyramid, its tops and its planes."""
    known = _PYRAMIDS.setdefault(terrain, {})
    if unknown not in known:
        start = 0
        rows: list[tuple[int, int, int]] = []
        height, width = (side - 1 for side in terrain.heights.shape)
        while not rows or (width, height) != (1, 1):
            width, height = -(-width // 4), -(-height // 4)
            rows.append((width, height, start))
            start += width * height
        levels, tops = np.array(rows, np.int64), np.empty(start)
        planes = np.empty((start, 5))
        fill_pyramid(terrain.heights, terrain.cell, unknown, levels, tops, planes)
        known[unknown] = (levels, tops, planes)
    return known[unknown]
