"""What may come towards a robot, by one look, and what moves as the map says.

The premises: nothing that isn't on the map is faster than ``top``; what was seen stays in its tube;
whatever else there is was beyond the reach of the look, or behind one of its mouths, when that was
taken. A mouth is a line through which something may come out of what was hidden. What is on the map
is where its motion says, within its error, however fast that is.

At a time t after the look, all that may be there is at a distance from a place p of at least

    reach - |p - eye| - top t                                  what was beyond the reach,
    |p - mouth| - top t                                        what was hidden,
    max(|p - tube(t)|, |p - tube(0)| - top t)                  what was seen,
    |p - motion(t)|                                            what is on the map:

the first two since p lies in what was seen, and a way from the unseen to p is at least that long;
the third since it is both in its tube and no farther than ``top t`` from where it was. With p fixed
each of them falls by no more than a rate L in a second: ``top``, or for what was seen the larger of
``top`` and the speed and growth of its tube, or the speed and growth of a motion; but for the
instants at which a motion jumps, or begins.

Tested through ``trajectory/test_passive_safety`` and ``trajectory/test_charted_safety``.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.motion.motion_pairs import next_piece
from viaspline.kernels.motion.moving_distance import moving_distance, piece_at
from viaspline.kernels.motion.packed_motion import (
    GROWTH,
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

JUMP: Final = 1e-6
"""What is no farther off where the next piece of its motion begins doesn't jump, in metres and
radians."""

LOOKED_S: Final = 15.0
"""It is asked no longer ahead whether something stays away from a path [s]."""


class Threats(NamedTuple):
    """What may come.

    Attributes:
        tubes: What was seen; each goes without jumps, and is there from the look on.
        seen_at: When the look was [s].
        top: Nothing that isn't on the map is faster [m/s].
        eye: x, y of where it was taken [m], (2,).
        reach: Nothing was hidden nearer than this but behind mouths [m]; infinite: nothing was
            beyond.
        mouths: x0, y0, x1, y1 [m], (k, 4).
        charted: What moves as the map says.
        free_until: Up to when each of that is away from all of the path that is asked about [s].
    """

    tubes: PackedMotion
    seen_at: float
    top: float
    eye: Floats
    reach: float
    mouths: Floats
    charted: PackedMotion
    free_until: Floats


@inner
def sources(threats: Threats) -> int:
    """How many things may come; what is on the map is the last of them."""
    return first_charted(threats) + int(threats.charted.speeds.size)


@inner
def first_charted(threats: Threats) -> int:
    """The first source that is on the map."""
    return int(1 + threats.mouths.shape[0] + threats.tubes.speeds.size)


@inner
def gap_to(threats: Threats, k: int, t: float, x: float, y: float) -> float:
    """How far from (x, y) at an instant what comes from source k is at least [m]."""
    grown = threats.top * (t - threats.seen_at)
    if k == 0:
        return threats.reach - math.hypot(x - threats.eye[0], y - threats.eye[1]) - grown
    mouths = threats.mouths.shape[0]
    if k <= mouths:
        return _segment_gap(x, y, threats.mouths[k - 1]) - grown
    charted = k - first_charted(threats)
    if charted >= 0:
        return moving_distance(threats.charted, charted, t, x, y, np.inf)
    i = k - 1 - mouths
    within_tube = moving_distance(threats.tubes, i, t, x, y, np.inf)
    was = moving_distance(threats.tubes, i, threats.seen_at, x, y, np.inf)
    return max(within_tube, was - grown)


@inner
def rate_of(threats: Threats, k: int) -> float:
    """By how much the distance to what comes from source k falls in a second at most [m/s]."""
    charted = k - first_charted(threats)
    if charted >= 0:
        return threats.charted.speeds[charted] + threats.charted.errors[charted, GROWTH]
    i = k - 1 - threats.mouths.shape[0]
    if i < 0:
        return threats.top
    return max(threats.top, threats.tubes.speeds[i] + threats.tubes.errors[i, GROWTH])


@inner
def jumps_at(threats: Threats, k: int, t: float, until: float) -> float:
    """When what comes from source k jumps, or begins, after t and not after ``until`` [s].

    Infinite if it doesn't.
    """
    charted = k - first_charted(threats)
    if charted < 0:
        return np.inf
    return _first_jump(threats.charted, charted, t, until)


@kernel
def free_until(motion: PackedMotion, x: float, y: float, radius: float, t: float) -> Floats:
    """Up to when each of what moves is away from a disc for certain, from an instant on [s], (n,).

    Args:
        motion: What moves.
        x: The disc's middle [m].
        y: [m].
        radius: With what is to be kept [m].
        t: The instant [s].
    """
    until = np.full(motion.speeds.size, t)
    for i in range(until.size):
        gap = moving_distance(motion, i, t, x, y, np.inf) - radius
        if gap > 0.0:
            rate = motion.speeds[i] + motion.errors[i, GROWTH]
            until[i] = t + min(gap / rate, LOOKED_S)
            until[i] = min(until[i], _first_jump(motion, i, t, until[i]))
    return until


@inner
def _first_jump(motion: PackedMotion, i: int, t: float, until: float) -> float:
    """When obstacle i jumps, or begins, after t and not after ``until`` [s]; else infinite."""
    row, shift, ends = piece_at(motion, i, t)
    if motion.rounds[i, 1] > 0.0:  # a round shows all that there is
        until = min(until, t + 2.0 * motion.rounds[i, 1])
    while ends <= until and ends < np.inf:
        before = motion.pieces[row]
        after_row, after_shift, after_ends = next_piece(motion, i, row, shift)
        after = motion.pieces[after_row]
        if after[PRESENT] > 0.0 and (
            before[PRESENT] == 0.0 or _apart(before, after, ends - shift, ends - after_shift)
        ):
            return ends
        row, shift, ends = after_row, after_shift, after_ends
    return np.inf


@inner
def _apart(before: Floats, after: Floats, late: float, early: float) -> bool:
    """Whether a piece ends elsewhere than the next one begins; times by the clock of each [s]."""
    b, a = late - before[KNOWN], early - after[KNOWN]
    dx = after[X] + after[SPEED_X] * a - before[X] - before[SPEED_X] * b
    dy = after[Y] + after[SPEED_Y] * a - before[Y] - before[SPEED_Y] * b
    turned = after[HEADING] + after[TURNING] * a - before[HEADING] - before[TURNING] * b
    return math.hypot(dx, dy) > JUMP or abs(2.0 * math.sin(0.5 * turned)) > JUMP


@inner
def _segment_gap(x: float, y: float, segment: Floats) -> float:
    """Distance from (x, y) to a segment (4,) [m]."""
    dx = segment[2] - segment[0]
    dy = segment[3] - segment[1]
    length = dx * dx + dy * dy
    w = 0.0
    if length > 0.0:
        w = min(max(((x - segment[0]) * dx + (y - segment[1]) * dy) / length, 0.0), 1.0)
    return math.hypot(x - segment[0] - w * dx, y - segment[1] - w * dy)
