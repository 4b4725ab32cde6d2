"""How far an upright cylinder is from the ground, taken as columns: one for each patch.

A column is as high as the highest corner of its patch, and has no lower end. Where ground that is
not known blocks, all beyond the terrain's edge does. Flat ground is one column without sides.

Tested through ``kernels/space/test_space_distance``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.jit import inlined, uncounted
from viaspline.kernels.space.ground_pyramid import has_terrain, patch_top
from viaspline.kernels.space.near_first import cell_at, nearest_of_four, step_of
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.product_distance import chord_product, combined, rectangle_signed
from viaspline.kernels.space.voxel_distance import cut

ALL_STEPS = 16  # through the cells below one


@inlined
def _top_of(space: PackedSpace, level: int, i: int, j: int) -> float:
    """Height of the highest corner in a cell; level -1 are the patches."""
    if level < 0:
        return patch_top(space, i, j)
    row = space.ground_levels[level]
    return space.ground_tops[row[2] + i + row[0] * j]


@inlined
def _columns_of(space: PackedSpace, level: int) -> int:
    return space.heights.shape[1] - 1 if level < 0 else space.ground_levels[level, 0]


@inlined
def _rows_of(space: PackedSpace, level: int) -> int:
    return space.heights.shape[0] - 1 if level < 0 else space.ground_levels[level, 1]


@inlined
def _size_of(level: int) -> float:
    """Patches along the side of a cell."""
    return float(1 << (2 * (level + 1)))


@inlined
def _edge(space: PackedSpace, px: float, py: float) -> float:
    """How far (px, py), in patches, lies inside of the terrain [m]; inf if all is free beyond."""
    if space.ground_frame[4] < 0.0:
        return np.inf
    rows, columns = space.heights.shape
    inside = -rectangle_signed(px, py, 0.0, 0.0, columns - 1.0, rows - 1.0)
    return inside * space.ground_frame[2]


@uncounted
def _terrain_signed(space: PackedSpace, x: float, y: float, z: float, limit: float) -> float:
    """Signed distance between the terrain's columns and the core at a place [m]."""
    radius, half = space.core[0], space.core[1]
    best = limit
    frame = space.ground_frame
    side = frame[2]
    px, py = (x - frame[0]) / side, (y - frame[1]) / side
    i = int(min(max(px, 0.0), space.heights.shape[1] - 2.0))
    j = int(min(max(py, 0.0), space.heights.shape[0] - 2.0))
    a = rectangle_signed(px, py, float(i), float(j), i + 1.0, j + 1.0) * side - radius
    best = min(best, combined(a, z - patch_top(space, i, j) - half), _edge(space, px, py) - radius)
    top = space.ground_levels.shape[0] - 1
    level, i, j, step = top, 0, 0, 0
    while True:  # the cells below cell (i, j) of a level, from the nearest on
        size = _size_of(level - 1)
        near_x, near_y = nearest_of_four(px, 4 * i, size), nearest_of_four(py, 4 * j, size)
        if step < 0:  # back from the cell whose number it is
            step = 1 + step_of(near_x, (-1 - step) & 3) + 4 * step_of(near_y, (-1 - step) >> 2)
        down = False
        while step < ALL_STEPS:
            ci, cj = 4 * i + cell_at(near_x, step & 3), 4 * j + cell_at(near_y, step >> 2)
            step += 1
            if ci >= _columns_of(space, level - 1) or cj >= _rows_of(space, level - 1):
                continue
            b = z - _top_of(space, level - 1, ci, cj) - half
            if b >= best:
                continue
            x0, y0 = ci * size, cj * size
            a = rectangle_signed(px, py, x0, y0, x0 + size, y0 + size) * side - radius
            bound = combined(a, b)
            if bound >= best:
                continue
            if level == 0:
                best = bound
                continue
            level, i, j, step, down = level - 1, ci, cj, 0, True
            break
        if down:
            continue
        if level == top:
            return best
        step = -1 - ((i & 3) + 4 * (j & 3))
        level, i, j = level + 1, i >> 2, j >> 2


@uncounted
def _terrain_chord(
    space: PackedSpace, ax: float, ay: float, az: float, dx: float, dy: float, dz: float,
    limit: float,
) -> float:  # fmt: skip
    """Distance between the terrain's columns and the core along the chord from a by d [m]."""
    radius, half = space.core[0], space.core[1]
    frame = space.ground_frame
    side = frame[2]
    best = limit
    middle = ground_signed(space, ax + 0.5 * dx, ay + 0.5 * dy, az + 0.5 * dz, limit)
    if middle < best:
        best = max(middle, 0.0)
    ax, ay = ax - frame[0], ay - frame[1]
    lowest = min(az, az + dz)
    best = min(best, _edge(space, ax / side, ay / side) - radius)
    best = min(best, _edge(space, (ax + dx) / side, (ay + dy) / side) - radius)
    top = space.ground_levels.shape[0] - 1
    mx, my = (ax + 0.5 * dx) / side, (ay + 0.5 * dy) / side
    level, i, j, step = top, 0, 0, 0
    while best > 0.0:  # the cells below cell (i, j) of a level, from the nearest on
        cells = _size_of(level - 1)
        size = cells * side
        near_x, near_y = nearest_of_four(mx, 4 * i, cells), nearest_of_four(my, 4 * j, cells)
        if step < 0:  # back from the cell whose number it is
            step = 1 + step_of(near_x, (-1 - step) & 3) + 4 * step_of(near_y, (-1 - step) >> 2)
        down = False
        while step < ALL_STEPS:
            ci, cj = 4 * i + cell_at(near_x, step & 3), 4 * j + cell_at(near_y, step >> 2)
            step += 1
            if ci >= _columns_of(space, level - 1) or cj >= _rows_of(space, level - 1):
                continue
            roof = _top_of(space, level - 1, ci, cj) + half
            if lowest - roof >= best:
                continue
            x0, y0, wide = ci * size, cj * size, best + radius
            near, far = cut(0.0, 1.0, ax, dx, x0 - wide, x0 + size + wide)
            near, far = cut(near, far, ay, dy, y0 - wide, y0 + size + wide)
            if far < near or min(az + near * dz, az + far * dz) - roof >= best:
                continue
            if level == 0:
                best = chord_product(
                    ax, ay, az, dx, dy, dz, x0, y0, x0 + size, y0 + size, -np.inf, roof, radius,
                    best,
                )  # fmt: skip
                continue
            level, i, j, step, down = level - 1, ci, cj, 0, True
            break
        if down:
            continue
        if level == top:
            break
        step = -1 - ((i & 3) + 4 * (j & 3))
        level, i, j = level + 1, i >> 2, j >> 2
    return best


@inlined
def ground_signed(space: PackedSpace, x: float, y: float, z: float, limit: float) -> float:
    """Signed distance between the ground's columns and the core at a place [m]."""
    if has_terrain(space):
        return _terrain_signed(space, x, y, z, limit)
    return min(z - space.ground_frame[3] - space.core[1], limit)


@inlined
def ground_chord(
    space: PackedSpace, ax: float, ay: float, az: float, dx: float, dy: float, dz: float,
    limit: float,
) -> float:  # fmt: skip
    """Distance between the ground's columns and the core along the chord from a by d [m]."""
    if has_terrain(space):
        return _terrain_chord(space, ax, ay, az, dx, dy, dz, limit)
    return min(max(min(az, az + dz) - space.ground_frame[3] - space.core[1], 0.0), limit)
