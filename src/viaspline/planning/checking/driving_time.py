"""How long a path takes to be driven, as far as its shape tells."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Final

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.curve.slow_parts import slow_parts
from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.timing.path_time import path_time
from viaspline.planning.problem.path_pace import Pace

AT_A_JOINT: Final = 1e-9
"""Of a span: a zone that begins or ends so near to a joint does so there."""


def driving_time(spans: Floats, pace: Pace, rests: Flags) -> float:
    """The time in which a curve is driven [s], to a part in a thousand.

    Args:
        spans: Bézier control polygons [m], (m, 4, d).
        pace: How fast it may be driven, and where more slowly.
        rests: Whether the robot stands still at each joint, (m + 1,).
    """
    tops = np.full(len(spans), pace.speed)
    if pace.zones:
        spans, rests, tops = _cut_at_zones(spans, rests, pace)
    writable = spans if spans.flags.writeable else spans.copy()  # numba compiles for one kind
    return float(
        path_time(writable, rests, tops, pace.accel, pace.brake, pace.lateral, pace.yaw_rate)
    )


def _cut_at_zones(spans: Floats, rests: Flags, pace: Pace) -> tuple[Floats, Flags, Floats]:
    """A curve cut where it enters and leaves zones: spans, rests, and the largest speeds [m/s]."""
    parts = np.array(slow_parts(spans, pace.zones)).reshape(-1, 3)
    if not len(parts):
        return spans, rests, np.full(len(spans), pace.speed)
    ends = np.unique(parts[:, :2])
    inside = ends[np.abs(ends - np.round(ends)) > AT_A_JOINT]
    curve = PiecewiseCubic(spans)
    sections = pairwise([0.0, *inside.tolist(), float(len(spans))])
    cut = [curve.section(first, last).spans for first, last in sections]
    joints = np.arange(len(spans) + 1.0)
    cuts = np.union1d(joints, inside)
    stands = np.zeros(len(cuts), np.bool_)
    stands[np.isin(cuts, joints)] = rests
    middles = 0.5 * (cuts[:-1] + cuts[1:])
    tops = np.full(len(middles), pace.speed)
    for low, high, speed in parts.tolist():
        within = (middles > low) & (middles < high)
        tops[within] = np.minimum(tops[within], speed)
    return np.concatenate(cut), stands, tops


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


def lost_in_zones(corners: Floats, pace: Pace) -> float:
    """How much longer a way takes for the zones on it, at full speed else [s].

    Args:
        corners: Of straight lines [m], (n, 2).
        pace: How fast it may be driven, and where more slowly.

    Example:
        >>> from viaspline.mission.world_spec import SpeedZone
        >>> gate = SpeedZone(polygon=[(1, -1), (3, -1), (3, 1), (1, 1)], max_speed_mps=0.5)
        >>> pace = Pace(speed=2.0, accel=1.0, brake=1.0, lateral=1.0, zones=(gate,))
        >>> round(lost_in_zones(np.array([[0.0, 0.0], [10.0, 0.0]]), pace), 3)
        3.0
    """
    if not pace.zones:
        return 0.0
    ways = np.diff(corners, axis=0)[:, None]
    lines = corners[:-1, None] + np.linspace(0.0, 1.0, 4)[None, :, None] * ways
    cut, _, tops = _cut_at_zones(lines, np.zeros(len(lines) + 1, np.bool_), pace)
    lengths = np.linalg.norm(cut[:, 3] - cut[:, 0], axis=1)
    return float((lengths * (1.0 / tops - 1.0 / pace.speed)).sum())


def straight_time(length: float, pace: Pace) -> float:
    """The time from rest to rest along a straight line [s]: no curve as long is faster.

    Example:
        >>> straight_time(10.0, Pace(speed=2.0, accel=1.0, brake=1.0, lateral=1.0))
        7.0
    """
    each = 0.5 / pace.accel + 0.5 / pace.brake  # to speed up and to slow down, a m/s
    speed = min(pace.speed, math.sqrt(length / each)) if length > 0.0 else pace.speed
    return length / speed + speed * each if length > 0.0 else 0.0
