"""The time law of a part of a path: what it costs doesn't grow with the path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.mission.world_spec import SpeedZone
from viaspline.trajectory.coupled import Stage
from viaspline.trajectory.limited_path import LimitedCubicPath
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime
from viaspline.trajectory.slow_zones import Slow
from viaspline.trajectory.trajectory import Trajectory


def retime_part(
    path: Path,
    start: float,
    end: float,
    limits: Limits,
    stations: Sequence[Station] = (),
    *,
    zones: Sequence[SpeedZone] = (),
    slow: Sequence[Slow] = (),
    start_speed: float = 0.0,
    start_accel: float = 0.0,
    start_time: float = 0.0,
    replaces: Trajectory | None = None,
) -> Trajectory:
    """The fastest drive along a part of a path, to rest at its end; see ``retime``.

    Args:
        path: What is driven.
        start: Distance along it at which the part begins [m].
        end: At which it ends [m].
        limits: As for ``retime``.
        stations: Stops, as distances along the path; those beyond the part are left out.
        zones: Areas with a lower speed.
        slow: Stretches with a lower speed, as distances along the path.
        start_speed: [m/s].
        start_accel: [m/s²].
        start_time: [s].
        replaces: The time law that is driven until then.

    Returns:
        The time law, in distances along the path.

    Raises:
        GeometryError: As ``retime``.

    Example:
        >>> line = Path([[[0, 0], [10, 0], [20, 0], [30, 0]]], vias=[])
        >>> law = retime_part(line, 5.0, 15.0, Limits(max_speed=2, max_accel=1))
        >>> law.distances.tolist(), law.speeds.tolist()
        ([5.0, 7.0, 13.0, 15.0], [0.0, 2.0, 2.0, 0.0])
    """
    first, last = np.asarray(path.parameter(np.array([start, end]))).tolist()
    part = path.section(first, last)
    ahead = [
        replace(stop, distance=min(max(stop.distance - start, 0.0), part.length))
        for stop in stations
        if stop.distance <= end
    ]
    there = [Slow(p.start - start, p.end - start, p.speed) for p in slow]
    law = retime(
        part, limits, ahead, zones=zones, slow=there, start_speed=start_speed,
        start_accel=start_accel, start_time=start_time, replaces=replaces,
    )  # fmt: skip
    moved = law.moved(start)
    return replace(moved, distances=np.minimum(moved.distances, end))


def end_of_cells(
    path: Path, start: float, end: float, limits: Limits, start_speed: float, most: int
) -> float:
    """Up to where a part of a path is no more than so many cells of its time law [m].

    Where a path bends sharply, cells are a thousandth as long as elsewhere.

    Args:
        path: What is driven.
        start: Distance along it at which the part begins [m].
        end: At which it ends at the latest [m].
        limits: Of the time law.
        start_speed: [m/s].
        most: Number of cells.

    Example:
        >>> line = Path([[[0, 0], [10, 0], [20, 0], [30, 0]]], vias=[])
        >>> end_of_cells(line, 5.0, 15.0, Limits(max_speed=2, max_accel=1), 0.0, 10)
        6.5625
    """
    first, last = np.asarray(path.parameter(np.array([start, end]))).tolist()
    if not first < last:
        return end
    part = path.section(first, last)
    stage = Stage(start=0.0, end=part.length, first=start_speed, last=0.0, top=limits.max_speed)
    cells, _ = LimitedCubicPath(part, limits).cells(stage)
    if cells.along.size - 1 <= most:
        return end
    return start + float(cells.along[most])
