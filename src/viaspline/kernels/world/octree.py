"""OctoMap's bits of an octree: which cubes they say to be free, and which blocked.

Each inner node is two bytes, two bits a child (0 unknown, 1 free, 2 blocked, 3 an inner node), the
inner children behind it one after the other, each with all that is below it. Child ``i`` lies at
``x + (i & 1)``, ``y + (i >> 1 & 1)``, ``z + (i >> 2)`` of half its parent's size.

Source: OccupancyOcTreeBase::readBinaryNode of OctoMap (Hornung et al. 2013, Autonomous Robots 34).

Tested through ``maps/test_octomap``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Bytes, Flags, Ints
from viaspline.kernels.jit import inner, kernel

DEPTH = 16
"""How often the root is halved; places count from 0 to 2 ** DEPTH cubes along each axis."""
TOO_SHORT = -1
TOO_DEEP = -2

_FREE = 1
_INNER = 3


@inner
def _state(data: Bytes, at: int, child: int) -> int:
    return (data[at + (child >> 2)] >> (2 * (child & 3))) & 3


@inner
def _place(parent: Ints, child: int, place: Ints) -> None:
    """Where a child lies, and how often it can be halved."""
    half = 1 << (parent[3] - 1)
    place[0] = parent[0] + half * (child & 1)
    place[1] = parent[1] + half * (child >> 1 & 1)
    place[2] = parent[2] + half * (child >> 2)
    place[3] = parent[3] - 1


@kernel
def octree_extent(data: Bytes, extent: Ints) -> tuple[int, int]:
    """Look through a whole octree.

    Args:
        data: Its bytes from the root on.
        extent: Becomes the box of all that is known: first x, y, z, then those beyond the last.

    Returns:
        How many bytes were read and how many nodes there are, the root among them. The first is
        `TOO_SHORT` where bytes are missing, `TOO_DEEP` where a single cube has children.
    """
    stack = np.zeros((8 * DEPTH + 8, 4), np.int64)
    stack[0, 3] = DEPTH
    top, at, nodes = 1, 0, 1
    for k in range(3):
        extent[k], extent[3 + k] = 1 << DEPTH, 0
    parent, place = np.zeros(4, np.int64), np.zeros(4, np.int64)
    while top > 0:
        top -= 1
        for k in range(4):
            parent[k] = stack[top, k]
        if at + 2 > len(data):
            return TOO_SHORT, nodes
        for child in range(7, -1, -1):
            state = _state(data, at, child)
            if state == 0:
                continue
            nodes += 1
            _place(parent, child, place)
            if state == _INNER:
                if place[3] == 0:
                    return TOO_DEEP, nodes
                for k in range(4):
                    stack[top, k] = place[k]
                top += 1
            else:
                for k in range(3):
                    extent[k] = min(extent[k], place[k])
                    extent[3 + k] = max(extent[3 + k], place[k] + (1 << place[3]))
        at += 2
    return at, nodes


@kernel
def fill_from_octree(data: Bytes, first: Ints, blocked: Flags) -> None:
    """Write what an octree knows into an array of cubes; the others are left as they are.

    Args:
        data: Its bytes, found whole by `octree_extent`.
        first: The place of cube (0, 0, 0): x, y, z.
        blocked: Cubes, shape (nx, ny, nz), which cover all that is known.
    """
    stack = np.zeros((8 * DEPTH + 8, 4), np.int64)
    stack[0, 3] = DEPTH
    top, at = 1, 0
    parent, place = np.zeros(4, np.int64), np.zeros(4, np.int64)
    while top > 0:
        top -= 1
        for k in range(4):
            parent[k] = stack[top, k]
        for child in range(7, -1, -1):
            state = _state(data, at, child)
            if state == 0:
                continue
            _place(parent, child, place)
            if state == _INNER:
                for k in range(4):
                    stack[top, k] = place[k]
                top += 1
                continue
            side = 1 << place[3]
            x, y, z = place[0] - first[0], place[1] - first[1], place[2] - first[2]
            for i in range(x, x + side):
                for j in range(y, y + side):
                    for k in range(z, z + side):
                        blocked[i, j, k] = state != _FREE
        at += 2
