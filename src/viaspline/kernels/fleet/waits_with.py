"""What a drive that differs a little from another one would wait, and whether it comes to rests.

Tested through ``fleet/test_swerved_fleet``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.expected_wait import expected_wait
from viaspline.kernels.fleet.linked_grid import NEXT, NONE, LinkedGrid, column_of
from viaspline.kernels.fleet.packed_samples import PackedSamples
from viaspline.kernels.fleet.reckoned_waits import (
    BETWEEN_M,
    FIRST,
    HIGH,
    LAST,
    LATE,
    LOW,
    OTHER_LATE,
    ROBOT,
    WAIT,
    Meetings,
    new_meetings,
    reckoned_waits,
)
from viaspline.kernels.fleet.swerve_shape import SampledDrive, sampled_drive
from viaspline.kernels.jit import inner, kernel

SPREAD_S = 2.0
"""So much sooner or later two robots come to a meeting than foreseen: standard deviation [s]."""
HORIZON_S = 12.0
"""Meetings of which one robot is gone so long before the other one comes stay out of it [s]."""
MOST_MEETINGS = 1000
"""Of one robot, that are within the horizon."""
KEPT_MORE_M = 0.15
"""By so much more than it has to a swerve keeps off places where others rest [m]."""


class RestGrid(NamedTuple):
    """Places where robots rest.

    Attributes:
        rows: x, y and reach of each [m], (k, 3).
        owner: Of each, (k,).
        grid: Cells are as wide as a robot has to keep off, at most.
    """

    rows: Floats
    owner: Ints
    grid: LinkedGrid


@inner
def comes_to_rest(
    rests: RestGrid, robot: int, own: float, drive: SampledDrive, begin: int, end: int
) -> bool:
    """Whether some samples are too near to where another robot rests."""
    grid = rests.grid
    for i in range(begin, end):
        x, y = drive.place[i, 0], drive.place[i, 1]
        column, row = column_of(grid, 0, x), column_of(grid, 1, y)
        for a in range(max(column - 1, 0), min(column + 2, grid.counts[0])):
            for b in range(max(row - 1, 0), min(row + 2, grid.counts[1])):
                k = grid.head[a * grid.counts[1] + b]
                while k != NONE:
                    near = own + rests.rows[k, 2] + KEPT_MORE_M
                    if rests.owner[k] != robot and (
                        math.hypot(x - rests.rows[k, 0], y - rests.rows[k, 1]) < near
                    ):
                        return True
                    k = grid.links[k, NEXT]
    return False


@inner
def wait_of_pair(
    samples: PackedSamples, robot: int, drive: SampledDrive, meeting: Ints, begin: int, end: int
) -> tuple[float, int]:
    """What one meeting costs with another drive, that differs from some sample to another.

    Returns:
        (the wait [s], how many pairs of samples were looked at).
    """
    other = meeting[ROBOT]
    first = samples.first[other]
    more = end - begin
    low = max(first + meeting[LOW] - more, first)
    high = min(first + meeting[HIGH] + more + 1, samples.first[other + 1])
    near = samples.reach[robot] + samples.reach[other] + BETWEEN_M
    late, other_late, looks = -np.inf, -np.inf, 0
    i, last = min(begin, meeting[FIRST]), max(end, meeting[LAST] + 1)
    while i < last:
        x, y = drive.place[i, 0], drive.place[i, 1]
        q, nearest = low, np.inf
        while q < high:
            apart = math.hypot(x - samples.place[q, 0], y - samples.place[q, 1])
            looks += 1
            if apart < near:
                late = max(late, samples.goes[q] - drive.comes[i])
                other_late = max(other_late, drive.goes[i] - samples.comes[q])
            nearest = min(nearest, apart)
            q += 1 + max(int((apart - near) / near), 0)  # samples are nearer to each other
        i += 1 + max(int((nearest - near) / near), 0)
    if late == -np.inf:
        return 0.0, looks
    return expected_wait(late, other_late, SPREAD_S), looks


@inner
def waits_with(
    samples: PackedSamples, grid: LinkedGrid, robot: int, drive: SampledDrive, known: Meetings,
    moved: tuple[int, int, float], asked: Ints, most: float, scratch: Meetings,
) -> float:  # fmt: skip
    """What a drive costs that differs from one whose meetings are known [s].

    Args:
        samples: Of all paths.
        grid: Of their places.
        robot: Whose drive it is.
        drive: Its samples.
        known: The meetings of the other drive.
        moved: From which sample to which it differs, and how much later it comes behind that [s].
        asked: Without any meeting, (n, 2); written to, and left so.
        most: More isn't looked for [s].
        scratch: Written to.
    """
    begin, end, longer = moved
    total, low, high = 0.0, begin, end
    for g in range(known.written[0]):
        one, times = known.whole[g], known.real[g]
        if one[LAST] < begin:
            total += times[WAIT]
        elif one[FIRST] >= end:
            total += expected_wait(times[LATE] - longer, times[OTHER_LATE] + longer, SPREAD_S)
        else:
            span = asked[one[ROBOT]]
            span[0], span[1] = min(span[0], one[FIRST]), max(span[1], one[LAST])
            low, high = min(low, one[FIRST]), max(high, one[LAST] + 1)
    if total < most:
        total += reckoned_waits(
            samples, grid, robot, drive, (begin, end), (low, high), asked, SPREAD_S, HORIZON_S,
            most - total, scratch,
        )  # fmt: skip
    for g in range(known.written[0]):
        span = asked[known.whole[g, ROBOT]]
        span[0], span[1] = drive.distance.size, -1
    return total


@kernel
def waits_of_all(samples: PackedSamples, grid: LinkedGrid) -> Floats:
    """What the drive of each robot costs where it meets others [s], (n,)."""
    robots = samples.reach.size
    asked, waits = np.zeros((robots, 2), np.int64), np.zeros(robots)
    meetings = new_meetings(robots, MOST_MEETINGS)
    for robot in range(robots):
        drive = sampled_drive(samples, robot)
        whole = (0, drive.distance.size)
        waits[robot] = reckoned_waits(
            samples, grid, robot, drive, whole, whole, asked, SPREAD_S, HORIZON_S, np.inf, meetings
        )
    return waits
