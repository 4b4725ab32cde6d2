"""The time law under limits that couple speed and acceleration: yaw, and every axis."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels import topp
from viaspline.trajectory.cells import Cells, Grain
from viaspline.trajectory.limits import SETTLE, Limits
from viaspline.trajectory.zones import Slow

Floats = NDArray[np.float64]

RAMP = 8
"""Stretches that the shortest way to full speed is divided into, at least."""

LEGS = 16
"""Stretches between two places where the robot stops, at least."""

_GRADED = 1e-3 * 1.5 ** np.arange(12)
"""Nodes beside a rest, as parts of the shortest way to full speed."""

MOST = 20_000
"""A cell is never made shorter than the path over this, as long as it bends little."""


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
    several = (limits.axis_speed, limits.axis_accel, limits.max_yaw_accel)
    over_ground = limits.max_yaw_rate is not None and dimension > 2
    return over_ground or any(limit is not None for limit in several)


def grain_for(limits: Limits, dimension: int, stage: Stage, grid: int | None = None) -> Grain:
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
    longest = max(square / (2.0 * accel) / RAMP, length / MOST)
    return Grain(
        longest=longest if grid is None else min(longest, length / grid),
        least=length / MOST,
        accel=accel,
        square=square,
        axis=min([*axes.tolist(), _or_inf(limits.max_lateral_accel)]),
        yaw_accel=np.inf if limits.max_yaw_accel is None else limits.max_yaw_accel,
        heading=limits.max_yaw_rate is not None or limits.max_yaw_accel is not None,
    )


def coupled_profile(cells: Cells, limits: Limits, stage: Stage, grain: Grain) -> Profile:
    """The fastest v² that keeps every limit everywhere, on a grid of distances.

    Args:
        cells: Of the path, at least from start to end.
        limits: Those of the Limits, jerk left out.
        stage: What is asked.
        grain: What the cells were made for.
    """
    system = _System.of(cells, limits, stage, grain)
    squares, over, missed = system.solve(stage.first**2)
    return Profile(system.line, squares, over, missed)


class _System(NamedTuple):
    """Half-planes for every stretch and caps for every node."""

    line: Floats
    planes: Floats
    caps: Floats
    brake: float

    @classmethod
    def of(cls, cells: Cells, limits: Limits, stage: Stage, grain: Grain) -> _System:
        d, slip = cells.tangents.shape[1], 1e-9 * (1.0 + stage.end)
        rests = rests_of(cells, limits, stage)
        ramp = grain.square / (2.0 * grain.accel)
        marks = _marks(cells.along, rests, stage, ramp, slip)
        line, cell, ends = topp.divide(cells.along, marks, slip)
        tops = np.full(len(cell), grain.square)
        for part in stage.slow:
            middles = 0.5 * (line[1:] + line[:-1])
            within = (middles > part.start) & (middles < part.end)
            tops[within] = np.minimum(tops[within], part.speed**2)
        caps = np.full(len(line), grain.square)
        if limits.max_yaw_accel is not None and d > 1:
            at = np.searchsorted(line, cells.along[1:-1] - slip)
            inner = (at > 0) & (at < len(line))
            rate = limits.max_yaw_accel * SETTLE
            slow = (rate / np.maximum(cells.jumps[inner], 1e-12)) ** 2
            np.minimum.at(caps, at[inner], slow)
        caps[np.searchsorted(line, rests)] = 0.0
        caps[-1] = min(caps[-1], stage.last**2)
        speeds = caps_of_cells(cells, limits, grain)
        planes = topp.stretch_planes(
            line, cell, ends, tops, caps, cells.tangents, cells.bends, cells.yaws, cells.misses,
            speeds, limits.max_accel, limits.brake, grain.accel, limits.of_axes("axis_accel", d),
            _or_inf(limits.max_yaw_accel),
        )  # fmt: skip
        return cls(line, planes, caps, limits.brake)

    def solve(self, first: float) -> tuple[Floats, float, float]:
        squares, over, missed = topp.reachable_profile(
            self.line, self.planes, self.caps, self.brake, first
        )
        return squares, float(over), float(missed)


def caps_of_cells(cells: Cells, limits: Limits, grain: Grain) -> Floats:
    """The line below which v² keeps every limit of a speed, at both ends of each cell, (n, 2)."""
    return topp.cell_caps(
        cells.along, cells.tangents, cells.bends, cells.yaws, cells.misses, grain.square,
        grain.accel, limits.of_axes("axis_speed", cells.tangents.shape[1]),
        _or_inf(limits.max_lateral_accel), _or_inf(limits.max_yaw_rate),
    )  # fmt: skip


def _or_inf(limit: float | None) -> float:
    return np.inf if limit is None else limit


def rests_of(cells: Cells, limits: Limits, stage: Stage) -> Floats:
    """Where the robot rests from start to end [m]: at stops, and where it turns on the spot."""
    bends = (limits.max_lateral_accel, limits.max_yaw_rate, limits.max_yaw_accel, limits.axis_accel)
    rests = np.array(stage.stops)
    if cells.rests.any() and any(limit is not None for limit in bends):
        turns = cells.along[cells.rests]
        rests = np.concatenate((rests, turns[(turns > stage.start) & (turns < stage.end)]))
    return np.unique(rests)


def _marks(along: Floats, rests: Floats, stage: Stage, ramp: float, slip: float) -> Floats:
    """Places that have to be nodes [m], and nodes for where the cells are too long.

    These are a few between rests, and ever closer ones beside a rest: a zone or a bend may keep
    the speed so low that the robot is up to it within a small part of a cell.
    """
    edges = [place for part in stage.slow for place in (part.start, part.end)]
    ends = np.array([stage.start, stage.end])
    stops = np.unique(np.concatenate((ends, rests)))
    legs = [_lattice(low, high) for low, high in pairwise(stops)]
    fixed = np.union1d(stops, edges) if edges else stops
    fixed = fixed[(fixed >= stage.start) & (fixed <= stage.end)]
    steps = ramp * _GRADED
    beside = rests if stage.first > 0.0 else np.append(rests, stage.start)
    beside = np.append(beside, stage.end)[:, None]
    free = np.concatenate((*legs, (beside - steps).ravel(), (beside + steps).ravel()))
    free = free[(free > stage.start) & (free < stage.end)]
    after = np.searchsorted(fixed, free)
    gap = np.minimum(fixed[after] - free, free - fixed[after - 1])
    far = gap > slip
    cells = np.searchsorted(along, free).clip(1, along.size - 1)
    apart = 0.1 * np.minimum(along[cells] - along[cells - 1], gap)
    far &= (along[cells] - free > apart) & (free - along[cells - 1] > apart)
    return np.unique(np.concatenate((fixed, free[far])))


def _lattice(low: float, high: float) -> Floats:
    """Multiples of a power of two between two distances, ``LEGS`` to twice as many.

    From a start farther on these are the same or finer ones, so a profile that was found from
    farther back can still be driven.
    """
    step = 2.0 ** np.floor(np.log2((high - low) / LEGS))
    return np.asarray(step * np.arange(np.floor(low / step) + 1.0, np.ceil(high / step)))
