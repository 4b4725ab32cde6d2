"""A path as the time law sees it: its length, where it is slow, and the fastest v² along it.

Tested through ``trajectory/test_retime``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, cast

import numpy as np

from viaspline.curve.slow_parts import slow_parts
from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.mission.world_spec import SpeedZone
from viaspline.trajectory.cells import (
    MIN_SAMPLES,
    Cells,
    CellSize,
    Evaluable,
    cubic_cells,
    sampled_cells,
)
from viaspline.trajectory.coupled import Profile, Stage, cell_size_for, coupled_profile, is_coupled
from viaspline.trajectory.curvature_limited import Cubic, bend_profile
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.slow_zones import Slow
from viaspline.trajectory.turned import TurnedCurve, turned


class LimitedPath(Protocol):
    """A path under limits."""

    @property
    def length(self) -> float:
        """Length [m]."""

    def slow(self, zones: Sequence[SpeedZone], start: float) -> tuple[Slow, ...]:
        """Where zones make it slow, from a distance on [m]."""

    def cells(self, stage: Stage) -> tuple[Cells, CellSize]:
        """The path in cells that are fine enough for the limits."""

    def profile(self, stage: Stage) -> Profile:
        """The fastest v² on a stage, jerk left out."""


def limited_path_of(
    path: Cubic | Evaluable, limits: Limits, grid: int | None = None
) -> LimitedPath:
    """A path under limits, proven if it is a piecewise cubic and sampled if not."""
    if grid is not None and not 1 <= grid <= 1_000_000:
        raise GeometryError(f"grid is {grid}; give a number of cells from 1 to 1000000")
    if hasattr(path, "spans"):
        return LimitedCubicPath(cast(Cubic, path), limits, grid)
    rough = cell_size_for(limits, 1, Stage(start=0.0, end=1.0, first=0.0, last=0.0, top=1.0))
    sampled = TurnedCurve(path, limits.axis_heading) if limits.axis_heading else path
    cells, u = sampled_cells(sampled, rough, MIN_SAMPLES if grid is None else grid)
    return LimitedSampledPath(path, limits, cells, u)


def crawl(limits: Limits) -> float:
    """With which acceleration stretches are driven that are too short to tell [m/s²]."""
    return 2.0 / (1.0 / limits.max_accel + 1.0 / limits.brake)


@dataclass(frozen=True)
class LimitedCubicPath:
    """A piecewise cubic under limits."""

    path: Cubic
    limits: Limits
    grid: int | None = None

    @property
    def length(self) -> float:
        """Length [m]."""
        return float(self.path.length)

    def _ahead(self, start: float) -> tuple[int, float]:
        """The span in which the path is at a distance [m], and the distance where it begins."""
        if start <= 0.0:
            return 0, 0.0
        joints = np.asarray(
            self.path.distance(np.linspace(*self.path.domain, len(self.path.spans) + 1))
        )
        first = max(int(np.searchsorted(joints[:-1], start, side="right")) - 1, 0)
        return first, float(joints[first])

    def slow(self, zones: Sequence[SpeedZone], start: float) -> tuple[Slow, ...]:
        """Where zones make it slow, from a distance on [m]."""
        if not zones:
            return ()
        first, _ = self._ahead(start)
        begin, end = self.path.domain
        per_span = (end - begin) / len(self.path.spans)
        found = []
        for low, high, speed in slow_parts(self.path.spans[first:], zones):
            u = begin + per_span * (first + np.array([low, high]))
            places = np.asarray(self.path.distance(np.minimum(u, end)))
            if places[1] > start:
                found.append(Slow(max(float(places[0]), start), float(places[1]), speed))
        return tuple(found)

    def cells(self, stage: Stage) -> tuple[Cells, CellSize]:
        """The path in cells that are fine enough for the limits."""
        cell_size = cell_size_for(self.limits, self.path.spans.shape[2], stage, self.grid)
        first, begin = self._ahead(stage.start)
        ahead = np.array(self.path.spans[first:])  # writable: numba compiles for one kind
        spans = turned(ahead, self.limits.axis_heading)
        return cubic_cells(spans, begin, self.length, cell_size), cell_size

    def profile(self, stage: Stage) -> Profile:
        """The fastest v² on a stage, jerk left out."""
        if not is_coupled(self.limits, _dimension(self.path, self.limits)):
            return bend_profile(self.path, self.limits, stage)
        cells, cell_size = self.cells(stage)
        return coupled_profile(cells, self.limits, stage, cell_size)


def _dimension(path: Cubic, limits: Limits) -> int:
    """Number of coordinates, where a limit depends on it: else a path needn't have spans."""
    return 2 if limits.max_yaw_rate is None else int(path.spans.shape[2])


@dataclass(frozen=True)
class LimitedSampledPath:
    """Any other curve under limits.

    Attributes:
        path: The curve.
        limits: What is kept along it.
        along_cells: Its cells.
        u: Their ends as parameters, shape (n + 1,).
    """

    path: Evaluable
    limits: Limits
    along_cells: Cells
    u: Floats

    @property
    def length(self) -> float:
        """Length [m]."""
        return float(self.along_cells.along[-1])

    def slow(self, zones: Sequence[SpeedZone], start: float) -> tuple[Slow, ...]:
        """Where zones make it slow, from a distance on [m]; every cell is taken as a cubic."""
        if not zones:
            return ()
        points, ways = (np.asarray(self.path.evaluate(self.u, order)) for order in (0, 1))
        thirds = np.diff(self.u)[:, None] / 3.0
        inner = (points[:-1] + ways[:-1] * thirds, points[1:] - ways[1:] * thirds)
        spans = np.stack((points[:-1], *inner, points[1:]), axis=1)
        along = self.along_cells.along
        found = []
        for low, high, speed in slow_parts(spans, zones):
            ends = np.interp([low, high], np.arange(along.size), along)
            if ends[1] > start:
                found.append(Slow(max(float(ends[0]), start), float(ends[1]), speed))
        return tuple(found)

    def cells(self, stage: Stage) -> tuple[Cells, CellSize]:
        """The path in cells that are fine enough for the limits."""
        dimension = self.along_cells.tangents.shape[1]
        return self.along_cells, cell_size_for(self.limits, dimension, stage)

    def profile(self, stage: Stage) -> Profile:
        """The fastest v² on a stage, jerk left out."""
        return coupled_profile(self.along_cells, self.limits, stage, self.cells(stage)[1])
