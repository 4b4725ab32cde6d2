"""Voxels as bits: words of 4 x 4 x 4 cubes, and on each coarser level words of 4 x 4 x 4 words.

A bit for each cube and a 63rd of that above it: 88 million cubes take 11 MB. Words are signed, for
numba makes floats of a signed number and an unsigned one; the bits are the same.

Tested through ``kernels/space/test_voxel_words``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Flags, Ints
from viaspline.kernels.jit import inlined, kernel, uncounted
from viaspline.kernels.space.packed_space import PackedSpace


@inlined
def bit_of(x: int, y: int, z: int) -> int:
    """Which bit of its word a cube, or a word, is."""
    return (x & 3) + 4 * (y & 3) + 16 * (z & 3)


@kernel
def fill_words(blocked: Flags, levels: Ints, words: Ints) -> None:
    """Set the bits of blocked cubes, and those of the levels above.

    Args:
        blocked: Shape (nx, ny, nz).
        levels: As in PackedSpace, for these cubes alone, from fine to coarse, (l, 4).
        words: Zeros that are filled in place, (w,).
    """
    one = levels[0, 3] * 0 + 1
    across, deep, first = levels[0, 0], levels[0, 1], levels[0, 3]
    for x in range(blocked.shape[0]):
        for y in range(blocked.shape[1]):
            row = first + (x >> 2) + across * (y >> 2)
            for z in range(blocked.shape[2]):
                if blocked[x, y, z]:
                    words[row + across * deep * (z >> 2)] |= one << bit_of(x, y, z)
    for level in range(1, levels.shape[0]):
        nx, ny, nz, below = levels[level - 1]
        across, deep, _, first = levels[level]
        for k in range(nx * ny * nz):
            if words[below + k] != 0:
                x, y, z = k % nx, (k // nx) % ny, k // (nx * ny)
                at = first + (x >> 2) + across * ((y >> 2) + deep * (z >> 2))
                words[at] |= one << bit_of(x, y, z)


@uncounted
def to_voxels(
    space: PackedSpace, g: int, x: float, y: float, z: float
) -> tuple[float, float, float]:
    """A place in the frame of block g, in cubes."""
    frame = space.voxel_frames[g]
    px = x - frame[0]
    py = y - frame[1]
    scale = 1.0 / frame[5]
    u = (frame[3] * px + frame[4] * py) * scale
    v = (frame[3] * py - frame[4] * px) * scale
    return u, v, (z - frame[2]) * scale


@inlined
def layer(space: PackedSpace, g: int, cell: int, size: float) -> tuple[float, float]:
    """From which height to which a cell of a level reaches in block g [cubes]."""
    if math.isnan(space.voxel_frames[g, 6]):
        return cell * size, (cell + 1) * size
    return space.voxel_frames[g, 6], space.voxel_frames[g, 7]


@uncounted
def is_blocked(space: PackedSpace, g: int, i: int, j: int, k: int) -> bool:
    """Whether cube (i, j, k) of block g is blocked; outside of the block none is."""
    level = space.voxel_levels[space.voxel_starts[g]]
    x, y, z = i >> 2, j >> 2, k >> 2
    if not (0 <= x < level[0] and 0 <= y < level[1] and 0 <= z < level[2]):
        return False
    word = space.voxel_words[level[3] + x + level[0] * (y + level[1] * z)]
    return (word >> bit_of(i, j, k)) & 1 == 1
