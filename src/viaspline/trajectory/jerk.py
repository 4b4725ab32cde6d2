"""The time law with a limit of the jerk."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.kernels.timing import time_grid
from viaspline.trajectory.cells import Cells, CellSize
from viaspline.trajectory.coupled import Profile, Stage, caps_of_cells, jump_caps
from viaspline.trajectory.jerk_limited import JerkLimitedMotion, smoothest, smoothest_from
from viaspline.trajectory.limited_path import LimitedCubicPath, LimitedPath
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.motion_ends import Even, Moving, Rest, Rows, Seam
from viaspline.trajectory.motion_pieces import time_into
from viaspline.trajectory.slow_zones import Slow
from viaspline.trajectory.trajectory import Trajectory

QUICKEST_S = 0.02
"""Time in which the acceleration rises from nothing at the soonest [s]: no motor answers sooner,
and it makes no difference to the duration."""

MAX_FINE_CELLS = 400
"""Cells that a path is cut into for the jerk alone, at most."""

MIN_REST_STRETCHES = 32
"""Stretches from rest to rest, at least."""

LEAST_STRETCHES = 4
"""Stretches with which a motion can be found that keeps a jerk, at least."""

STRETCH_GROWTH = 1.25
"""Beside a rest every stretch is longer than the one before it by this."""

HAIR_RATIO = 0.01
"""No end of a slow part is nearer to a node than this, of the distance between nodes."""

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


@dataclass(frozen=True)
class Section:
    """A part of a path in stretches that are fine enough for the jerk.

    Attributes:
        cells: Of the path.
        limits: With ``max_jerk``.
        cell_size: What the cells were made for.
        line: Ends of the stretches as distances [m], shape (n + 1,).
        cell: Of each stretch, shape (n,).
        parts: Which part of it, in [0, 1], shape (n, 2).
        tops: Largest v² on the stretches [m²/s²], shape (n,).
        caps: The same at their ends, shape (n + 1,).
    """

    cells: Cells
    limits: Limits
    cell_size: CellSize
    line: Floats
    cell: NDArray[np.int64]
    parts: Floats
    tops: Floats
    caps: Floats

    @classmethod
    def of(
        cls, cells: Cells, limits: Limits, stage: Stage, cell_size: CellSize,
        low: float, high: float, also: Sequence[float] = (),
    ) -> Section:  # fmt: skip
        """The part between two distances [m], with other ends of stretches where they are asked."""
        assert limits.max_jerk is not None
        weakest, short = min(limits.max_accel, limits.brake, cell_size.axis), (high - low) / 40.0
        rest = min(0.05 * weakest**3 / limits.max_jerk**2, short)
        moving = min(stage.first * weakest / limits.max_jerk / 20.0, short)
        moving = min(moving, 0.01 * stage.first**2 / weakest)
        begin = moving if low == stage.start and stage.first > 0.0 else rest
        slip = 1e-12 * (1.0 + high)
        marks = np.union1d(_marks(cells.along, low, high, begin, rest), also)
        at_once = 1e-9 * (1.0 + high)
        marks = _with_edges(marks, cells.along, stage.slow, at_once)
        line, cell, parts = time_grid.divide(cells.along, marks, slip)
        tops = np.full(cell.size, cell_size.square)
        for slow in stage.slow:
            meets = (line[1:] > slow.start + at_once) & (line[:-1] < slow.end - at_once)
            tops[meets] = np.minimum(tops[meets], slow.speed**2)
        caps = jump_caps(cells, limits, line, cell_size)
        if high >= stage.end and stage.last > 0.0:
            caps[-1] = min(caps[-1], stage.last**2)
        return cls(cells, limits, cell_size, line, cell, parts, tops, caps)

    def rows(self, start: Rest | Moving | Seam, end: Rest | Even | Seam) -> Rows:
        """The limits of every stretch."""
        rows = _rows(self.cells, self.limits, self.cell_size, self.cell, self.parts, self.tops)
        rows.limits[:, 0] = np.minimum(rows.limits[:, 0], self.caps[:-1])
        rows.limits[:, 2] = np.minimum(rows.limits[:, 2], self.caps[1:])
        beside = [(0, 1, 4)] if isinstance(start, Rest) else []
        beside += [(-1, 0, 2)] if isinstance(end, Rest) else []
        for k, a, w in beside:
            _beside_rest(rows, self.cells, self.limits, self.cell, k, a, w)
        return rows


def _marks(along: Floats, low: float, high: float, first: float, last: float) -> Floats:
    """The ends, and places beside them that come ever closer [m]; none beside an end of a cell."""
    even = low + (high - low) * np.arange(1, MIN_REST_STRETCHES) / MIN_REST_STRETCHES
    beside = [_steps(0.5 * (high - low), step) for step in (first, last)]
    free = np.concatenate((low + beside[0], even, high - beside[1]))
    at = np.searchsorted(along, free).clip(1, along.size - 1)
    gap = np.minimum(free - low, high - free)
    apart = 0.05 * np.minimum(along[at] - along[at - 1], gap)
    far = (along[at] - free > apart) & (free - along[at - 1] > apart)
    return np.unique(np.concatenate(([low], free[far], [high])))


def _with_edges(marks: Floats, along: Floats, slow: Sequence[Slow], slip: float) -> Floats:
    """Marks, and where slow parts begin and end; a little more of them is slow beside a node [m].

    Args:
        marks: Increasing [m].
        along: Ends of the cells, which are nodes as well [m].
        slow: The slow parts.
        slip: What is nearer to a node than this is at it [m].
    """
    if not slow:
        return marks
    nodes = np.union1d(along, marks)
    starts = _between_nodes(nodes, np.array([part.start for part in slow]), slip)
    ends = -_between_nodes(-nodes[::-1], -np.array([part.end for part in slow]), slip)
    edges = np.concatenate((starts, ends))
    return np.union1d(marks, edges[(edges > marks[0]) & (edges < marks[-1])])


def _between_nodes(nodes: Floats, starts: Floats, slip: float) -> Floats:
    """Where slow parts begin, sooner where a node comes at once; none where one has just been."""
    at = np.searchsorted(nodes, starts).clip(1, nodes.size - 1)
    before, after = nodes[at - 1], nodes[at]
    apart = HAIR_RATIO * (after - before)
    needed = (starts - before > apart) & (after - starts > slip)
    return np.asarray(np.minimum(starts, after - apart)[needed])


def _steps(room: float, first: float) -> Floats:
    """Distances that grow from a first one on, as far as there is room [m]."""
    count = int(np.log1p((STRETCH_GROWTH - 1.0) * room / first) / np.log(STRETCH_GROWTH))
    return np.asarray(
        first * (STRETCH_GROWTH ** np.arange(1.0, count + 1.0) - 1.0) / (STRETCH_GROWTH - 1.0)
    )


def _rows(
    cells: Cells,
    limits: Limits,
    cell_size: CellSize,
    cell: NDArray[np.int64],
    parts: Floats,
    tops: Floats,
) -> Rows:
    """The limits of every stretch as rows over a0, a1, w0, m and w1."""
    n = cell.size
    lines = caps_of_cells(cells, limits, cell_size)[cell]
    caps = lines[:, :1] + parts * (lines[:, 1:] - lines[:, :1])
    caps = np.minimum(caps, tops[:, None])
    misses, pairs = cells.misses[cell], _pairs(cells, limits, cell)
    most = np.full(n, cell_size.accel)
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
    return Rows(np.stack(weights, axis=1), np.stack(bounds, axis=1))


def _pairs(
    cells: Cells, limits: Limits, cell: NDArray[np.int64]
) -> list[tuple[Floats, Floats, int, int, float]]:
    """What couples speed and acceleration on stretches: A, B, their misses, and |A a + B w| <=."""
    axes = limits.of_axes("axis_accel", cells.tangents.shape[1])
    pairs = [
        (cells.tangents[cell, j], cells.bends[cell, j], 0, 1, float(axes[j]))
        for j in range(axes.size)
    ]
    if limits.max_yaw_accel is not None and cells.yaws.size:
        pairs.append((cells.yaws[cell, 0], cells.yaws[cell, 1], 2, 3, limits.max_yaw_accel))
    return pairs


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
    rows: Rows, cells: Cells, limits: Limits, cell: NDArray[np.int64], k: int, a: int, w: int
) -> None:
    """Rows of a stretch on which a and w grow from 0, or fall to it: both at their largest."""
    cap, at = rows.limits[k, :3].min(), cell[[k]]
    rows.limits[k, 7:] = np.inf
    rows.weights[k, :3], rows.weights[k, 7:] = 0.0, 0.0
    rows.weights[k, 0, w], rows.limits[k, :3] = 1.0, (cap, np.inf, np.inf)
    misses = cells.misses[cell[k]]
    for i, (along, across, miss_a, miss_w, limit) in enumerate(_pairs(cells, limits, at)):
        row = 7 + 10 * i
        size = np.abs(along).max() + misses[miss_a]
        rows.weights[k, row, a] = size if a == 1 else -size
        rows.weights[k, row, w] = np.abs(across).max() + misses[miss_w]
        rows.limits[k, row] = limit


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
