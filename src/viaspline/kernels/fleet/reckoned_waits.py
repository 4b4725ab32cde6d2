"""What a drive has to wait for others, or these for it, reckoned from samples of all paths.

It proves nothing, and looks at nobody's true boxes: it is to tell in microseconds which of many
ways is worth to be laid. Samples near each other that follow each other along both paths are one
meeting; what either robot comes too early for letting the other pass first says what it costs.

Tested through ``fleet/test_swerved_fleet``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.expected_wait import expected_wait
from viaspline.kernels.fleet.linked_grid import NEXT, NONE, LinkedGrid, column_of
from viaspline.kernels.fleet.packed_samples import PackedSamples
from viaspline.kernels.fleet.swerve_shape import SampledDrive
from viaspline.kernels.growable import new_floats, new_ints
from viaspline.kernels.jit import inner

BETWEEN_M = 0.15
"""Samples that are by so much farther apart than robots may be count as too near: what lies between
them is nearer [m]."""
GAP, OTHER_GAP = 5, 5
"""Samples of one meeting follow each other within so many along the one path and the other."""
NEVER = -(1 << 30)
ROBOT, FIRST, LAST, LOW, HIGH = range(5)
"""Columns of meetings: the other robot, from which sample of the drive to which, and of the
other's."""
LATE, OTHER_LATE, WAIT = range(3)


class Meetings(NamedTuple):
    """Where a drive may meet others, and what it takes to find out.

    Attributes:
        whole: A row for each meeting: see ``ROBOT``, (room, 5).
        real: What the drive comes too early for letting the other pass, and the other one, and the
            wait that is reckoned with [s], (room, 3).
        written: So many rows are, (1,).
        open: Of each robot two meetings that may go on, as ``whole``, (2 n, 5),
        times: and as ``real``, (2 n, 3).
        touched: Those of them that are in use, (2 n,).
    """

    whole: Ints
    real: Floats
    written: Ints
    open: Ints
    times: Floats
    touched: Ints


@inner
def new_meetings(robots: int, room: int) -> Meetings:
    """For drives among so many robots; more meetings than there is room for aren't written."""
    open_ones = new_ints(2 * robots, 5)
    for k in range(2 * robots):
        open_ones[k, LAST] = NEVER
    return Meetings(
        new_ints(room, 5), new_floats(room, 3), np.zeros(1, np.int64), open_ones,
        new_floats(2 * robots, 3), np.empty(2 * robots, np.int64),
    )  # fmt: skip


@inner
def _close(meetings: Meetings, k: int, spread: float, horizon: float) -> float:
    """End a meeting that was open, and write it down; what it costs [s]."""
    late, other_late = meetings.times[k, LATE], meetings.times[k, OTHER_LATE]
    wait = 0.0
    if min(late, other_late) > -horizon:
        wait = expected_wait(late, other_late, spread)
        at = meetings.written[0]
        if at < meetings.whole.shape[0]:
            meetings.whole[at] = meetings.open[k]
            meetings.real[at, LATE], meetings.real[at, OTHER_LATE] = late, other_late
            meetings.real[at, WAIT] = wait
            meetings.written[0] = at + 1
    meetings.open[k, LAST] = NEVER
    return wait


@inner
def _slot(meetings: Meetings, other: int, i: int, j: int) -> int:
    """The open meeting with another robot that a pair of samples goes on with; else ``NONE``."""
    for k in range(2 * other, 2 * other + 2):
        open_one = meetings.open[k]
        if i - open_one[LAST] <= GAP and (
            open_one[LOW] - OTHER_GAP <= j <= open_one[HIGH] + OTHER_GAP
        ):
            return k
    return NONE


@inner
def reckoned_waits(
    samples: PackedSamples, grid: LinkedGrid, robot: int, drive: SampledDrive,
    within: tuple[int, int], whole: tuple[int, int], asked: Ints, spread: float, horizon: float,
    most: float, meetings: Meetings,
) -> float:  # fmt: skip
    """What a drive costs where it meets others: the waits of it or of them, in the mean [s].

    Args:
        samples: Of all paths.
        grid: Of their places; cells are as wide as two robots may be near each other.
        robot: Whose drive it is; its own samples play no part.
        drive: Its samples.
        within: From which sample on all others are looked at, and up to which.
        whole: From where to where those alone outside of that whose meetings are asked for.
        asked: Of each robot, from which sample of the drive to which, (n, 2).
        spread: See ``expected_wait`` [s].
        horizon: Meetings of which one is over for so long before the other comes cost nothing [s].
        most: More isn't looked for [s].
        meetings: Written to.
    """
    total, used = 0.0, 0
    meetings.written[0] = 0
    own = samples.reach[robot]
    for i in range(whole[0], whole[1]):
        x, y = drive.place[i, 0], drive.place[i, 1]
        is_within = within[0] <= i < within[1]
        column, row = column_of(grid, 0, x), column_of(grid, 1, y)
        for a in range(max(column - 1, 0), min(column + 2, grid.counts[0])):
            for b in range(max(row - 1, 0), min(row + 2, grid.counts[1])):
                q = grid.head[a * grid.counts[1] + b]
                while q != NONE:
                    other = samples.robot[q]
                    dx, dy = x - samples.place[q, 0], y - samples.place[q, 1]
                    near = own + samples.reach[other] + BETWEEN_M
                    is_near = other != robot and dx * dx + dy * dy < near * near
                    if is_near and (is_within or asked[other, 0] <= i <= asked[other, 1]):
                        j = q - samples.first[other]
                        k = _slot(meetings, other, i, j)
                        if k == NONE:
                            k = 2 * other
                            if meetings.open[k, LAST] > meetings.open[k + 1, LAST]:
                                k += 1  # the one that was seen longer ago
                            if meetings.open[k, LAST] != NEVER:
                                total += _close(meetings, k, spread, horizon)
                            else:
                                meetings.touched[used] = k
                                used += 1
                            meetings.open[k, ROBOT], meetings.open[k, FIRST] = other, i
                            meetings.open[k, LOW], meetings.open[k, HIGH] = j, j
                            meetings.times[k, LATE] = meetings.times[k, OTHER_LATE] = -np.inf
                        one, times = meetings.open[k], meetings.times[k]
                        one[LAST] = i
                        one[LOW], one[HIGH] = min(one[LOW], j), max(one[HIGH], j)
                        times[LATE] = max(times[LATE], samples.goes[q] - drive.comes[i])
                        times[OTHER_LATE] = max(times[OTHER_LATE], drive.goes[i] - samples.comes[q])
                    q = grid.links[q, NEXT]
        if total > most:
            break
    for k in meetings.touched[:used]:
        if meetings.open[k, LAST] != NEVER:
            total += _close(meetings, k, spread, horizon)
    return total
