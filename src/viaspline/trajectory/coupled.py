"""The time law under limits that couple speed and acceleration: yaw, and every axis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.timing import cell_caps, halfplanes, reachability, time_grid
from viaspline.trajectory.cells import Cells, CellSize
from viaspline.trajectory.limits import YAW_SETTLE_S, Limits
from viaspline.trajectory.slow_zones import Slow
from viaspline.trajectory.steering_rate import jump_speeds, steered_caps

MIN_RAMP_STRETCHES = 8
"""Stretches that the shortest way to full speed is divided into, at least."""

GATE, SHARE, PIECES = 0.009, 0.0022, 16
"""Where more than ``GATE`` of the time may be lost to the grid, stretches are cut into up to
``PIECES`` so that it is ``SHARE``. What is lost indeed is a fifth to a half of that."""

MAX_STRETCHES, LEAST_RAMPS = 20_000, 4.0
"""A cell is never made shorter than the path over this, as long as it bends little, nor than so
many ways to full speed over it: a short part of a path is cut no finer than a longer one."""


class Profile(NamedTuple):
    """v² along a path, and what is wrong with it.

    Attributes:
        points: Distances [m], increasing, shape (n,).
        squares: v² there [m²/s²], linear between them, shape (n,).
        over: It is above the limits up to here [m]; the start if it never is.
        missed: The first place where it can't come to rest as it should [m]; nan if none.
    """

    points: Floats
    squares: Floats
    over: float
    missed: float


@dataclass(frozen=True, kw_only=True)
class Stage:
    """From where to where a time law is sought, and what is asked on the way.

    Attributes:
        start: Distance along the path [m].
        end: The same of its end [m].
        first: Speed at the start [m/s].
        last: Largest speed at the end [m/s].
        top: Largest speed anywhere [m/s].
        stops: Distances where the robot rests [m].
        slow: Stretches with a lower speed.
    """

    start: float
    end: float
    first: float
    last: float
    top: float
    stops: tuple[float, ...] = ()
    slow: tuple[Slow, ...] = ()


def is_coupled(limits: Limits, dimension: int) -> bool:
    """Whether these limits ask for more than a largest speed at every place."""
    several = (limits.axis_speed, limits.axis_accel, limits.max_yaw_accel, limits.max_steer_rate)
    over_ground = limits.max_yaw_rate is not None and dimension > 2
    return over_ground or any(limit is not None for limit in several)


def cell_size_for(
    limits: Limits, dimension: int, stage: Stage, grid: int | None = None
) -> CellSize:
    """How fine the cells of a path have to be for these limits; ``grid``: at least so many."""
    speeds = limits.of_axes("axis_speed", dimension)
    axes = limits.of_axes("axis_accel", dimension)
    accel = max(limits.max_accel, limits.brake)
    if axes.size:
        accel = min(accel, float(np.linalg.norm(axes)))
    length = stage.end  # of all of the path: under way its cells stay the same
    square = min(stage.top**2, max(stage.first, stage.last) ** 2 + 2.0 * accel * length)
    if speeds.size:
        square = min(square, float(speeds @ speeds))
    longest = max(square / (2.0 * accel) / MIN_RAMP_STRETCHES, length / MAX_STRETCHES)
    turning = (limits.max_yaw_rate, limits.max_yaw_accel, limits.max_steer_rate)
    steered = np.inf
    if limits.max_steer_rate is not None and limits.wheelbase is not None:
        steered = limits.max_steer_rate / limits.wheelbase * max(stage.top, stage.first)
    return CellSize(
        longest=longest if grid is None else min(longest, length / grid),
        least=max(length, LEAST_RAMPS * stage.top**2 / (2.0 * accel)) / MAX_STRETCHES,
        accel=accel,
        square=square,
        axis=min([*axes.tolist(), _or_inf(limits.max_lateral_accel)]),
        yaw_accel=min(_or_inf(limits.max_yaw_accel), steered),
        heading=any(limit is not None for limit in turning),
    )


def coupled_profile(cells: Cells, limits: Limits, stage: Stage, cell_size: CellSize) -> Profile:
    """The fastest v² that keeps every limit everywhere, on a grid of distances.

    Where the acceleration changes much from one stretch to the next the grid is made finer, and
    the fastest v² sought again.

    Args:
        cells: Of the path, at least from start to end.
        limits: Those of the Limits, jerk left out.
        stage: What is asked.
        cell_size: What the cells were made for.
    """
    system = System.of(cells, limits, stage, cell_size)
    first = system.solve(stage.first**2)
    scale = min(cell_size.axis, cell_size.accel)
    finer = time_grid.refined(first.points, first.squares, first.over, scale, GATE, SHARE, PIECES)
    if finer.size == first.points.size:
        return first
    return system.on(finer, limits, stage, cell_size).solve(stage.first**2)


class System(NamedTuple):
    """Half-planes for every stretch and caps for every node.

    Attributes:
        cells: Of the path.
        rests: Where the robot rests [m].
        speeds: Of ``caps_of_cells``.
        line: Nodes [m], shape (n + 1,).
        planes: Half-planes p w0 + q w1 <= g of v² at both ends, shape (n, k, 3).
        caps: Largest v² at the nodes, shape (n + 1,).
        brake: [m/s²].
    """

    cells: Cells
    rests: Floats
    speeds: Floats
    line: Floats
    planes: Floats
    caps: Floats
    brake: float

    @classmethod
    def of(cls, cells: Cells, limits: Limits, stage: Stage, cell_size: CellSize) -> System:
        """The limits on the grid of all ends of cells, and more where they are long."""
        rests, speeds = rests_of(cells, limits, stage), caps_of_cells(cells, limits, cell_size)
        none = np.empty(0)
        bare = cls(cells, rests, speeds, none, np.empty((0, 0, 3)), none, limits.brake)
        return bare.on(_marks(cells.along, rests, stage, cell_size), limits, stage, cell_size)

    def on(self, marks: Floats, limits: Limits, stage: Stage, cell_size: CellSize) -> System:
        """The system on the grid of some marks and all ends of cells."""
        cells, slip = self.cells, 1e-9 * (1.0 + stage.end)
        line, cell, ends = time_grid.divide(cells.along, marks, slip)
        tops = np.full(cell.size, cell_size.square)
        middles = 0.5 * (line[1:] + line[:-1])
        first = np.searchsorted(middles, [part.start for part in stage.slow], side="right")
        last = np.searchsorted(middles, [part.end for part in stage.slow])
        for part, low, high in zip(stage.slow, first.tolist(), last.tolist(), strict=True):
            np.minimum(tops[low:high], part.speed**2, out=tops[low:high])
        caps = jump_caps(cells, limits, line, cell_size)
        caps[np.searchsorted(line, self.rests)] = 0.0
        caps[-1] = min(caps[-1], stage.last**2)
        half_planes = halfplanes.stretch_planes(
            line, cell, ends, tops, caps, cells.tangents, cells.bends, cells.yaws, cells.misses,
            self.speeds, limits.max_accel, limits.brake, cell_size.accel,
            limits.of_axes("axis_accel", cells.tangents.shape[1]), _or_inf(limits.max_yaw_accel),
        )  # fmt: skip
        return self._replace(line=line, planes=half_planes, caps=caps)

    def solve(self, first: float) -> Profile:
        """The fastest v² from one at the start on [m²/s²]."""
        squares, over, missed = reachability.reachable_profile(
            self.line, self.planes, self.caps, self.brake, first
        )
        return Profile(self.line, squares, float(over), float(missed))


def jump_caps(cells: Cells, limits: Limits, line: Floats, cell_size: CellSize) -> Floats:
    """The largest v² at nodes, for jumps of the curvature [m²/s²], shape (n + 1,)."""
    caps = np.full(line.size, cell_size.square)
    if not cells.yaws.size or (limits.max_yaw_accel is None and limits.max_steer_rate is None):
        return caps
    at = np.searchsorted(line, cells.along[1:-1] - 1e-9 * (1.0 + line[-1]))
    inner = (at > 0) & (at < line.size)
    rate = _or_inf(limits.max_yaw_accel) * YAW_SETTLE_S
    slow = rate / np.maximum(cells.jumps[inner], 1e-12)
    before, after = cells.yaws[:-1, 0, 2], cells.yaws[1:, 0, 0]
    slow = np.minimum(slow, jump_speeds(before[inner], after[inner], limits))
    np.minimum.at(caps, at[inner], slow * slow)
    return caps


def caps_of_cells(cells: Cells, limits: Limits, cell_size: CellSize) -> Floats:
    """The line below which v² keeps every limit of a speed, at both ends of each cell, (n, 2)."""
    caps = cell_caps.cell_caps(
        cells.along, cells.tangents, cells.bends, cells.yaws, cells.misses, cell_size.square,
        cell_size.accel, limits.of_axes("axis_speed", cells.tangents.shape[1]),
        _or_inf(limits.max_lateral_accel), _or_inf(limits.max_yaw_rate),
    )  # fmt: skip
    return np.asarray(np.minimum(caps, steered_caps(cells, limits)[:, None]))


def _or_inf(limit: float | None) -> float:
    return np.inf if limit is None else limit


def rests_of(cells: Cells, limits: Limits, stage: Stage) -> Floats:
    """Where the robot rests from start to end [m]: at stops, and where it turns on the spot."""
    bends = (
        limits.max_lateral_accel, limits.max_yaw_rate, limits.max_yaw_accel, limits.axis_accel,
        limits.max_steer_rate,
    )  # fmt: skip
    rests = np.array(stage.stops, dtype=np.float64)
    if not rests.size and not cells.rests.any():
        return rests
    if cells.rests.any() and any(limit is not None for limit in bends):
        turns = cells.along[cells.rests]
        rests = np.concatenate((rests, turns[(turns > stage.start) & (turns < stage.end)]))
    return np.unique(rests)


def _marks(along: Floats, rests: Floats, stage: Stage, cell_size: CellSize) -> Floats:
    """Places that have to be nodes [m], and nodes for where the cells are too long."""
    start, end = stage.start, stage.end
    stops = np.array(sorted({start, end, *rests.tolist()}))
    places = {place for part in stage.slow for place in (part.start, part.end)}
    edges = np.array(sorted(place for place in places if start < place < end), dtype=np.float64)
    graded = stage.first <= 0.0 or (rests.size > 0 and bool(rests[0] <= start))
    ramp = cell_size.square / (2.0 * cell_size.accel)
    return time_grid.marks(along, stops, edges, graded, ramp, 1e-9 * (1.0 + end))
