"""A part of a path in stretches that are fine enough for a limit of the jerk.

Tested through ``trajectory/test_jerk``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.kernels.timing import time_grid
from viaspline.trajectory.cells import Cells, CellSize
from viaspline.trajectory.coupled import Stage, jump_caps
from viaspline.trajectory.jerk_rows import beside_rest, rows_of
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.motion_ends import Even, Moving, Rest, Rows, Seam
from viaspline.trajectory.slow_zones import Slow

MIN_REST_STRETCHES = 32
"""Stretches from rest to rest, at least."""

STRETCH_GROWTH = 1.25
"""Beside a rest every stretch is longer than the one before it by this."""

HAIR_RATIO = 0.01
"""No end of a slow part is nearer to a node than this, of the distance between nodes."""


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
        rows = rows_of(self.cells, self.limits, self.cell_size, self.cell, self.parts, self.tops)
        rows.limits[:, 0] = np.minimum(rows.limits[:, 0], self.caps[:-1])
        rows.limits[:, 2] = np.minimum(rows.limits[:, 2], self.caps[1:])
        beside = [(0, 1, 4)] if isinstance(start, Rest) else []
        beside += [(-1, 0, 2)] if isinstance(end, Rest) else []
        for k, a, w in beside:
            beside_rest(rows, self.cells, self.limits, self.cell, k, a, w)
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
