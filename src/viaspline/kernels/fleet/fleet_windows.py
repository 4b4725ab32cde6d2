"""A window of time in which robots of a fleet are looked at: what holds their ways, in a grid.

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


class Windowed(NamedTuple):
    """What the robots do in a window of time, and the grid of that.

    Attributes:
        stage: In which each robot is when the window begins, (n, 1).
        box: What holds its way in it, grown by its reach: (x and y, from and to) [m], (n, 4).
        square: The square of its box's middle, (n, 2).
        head: The first robot of a bucket, or -1, (buckets, 1); the buckets are a power of two.
        following: The next one in its bucket, or -1, (n, 1).
    """

    stage: Ints
    box: Floats
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
def cover_window(
    courses: PackedCourses, laws: PackedLaws, begin: float, end: float, more: float,
    now: Windowed,
) -> float:  # fmt: skip
    """Move all robots on to a window and cover their ways in it. The widest extent [m]."""
    widest = 0.0
    for robot in range(courses.reach.shape[0]):
        if not laws.is_timed[robot]:
            continue
        last = 2 * (courses.first[robot + 1] - 1)
        stage = _advanced(laws, now.stage[robot, 0], last, begin)
        now.stage[robot, 0] = stage
        if stage == last and laws.leave[stage >> 1] < begin:
            now.square[robot, 0] = -1  # it has left
            continue
        x, y = stage_place(courses, laws, stage, begin)
        low_x, low_y, high_x, high_y = x, y, x, y
        error = stage_error(courses, laws, stage)
        while stage < last and stage_end(laws, stage) < end:
            stage += 1
            x, y = courses.place[stage >> 1, 0], courses.place[stage >> 1, 1]
            low_x, low_y = min(low_x, x), min(low_y, y)
            high_x, high_y = max(high_x, x), max(high_y, y)
            error = max(error, stage_error(courses, laws, stage))
        x, y = stage_place(courses, laws, stage, end)
        grown = courses.reach[robot] + error + more
        low_x, low_y = min(low_x, x) - grown, min(low_y, y) - grown
        high_x, high_y = max(high_x, x) + grown, max(high_y, y) + grown
        now.box[robot, 0], now.box[robot, 1] = low_x, low_y
        now.box[robot, 2], now.box[robot, 3] = high_x, high_y
        now.square[robot, 0] = 0
        widest = max(widest, max(high_x - low_x, high_y - low_y))
    return widest


@inlined
def bucket_of(x: int, y: int, mask: int) -> int:
    """The bucket of a square of the grid."""
    return ((x * PRIME_X) ^ (y * PRIME_Y)) & mask


@inner
def file_window(laws: PackedLaws, side: float, is_here: Ints, now: Windowed) -> None:
    """Put the boxes of a window into the grid, each by its middle."""
    mask = now.head.shape[0] - 1
    for bucket in range(mask + 1):
        now.head[bucket, 0] = -1
    for robot in range(is_here.shape[0]):
        is_here[robot, 0] = laws.is_timed[robot] and now.square[robot, 0] == 0
        if is_here[robot, 0]:
            x = math.floor(0.5 * (now.box[robot, 0] + now.box[robot, 2]) / side)
            y = math.floor(0.5 * (now.box[robot, 1] + now.box[robot, 3]) / side)
            now.square[robot, 0], now.square[robot, 1] = x, y
            bucket = bucket_of(x, y, mask)
            now.following[robot, 0] = now.head[bucket, 0]
            now.head[bucket, 0] = robot
    for robot in range(is_here.shape[0]):
        if not is_here[robot, 0]:
            now.following[robot, 0] = -1


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
