"""How long a path takes to be driven, as far as its shape tells."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.timing.path_time import path_time
from viaspline.planning.problem.path_pace import Pace


def driving_time(spans: Floats, pace: Pace, rests: Flags) -> float:
    """The time in which a curve is driven [s], to a part in a thousand.

    Args:
        spans: Bézier control polygons [m], (m, 4, d).
        pace: How fast it may be driven.
        rests: Whether the robot stands still at each joint, (m + 1,).
    """
    writable = spans if spans.flags.writeable else spans.copy()  # numba compiles for one kind
    return float(
        path_time(
            writable, rests, pace.speed, pace.accel, pace.brake, pace.lateral, pace.yaw_rate
        )
    )  # fmt: skip


def leg_time(spans: Floats, pace: Pace, ends: tuple[bool, bool]) -> float:
    """The time in which a part of a path is driven [s].

    Args:
        spans: Bézier control polygons [m], (m, 4, d).
        pace: How fast it may be driven.
        ends: Whether the robot stands still where it begins, and where it ends.
    """
    rests = np.zeros(len(spans) + 1, np.bool_)
    rests[[0, -1]] = ends
    return driving_time(spans, pace, rests)


def straight_time(length: float, pace: Pace) -> float:
    """The time from rest to rest along a straight line [s]: no curve as long is faster.

    Example:
        >>> straight_time(10.0, Pace(speed=2.0, accel=1.0, brake=1.0, lateral=1.0))
        7.0
    """
    each = 0.5 / pace.accel + 0.5 / pace.brake  # to speed up and to slow down, a m/s
    speed = min(pace.speed, math.sqrt(length / each)) if length > 0.0 else pace.speed
    return length / speed + speed * each if length > 0.0 else 0.0
