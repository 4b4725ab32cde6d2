"""How far a vehicle gets beside straight lines that turns before it has reached their corners."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats


def turn_angles(points: Floats) -> Floats:
    """By how much the direction changes at each inner point [rad], 0 to pi, shape (n - 2,).

    >>> turn_angles(np.array([[0, 0], [1, 0], [1, 1], [1, 3]], float)).round(3).tolist()
    [1.571, 0.0]
    """
    steps = np.diff(points, axis=0)
    before, after = steps[:-1], steps[1:]
    sizes = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    cosines = np.divide(
        (before * after).sum(axis=1), sizes, out=np.ones(len(sizes)), where=sizes > 0
    )
    return np.asarray(np.arccos(np.clip(cosines, -1.0, 1.0)))


def corner_strays(points: Floats, acceptance: float, outer: float = 0.0) -> Floats:
    """How far beside its lines a vehicle may get about each line [m], shape (n - 1,).

    The vehicle heads straight for a point, and as soon as it is within the acceptance radius of it,
    or later, for the next one. It begins at the first point. At a turn by an angle a it is within
    r sin(a) of the two lines that meet there; what it was beside the line before adds to that.
    Where lines are shorter than two radii, or turn by more than a right angle, it is within r.

    Args:
        points: The corners [m], shape (n, d), n >= 2.
        acceptance: The radius r [m].
        outer: Distance of a polygonal body's farthest corner from its reference point [m]: the body
            turns while it is beside a line. 0 for a disc.

    Example:
        >>> square = np.array([[0, 0], [9, 0], [9, 9]], float)
        >>> corner_strays(square, 0.5).tolist(), corner_strays(square, 0.0).tolist()
        ([0.5, 0.5], [0.0, 0.0])
    """
    count = len(points) - 1
    strays = np.zeros(count + 1)  # about each corner; the ends have none
    if acceptance <= 0.0:
        return strays[:count]
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    turns = np.r_[0.0, turn_angles(points), 0.0]
    drifts = np.zeros(count + 2)  # by how much the way to each corner may be turned
    beside = 0.0  # the line ahead, where the vehicle sets out on it
    for k in range(1, count + 1):
        length = float(lengths[k - 1])
        is_long = length >= 2.0 * acceptance
        drifts[k] = drift = (
            math.asin(min(beside / (length - acceptance), 1.0)) if is_long else 0.5 * math.pi
        )
        angle = float(turns[k]) + drift
        beside = strays[k] = acceptance
        if is_long and angle < 0.5 * math.pi:
            beside = acceptance * math.sin(angle)
            strays[k] = min(beside + acceptance * math.sin(drift), acceptance)
    strays[count] = 0.0  # there it ends
    if outer > 0.0:
        swung = np.minimum(turns + drifts[:-1] + drifts[1:], math.pi)
        strays += outer * 2.0 * np.sin(0.5 * swung)
    return np.maximum(strays[:-1], strays[1:])
