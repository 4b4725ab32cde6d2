"""What a drive waits for others that have their laws, and whether it comes to rests of theirs.

Along its way it comes later to each meeting by what it has waited before. Both robots come sooner
or later than reckoned, so that a meeting costs the lesser wait in the mean; where the other one has
less to wait, it is that one that waits.

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
from viaspline.kernels.fleet.sampled_meetings import (
    BETWEEN_M,
    FIRST,
    HIGH,
    LAST,
    LATE,
    LOW,
    OTHER_LATE,
    ROBOT,
    SHIFT,
    WAIT,
    Meetings,
    add_meeting,
    find_meetings,
)
from viaspline.kernels.fleet.swerve_shape import SampledDrive
from viaspline.kernels.jit import inner, uncounted

FAR = 1e6
"""The square of how often two samples are farther apart than is too near, at most."""
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


@uncounted
def wait_in_turn(meetings: Meetings, spread: float) -> float:
    """What is waited at meetings, one after the other [s]. ``WAIT`` and ``SHIFT`` are written.

    Args:
        meetings: In the order in which the drive comes to them.
        spread: So much sooner or later two robots come to a meeting than foreseen: standard
            deviation [s].
    """
    shift, total = 0.0, 0.0
    for g in range(meetings.written[0]):
        late = meetings.real[g, LATE] - shift
        other_late = meetings.real[g, OTHER_LATE] + shift
        wait = expected_wait(late, other_late, spread)
        meetings.real[g, WAIT], meetings.real[g, SHIFT] = wait, shift
        total += wait
        if late < other_late:
            shift += wait
    return total


@uncounted
def shift_behind(meetings: Meetings, g: int) -> float:
    """How much a drive has waited in all when it has passed meeting g [s]."""
    shift = meetings.real[g, SHIFT]
    if meetings.real[g, LATE] - shift < meetings.real[g, OTHER_LATE] + shift:
        return shift + meetings.real[g, WAIT]
    return shift


@uncounted
def _look_at_pair(
    samples: PackedSamples, robot: int, drive: SampledDrive, other: int, rows: tuple[int, int],
    others: tuple[int, int], behind: tuple[int, float], soonest: tuple[float, float],
) -> tuple[float, float, int]:  # fmt: skip
    """What two robots come too early for letting each other pass, by some samples of both.

    Args:
        samples: Of all paths.
        robot: The one,
        drive: and its samples.
        other: The other one.
        rows: From which sample of the drive to which.
        others: From which sample of all to which.
        behind: Behind which sample of the drive it comes later than it says, and how much [s].
        soonest: What is known of that already [s].

    Returns:
        (late, other late, how many pairs of samples were looked at).
    """
    late, other_late = soonest
    near, looks, i = samples.reach[robot] + samples.reach[other] + BETWEEN_M, 0, rows[0]
    scale = 1.0 / (near * near)
    while i < rows[1]:
        x, y = drive.place[i, 0], drive.place[i, 1]
        later = behind[1] if i > behind[0] else 0.0
        q, nearest = others[0], np.inf
        while q < others[1]:
            dx, dy = x - samples.place[q, 0], y - samples.place[q, 1]
            square = (dx * dx + dy * dy) * scale
            looks += 1
            nearest = min(nearest, square)
            if square < 1.0:
                late = max(late, samples.goes[q] - drive.comes[i] - later)
                other_late = max(other_late, drive.goes[i] + later - samples.comes[q])
                q += 1
            else:
                q += int(math.sqrt(square))  # samples are nearer to each other
        i += 1 if nearest < 1.0 else int(math.sqrt(min(nearest, FAR)))
    return late, other_late, looks


@uncounted
def wait_of_pair(
    samples: PackedSamples, robot: int, drive: SampledDrive, known: Meetings, g: int,
    moved: tuple[int, int, float], spread: float, most: float,
) -> tuple[float, int]:  # fmt: skip
    """What one meeting costs where a drive is led aside.

    Args:
        samples: Of all paths.
        robot: Whose drive it is.
        drive: Where it is led aside; when it comes later behind that isn't in it yet.
        known: The meetings of the drive as it was.
        g: Which of them.
        moved: From which sample to which it is led aside, and how much later it comes behind that.
        spread: See ``wait_in_turn`` [s].
        most: It isn't looked further where it costs more [s].

    Returns:
        (the wait [s], how many pairs of samples were looked at).
    """
    begin, end, longer = moved
    other, shift = known.whole[g, ROBOT], known.real[g, SHIFT]
    first, last = known.whole[g, FIRST], known.whole[g, LAST] + 1
    others = (
        max(samples.first[other] + known.whole[g, LOW] - (end - begin), samples.first[other]),
        min(
            samples.first[other] + known.whole[g, HIGH] + end - begin + 1, samples.first[other + 1]
        ),
    )
    behind = (end, longer)
    late, other_late, looks = _look_at_pair(
        samples, robot, drive, other, (first, last), others, behind, (-np.inf, -np.inf)
    )
    if late > -np.inf:
        wait = expected_wait(late - shift, other_late + shift, spread)
        if wait > most:
            return wait, looks
    for rows in ((begin, first), (last, end)):
        late, other_late, more = _look_at_pair(
            samples, robot, drive, other, rows, others, behind, (late, other_late)
        )
        looks += more
    if late == -np.inf:
        return 0.0, looks
    return expected_wait(late - shift, other_late + shift, spread), looks


@uncounted
def waits_with(
    samples: PackedSamples, grid: LinkedGrid, robot: int, drive: SampledDrive, known: Meetings,
    moved: tuple[int, int, float], asked: Ints, spread: float, scratch: Meetings,
) -> float:  # fmt: skip
    """What a drive waits that differs from one whose meetings are known [s].

    Args:
        samples: Of all paths.
        grid: Of their places.
        robot: Whose drive it is.
        drive: Its samples.
        known: The meetings of the other drive.
        moved: From which sample to which it differs, and how much later it comes behind that [s].
        asked: Without any meeting, (n, 2); written to, and left so.
        spread: See ``wait_in_turn`` [s].
        scratch: Written to.
    """
    begin, end, longer = moved
    low, high = begin, end
    scratch.written[0] = 0
    for g in range(known.written[0]):
        first, last, other = known.whole[g, FIRST], known.whole[g, LAST], known.whole[g, ROBOT]
        late, other_late = known.real[g, LATE], known.real[g, OTHER_LATE]
        if last < begin:
            add_meeting(scratch, known.whole, g, late, other_late)
        elif first >= end:
            add_meeting(scratch, known.whole, g, late - longer, other_late + longer)
        else:
            asked[other, 0], asked[other, 1] = (
                min(asked[other, 0], first),
                max(asked[other, 1], last),
            )
            low, high = min(low, first), max(high, last + 1)
    find_meetings(samples, grid, robot, drive, (begin, end), (low, high), asked, scratch)
    for g in range(known.written[0]):
        other = known.whole[g, ROBOT]
        asked[other, 0], asked[other, 1] = drive.distance.size, -1
    return wait_in_turn(scratch, spread)
