"""How near a robot comes to an obstacle while both go evenly: bounds over a piece of time.

Seen from the frame of the obstacle the robot goes straight on, if that frame doesn't turn, and the
least distance is that of a segment: exact. How far the robot's true track is from the straight line
(its sag) comes off; where the frame turns by φ while the line goes from q0 to q1 in it, the line is
bent by no more than (2 |φ| |q1 - q0| + φ² max |q|) / 8, for in the frame q'' = -2 ω q' - ω² q.

Tested through ``trajectory/test_moving_certificate``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.jit import inlined, inner
from viaspline.kernels.motion.moving_distance import uncertainty
from viaspline.kernels.motion.packed_motion import (
    HEADING,
    KNOWN,
    PRESENT,
    SPEED_X,
    SPEED_Y,
    TURNING,
    PackedMotion,
    X,
    Y,
)
from viaspline.kernels.world.ring_distance import is_disc, radius_of
from viaspline.kernels.world.shape import obstacle_segment, obstacle_signed

TOUCHING_M = 1e-9  # what comes nearer than this is asked for its depth [m]


@inlined
def relative_line(
    motion: PackedMotion, row: int, shift: float, begin: float, end: float,
    ax: float, ay: float, bx: float, by: float,
) -> tuple[float, float, float, float]:  # fmt: skip
    """A line that is evenly driven, as seen from the origin of a frame that goes evenly [m].

    The arguments are those of ``gap_bounds``.
    """
    pieces = motion.pieces
    early = begin - shift - pieces[row, KNOWN]
    late = end - shift - pieces[row, KNOWN]
    ax -= pieces[row, X] + pieces[row, SPEED_X] * early
    ay -= pieces[row, Y] + pieces[row, SPEED_Y] * early
    bx -= pieces[row, X] + pieces[row, SPEED_X] * late
    by -= pieces[row, Y] + pieces[row, SPEED_Y] * late
    return ax, ay, bx, by


@inlined
def nearest_share(
    motion: PackedMotion, row: int, shift: float, begin: float, end: float,
    ax: float, ay: float, bx: float, by: float,
) -> float:  # fmt: skip
    """How far along such a line, in [0, 1], it is nearest to the origin of the frame."""
    ax, ay, bx, by = relative_line(motion, row, shift, begin, end, ax, ay, bx, by)
    dx = bx - ax
    dy = by - ay
    squared = dx * dx + dy * dy
    return min(1.0, max(0.0, -(ax * dx + ay * dy) / squared)) if squared > 0.0 else 0.0


@inlined
def circle_gap(
    motion: PackedMotion, i: int, row: int, shift: float, begin: float, end: float,
    ax: float, ay: float, bx: float, by: float,
) -> float:  # fmt: skip
    """Distance of such a line from the circle round obstacle i [m]; infinite where it isn't there.

    It is the obstacle's own if that is a disc about its origin.
    """
    if motion.pieces[row, PRESENT] == 0.0:
        return np.inf
    w = nearest_share(motion, row, shift, begin, end, ax, ay, bx, by)
    ax, ay, bx, by = relative_line(motion, row, shift, begin, end, ax, ay, bx, by)
    return math.sqrt((ax + w * (bx - ax)) ** 2 + (ay + w * (by - ay)) ** 2) - motion.reaches[i]


@inlined
def is_circle(motion: PackedMotion, i: int) -> bool:
    """Whether obstacle i is a disc about the origin of its frame."""
    slot = motion.shapes.slot[i]
    return is_disc(motion.shapes, slot) and radius_of(motion.shapes, slot) == motion.reaches[i]


@inner
def gap_bounds(
    motion: PackedMotion, i: int, row: int, shift: float, begin: float, end: float,
    ax: float, ay: float, bx: float, by: float, sag: float, enough: float,
) -> tuple[float, float]:  # fmt: skip
    """Bounds of the least distance between a robot's track and obstacle i on a piece of its motion.

    Args:
        motion: PackedMotion.
        i: The obstacle.
        row: Its piece; see ``piece_at``.
        shift: Time 0 of the piece [s].
        begin: The first instant [s].
        end: The last one [s].
        ax: Where the line begins that the track is near to [m].
        ay: The same.
        bx: Where it ends [m].
        by: The same.
        sag: How near [m].
        enough: What is farther away need not be known [m].

    Returns:
        (lower, upper) [m]: less how far off the obstacle may be. The upper one is infinite where
        the lower one is not below ``enough``.
    """
    circle = circle_gap(motion, i, row, shift, begin, end, ax, ay, bx, by)
    least = uncertainty(motion, i, begin)
    most = uncertainty(motion, i, end)
    outside = circle - sag - most
    if is_circle(motion, i):
        return outside, circle + sag - least
    if outside >= enough:
        return outside, np.inf
    ax, ay, bx, by = relative_line(motion, row, shift, begin, end, ax, ay, bx, by)
    piece = motion.pieces[row]
    turn = piece[TURNING] * (end - begin)
    heading = piece[HEADING] + piece[TURNING] * (begin - shift - piece[KNOWN])
    if turn != 0.0:
        apart = math.sqrt((bx - ax) ** 2 + (by - ay) ** 2)
        far = math.sqrt(max(ax * ax + ay * ay, bx * bx + by * by))
        sag += 0.125 * abs(turn) * (2.0 * apart + abs(turn) * far)
    if heading != 0.0 or turn != 0.0:
        c, s = math.cos(heading), math.sin(heading)
        ax, ay = c * ax + s * ay, c * ay - s * ax
        c, s = math.cos(heading + turn), math.sin(heading + turn)
        bx, by = c * bx + s * by, c * by - s * bx
    limit = max(enough + sag + most, TOUCHING_M)
    near = obstacle_segment(motion.shapes, i, ax, ay, bx, by, limit)
    if near >= limit:
        return enough, np.inf
    far = near
    if near <= -radius_of(motion.shapes, motion.shapes.slot[i]):  # which says nothing about depth
        far = obstacle_signed(motion.shapes, i, 0.5 * (ax + bx), 0.5 * (ay + by), np.inf)
        near = far - 0.5 * math.sqrt((bx - ax) ** 2 + (by - ay) ** 2)
    return max(near - sag - most, outside), far + sag - least
