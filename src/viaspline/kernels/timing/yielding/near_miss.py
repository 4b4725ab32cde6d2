"""When something that moves first comes too near to a robot that follows its law, or stands.

By steps that no closing speed can overtake: what says that nothing comes near is a proof.

Tested through ``trajectory/yielding/test_law_among``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.motion.moving_distance import piece_at, piece_distance
from viaspline.kernels.motion.packed_motion import GROWTH, PRESENT, PackedMotion
from viaspline.kernels.timing.yielding.path_tree import PathTree

JUST_M = 1e-4  # what is nearer than required by less than this may count as clear [m]
TOUCH = 1e-6  # what lies nearer than this to being too near is [m]


@inner
def standing_conflict(
    motion: PackedMotion, required: float, x: float, y: float, begin: float, end: float
) -> tuple[float, int]:
    """The first time at which something is nearer than required to (x, y), and what.

    Args:
        motion: What moves.
        required: To every shape [m].
        x: [m].
        y: [m].
        begin: From when on [s].
        end: Until when [s].

    Returns:
        (time [s], index); infinite and -1 if nothing is.
    """
    first, what = np.inf, -1
    for i in range(motion.first_piece.size - 1):
        stop = min(end, first)
        closing = motion.speeds[i] + motion.errors[i, GROWTH]
        t = begin
        while t <= stop:
            row, shift, until = piece_at(motion, i, t)
            until = max(until, t + 1e-9)
            if motion.pieces[row, PRESENT] == 0.0:
                t = until
                continue
            gap = piece_distance(motion, i, row, shift, t, x, y, np.inf) - required
            if gap < TOUCH:
                first, what = t, i
                break
            t = until if gap >= closing * (until - t) else t + gap / closing
    return first, what


@kernel
def law_conflict(
    motion: PackedMotion, required: float, tree: PathTree, times: Floats, distances: Floats,
    speeds: Floats, accelerations: Floats, hold: float,
) -> tuple[float, int]:  # fmt: skip
    """The first time at which something may be nearer than required to a robot on its way.

    Args:
        motion: What moves.
        required: From the robot's centre to every shape [m].
        tree: The path.
        times: Of a law with even acceleration between its points [s], (n,).
        distances: [m], (n,).
        speeds: [m/s], (n,).
        accelerations: [m/s²], (n - 1,).
        hold: For how long it stands at the end of the law [s].

    Returns:
        (time [s], index); infinite and -1 if nothing is.
    """
    top = 0.0
    for k in range(speeds.size):
        top = max(top, speeds[k])
    first, what = np.inf, -1
    end = times[times.size - 1]
    for i in range(motion.first_piece.size - 1):
        closing = motion.speeds[i] + motion.errors[i, GROWTH] + top
        t, k, leaf = times[0], 0, 0
        while t <= min(end, first):
            row, shift, until = piece_at(motion, i, t)
            until = max(until, t + 1e-9)
            if motion.pieces[row, PRESENT] == 0.0:
                t = until
                continue
            while k < accelerations.size - 1 and times[k + 1] <= t:
                k += 1
            late = t - times[k]
            s = distances[k] + (speeds[k] + 0.5 * accelerations[k] * late) * late
            s = min(s, distances[k + 1])
            while leaf < tree.misses.size - 1 and tree.along[leaf + 1] < s:
                leaf += 1
            arc = tree.along[leaf + 1] - tree.along[leaf]
            share = (s - tree.along[leaf]) / arc if arc > 0.0 else 0.0
            x = tree.points[leaf, 0] + share * (tree.points[leaf + 1, 0] - tree.points[leaf, 0])
            y = tree.points[leaf, 1] + share * (tree.points[leaf + 1, 1] - tree.points[leaf, 1])
            gap = piece_distance(motion, i, row, shift, t, x, y, np.inf) - required
            gap -= tree.misses[leaf]
            if gap < TOUCH:
                first, what = t, i
                break
            t = until if gap >= closing * (until - t) else t + gap / closing
    last = tree.points.shape[0] - 1
    x, y = tree.points[last, 0], tree.points[last, 1]
    if what < 0 and hold > 0.0:
        first, what = standing_conflict(motion, required, x, y, end, end + hold)
    return first, what


@kernel
def standing_conflicts(
    motion: PackedMotion, required: float, x: float, y: float, begin: float, end: float
) -> tuple[float, int]:
    """``standing_conflict``, for Python."""
    return standing_conflict(motion, required, x, y, begin, end)


@kernel
def standing_taken(
    motion: PackedMotion, required: float, x: float, y: float, begin: float, end: float, looks: int
) -> float:
    """Until when something is nearer than required to (x, y) all the time [s].

    Args:
        motion: What moves.
        required: To every shape [m]; what is nearer by less than ``JUST_M`` doesn't count.
        x: [m].
        y: [m].
        begin: From when on [s].
        end: Until when it is looked at [s].
        looks: So often at most.

    Returns:
        A time up to which it is proven; begin if it isn't taken then.
    """
    t = begin
    for _ in range(looks):
        if t >= end:
            break
        later = t
        for i in range(motion.first_piece.size - 1):
            row, shift, until = piece_at(motion, i, t)
            if motion.pieces[row, PRESENT] == 0.0:
                continue
            deep = required - JUST_M - piece_distance(motion, i, row, shift, t, x, y, np.inf)
            if deep > 0.0:
                leaves = (
                    np.inf if motion.speeds[i] == 0.0 else t + (deep + JUST_M) / motion.speeds[i]
                )
                later = max(later, min(leaves, until))
        if later == t:
            break
        t = later
    return min(t, end)
