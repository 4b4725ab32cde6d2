"""Where a moving obstacle is at an instant, and how far from it a place is then.

Tested through ``world/test_moving_obstacles``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inlined, kernel, uncounted
from viaspline.kernels.motion.packed_motion import (
    BEGINS,
    GROWTH,
    HEADING,
    KNOWN,
    PRESENT,
    SINCE,
    SPEED_X,
    SPEED_Y,
    TURNING,
    UNCERTAIN,
    PackedMotion,
    X,
    Y,
)
from viaspline.kernels.world.shape import obstacle_signed


@inlined
def piece_at(motion: PackedMotion, i: int, instant: float) -> tuple[int, float, float]:
    """The piece of obstacle i at an instant [s].

    Returns:
        (row, shift, until): its row; the time of the mission's clock that is time 0 of the row
        [s]; when the next one begins [s], infinite if none does.
    """
    first = motion.first_piece[i]
    low = first
    high = motion.first_piece[i + 1] - 1
    began = motion.rounds[i, 0]
    period = motion.rounds[i, 1]
    shift = 0.0
    if period > 0.0:
        shift = math.floor((instant - began) / period) * period
        if instant - shift >= began + period:  # rounding
            shift += period
    local = instant - shift
    while low < high:
        middle = (low + high + 1) // 2
        if motion.pieces[middle, BEGINS] <= local:
            low = middle
        else:
            high = middle - 1
    if low + 1 < motion.first_piece[i + 1]:
        until = motion.pieces[low + 1, BEGINS] + shift
    elif period > 0.0:
        until = began + period + shift
    else:
        until = np.inf
    return low, shift, until


@inlined
def uncertainty(motion: PackedMotion, i: int, instant: float) -> float:
    """How far from its place obstacle i may be at an instant [m]."""
    errors = motion.errors[i]
    return errors[UNCERTAIN] + errors[GROWTH] * max(0.0, instant - errors[SINCE])


@inlined
def piece_distance(
    motion: PackedMotion, i: int, row: int, shift: float, instant: float,
    x: float, y: float, limit: float,
) -> float:  # fmt: skip
    """Distance from (x, y) to obstacle i on a piece of its motion, less how far off it may be [m].

    Args:
        motion: PackedMotion.
        i: The obstacle.
        row: Its piece; see ``piece_at``.
        shift: Time 0 of the piece [s].
        instant: [s].
        x: [m].
        y: [m].
        limit: Is answered where it is farther away, or isn't there [m].
    """
    piece = motion.pieces[row]
    if piece[PRESENT] == 0.0:
        return limit
    late = instant - shift - piece[KNOWN]
    dx = x - piece[X] - piece[SPEED_X] * late
    dy = y - piece[Y] - piece[SPEED_Y] * late
    error = uncertainty(motion, i, instant)
    far = limit + error + motion.reaches[i]  # from the frame's origin: no point of it is nearer
    if far > 0.0 and dx * dx + dy * dy >= far * far:
        return limit
    heading = piece[HEADING] + piece[TURNING] * late
    if heading != 0.0:
        c = math.cos(heading)
        s = math.sin(heading)
        dx, dy = c * dx + s * dy, c * dy - s * dx
    slot = motion.shapes.slot[i]
    if slot >= 0 and motion.shapes.heads[slot, 3] == 1.0:  # a disc
        head = motion.shapes.heads[slot]
        return min(limit, math.hypot(dx - head[0], dy - head[1]) - head[2] - error)
    return min(limit, obstacle_signed(motion.shapes, i, dx, dy, limit + error) - error)


@uncounted
def moving_distance(
    motion: PackedMotion, i: int, instant: float, x: float, y: float, limit: float
) -> float:
    """Signed distance from (x, y) to obstacle i at an instant [m]; see ``piece_distance``."""
    row, shift, _ = piece_at(motion, i, instant)
    return piece_distance(motion, i, row, shift, instant, x, y, limit)


@kernel
def moving_distances(motion: PackedMotion, instants: Floats, points: Floats) -> tuple[Floats, Ints]:
    """Signed distance of points (n, 2) at instants (n,), and the index of what is nearest.

    Infinite and -1 where nothing is there at that instant.
    """
    count = points.shape[0]
    distance = np.full(count, np.inf)
    index = np.full(count, -1, np.int64)
    for k in range(count):
        x, y, instant = points[k, 0], points[k, 1], instants[k]
        for i in range(motion.first_piece.size - 1):
            row, shift, _ = piece_at(motion, i, instant)
            found = piece_distance(motion, i, row, shift, instant, x, y, distance[k])
            if found < distance[k]:
                distance[k], index[k] = found, i
    return distance, index


@kernel
def frames_at(motion: PackedMotion, instant: float) -> Floats:
    """x, y [m], heading [rad] of all obstacles' frames at an instant, (n, 3); nan: not there."""
    count = motion.first_piece.size - 1
    frames = np.full((count, 3), np.nan)
    for i in range(count):
        row, shift, _ = piece_at(motion, i, instant)
        piece = motion.pieces[row]
        if piece[PRESENT] == 0.0:
            continue
        late = instant - shift - piece[KNOWN]
        frames[i, 0] = piece[X] + piece[SPEED_X] * late
        frames[i, 1] = piece[Y] + piece[SPEED_Y] * late
        frames[i, 2] = piece[HEADING] + piece[TURNING] * late
    return frames
