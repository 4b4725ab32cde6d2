"""The time law with a limit of the jerk: from rest to rest, between all stops."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels import nodes
from viaspline.trajectory.cells import Cells, Grain
from viaspline.trajectory.coupled import Profile, Stage, caps_of_cells, rests_of
from viaspline.trajectory.course import Course, CubicCourse
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.pieces import time_into
from viaspline.trajectory.smooth import Motion, Rows, smoothest
from viaspline.trajectory.trajectory import Trajectory

Floats = NDArray[np.float64]

QUICKEST = 0.02
"""Time in which the acceleration rises from nothing at the soonest [s]: no motor answers sooner,
and it makes no difference to the duration."""

FINEST = 400
"""Cells that a path is cut into for the jerk alone, at most."""

FEWEST = 32
"""Stretches from rest to rest, at least."""

GROWTH = 1.25
"""Beside a rest every stretch is longer than the one before it by this."""


def smooth_law(
    course: Course,
    limits: Limits,
    stage: Stage,
    plain: Profile,
    stops: Sequence[Station],
    start_time: float,
) -> Trajectory:
    """The fastest drive that keeps the jerk and all other limits, between rests.

    Before the first rest of a drive that begins under way, and after the last one of a drive that
    ends under way, the jerk is not limited.

    Args:
        course: What is driven.
        limits: With ``max_jerk``.
        stage: What is asked.
        plain: The fastest v² without a limit of the jerk; it has a rest somewhere.
        stops: With their dwells, in order.
        start_time: [s].
    """
    assert limits.max_jerk is not None
    jerk = max(limits.max_accel, limits.brake) / QUICKEST
    limits = replace(limits, max_jerk=min(limits.max_jerk, jerk))
    still = np.flatnonzero(plain.squares <= 0.0)
    start, end = float(plain.points[still[0]]), float(plain.points[still[-1]])
    lines, motions = [plain.points[: still[0] + 1]], [_without(plain, 0, int(still[0]))]
    for line, motion in _sections(course, limits, stage, start, end):
        lines.append(line[1:])
        motions.append(motion)
    lines.append(plain.points[still[-1] + 1 :])
    motions.append(_without(plain, int(still[-1]), plain.points.size - 1))
    over = plain.over if plain.over > stage.start else None
    return _joined(np.concatenate(lines), motions, stops, start_time, over)


def _without(profile: Profile, first: int, last: int) -> Motion:
    """The motion of a profile from one of its points to another; its jerk is not limited."""
    squares = profile.squares[first : last + 1]
    accelerations = 0.5 * np.diff(squares) / np.diff(profile.points[first : last + 1])
    none = np.zeros(accelerations.size)
    return Motion(np.sqrt(squares), accelerations, none, none)


def _sections(
    course: Course, limits: Limits, stage: Stage, start: float, end: float
) -> Iterator[tuple[Floats, Motion]]:
    """The motions between rests, with the ends of their pieces [m]."""
    if not end > start:
        return
    assert limits.max_jerk is not None
    stage = replace(stage, start=start, end=end, first=0.0, last=0.0)
    accel, length = max(limits.max_accel, limits.brake), stage.end - stage.start
    if isinstance(course, CubicCourse):
        fast = min(stage.top, (length * length * limits.max_jerk) ** (1.0 / 3.0))
        longest = max(fast * accel / limits.max_jerk / 6.0, course.length / FINEST)
        course = replace(course, grid=max(course.grid or 1, int(np.ceil(course.length / longest))))
    cells, grain = course.cells(stage)
    ends = np.array([stage.start, stage.end])
    rests = np.unique(np.concatenate((ends, rests_of(cells, limits, stage))))
    for low, high in pairwise(rests[(rests >= start) & (rests <= end)]):
        yield _section(cells, limits, stage, grain, float(low), float(high))


def _section(
    cells: Cells, limits: Limits, stage: Stage, grain: Grain, low: float, high: float
) -> tuple[Floats, Motion]:
    """The motion between two rests, and the ends of its pieces as distances [m]."""
    assert limits.max_jerk is not None
    weakest = min(limits.max_accel, limits.brake, grain.axis)
    first = min(0.05 * weakest**3 / limits.max_jerk**2, (high - low) / 40.0)
    slip = 1e-12 * (1.0 + high)
    line, cell, parts = nodes.divide(cells.along, _marks(cells.along, low, high, first), slip)
    tops = np.full(cell.size, grain.square)
    middles = 0.5 * (line[1:] + line[:-1])
    for slow in stage.slow:
        within = (middles > slow.start) & (middles < slow.end)
        tops[within] = np.minimum(tops[within], slow.speed**2)
    rows = _rows(cells, limits, grain, cell, parts, tops)
    return line, smoothest(np.diff(line), rows, limits.max_jerk)


def _marks(along: Floats, low: float, high: float, first: float) -> Floats:
    """The ends, and places beside them that come ever closer [m]; none beside an end of a cell."""
    count = int(np.log1p((GROWTH - 1.0) * 0.5 * (high - low) / first) / np.log(GROWTH))
    steps = first * (GROWTH ** np.arange(1.0, count + 1.0) - 1.0) / (GROWTH - 1.0)
    even = low + (high - low) * np.arange(1, FEWEST) / FEWEST
    free = np.concatenate((low + steps, even, high - steps))
    at = np.searchsorted(along, free).clip(1, along.size - 1)
    gap = np.minimum(free - low, high - free)
    apart = 0.05 * np.minimum(along[at] - along[at - 1], gap)
    far = (along[at] - free > apart) & (free - along[at - 1] > apart)
    return np.unique(np.concatenate(([low], free[far], [high])))


def _rows(
    cells: Cells, limits: Limits, grain: Grain, cell: NDArray[np.int64], parts: Floats, tops: Floats
) -> Rows:
    """The limits of every stretch as rows over a0, a1, w0, m and w1."""
    n, d = cell.size, cells.tangents.shape[1]
    lines = caps_of_cells(cells, limits, grain)[cell]
    caps = lines[:, :1] + parts * (lines[:, 1:] - lines[:, :1])
    caps = np.minimum(caps, tops[:, None])
    axes, misses = limits.of_axes("axis_accel", d), cells.misses[cell]
    pairs = [
        (cells.tangents[cell, j], cells.bends[cell, j], 0, 1, axes[j]) for j in range(axes.size)
    ]
    if limits.max_yaw_accel is not None and cells.yaws.size:
        pairs.append((cells.yaws[cell, 0], cells.yaws[cell, 1], 2, 3, limits.max_yaw_accel))
    most = np.full(n, grain.accel)
    for _, _, miss, _, limit in pairs:
        most = np.minimum(most, 0.25 * limit / np.maximum(misses[:, miss], 1e-300))
    weights, bounds = [np.zeros((n, 5)) for _ in range(7)], [np.zeros(n) for _ in range(7)]
    levels = (caps[:, 0], 0.5 * (caps[:, 0] + caps[:, 1]), caps[:, 1])
    for k in range(3):
        weights[k][:, 2 + k], bounds[k] = 1.0, levels[k]
    for k, (end, sign) in enumerate(((0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)), start=3):
        weights[k][:, end] = sign
        bounds[k] = np.minimum(most, limits.max_accel if sign > 0.0 else limits.brake)
    for along, across, miss_a, miss_w, limit in pairs:
        room = limit - misses[:, miss_a] * most
        for row, slack in _couple(_part(along, parts), _part(across, parts), misses[:, miss_w]):
            for sign in (1.0, -1.0):
                weights.append(sign * row + slack)
                bounds.append(room)
    rows = Rows(np.stack(weights, axis=1), np.stack(bounds, axis=1))
    for k, a, w in ((0, 1, 4), (-1, 0, 2)):
        _beside_rest(rows, k, a, w, pairs, misses)
    return rows


def _part(coefficients: Floats, parts: Floats) -> Floats:
    """Bernstein coefficients (n, 3) of quadratics on parts (n, 2) of their cells."""
    x, y = parts[:, :1], parts[:, 1:]
    c = coefficients[:, 0:1], coefficients[:, 1:2], coefficients[:, 2:3]

    def blossom(p: Floats, q: Floats) -> Floats:
        left, right = c[0] + p * (c[1] - c[0]), c[1] + p * (c[2] - c[1])
        return np.asarray(left + q * (right - left))

    return np.concatenate((blossom(x, x), blossom(x, y), blossom(y, y)), axis=1)


def _couple(t: Floats, k: Floats, miss: Floats) -> list[tuple[Floats, Floats]]:
    """T a + K w as five Bernstein coefficients over a0, a1, w0, m, w1, and what K misses."""
    n = t.shape[0]
    cubic = np.zeros((5, n, 2))  # the last one is never used but for its weight of 0
    cubic[0, :, 0] = t[:, 0]
    cubic[1, :, 0], cubic[1, :, 1] = 2.0 * t[:, 1] / 3.0, t[:, 0] / 3.0
    cubic[2, :, 0], cubic[2, :, 1] = t[:, 2] / 3.0, 2.0 * t[:, 1] / 3.0
    cubic[3, :, 1] = t[:, 2]
    shares = np.array([[1, 0, 0], [0.5, 0.5, 0], [1 / 6, 4 / 6, 1 / 6], [0, 0.5, 0.5], [0, 0, 1]])
    found = []
    for j in range(5):
        row, slack = np.zeros((n, 5)), np.zeros((n, 5))
        row[:, :2] = 0.25 * j * cubic[j - 1] + (1.0 - 0.25 * j) * cubic[j]
        for i in range(3):
            if 0 <= j - i <= 2:
                row[:, 2 + i] = shares[j, i] * k[:, j - i]
        slack[:, 2:] = miss[:, None] * shares[j]
        found.append((row, slack))
    return found


def _beside_rest(
    rows: Rows,
    k: int,
    a: int,
    w: int,
    pairs: Sequence[tuple[Floats, Floats, int, int, float]],
    misses: Floats,
) -> None:
    """Rows of a stretch on which a and w grow from 0, or fall to it: both at their largest."""
    cap = rows.limits[k, :3].min()
    rows.limits[k, 7:] = np.inf
    rows.weights[k, :3], rows.weights[k, 7:] = 0.0, 0.0
    rows.weights[k, 0, w], rows.limits[k, :3] = 1.0, (cap, np.inf, np.inf)
    for i, (along, across, miss_a, miss_w, limit) in enumerate(pairs):
        row = 7 + 10 * i
        size = np.abs(along[k]).max() + misses[k, miss_a]
        rows.weights[k, row, a] = size if a == 1 else -size
        rows.weights[k, row, w] = np.abs(across[k]).max() + misses[k, miss_w]
        rows.limits[k, row] = limit


def _joined(
    line: Floats,
    motions: Sequence[Motion],
    stops: Sequence[Station],
    start_time: float,
    over: float | None,
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
    return Trajectory(line, speeds, arrivals, accelerations, tuple(stops), over, changes, jerks)
