"""What a car can do next in a search through poses: moves of evenly changing curvature.

The curvature is on one of five levels from one turning circle to the other, and a move keeps it or
ramps it to the next level.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.turning.curvature_ramp import along_bend

LEVELS, WAYS = 5, 3  # of curvature; moves from each: down, keep, up
# columns of the scales
STEP, PACE, COUNT = range(3)


class MotionPrimitives(NamedTuple):
    """What a robot can do next: short moves where it is tight, longer ones where there is room.

    Attributes:
        sizes: The least radius; length of the ramps to it and back [m], (2,).
        scales: Of the short moves and of ever longer ones: their length, the distance between
            the places at which the body is looked at [m], how many these are, (k, 3).
        segments: Of the move on a scale from a level of curvature by a way: the ramp, and what
            is kept after it, (k * LEVELS * WAYS, 2, 3).
        places: Along every move from the origin: x, y, cosine and sine of the heading,
            (k * LEVELS * WAYS, n, 4).
        turns: By how much each turns [rad], (k * LEVELS * WAYS,).
    """

    sizes: Floats
    scales: Floats
    segments: Floats
    places: Floats
    turns: Floats


@kernel
def primitives_of(rho: float, ramp: float, steps: Floats, pace: float) -> MotionPrimitives:
    """The moves of a robot.

    Args:
        rho: The least radius [m].
        ramp: From no curvature to the most [m].
        steps: Lengths of the moves on every scale [m], at least half of ``ramp``, (k,).
        pace: Between places at which the body is looked at, at most [m].
    """
    most = math.ceil(steps.max() / pace)
    segments = np.zeros((steps.size * LEVELS * WAYS, 2, 3))
    places = np.zeros((steps.size * LEVELS * WAYS, most, 4))
    turns = np.zeros(steps.size * LEVELS * WAYS)
    scales = np.zeros((steps.size, 3))
    for scale in range(steps.size):
        step = steps[scale]
        count = math.ceil(step / pace)
        scales[scale, STEP], scales[scale, PACE], scales[scale, COUNT] = step, step / count, count
        for level in range(LEVELS):
            for way in range(WAYS):
                row = (scale * LEVELS + level) * WAYS + way
                turns[row] = _lay_move(
                    rho, ramp, step, count, level, way, segments[row], places[row]
                )
    return MotionPrimitives(np.array([rho, ramp]), scales, segments, places, turns)


@inner
def _lay_move(
    rho: float, ramp: float, step: float, count: int, level: int, way: int, segments: Floats,
    places: Floats,
) -> float:  # fmt: skip
    """Fill in the segments and places of a move; returns by how much it turns [rad]."""
    first = (level - LEVELS // 2) / (LEVELS // 2) / rho
    last = (level + way - 1 - LEVELS // 2) / (LEVELS // 2) / rho
    bend = min(0.5 * ramp, step) if way != 1 else 0.0
    segments[0, 0], segments[0, 1], segments[0, 2] = first, last, bend
    segments[1, 0], segments[1, 1], segments[1, 2] = last, last, step - bend
    x0, y0, turn0, turn = 0.0, 0.0, 0.0, 0.0
    if bend > 0.0:
        x0, y0, turn0 = along_bend(first, last, bend, bend)
    for k in range(count):
        s = step * (k + 1) / count
        if s <= bend:
            x, y, turn = along_bend(first, last, bend, s)
        else:
            dx, dy, more = along_bend(last, last, step, s - bend)
            c, sine = math.cos(turn0), math.sin(turn0)
            x, y, turn = x0 + c * dx - sine * dy, y0 + sine * dx + c * dy, turn0 + more
        places[k, 0], places[k, 1] = x, y
        places[k, 2], places[k, 3] = math.cos(turn), math.sin(turn)
    return turn
