"""How near a segment passes the cubes of a voxel block, exactly.

Here lengths are in cubes: a segment is p + t d for t from 0 to 1.
"""

from __future__ import annotations

import math

from viaspline.kernels.jit import inlined, inner
from viaspline.kernels.space.routing.voxel_block import VoxelBlock, is_blocked

_STEPS = 60


@inlined
def _beyond(e: float) -> float:
    """How far a coordinate lies outside of 0 to 1, with its sign."""
    if e < 0.0:
        return e
    if e > 1.0:
        return e - 1.0
    return 0.0


@inlined
def _inward_slope(e: float, d: float) -> float:
    """The square of a direction's part that changes the distance; 0 within the slab."""
    return d * d if e < 0.0 or e > 1.0 else 0.0


@inner
def cube_on_segment(
    x: float, y: float, z: float, dx: float, dy: float, dz: float, first: float, last: float
) -> tuple[float, float]:
    """Squared distance of the unit cube from a part of a segment, and where on it.

    The square is convex in t and quadratic in pieces: Newton's step within a bracket ends in the
    right piece, and there it is exact.

    Args:
        x: Where the segment begins, from the cube's least corner.
        y: Where it begins.
        z: Where it begins.
        dx: Where it goes.
        dy: Where it goes.
        dz: Where it goes.
        first: The part's beginning, t.
        last: Its end.

    Returns:
        (squared distance, t).
    """
    low = first
    high = last
    t = first
    for step in range(_STEPS):
        ex = x + t * dx
        ey = y + t * dy
        ez = z + t * dz
        slope = _beyond(ex) * dx + _beyond(ey) * dy + _beyond(ez) * dz
        if (step == 0 and slope >= 0.0) or (step == 1 and slope <= 0.0):
            break  # it only rises, or only falls
        if step == 0:
            t = last
            continue
        if slope > 0.0:
            high = t
        else:
            low = t
        bend = _inward_slope(ex, dx) + _inward_slope(ey, dy) + _inward_slope(ez, dz)
        if abs(slope) <= 1e-13 * bend or bend == 0.0:
            break
        t -= slope / bend
        if not low < t < high:
            t = 0.5 * (low + high)
    ex = _beyond(x + t * dx)
    ey = _beyond(y + t * dy)
    ez = _beyond(z + t * dz)
    return ex * ex + ey * ey + ez * ez, t


@inner
def _piece_is_free(
    block: VoxelBlock,
    x: float,
    y: float,
    z: float,
    dx: float,
    dy: float,
    dz: float,
    first: float,
    last: float,
    radius: float,
) -> bool:
    """Whether no blocked cube lies nearer than the radius to a part of a segment."""
    square = radius * radius
    ax = x + first * dx
    ay = y + first * dy
    az = z + first * dz
    bx = x + last * dx
    by = y + last * dy
    bz = z + last * dz
    counts = block.counts
    i0 = max(0, math.floor(min(ax, bx) - radius))
    j0 = max(0, math.floor(min(ay, by) - radius))
    k0 = max(0, math.floor(min(az, bz) - radius))
    i1 = min(counts[0] - 1, math.floor(max(ax, bx) + radius))
    j1 = min(counts[1] - 1, math.floor(max(ay, by) + radius))
    k1 = min(counts[2] - 1, math.floor(max(az, bz) + radius))
    for i in range(i0, i1 + 1):
        for j in range(j0, j1 + 1):
            for k in range(k0, k1 + 1):
                if is_blocked(block, i, j, k):
                    gap, _ = cube_on_segment(x - i, y - j, z - k, dx, dy, dz, first, last)
                    if gap < square:
                        return False
    return True


@inlined
def _leaves(at: float, d: float, low: float, high: float) -> float:
    """How much further along a coordinate leaves a slab; below 0 where it is outside."""
    if not low <= at <= high:
        return -1.0
    if d > 0.0:
        return (high - at) / d
    if d < 0.0:
        return (low - at) / d
    return math.inf


@inlined
def _free_stride(
    block: VoxelBlock,
    x: float,
    y: float,
    z: float,
    dx: float,
    dy: float,
    dz: float,
    radius: float,
) -> float:
    """How far along a segment is certainly free from here on: to where it leaves a free cube."""
    words = block.skips.shape
    i = min(max(0, int(x) >> 2), words[0] - 1)
    j = min(max(0, int(y) >> 2), words[1] - 1)
    k = min(max(0, int(z) >> 2), words[2] - 1)
    skip = int(block.skips[i, j, k])
    if skip == 0:
        return -1.0
    least = 4.0 * (1 - skip) + radius
    most = 4.0 * skip - radius
    far = _leaves(x, dx, 4.0 * i + least, 4.0 * i + most)
    far = min(far, _leaves(y, dy, 4.0 * j + least, 4.0 * j + most))
    return min(far, _leaves(z, dz, 4.0 * k + least, 4.0 * k + most))


@inlined
def keeps_limits(block: VoxelBlock, x: float, y: float, z: float) -> bool:
    """Whether a place [m] lies within the limits."""
    limits = block.limits
    return (
        limits[0] <= x <= limits[3] and limits[1] <= y <= limits[4] and limits[2] <= z <= limits[5]
    )


@inner
def segment_is_free(
    block: VoxelBlock,
    x: float,
    y: float,
    z: float,
    dx: float,
    dy: float,
    dz: float,
    radius: float,
) -> bool:
    """Whether a segment keeps a radius from every blocked cube."""
    longest = max(abs(dx), abs(dy), abs(dz))
    stride = 1.0 / longest if longest > 1.0 else 1.0
    t = 0.0
    while t < 1.0:
        far = _free_stride(block, x + t * dx, y + t * dy, z + t * dz, dx, dy, dz, radius)
        if far > 0.25 * stride:
            t += far
            continue
        until = min(1.0, t + stride)
        if not _piece_is_free(block, x, y, z, dx, dy, dz, t, until, radius):
            return False
        t = until
    return True
