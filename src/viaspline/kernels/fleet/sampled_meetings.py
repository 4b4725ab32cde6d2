"""Where a drive meets others, by samples of all paths.

It proves nothing, and looks at nobody's true boxes: it is to tell in microseconds which of many
ways is worth to be laid. Samples near each other that follow each other along both paths are one
meeting; what either robot comes too early for letting the other pass first says what it costs.

Tested through ``fleet/test_swerved_fleet``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.linked_grid import NEXT, NONE, LinkedGrid, column_of
from viaspline.kernels.fleet.packed_samples import PackedSamples
from viaspline.kernels.fleet.swerve_shape import SampledDrive
from viaspline.kernels.growable import new_floats, new_ints
from viaspline.kernels.jit import inner, uncounted

BETWEEN_M = 0.15
"""Samples that are by so much farther apart than robots may be count as too near: what lies between
them is nearer [m]."""
HORIZON_S = 40.0
"""Meetings of which one robot is gone so long before the other one comes are none [s]."""
MOST_MEETINGS = 1000
"""Of one robot, that are within the horizon."""
GAP, OTHER_GAP = 5, 5
"""Samples of one meeting follow each other within so many along the one path and the other."""
NEVER = -(1 << 30)
ROBOT, FIRST, LAST, LOW, HIGH = range(5)
"""Columns of meetings: the other robot, from which sample of the drive to which, and of the
other's."""
LATE, OTHER_LATE, WAIT, SHIFT = range(4)


class Meetings(NamedTuple):
    """Where a drive may meet others, and what it takes to find out.

    Attributes:
        whole: A row for each meeting: see ``ROBOT``, (room, 5).
        real: What the drive comes too early for letting the other pass, and the other one; how long
            one of them is reckoned to wait, and the drive before that in all [s], (room, 4).
        written: So many rows are, (1,).
        open: Of each robot two meetings that may go on, as ``whole``, (2 n, 5),
        times: and the first two of ``real``, (2 n, 2).
        touched: Those of them that are in use, (2 n,).
    """

    whole: Ints
    real: Floats
    written: Ints
    open: Ints
    times: Floats
    touched: Ints


@inner
def new_meetings(robots: int) -> Meetings:
    """For drives among so many robots; more meetings than there is room for aren't written."""
    open_ones = new_ints(2 * robots, 5)
    for k in range(2 * robots):
        open_ones[k, LAST] = NEVER
    return Meetings(
        new_ints(MOST_MEETINGS, 5), new_floats(MOST_MEETINGS, 4), np.zeros(1, np.int64), open_ones,
        new_floats(2 * robots, 2), np.empty(2 * robots, np.int64),
    )  # fmt: skip


@uncounted
def add_meeting(meetings: Meetings, whole: Ints, row: int, late: float, other_late: float) -> None:
    """Put a meeting among others, which are in the order in which the drive comes to them.

    Args:
        meetings: Written to, if there is room.
        whole: Rows as theirs.
        row: Which of them it is.
        late: See ``real``.
        other_late: See ``real``.
    """
    at = meetings.written[0]
    if at == meetings.whole.shape[0]:
        return
    meetings.written[0] = at + 1
    while at > 0 and meetings.whole[at - 1, FIRST] > whole[row, FIRST]:
        for k in range(5):
            meetings.whole[at, k] = meetings.whole[at - 1, k]
        meetings.real[at, LATE] = meetings.real[at - 1, LATE]
        meetings.real[at, OTHER_LATE] = meetings.real[at - 1, OTHER_LATE]
        at -= 1
    for k in range(5):
        meetings.whole[at, k] = whole[row, k]
    meetings.real[at, LATE], meetings.real[at, OTHER_LATE] = late, other_late


@uncounted
def _close(meetings: Meetings, k: int) -> None:
    """End a meeting that was open, and write it down."""
    late, other_late = meetings.times[k, LATE], meetings.times[k, OTHER_LATE]
    if min(late, other_late) > -HORIZON_S:
        add_meeting(meetings, meetings.open, k, late, other_late)
    meetings.open[k, LAST] = NEVER


@uncounted
def _slot(meetings: Meetings, other: int, i: int, j: int) -> int:
    """The open meeting with another robot that a pair of samples goes on with; else ``NONE``."""
    for k in range(2 * other, 2 * other + 2):
        if i - meetings.open[k, LAST] <= GAP and (
            meetings.open[k, LOW] - OTHER_GAP <= j <= meetings.open[k, HIGH] + OTHER_GAP
        ):
            return k
    return NONE


@uncounted
def find_meetings(
    samples: PackedSamples, grid: LinkedGrid, robot: int, drive: SampledDrive,
    within: tuple[int, int], whole: tuple[int, int], asked: Ints, meetings: Meetings,
) -> None:  # fmt: skip
    """Find the meetings of a drive, and add them to those that there are.

    Args:
        samples: Of all paths.
        grid: Of their places; cells are as wide as two robots may be near each other.
        robot: Whose drive it is; its own samples play no part.
        drive: Its samples.
        within: From which sample on all others are looked at, and up to which.
        whole: From where to where those alone outside of that whose meetings are asked for.
        asked: Of each robot, from which sample of the drive to which, (n, 2).
        meetings: Written to.
    """
    used, own = 0, samples.reach[robot]
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
                                _close(meetings, k)
                            else:
                                meetings.touched[used] = k
                                used += 1
                            meetings.open[k, ROBOT], meetings.open[k, FIRST] = other, i
                            meetings.open[k, LOW], meetings.open[k, HIGH] = j, j
                            meetings.times[k, LATE] = meetings.times[k, OTHER_LATE] = -np.inf
                        meetings.open[k, LAST] = i
                        meetings.open[k, LOW] = min(meetings.open[k, LOW], j)
                        meetings.open[k, HIGH] = max(meetings.open[k, HIGH], j)
                        late, other_late = (
                            samples.goes[q] - drive.comes[i],
                            drive.goes[i] - samples.comes[q],
                        )
                        meetings.times[k, LATE] = max(meetings.times[k, LATE], late)
                        meetings.times[k, OTHER_LATE] = max(
                            meetings.times[k, OTHER_LATE], other_late
                        )
                    q = grid.links[q, NEXT]
    for u in range(used):
        if meetings.open[meetings.touched[u], LAST] != NEVER:
            _close(meetings, meetings.touched[u])
