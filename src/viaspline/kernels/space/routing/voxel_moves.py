"""What a voxel block answers to a search for a route: see ``route_protocol``.

Tested through ``kernels/space/routing/test_lazy_theta`` and
``kernels/space/routing/test_pull_taut``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, inner
from viaspline.kernels.space.routing.planes import add_plane
from viaspline.kernels.space.routing.route_protocol import (
    PlaceLattice,
    answers_route,
    is_free,
    is_open,
    neighbours,
    open_moves,
    touched,
)
from viaspline.kernels.space.routing.voxel_block import VoxelBlock, is_blocked, is_inside
from viaspline.kernels.space.routing.voxel_segment import (
    cube_on_segment,
    keeps_limits,
    segment_is_free,
)


def _needed(move: int) -> int:
    """The cubes that a ball passes on a move to a neighbour: all between the two."""
    spans = [(0,) if d == 0 else (0, d) for d in (move // 9 - 1, move // 3 % 3 - 1, move % 3 - 1)]
    return sum(
        1 << (9 * (a + 1) + 3 * (b + 1) + c + 1)
        for a in spans[0]
        for b in spans[1]
        for c in spans[2]
    )


NEEDED = tuple(_needed(move) for move in range(27))


@inner
def _free_about(block: VoxelBlock, i: int, j: int, k: int) -> int:
    """Which of the 27 cubes round one are free; all are where the next blocked one is far."""
    free = 0
    for a in range(3):
        for b in range(3):
            for c in range(3):
                x = i + a - 1
                y = j + b - 1
                z = k + c - 1
                if not is_inside(block, x, y, z) or not is_blocked(block, x, y, z):
                    free |= 1 << (9 * a + 3 * b + c)
    return free


@inlined
def _is_own(block: VoxelBlock, lattice: PlaceLattice) -> bool:
    """Whether the places of a lattice are the middles of the cubes."""
    cell = block.frame[3]
    own = lattice.frame[3] == cell
    for axis in range(3):
        own = own and lattice.frame[axis] == block.frame[axis] + 0.5 * cell
    return own


@answers_route(is_free, VoxelBlock)
def _free_way(
    block: VoxelBlock,
    x: float,
    y: float,
    z: float,
    dx: float,
    dy: float,
    dz: float,
    radius: float,
) -> bool:
    if not keeps_limits(block, x, y, z) or not keeps_limits(block, x + dx, y + dy, z + dz):
        return False
    size = 1.0 / block.frame[3]
    return segment_is_free(
        block,
        (x - block.frame[0]) * size,
        (y - block.frame[1]) * size,
        (z - block.frame[2]) * size,
        dx * size,
        dy * size,
        dz * size,
        radius * size,
    )


@answers_route(is_open, VoxelBlock)
def _is_open(block: VoxelBlock, x: float, y: float, z: float, radius: float) -> bool:
    cell = block.frame[3]
    i = math.floor((x - block.frame[0]) / cell)
    j = math.floor((y - block.frame[1]) / cell)
    k = math.floor((z - block.frame[2]) / cell)
    return not is_inside(block, i, j, k) or not is_blocked(block, i, j, k)


@answers_route(open_moves, VoxelBlock)
def _open_moves(
    block: VoxelBlock, lattice: PlaceLattice, i: int, j: int, k: int, radius: float
) -> int:
    found = neighbours(lattice, i, j, k)
    if radius > 0.5 * block.frame[3] or not _is_own(block, lattice):
        return found
    free = _free_about(block, i, j, k)
    for move in range(27):
        if free & NEEDED[move] != NEEDED[move]:
            found &= ~(1 << move)
    return found


@inlined
def _clamped(e: float) -> float:
    return min(max(e, 0.0), 1.0)


@inner
def _touched_by_piece(
    block: VoxelBlock,
    x: float,
    y: float,
    z: float,
    dx: float,
    dy: float,
    dz: float,
    first: float,
    last: float,
    near: float,
    radius: float,
    planes: Floats,
    count: int,
) -> int:
    """Planes of the cubes about a part of a segment; x, y, z, near and radius in cubes."""
    cell = block.frame[3]
    counts = block.counts
    ax = x + first * dx
    ay = y + first * dy
    az = z + first * dz
    bx = x + last * dx
    by = y + last * dy
    bz = z + last * dz
    i1 = min(counts[0] - 1, math.floor(max(ax, bx) + near))
    j1 = min(counts[1] - 1, math.floor(max(ay, by) + near))
    k1 = min(counts[2] - 1, math.floor(max(az, bz) + near))
    for i in range(max(0, math.floor(min(ax, bx) - near)), i1 + 1):
        for j in range(max(0, math.floor(min(ay, by) - near)), j1 + 1):
            for k in range(max(0, math.floor(min(az, bz) - near)), k1 + 1):
                if not is_blocked(block, i, j, k):
                    continue
                square, t = cube_on_segment(x - i, y - j, z - k, dx, dy, dz, 0.0, 1.0)
                if square >= near * near or square == 0.0:
                    continue
                ex = x + t * dx
                ey = y + t * dy
                ez = z + t * dz
                sx = i + _clamped(ex - i)
                sy = j + _clamped(ey - j)
                sz = k + _clamped(ez - k)
                size = 1.0 / math.sqrt(square)
                nx = (ex - sx) * size
                ny = (ey - sy) * size
                nz = (ez - sz) * size
                offset = nx * (block.frame[0] + sx * cell)
                offset += ny * (block.frame[1] + sy * cell)
                offset += nz * (block.frame[2] + sz * cell)
                count = add_plane(planes, count, nx, ny, nz, offset + radius, t)
    return count


@answers_route(touched, VoxelBlock)
def _touched_cubes(
    block: VoxelBlock,
    x: float,
    y: float,
    z: float,
    dx: float,
    dy: float,
    dz: float,
    radius: float,
    reach: float,
    planes: Floats,
    count: int,
) -> int:
    size = 1.0 / block.frame[3]
    longest = max(abs(dx), abs(dy), abs(dz)) * size
    pieces = max(1, math.ceil(0.5 * longest))
    near = (radius + reach) * size
    limits = block.limits
    for side in range(2):  # a way between two places within limits is within them
        sign = 1.0 - 2.0 * side
        count = add_plane(planes, count, sign, 0.0, 0.0, sign * limits[3 * side], 1.0)
        count = add_plane(planes, count, 0.0, sign, 0.0, sign * limits[3 * side + 1], 1.0)
        count = add_plane(planes, count, 0.0, 0.0, sign, sign * limits[3 * side + 2], 1.0)
    for piece in range(pieces):
        count = _touched_by_piece(
            block,
            (x - block.frame[0]) * size,
            (y - block.frame[1]) * size,
            (z - block.frame[2]) * size,
            dx * size,
            dy * size,
            dz * size,
            piece / pieces,
            (piece + 1) / pieces,
            near,
            radius,
            planes,
            count,
        )
    return count
