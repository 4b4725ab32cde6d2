"""Whether a robot that drives a cubic in time stays clear of what stands and of what moves.

The cubic is looked at in chords that are evenly driven; how far it bows out from one is bounded, so
what is found clear is clear.

Tested through ``spacetime/test_searched_paths``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from viaspline.kernels.arrays import Ints
from viaspline.kernels.jit import inlined, inner
from viaspline.kernels.motion.motion_pairs import next_piece
from viaspline.kernels.motion.moving_distance import piece_at, piece_distance
from viaspline.kernels.motion.moving_gap import gap_bounds
from viaspline.kernels.motion.packed_motion import GROWTH, PackedMotion
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.segment import nearest_to_segment

CHORD_S = 0.2  # a chord lasts so long at most [s]
SPEEDS_SEEN = 4  # a cubic's speed is looked at in the middle of so many parts
ROUNDING = 1.0 + 1e-9


class KeptClear(NamedTuple):
    """What a robot has to keep clear of.

    Attributes:
        world: What stands.
        motion: What moves.
        to_standing: From the robot's centre to what stands [m].
        to_moving: And to what moves [m].
    """

    world: PackedWorld
    motion: PackedMotion
    to_standing: float
    to_moving: float


class Thrust(NamedTuple):
    """A cubic in time: where a robot is from one instant on.

    Attributes:
        begin: The instant [s].
        lasts: For how long it is driven [s].
        x: [m].
        y: [m].
        vx: [m/s].
        vy: [m/s].
        ax: [m/s²].
        ay: [m/s²].
        jx: [m/s³].
        jy: [m/s³].
    """

    begin: float
    lasts: float
    x: float
    y: float
    vx: float
    vy: float
    ax: float
    ay: float
    jx: float
    jy: float


@inlined
def place_on(thrust: Thrust, late: float) -> tuple[float, float]:
    """Where the robot is so long after the beginning [m]."""
    x = thrust.x + late * (thrust.vx + late * (0.5 * thrust.ax + late * thrust.jx / 6.0))
    y = thrust.y + late * (thrust.vy + late * (0.5 * thrust.ay + late * thrust.jy / 6.0))
    return x, y


@inlined
def thrust_between(start: Thrust, lasts: float, x: float, y: float, vx: float, vy: float) -> Thrust:
    """The cubic from the beginning of a thrust to a place and speed so long after it [s]."""
    dx, dy = x - start.x, y - start.y
    ax = (6.0 * dx / lasts - 4.0 * start.vx - 2.0 * vx) / lasts
    ay = (6.0 * dy / lasts - 4.0 * start.vy - 2.0 * vy) / lasts
    jx = (6.0 * (start.vx + vx) - 12.0 * dx / lasts) / (lasts * lasts)
    jy = (6.0 * (start.vy + vy) - 12.0 * dy / lasts) / (lasts * lasts)
    return Thrust(start.begin, lasts, start.x, start.y, start.vx, start.vy, ax, ay, jx, jy)


@inner
def keeps_limits(thrust: Thrust, hardest: float, top: float) -> bool:
    """Whether a cubic is driven without more acceleration or speed than there is, nearly."""
    end_ax, end_ay = thrust.ax + thrust.lasts * thrust.jx, thrust.ay + thrust.lasts * thrust.jy
    if max(thrust.ax**2 + thrust.ay**2, end_ax**2 + end_ay**2) > hardest * hardest * ROUNDING:
        return False
    for k in range(1, SPEEDS_SEEN):
        late = thrust.lasts * k / SPEEDS_SEEN
        vx = thrust.vx + late * (thrust.ax + 0.5 * late * thrust.jx)
        vy = thrust.vy + late * (thrust.ay + 0.5 * late * thrust.jy)
        if vx * vx + vy * vy > top * top * ROUNDING:
            return False
    return True


@inlined
def near_ones(
    around: KeptClear, x: float, y: float, begin: float, lasts: float, top: float, out: Ints
) -> int:
    """Which obstacles may come too near to a robot that is at (x, y) and drives on.

    Args:
        around: KeptClear.
        x: [m].
        y: [m].
        begin: When it is there [s].
        lasts: For how long it drives on [s].
        top: The fastest that it goes [m/s].
        out: Where their indices are written, (n,).

    Returns:
        How many there are.
    """
    motion = around.motion
    found = 0
    for i in range(motion.first_piece.size - 1):
        row, shift, until = piece_at(motion, i, begin)
        if until >= begin + lasts:
            closing = top + motion.speeds[i] + motion.errors[i, GROWTH]
            far = around.to_moving + closing * lasts
            if piece_distance(motion, i, row, shift, begin, x, y, far) >= far:
                continue
        out[found] = i
        found += 1
    return found


@inlined
def _clear_of(
    around: KeptClear, i: int, begin: float, end: float, ax: float, ay: float, bx: float,
    by: float, sag: float,
) -> bool:  # fmt: skip
    """Whether obstacle i stays clear of a chord that is evenly driven from one time to another."""
    motion, enough = around.motion, around.to_moving
    row, shift, until = piece_at(motion, i, begin)
    now = begin
    while True:
        stop = min(until, end)
        first, last = (now - begin) / (end - begin), (stop - begin) / (end - begin)
        gap, _ = gap_bounds(
            motion, i, row, shift, now, stop, ax + first * (bx - ax), ay + first * (by - ay),
            ax + last * (bx - ax), ay + last * (by - ay), sag, enough,
        )  # fmt: skip
        if gap < enough:
            return False
        if stop >= end:
            return True
        now = stop
        row, shift, until = next_piece(motion, i, row, shift)


@inlined
def thrust_is_clear(around: KeptClear, thrust: Thrust, near: Ints, count: int) -> bool:
    """Whether a robot that drives a cubic keeps its distances.

    Args:
        around: KeptClear.
        thrust: The cubic.
        near: The obstacles that may come near, see ``near_ones``.
        count: How many of them.
    """
    chords = max(math.ceil(thrust.lasts / CHORD_S), 1)
    step = thrust.lasts / chords
    end_ax, end_ay = thrust.ax + thrust.lasts * thrust.jx, thrust.ay + thrust.lasts * thrust.jy
    hardest = math.sqrt(max(thrust.ax**2 + thrust.ay**2, end_ax**2 + end_ay**2))
    sag = 0.125 * hardest * step * step
    ax, ay = thrust.x, thrust.y
    for k in range(chords):
        bx, by = place_on(thrust, (k + 1) * step)
        gap, _ = nearest_to_segment(around.world, ax, ay, bx, by, around.to_standing + sag)
        if gap < around.to_standing + sag:
            return False
        begin = thrust.begin + k * step
        for j in range(count):
            if not _clear_of(around, near[j], begin, begin + step, ax, ay, bx, by, sag):
                return False
        ax, ay = bx, by
    return True


@inner
def cubic_is_clear(around: KeptClear, thrust: Thrust, top: float, near: Ints) -> bool:
    """Whether a robot that drives a cubic, at most so fast [m/s], keeps its distances."""
    count = near_ones(around, thrust.x, thrust.y, thrust.begin, thrust.lasts, top, near)
    return thrust_is_clear(around, thrust, near, count)
