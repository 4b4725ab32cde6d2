"""Voxels as kernels see them: bits, four by four by four to a word, and how far words are free.

A word of zeros is a free block. Beside it stands how many blocks away the next one is that isn't
free, so that a segment crosses open space in a few steps. Of 88 million voxels that is 13 MB.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Bytes, Flags, Floats, Ints
from viaspline.kernels.jit import inlined, inner, kernel

FARTHEST = 255


class VoxelBlock(NamedTuple):
    """Cubes of space, some of them blocked; beyond them all is free.

    Attributes:
        words: Bit 16 (i mod 4) + 4 (j mod 4) + k mod 4 of word i/4, j/4, k/4 is cube (i, j, k),
            (bx, by, bz).
        skips: How many words away, along the axis where it is most, the next is that isn't free:
            0 is one with a blocked cube, (bx, by, bz).
        frame: Outer corner of cube (0, 0, 0) [m] and the side of a cube [m], (4,).
        counts: Cubes along x, y and z, (3,).
        limits: Places stay within x, y, z from and to [m], (6,).
    """

    words: Ints
    skips: Bytes
    frame: Floats
    counts: Ints
    limits: Floats


@inlined
def is_blocked(block: VoxelBlock, i: int, j: int, k: int) -> bool:
    """Whether a cube of the block is blocked."""
    bit = ((i & 3) << 4) | ((j & 3) << 2) | (k & 3)
    return (block.words[i >> 2, j >> 2, k >> 2] >> bit) & 1 == 1


@inlined
def is_inside(block: VoxelBlock, i: int, j: int, k: int) -> bool:
    """Whether the block has such a cube."""
    counts = block.counts
    return 0 <= i < counts[0] and 0 <= j < counts[1] and 0 <= k < counts[2]


@kernel
def packed_bits(blocked: Flags, words: Ints) -> None:
    """Write the words of cubes, (nx, ny, nz), into (bx, by, bz) zeros."""
    one = np.int64(1)
    for i in range(blocked.shape[0]):
        for j in range(blocked.shape[1]):
            for k in range(blocked.shape[2]):
                if blocked[i, j, k]:
                    bit = np.int64(((i & 3) << 4) | ((j & 3) << 2) | (k & 3))
                    words[i >> 2, j >> 2, k >> 2] |= one << bit


@inner
def _least_about(skips: Bytes, i: int, j: int, k: int, side: int) -> int:
    """The least of a block's skips and those of the 13 neighbours before or after it, and one."""
    least = int(skips[i, j, k])
    for place in range(13):
        at = place if side < 0 else 26 - place
        x = i + at // 9 - 1
        y = j + at // 3 % 3 - 1
        z = k + at % 3 - 1
        if 0 <= x < skips.shape[0] and 0 <= y < skips.shape[1] and 0 <= z < skips.shape[2]:
            least = min(least, int(skips[x, y, z]) + 1)
    return least


@kernel
def spread_skips(words: Ints, skips: Bytes) -> None:
    """Write how many words away the next is that isn't free, (bx, by, bz), up to 255.

    Two passes are exact for the chessboard distance: A. Rosenfeld and J. Pfaltz, "Sequential
    Operations in Digital Picture Processing", JACM 1966.
    """
    nx, ny, nz = words.shape
    for i in range(nx):
        for j in range(ny):
            for k in range(nz):
                skips[i, j, k] = 0 if words[i, j, k] != 0 else FARTHEST
                skips[i, j, k] = _least_about(skips, i, j, k, -1)
    for i in range(nx - 1, -1, -1):
        for j in range(ny - 1, -1, -1):
            for k in range(nz - 1, -1, -1):
                skips[i, j, k] = _least_about(skips, i, j, k, 1)


def voxel_block(
    blocked: Flags, cell: float, origin: tuple[float, float, float], limits: Floats
) -> VoxelBlock:
    """Cubes as kernels see them.

    Args:
        blocked: (nx, ny, nz).
        cell: Side of a cube [m].
        origin: Outer corner of cube (0, 0, 0) [m].
        limits: Within which places stay: x, y, z from and to [m], (6,).
    """
    shape = tuple((n + 3) // 4 for n in blocked.shape)
    words = np.zeros(shape, np.int64)
    packed_bits(blocked, words)
    skips = np.empty(shape, np.uint8)
    spread_skips(words, skips)
    frame = np.array((*origin, cell), np.float64)
    counts = np.array(blocked.shape, np.int64)
    return VoxelBlock(words, skips, frame, counts, np.array(limits, np.float64))
