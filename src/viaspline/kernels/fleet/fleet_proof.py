"""The least distance of any two robots of a fleet, proven over continuous time.

Time is cut into windows. In each, what holds the way of every robot is put into a grid, and pairs
that are near there are followed from stage to stage. Within a stage of either, both go along chords
with constant acceleration. So the difference p of their places bows out from the straight line
between two instants h apart by h²/8 |p''|, and that line's distance from 0 is exact. What may be
least is halved.

Tested through ``fleet/test_fleet_certificate``.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.fleet_motion import (
    stage_acceleration,
    stage_end,
    stage_error,
    stage_place,
)
from viaspline.kernels.fleet.fleet_windows import (
    WindowGrid,
    Windows,
    bucket_of,
    cover_windows,
    file_window,
    window_times,
)
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.growable import new_floats, new_ints
from viaspline.kernels.jit import inlined, inner, kernel

LOWER: Final = 0  # proven: nowhere is anything less [m]
UPPER: Final = 1  # the least that was met [m]
WHEN: Final = 2  # when that was [s]
FIRST_X: Final = 3  # where the two were [m]
FIRST_Y: Final = 4
SECOND_X: Final = 5
SECOND_Y: Final = 6
BEST_COLUMNS: Final = 7

HALF_SLACK = 5e-7  # half of PROOF_SLACK_M [m]
GROWTH = 4.0  # of the distance that is looked at, while nothing is found
DEEPEST = 40
BUCKETS_EACH = 8
"""So many buckets there are for each robot: most of those that are looked into are empty."""
AT_ONCE = 16
"""So many windows are covered at once: what is known of a robot lies together in memory."""


@inlined
def _least(x0: float, y0: float, x1: float, y1: float) -> float:
    """The distance of a segment from the origin."""
    dx, dy = x1 - x0, y1 - y0
    squared = dx * dx + dy * dy
    part = 0.0
    if squared > 0.0:
        part = min(max(-(x0 * dx + y0 * dy) / squared, 0.0), 1.0)
    x, y = x0 + part * dx, y0 + part * dy
    return math.sqrt(x * x + y * y)


@inlined
def _is_settled(lower: float, best: Floats, tolerance: float) -> bool:
    """Whether a bound needs no halving: near the least, on the same side of what is required."""
    least = best[0, UPPER]
    if lower >= least:
        return True
    return lower >= least - tolerance and (lower >= -HALF_SLACK or least < -2.0 * HALF_SLACK)


@inlined
def _meet(best: Floats, pair: Ints, value: float, when: float, at: Floats, i: int, j: int) -> None:
    """Note a distance if it is the least so far; ``at`` has the places of both."""
    if value < best[0, UPPER]:
        best[0, UPPER], best[0, WHEN] = value, when
        for column in range(4):
            best[0, FIRST_X + column] = at[0, column]
        pair[0, 0], pair[0, 1] = i, j


@inner
def _halve(
    courses: PackedCourses, laws: PackedLaws, i: int, j: int, stage_i: int, stage_j: int,
    begin: float, end: float, off: float, tolerance: float, stack: Floats, at: Floats,
    best: Floats, pair: Ints,
) -> None:  # fmt: skip
    """The least distance between two instants in which either robot has one stage.

    Args:
        courses: PackedCourses.
        laws: PackedLaws.
        i: A robot.
        j: Another one.
        stage_i: Its stage.
        stage_j: That of the other one.
        begin: The earlier instant [s].
        end: The later one [s].
        off: What is taken off the distance of the chords' points [m].
        tolerance: How near the least has to be known [m].
        stack: Room for halves, (DEEPEST + 2, 7).
        at: Room for the places of both, (1, 4).
        best: What is known so far, (1, BEST_COLUMNS).
        pair: Whose that is, (1, 2).
    """
    ax, ay = stage_acceleration(courses, laws, stage_i)
    bx, by = stage_acceleration(courses, laws, stage_j)
    bend = 0.125 * math.sqrt((ax - bx) ** 2 + (ay - by) ** 2)
    stack[0, 0], stack[0, 1], stack[0, 6] = begin, end, 0.0
    for side in range(2):
        instant = stack[0, side]
        at[0, 0], at[0, 1] = stage_place(courses, laws, stage_i, instant)
        at[0, 2], at[0, 3] = stage_place(courses, laws, stage_j, instant)
        x, y = at[0, 0] - at[0, 2], at[0, 1] - at[0, 3]
        stack[0, 2 + 2 * side], stack[0, 3 + 2 * side] = x, y
        _meet(best, pair, math.sqrt(x * x + y * y) - off, instant, at, i, j)
    top = 0
    while top >= 0:
        t0, t1, depth = stack[top, 0], stack[top, 1], stack[top, 6]
        x0, y0, x1, y1 = stack[top, 2], stack[top, 3], stack[top, 4], stack[top, 5]
        top -= 1
        lower = _least(x0, y0, x1, y1) - bend * (t1 - t0) ** 2 - off
        middle = 0.5 * (t0 + t1)
        is_done = depth >= DEEPEST or not t0 < middle < t1
        if is_done or _is_settled(lower, best, tolerance):
            best[0, LOWER] = min(best[0, LOWER], lower)
            continue
        at[0, 0], at[0, 1] = stage_place(courses, laws, stage_i, middle)
        at[0, 2], at[0, 3] = stage_place(courses, laws, stage_j, middle)
        x, y = at[0, 0] - at[0, 2], at[0, 1] - at[0, 3]
        _meet(best, pair, math.sqrt(x * x + y * y) - off, middle, at, i, j)
        for half in range(2):
            top += 1
            stack[top, 0], stack[top, 1] = (middle, t1) if half == 0 else (t0, middle)
            stack[top, 2], stack[top, 3] = (x, y) if half == 0 else (x0, y0)
            stack[top, 4], stack[top, 5] = (x1, y1) if half == 0 else (x, y)
            stack[top, 6] = depth + 1.0


@inner
def _follow(
    courses: PackedCourses, laws: PackedLaws, i: int, j: int, stage_i: int, stage_j: int,
    begin: float, end: float, tolerance: float, stack: Floats, at: Floats, best: Floats,
    pair: Ints,
) -> None:  # fmt: skip
    """The least distance of two robots in a window, from stage to stage; see ``_halve``."""
    last_i, last_j = 2 * (courses.first[i + 1] - 1), 2 * (courses.first[j + 1] - 1)
    reach = courses.reach[i] + courses.reach[j]
    t = begin
    while True:
        until = min(end, min(stage_end(laws, stage_i), stage_end(laws, stage_j)))
        until = max(until, t)
        off = reach + stage_error(courses, laws, stage_i) + stage_error(courses, laws, stage_j)
        x0, y0 = stage_place(courses, laws, stage_i, t)
        x1, y1 = stage_place(courses, laws, stage_i, until)
        x2, y2 = stage_place(courses, laws, stage_j, t)
        x3, y3 = stage_place(courses, laws, stage_j, until)
        ax, ay = stage_acceleration(courses, laws, stage_i)
        bx, by = stage_acceleration(courses, laws, stage_j)
        bend = 0.125 * (until - t) ** 2 * math.sqrt((ax - bx) ** 2 + (ay - by) ** 2)
        lower = _least(x0 - x2, y0 - y2, x1 - x3, y1 - y3) - bend - off
        if _is_settled(lower, best, tolerance):
            best[0, LOWER] = min(best[0, LOWER], lower)
        else:
            _halve(
                courses, laws, i, j, stage_i, stage_j, t, until, off, tolerance, stack, at, best,
                pair,
            )  # fmt: skip
        t = until
        is_last_i, is_last_j = stage_i == last_i, stage_j == last_j
        if t >= end or (is_last_i and is_last_j):
            return
        if is_last_i and stage_end(laws, stage_i) <= t:
            return  # it leaves
        if is_last_j and stage_end(laws, stage_j) <= t:
            return
        if not is_last_i and stage_end(laws, stage_i) <= t:
            stage_i += 1
        if not is_last_j and stage_end(laws, stage_j) <= t:
            stage_j += 1


@inner
def _look(
    courses: PackedCourses, laws: PackedLaws, begin: float, end: float, tolerance: float,
    now: Windows, first: int, grid: WindowGrid, stack: Floats, at: Floats, best: Floats, pair: Ints,
) -> None:  # fmt: skip
    """Follow all pairs of robots whose boxes overlap in a window; see ``file_window``."""
    mask, box = grid.head.shape[0] - 1, now.box
    for i in range(grid.following.shape[0]):
        if now.stage[first + i, 0] < 0:
            continue
        low_x, low_y = box[first + i, 0], box[first + i, 1]
        high_x, high_y = box[first + i, 2], box[first + i, 3]
        for beside in range(9):
            x, y = grid.square[i, 0] + beside // 3 - 1, grid.square[i, 1] + beside % 3 - 1
            j = grid.head[bucket_of(x, y, mask), 0]
            while j > i:  # a bucket has its robots from the last one on
                is_near = grid.square[j, 0] == x and grid.square[j, 1] == y
                is_near = is_near and box[first + j, 0] <= high_x and box[first + j, 2] >= low_x
                if is_near and box[first + j, 1] <= high_y and box[first + j, 3] >= low_y:
                    _follow(
                        courses, laws, i, j, now.stage[first + i, 0], now.stage[first + j, 0],
                        begin, end, tolerance, stack, at, best, pair,
                    )  # fmt: skip
                j = grid.following[j, 0]


@kernel
def fleet_tightest(
    courses: PackedCourses, laws: PackedLaws, tolerance: float
) -> tuple[float, float, float, float, float, float, int, int]:
    """The least distance between any two robots beyond both of their reaches.

    Args:
        courses: PackedCourses.
        laws: PackedLaws.
        tolerance: How near the least has to be known [m]; nearer where it takes that to tell
            whether it is below 0.

    Returns:
        (proven lower bound [m], when the least was met [s], x and y of the one [m], and of the
        other, their numbers); infinite, with the numbers -1, where there are no two.
    """
    robots, count = courses.reach.shape[0], 0
    for robot in range(robots):
        count += 1 if laws.is_timed[robot] else 0
    best, pair = new_floats(1, BEST_COLUMNS), new_ints(1, 2)
    for column in range(BEST_COLUMNS):
        best[0, column] = 0.0
    pair[0, 0], pair[0, 1] = -1, -1
    buckets = 16
    while buckets < BUCKETS_EACH * robots:
        buckets *= 2
    grid = WindowGrid(new_ints(robots, 2), new_ints(buckets, 1), new_ints(robots, 1))
    for robot in range(robots):
        grid.square[robot, 0], grid.square[robot, 1] = 0, 0
    for bucket in range(buckets):
        grid.head[bucket, 0] = -1
    rows = AT_ONCE * robots
    now = Windows(
        new_ints(robots, 1), new_ints(rows, 1), new_floats(rows, 4), new_floats(rows, 2),
        new_floats(AT_ONCE, 1),
    )  # fmt: skip
    times, stack, at = new_floats(AT_ONCE + 1, 1), new_floats(DEEPEST + 2, 7), new_floats(1, 4)
    begin, end, lasts = window_times(courses, laws)
    within = 0.25 * max(lasts, 1.0)
    for robot in range(robots):
        if laws.is_timed[robot]:
            within = max(within, 0.5 * courses.reach[robot])
    best[0, UPPER] = np.inf
    while count > 1 and pair[0, 0] < 0:
        best[0, LOWER], best[0, UPPER] = within, within
        for robot in range(robots):
            now.reached[robot, 0] = 2 * courses.first[robot]
        windows = 1 if not end > begin else math.ceil((end - begin) / lasts)
        for window in range(0, windows, AT_ONCE):
            some = min(AT_ONCE, windows - window)
            for k in range(some + 1):
                times[k, 0] = min(begin + (window + k) * lasts, max(begin, end))
            least = max(best[0, UPPER], 0.0)  # what is farther apart needn't be looked at any more
            less = 0.5 * (within - least)
            cover_windows(courses, laws, times, some, 0.5 * within, less, now)
            for k in range(some):
                file_window(now, k * robots, max(now.widest[k, 0], 1e-9), grid)
                _look(
                    courses, laws, times[k, 0], times[k + 1, 0], tolerance, now, k * robots, grid,
                    stack, at, best, pair,
                )  # fmt: skip
        within *= GROWTH
    return (
        min(best[0, LOWER], best[0, UPPER]), best[0, WHEN], best[0, FIRST_X], best[0, FIRST_Y],
        best[0, SECOND_X], best[0, SECOND_Y], pair[0, 0], pair[0, 1],
    )  # fmt: skip
