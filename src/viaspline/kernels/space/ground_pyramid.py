"""Terrain in levels of 4 x 4 cells: how high the ground gets in each, and a plane close to it.

A level costs a sixteenth of the one below. The ground between four nodes is bilinear, so its
height over a plane is largest and least at nodes.

Tested through ``kernels/space/test_ground_pyramid``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inlined, kernel, uncounted
from viaspline.kernels.space.packed_space import PackedSpace


@inlined
def has_terrain(space: PackedSpace) -> bool:
    """Whether the ground has heights of its own."""
    return space.ground_levels.shape[0] > 0


@uncounted
def patch_top(space: PackedSpace, i: int, j: int) -> float:
    """Height of the highest corner of patch (i, j) [m]; see ``ground_frame`` where unknown."""
    nodes = space.heights
    one = max(nodes[j, i], nodes[j, i + 1])
    other = max(nodes[j + 1, i], nodes[j + 1, i + 1])
    if math.isnan(nodes[j, i] + nodes[j, i + 1] + nodes[j + 1, i] + nodes[j + 1, i + 1]):
        return space.ground_frame[4]
    return max(one, other)


@uncounted
def _fit(
    heights: Floats, x0: int, y0: int, x1: int, y1: int, cell: float, planes: Floats, row: int
) -> float:
    """Set the plane of the nodes x0..x1, y0..y1 and how far they are off it. The highest node."""
    a, b = heights[y0, x0], heights[y0, x1]
    c, d = heights[y1, x0], heights[y1, x1]
    slope_x = 0.5 * ((b - a) + (d - c)) / ((x1 - x0) * cell)
    slope_y = 0.5 * ((c - a) + (d - b)) / ((y1 - y0) * cell)
    base = 0.25 * (a + b + c + d) - 0.5 * cell * (slope_x * (x1 - x0) + slope_y * (y1 - y0))
    if math.isnan(base):  # a corner isn't known
        slope_x, slope_y, base = 0.0, 0.0, 0.0
    below, above, top = np.inf, -np.inf, -np.inf
    for y in range(y0, y1 + 1):
        for x in range(x0, x1 + 1):
            height = heights[y, x]
            if not math.isnan(height):
                off = height - base - cell * (slope_x * (x - x0) + slope_y * (y - y0))
                below = min(below, off)
                above = max(above, off)
                top = max(top, height)
    planes[row, 0] = base
    planes[row, 1] = slope_x
    planes[row, 2] = slope_y
    planes[row, 3] = below
    planes[row, 4] = above
    return top


@kernel
def fill_pyramid(
    heights: Floats, cell: float, unknown: float, levels: Ints, tops: Floats, planes: Floats
) -> None:
    """Set what is known of the cells of all levels.

    Args:
        heights: Of the nodes [m], (ny, nx).
        cell: From node to node [m].
        unknown: Height of a patch that isn't known [m]: inf or -inf.
        levels: As in PackedSpace, (l, 3).
        tops: Filled in place, (c,).
        planes: Filled in place, (c, 5).
    """
    last_y, last_x = heights.shape[0] - 1, heights.shape[1] - 1
    for level in range(levels.shape[0]):
        size = 4 << (2 * level)
        for j in range(levels[level, 1]):
            for i in range(levels[level, 0]):
                row = levels[level, 2] + i + levels[level, 0] * j
                x0, y0 = i * size, j * size
                x1, y1 = min(x0 + size, last_x), min(y0 + size, last_y)
                top = _fit(heights, x0, y0, x1, y1, cell, planes, row)
                if unknown == np.inf and top < np.inf:
                    for y in range(y0, y1 + 1):
                        for x in range(x0, x1 + 1):
                            if math.isnan(heights[y, x]):
                                top = unknown
                tops[row] = top


@inlined
def patch_at(space: PackedSpace, x: float, y: float) -> tuple[int, int, float, float]:
    """The patch that (x, y) lies in, and where in it in parts of its sides.

    Returns:
        (i, j, u, v): i is -1 outside of the terrain.
    """
    frame = space.ground_frame
    px = (x - frame[0]) / frame[2]
    py = (y - frame[1]) / frame[2]
    columns, rows = space.heights.shape[1] - 1, space.heights.shape[0] - 1
    if not (0.0 <= px <= columns and 0.0 <= py <= rows):
        return -1, -1, 0.0, 0.0
    i, j = min(int(px), columns - 1), min(int(py), rows - 1)
    return i, j, px - i, py - j


@inlined
def ground_height(space: PackedSpace, x: float, y: float) -> float:
    """Height of the ground at (x, y) [m]: nan where none is known, -inf without any ground."""
    if not has_terrain(space):
        return space.ground_frame[3]
    i, j, u, v = patch_at(space, x, y)
    if i < 0:
        return math.nan
    nodes = space.heights
    low = nodes[j, i] + u * (nodes[j, i + 1] - nodes[j, i])
    high = nodes[j + 1, i] + u * (nodes[j + 1, i + 1] - nodes[j + 1, i])
    return low + v * (high - low)


@kernel
def ground_heights(space: PackedSpace, places: Floats) -> Floats:
    """Height of the ground at places (n, 2) [m]; see ``ground_height``."""
    found = np.empty(places.shape[0])
    for k in range(places.shape[0]):
        found[k] = ground_height(space, places[k, 0], places[k, 1])
    return found
