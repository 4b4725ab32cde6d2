"""Windows of time in which robots of a fleet are looked at: what holds their ways, in a grid.

Tested through ``fleet/test_fleet_certificate``.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.fleet_motion import stage_end, stage_error, stage_place
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.jit import inlined, inner

WINDOW_REACHES = 2.0  # how far the fastest robot goes in a window, in mean reaches
MOST_WINDOWS = 200_000
PRIME_X: Final = 73856093
PRIME_Y: Final = 19349663


class Windows(NamedTuple):
    """What robots do in some windows of time behind each other: row w n + r is of robot r in w.

    Attributes:
        reached: In which stage each robot is when the next windows begin, (n, 1).
        stage: In which it is when a window begins; -1 where it has left, (windows n, 1).
        box: What holds its way in a window, grown by its reach: (x and y, from and to) [m],
            (windows n, 4).
        middle: Of that box [m], (windows n, 2).
        widest: The widest extent of boxes in each window [m], (windows, 1).
    """

    reached: Ints
    stage: Ints
    box: Floats
    middle: Floats
    widest: Floats


class WindowGrid(NamedTuple):
    """The robots of one window by the squares in which the middles of their boxes lie.

    Attributes:
        square: (n, 2).
        head: The last robot of a bucket, or -1, (buckets, 1); the buckets are a power of two.
        following: The one before it in its bucket, or -1, (n, 1).
    """

    square: Ints
    head: Ints
    following: Ints


@inlined
def _advanced(laws: PackedLaws, stage: int, last: int, instant: float) -> int:
    """The stage at an instant, from an earlier one on."""
    while stage < last and stage_end(laws, stage) <= instant:
        stage += 1
    return stage


@inner
def cover_windows(
    courses: PackedCourses, laws: PackedLaws, times: Floats, count: int, more: float, less: float,
    now: Windows,
) -> None:  # fmt: skip
    """Move all robots on through some windows and cover their ways in each.

    Robot by robot, as what is known of a robot lies together.

    Args:
        courses: PackedCourses.
        laws: PackedLaws.
        times: When each window begins, and the last one ends [s], (count + 1, 1) or more.
        count: How many windows.
        more: By how much boxes are grown beyond reaches [m].
        less: How much of that is left away again, but in their extents [m].
        now: Filled.
    """
    robots = courses.reach.shape[0]
    for window in range(count):
        now.widest[window, 0] = 0.0
    for robot in range(robots):
        if not laws.is_timed[robot]:
            for window in range(count):
                now.stage[window * robots + robot, 0] = -1
            continue
        last = 2 * (courses.first[robot + 1] - 1)
        reached = now.reached[robot, 0]
        for window in range(count):
            begin, end, row = times[window, 0], times[window + 1, 0], window * robots + robot
            stage = _advanced(laws, reached, last, begin)
            now.stage[row, 0] = stage
            if stage == last and laws.leave[stage >> 1] < begin:
                now.stage[row, 0] = -1  # it has left
                reached = stage
                continue
            x, y = stage_place(courses, laws, stage, begin)
            low_x, low_y, high_x, high_y = x, y, x, y
            error = stage_error(courses, laws, stage)
            while stage < last and stage_end(laws, stage) < end:
                stage += 1
                if stage & 1:  # it goes on from where it was
                    error = max(error, stage_error(courses, laws, stage))
                else:
                    x, y = courses.place[stage >> 1, 0], courses.place[stage >> 1, 1]
                    low_x, low_y = min(low_x, x), min(low_y, y)
                    high_x, high_y = max(high_x, x), max(high_y, y)
            reached = stage
            x, y = stage_place(courses, laws, stage, end)
            grown = courses.reach[robot] + error + more
            low_x, low_y = min(low_x, x) - grown, min(low_y, y) - grown
            high_x, high_y = max(high_x, x) + grown, max(high_y, y) + grown
            now.middle[row, 0], now.middle[row, 1] = 0.5 * (low_x + high_x), 0.5 * (low_y + high_y)
            now.box[row, 0], now.box[row, 1] = low_x + less, low_y + less
            now.box[row, 2], now.box[row, 3] = high_x - less, high_y - less
            extent = max(high_x - low_x, high_y - low_y)
            now.widest[window, 0] = max(now.widest[window, 0], extent)
        now.reached[robot, 0] = reached


@inlined
def bucket_of(x: int, y: int, mask: int) -> int:
    """The bucket of a square of the grid."""
    return ((x * PRIME_X) ^ (y * PRIME_Y)) & mask


@inner
def file_window(now: Windows, first: int, side: float, grid: WindowGrid) -> None:
    """Put the boxes of a window into the grid, each by its middle.

    Args:
        now: The windows.
        first: The row of the first robot in it.
        side: Of the squares [m].
        grid: Filled; empty, or as a window before left it.
    """
    mask = grid.head.shape[0] - 1
    for robot in range(grid.following.shape[0]):  # those of the window before
        grid.head[bucket_of(grid.square[robot, 0], grid.square[robot, 1], mask), 0] = -1
    for robot in range(grid.following.shape[0]):
        row = first + robot
        if now.stage[row, 0] >= 0:
            x = math.floor(now.middle[row, 0] / side)
            y = math.floor(now.middle[row, 1] / side)
            grid.square[robot, 0], grid.square[robot, 1] = x, y
            bucket = bucket_of(x, y, mask)
            grid.following[robot, 0] = grid.head[bucket, 0]
            grid.head[bucket, 0] = robot
        else:
            grid.following[robot, 0] = -1


@inner
def window_times(courses: PackedCourses, laws: PackedLaws) -> tuple[float, float, float]:
    """When the first robot departs, when the last one arrives, and for how long a window lasts."""
    begin, end, fastest, reach, count = np.inf, -np.inf, 0.0, 0.0, 0
    for robot in range(courses.reach.shape[0]):
        if laws.is_timed[robot]:
            first, last = courses.first[robot], courses.first[robot + 1] - 1
            reach, count = reach + courses.reach[robot], count + 1
            begin = min(begin, laws.leave[first])
            for node in range(first, last + 1):
                fastest = max(fastest, laws.speed[node])
                if laws.arrive[node] < np.inf:  # else it stands at its start for ever
                    end = max(end, laws.arrive[node])
    if not begin <= end:
        return 0.0, 0.0, 0.0
    lasts = end - begin
    if fastest > 0.0 and reach > 0.0:
        lasts = WINDOW_REACHES * reach / (count * fastest)
    return begin, end, max(lasts, (end - begin) / MOST_WINDOWS)
