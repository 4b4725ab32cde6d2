"""The time law with a limit of the jerk."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.trajectory.coupled import Profile, Stage
from viaspline.trajectory.jerk_limited import JerkLimitedMotion, smoothest, smoothest_from
from viaspline.trajectory.jerk_section import Section
from viaspline.trajectory.limited_path import LimitedCubicPath, LimitedPath
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.motion_ends import Even, Moving, Rest
from viaspline.trajectory.motion_pieces import time_into
from viaspline.trajectory.trajectory import Trajectory

QUICKEST_S = 0.02
"""Time in which the acceleration rises from nothing at the soonest [s]: no motor answers sooner,
and it makes no difference to the duration."""

MAX_FINE_CELLS = 400
"""Cells that a path is cut into for the jerk alone, at most."""

LEAST_STRETCHES = 4
"""Stretches with which a motion can be found that keeps a jerk, at least."""

MAX_EXCESS = 0.1
"""By what part of it a limit other than the jerk is widened at most where a robot is under way: as
much as the bound of a first stretch may be wider than what is driven on it."""


def smooth_law(
    limited_path: LimitedPath,
    limits: Limits,
    stage: Stage,
    plain: Profile,
    stops: Sequence[Station],
    start_time: float,
    start_accel: float = 0.0,
    replaces: Trajectory | None = None,
) -> Trajectory:
    """The fastest drive that keeps the jerk and all other limits.

    A drive that begins at a speed begins with ``start_accel`` as well. Where nothing is found that
    keeps everything before the first rest, the jerk may be larger there, as little as is found,
    and the time law says up to where. One that ends at a speed does so without acceleration.

    Args:
        limited_path: What is driven.
        limits: With ``max_jerk``.
        stage: What is asked.
        plain: The fastest v² without a limit of the jerk.
        stops: With their dwells, in order.
        start_time: [s].
        start_accel: Acceleration where it begins at a speed [m/s²].
        replaces: The time law of a robot that is under way: a first guess of how it goes on.
    """
    limits = reachable(limits)
    still = plain.points[plain.squares <= 0.0]
    ends = np.array([stage.start, stage.end])
    places = np.unique(np.concatenate((still[still > stage.start], ends)))
    fine = fine_path(limited_path, limits, stage)
    cells, cell_size = fine.cells(stage)
    lines, motions, over, harsh = [places[:1]], [], stage.start, stage.start
    for low, high in pairwise(places.tolist()):
        begin: Rest | Moving = Rest()
        if low == stage.start and stage.first > 0.0:
            begin = Moving(stage.first**2, start_accel)
        end = Rest() if high < stage.end or plain.squares[-1] <= 0.0 else Even()
        section = Section.of(cells, limits, stage, cell_size, low, high)
        hint = None if replaces is None else _hint(replaces, section.line, start_time)
        line, motion, beyond, sudden = _under_way(section, limits, plain, begin, end, hint)
        over, harsh = max(over, beyond), max(harsh, sudden)
        lines.append(line[1:])
        motions.append(motion)
    law = joined(np.concatenate(lines), motions, stops, start_time)
    return replace(
        law,
        over_limit_until=over if over > stage.start else None,
        over_jerk_until=harsh if harsh > stage.start else None,
    )


def reachable(limits: Limits) -> Limits:
    """The limits with a jerk that a motor may have."""
    assert limits.max_jerk is not None
    jerk = max(limits.max_accel, limits.brake) / QUICKEST_S
    return replace(limits, max_jerk=min(limits.max_jerk, jerk))


def fine_path(limited_path: LimitedPath, limits: Limits, stage: Stage) -> LimitedPath:
    """A course whose cells are short enough for the jerk, if it is a piecewise cubic."""
    assert limits.max_jerk is not None
    accel, length = max(limits.max_accel, limits.brake), stage.end - stage.start
    if not isinstance(limited_path, LimitedCubicPath):
        return limited_path
    fast = min(stage.top, (length * length * limits.max_jerk) ** (1.0 / 3.0) + stage.first)
    longest = max(fast * accel / limits.max_jerk / 6.0, limited_path.length / MAX_FINE_CELLS)
    return replace(
        limited_path, grid=max(limited_path.grid or 1, int(np.ceil(limited_path.length / longest)))
    )


def _between(plain: Profile, first: int, last: int) -> tuple[Floats, JerkLimitedMotion]:
    """The motion of a profile between two of its points; its jerk is not limited."""
    squares, line = plain.squares[first : last + 1], plain.points[first : last + 1]
    accelerations = 0.5 * np.diff(squares) / np.diff(line)
    none = np.zeros(accelerations.size)
    return line, JerkLimitedMotion(np.sqrt(squares), accelerations, none, none)


def _under_way(
    section: Section,
    limits: Limits,
    plain: Profile,
    start: Rest | Moving,
    end: Rest | Even,
    hint: Floats | None,
) -> tuple[Floats, JerkLimitedMotion, float, float]:
    """The motion on a section, and up to where it is over another limit and over the jerk [m]."""
    assert limits.max_jerk is not None
    line, widths, rows = section.line, np.diff(section.line), section.rows(start, end)
    first, last = np.searchsorted(plain.points, line[[0, -1]])
    if len(widths) < LEAST_STRETCHES:  # a hair: as far as a robot rolls on when it stops
        return *_between(plain, int(first), int(last)), plain.over, float(line[-1])
    if isinstance(start, Rest):
        return line, smoothest(widths, rows, limits.max_jerk, end), -np.inf, -np.inf
    begin = Moving(start.square, min(max(start.accel, -limits.brake), limits.max_accel))
    rough, sudden = _between(plain, int(first), int(last))
    sums = sudden.speeds[1:] + sudden.speeds[:-1]
    quick = float((2.0 * np.diff(rough) / np.maximum(sums, 1e-12)).sum())
    found = smoothest_from(widths, rows, limits.max_jerk, begin, end, limits.brake, quick, hint)
    if (
        found.beyond < MAX_EXCESS
        and found.time < 2.0 * quick + 4.0 * limits.brake / limits.max_jerk
    ):
        return line, found.motion, float(line[found.over]), float(line[found.harsh])
    return rough, sudden, plain.over, float(line[-1])


def _hint(law: Trajectory, line: Floats, time: float) -> Floats:
    """v² as another law has it from a time on, at the ends of stretches and in their middles."""
    places = np.interp(np.arange(2 * line.size - 1) / 2.0, np.arange(line.size), line)
    speeds = law.speed_at(float(law.distance_at(time)) + places - line[0])
    return np.asarray(speeds * speeds)


def joined(
    line: Floats,
    motions: Sequence[JerkLimitedMotion],
    stops: Sequence[Station],
    start_time: float,
) -> Trajectory:
    """The time law of motions one after the other, with the dwells between them."""
    speeds = np.concatenate([motions[0].speeds[:1], *(motion.speeds[1:] for motion in motions)])
    parts = zip(*(motion[1:] for motion in motions), strict=True)
    accelerations, changes, jerks = (np.concatenate(part) for part in parts)
    widths = np.diff(line)
    times = time_into(widths, widths, speeds[:-1], speeds[1:], changes, jerks)
    if stops:
        at = np.searchsorted(line, [stop.distance for stop in stops])
        line, speeds = np.insert(line, at, line[at]), np.insert(speeds, at, 0.0)
        times = np.insert(times, at, [stop.dwell for stop in stops])
        accelerations, changes, jerks = (
            np.insert(part, at, 0.0) for part in (accelerations, changes, jerks)
        )
    arrivals = start_time + np.concatenate(([0.0], np.cumsum(times)))
    return Trajectory(line, speeds, arrivals, accelerations, tuple(stops), None, changes, jerks)
