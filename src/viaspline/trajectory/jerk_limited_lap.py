"""The time law of a lap with a limit of the jerk: it goes on at its start where it ends.

Tested through ``trajectory/test_lap``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.trajectory.cells import Cells
from viaspline.trajectory.coupled import Profile, Stage
from viaspline.trajectory.jerk import fine_path, joined, reachable, smooth_law
from viaspline.trajectory.jerk_limited import JerkLimitedMotion, smoothest, smoothest_lap
from viaspline.trajectory.jerk_section import Section
from viaspline.trajectory.limited_path import LimitedPath
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.motion_ends import Rest, Seam
from viaspline.trajectory.slow_zones import Slow
from viaspline.trajectory.trajectory import Trajectory


def smooth_lap(
    limited_path: LimitedPath,
    limits: Limits,
    stage: Stage,
    plain: Profile,
    stops: Sequence[Station],
    start_time: float,
    seam_speed: float,
) -> Trajectory:
    """The fastest lap that keeps the jerk and all other limits, again and again.

    With rests on the way the last stretch before the seam and the first one after it are one
    motion, from the last rest to the first one.

    Args:
        limited_path: What is driven.
        limits: With ``max_jerk``.
        stage: The lap.
        plain: The fastest v² of a lap without a limit of the jerk.
        stops: With their dwells, in order.
        start_time: [s].
        seam_speed: The largest speed at the seam [m/s].
    """
    still, length = plain.points[plain.squares <= 0.0], stage.end
    if plain.squares[0] <= 0.0 or plain.squares[-1] <= 0.0:
        stage = replace(stage, first=0.0, last=0.0)
        return smooth_law(limited_path, limits, stage, plain, stops, start_time)
    limits, stage = reachable(limits), replace(stage, first=0.0, last=0.0)
    assert limits.max_jerk is not None
    cells, cell_size = fine_path(limited_path, limits, stage).cells(stage)
    top = seam_speed * seam_speed
    if not still.size:
        section = Section.of(cells, limits, stage, cell_size, 0.0, length)
        section.caps[[0, -1]] = np.minimum(section.caps[[0, -1]], top)
        rows = section.rows(Seam(), Seam())
        motion = smoothest_lap(np.diff(section.line), rows, limits.max_jerk)
        return joined(section.line, [motion], stops, start_time)
    slow = (*stage.slow, *(Slow(s.start + length, s.end + length, s.speed) for s in stage.slow))
    stage, cells = replace(stage, end=2.0 * length, slow=slow), _twice(cells)
    places = [*still.tolist(), float(still[0]) + length]
    lines: list[Floats] = [np.zeros(1)]
    motions: list[JerkLimitedMotion] = []
    for low, high in pairwise(places):
        seam = [length] if high > length else []
        section = Section.of(cells, limits, stage, cell_size, low, high, seam)
        line = section.line
        if seam:
            at = int(np.searchsorted(line, length))
            section.caps[at] = min(section.caps[at], top)
        rows = section.rows(Rest(), Rest())
        motion = smoothest(np.diff(line), rows, limits.max_jerk, Rest())
        if seam:
            before, after = _split(motion, at)
            lines = [line[at:] - length, *lines[1:], line[1 : at + 1]]
            motions = [after, *motions, before]
        else:
            lines.append(line[1:])
            motions.append(motion)
    lines[0][0], lines[-1][-1] = 0.0, length
    return joined(np.concatenate(lines), motions, stops, start_time)


def _twice(cells: Cells) -> Cells:
    """The cells of two laps."""
    return Cells(
        np.concatenate((cells.along, cells.along[1:] + cells.along[-1])),
        np.concatenate((cells.tangents, cells.tangents)),
        np.concatenate((cells.bends, cells.bends)),
        np.concatenate((cells.yaws, cells.yaws)),
        np.concatenate((cells.misses, cells.misses)),
        np.concatenate((cells.rests, cells.rests[1:])),
    )


def _split(motion: JerkLimitedMotion, at: int) -> tuple[JerkLimitedMotion, JerkLimitedMotion]:
    """The parts of a motion before and after one of its points."""
    first = JerkLimitedMotion(motion.speeds[: at + 1], *(part[:at] for part in motion[1:]))
    return first, JerkLimitedMotion(motion.speeds[at:], *(part[at:] for part in motion[1:]))
