"""How far an upright cylinder is from the blocked cubes of a block of voxels.

Both searches go down the levels of words: a word's set bits are cells of the level below, and those
that aren't nearer than what is known are left out.

Tested through ``kernels/space/test_space_distance``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.jit import inlined, uncounted
from viaspline.kernels.space.near_first import cell_at, nearest_of_four, step_of
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.product_distance import chord_product, combined, rectangle_signed
from viaspline.kernels.space.voxel_words import layer, to_voxels

NARROW_CELLS = 4.0  # cubes; within so little no time is lost by looking everywhere
ALL_STEPS = 64  # of a word


@inlined
def _word_of(space: PackedSpace, number: int, i: int, j: int, k: int) -> int:
    """Word (i, j, k) of a level, by its number among all levels."""
    level = space.voxel_levels[number]
    return space.voxel_words[level[3] + i + level[0] * (j + level[1] * k)]


@uncounted
def voxels_signed(space: PackedSpace, g: int, x: float, y: float, z: float, limit: float) -> float:
    """Signed distance between block g and the core at a place [m].

    In a blocked cube, or where the core reaches into one, it is that of the one cube.
    """
    side = space.voxel_frames[g, 5]
    u, v, w = to_voxels(space, g, x, y, z)
    radius, half = space.core[0] / side, space.core[1] / side
    within = limit / side
    best = within
    first = space.voxel_starts[g]
    top = space.voxel_starts[g + 1] - first - 1
    level, i, j, k, step = top, 0, 0, 0, 0
    while True:
        size = float(1 << (2 * level))
        near_x = nearest_of_four(u, 4 * i, size)
        near_y = nearest_of_four(v, 4 * j, size)
        near_z = nearest_of_four(w, 4 * k, size)
        if step < 0:  # back from the cell whose number it is
            cell = -1 - step
            step = 1 + step_of(near_x, cell & 3)
            step += 4 * step_of(near_y, (cell >> 2) & 3) + 16 * step_of(near_z, cell >> 4)
        word = _word_of(space, first + level, i, j, k)
        down = False
        while step < ALL_STEPS:
            row_y = cell_at(near_y, (step >> 2) & 3)
            row_z = cell_at(near_z, step >> 4)
            nibble = (word >> (4 * (row_y + 4 * row_z))) & 15
            cy, cz = 4 * j + row_y, 4 * k + row_z
            low, roof = layer(space, g, cz, size)
            b = max(low - w, w - roof) - half
            if nibble == 0 or b >= best or max(cy * size - v, v - (cy + 1) * size) - radius >= best:
                step = (step | 3) + 1
                continue
            cell = cell_at(near_x, step & 3)
            step += 1
            if (nibble >> cell) & 1 == 0:
                continue
            cx = 4 * i + cell
            x0, y0 = cx * size, cy * size
            a = rectangle_signed(u, v, x0, y0, x0 + size, y0 + size) - radius
            bound = combined(a, b)
            if bound >= best:
                continue
            if level == 0:
                best = bound
                continue
            level, i, j, k, step, down = level - 1, cx, cy, cz, 0, True
            break
        if down:
            continue
        if level == top:
            return best * side if best < within else limit
        step = -1 - ((i & 3) + 4 * (j & 3) + 16 * (k & 3))
        level, i, j, k = level + 1, i >> 2, j >> 2, k >> 2


@inlined
def cut(t: float, far: float, a: float, d: float, low: float, high: float) -> tuple[float, float]:
    """The part of [t, far] in which a + t d lies within an interval; empty where far < t."""
    if d == 0.0:
        return (t, far) if low <= a <= high else (1.0, -1.0)
    one = (low - a) / d
    other = (high - a) / d
    return max(t, min(one, other)), min(far, max(one, other))


@uncounted
def voxels_chord(
    space: PackedSpace, g: int, ax: float, ay: float, az: float, bx: float, by: float, bz: float,
    limit: float,
) -> float:  # fmt: skip
    """Distance between block g and the core along the chord from a to b [m]."""
    side = space.voxel_frames[g, 5]
    radius, half = space.core[0] / side, space.core[1] / side
    within = limit / side
    best = within
    if best > NARROW_CELLS:
        middle = voxels_signed(space, g, 0.5 * (ax + bx), 0.5 * (ay + by), 0.5 * (az + bz), limit)
        best = min(best, max(middle / side, 0.0))
        if best == np.inf:
            return limit
    ax, ay, az = to_voxels(space, g, ax, ay, az)
    bx, by, bz = to_voxels(space, g, bx, by, bz)
    dx, dy, dz = bx - ax, by - ay, bz - az
    first = space.voxel_starts[g]
    top = space.voxel_starts[g + 1] - first - 1
    level, i, j, k, step = top, 0, 0, 0, 0
    while best > 0.0:
        size = float(1 << (2 * level))
        wide, high = best + radius, best + half
        near_x = nearest_of_four(ax + 0.5 * dx, 4 * i, size)
        near_y = nearest_of_four(ay + 0.5 * dy, 4 * j, size)
        near_z = nearest_of_four(az + 0.5 * dz, 4 * k, size)
        if step < 0:  # back from the cell whose number it is
            cell = -1 - step
            step = 1 + step_of(near_x, cell & 3)
            step += 4 * step_of(near_y, (cell >> 2) & 3) + 16 * step_of(near_z, cell >> 4)
        word = _word_of(space, first + level, i, j, k)
        near, far = cut(0.0, 1.0, ax, dx, 4 * i * size - wide, 4 * (i + 1) * size + wide)
        if far < near:
            step = ALL_STEPS
        down = False
        while step < ALL_STEPS and best > 0.0:
            row_y = cell_at(near_y, (step >> 2) & 3)
            row_z = cell_at(near_z, step >> 4)
            nibble = (word >> (4 * (row_y + 4 * row_z))) & 15
            if nibble == 0:
                step = (step | 3) + 1
                continue
            cy, cz = 4 * j + row_y, 4 * k + row_z
            wide, high = best + radius, best + half
            enter, leave = cut(near, far, ay, dy, cy * size - wide, (cy + 1) * size + wide)
            low, roof = layer(space, g, cz, size)
            enter, leave = cut(enter, leave, az, dz, low - high, roof + high)
            if leave < enter:
                step = (step | 3) + 1
                continue
            west = min(ax + enter * dx, ax + leave * dx) - wide
            east = max(ax + enter * dx, ax + leave * dx) + wide
            if level == 0:
                step = (step | 3) + 1
                low, roof = low - half, roof + half
                best = _row_chord(
                    nibble, 4 * i, ax, ay, az, dx, dy, dz, cy, low, roof, radius, west, east, best
                )
                continue
            cell = cell_at(near_x, step & 3)
            step += 1
            cx = 4 * i + cell
            if (nibble >> cell) & 1 == 0 or (cx + 1) * size < west or cx * size > east:
                continue
            level, i, j, k, step, down = level - 1, cx, cy, cz, 0, True
            break
        if down:
            continue
        if level == top:
            break
        step = -1 - ((i & 3) + 4 * (j & 3) + 16 * (k & 3))
        level, i, j, k = level + 1, i >> 2, j >> 2, k >> 2
    return best * side if best < within else limit


@uncounted
def _row_chord(
    nibble: int, column: int, ax: float, ay: float, az: float, dx: float, dy: float, dz: float,
    cy: int, low: float, roof: float, radius: float, west: float, east: float, best: float,
) -> float:  # fmt: skip
    """Distance between a chord and the cubes of a row of four, neighbours as one [cubes]."""
    while nibble != 0:
        if nibble & 1 == 0:
            nibble >>= 1
            column += 1
            continue
        start = column
        while nibble & 1 == 1:
            nibble >>= 1
            column += 1
        if column >= west and start <= east:
            best = chord_product(
                ax, ay, az, dx, dy, dz, float(start), float(cy), float(column), cy + 1.0,
                low, roof, radius, best,
            )  # fmt: skip
    return best
