"""The least distance of any two robots of a fleet, proven over continuous time.

Time is cut into windows. In each, discs that hold the ways of robots are put into a grid. Pairs
that are near there are followed in the parts of the window in which they are near.

Tested through ``fleet/test_fleet_certificate``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.fleet_windows import (
    GONE,
    MOST_WINDOWS,
    PARTS,
    FleetWindow,
    WindowGrid,
    bucket_of,
    cover_window,
    file_window,
    window_times,
)
from viaspline.kernels.fleet.followed_pair import (
    BEST_COLUMNS,
    DEEPEST,
    FIRST_X,
    FIRST_Y,
    LOWER,
    SECOND_X,
    SECOND_Y,
    UPPER,
    WHEN,
    PairSearch,
    follow_pair,
)
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.growable import new_floats, new_ints
from viaspline.kernels.jit import inlined, inner, kernel

GROWTH = 4.0  # of the distance that is looked at, while nothing is found
BUCKETS_EACH = 8
"""So many buckets there are for each robot: most of those that are looked into are empty."""
FEW_MET, MANY_MET = 0.5, 3.0
"""Windows are to be so long that each robot is near so many others in one."""
SHORTEST = 1e-12  # part of a window, in instants: what is shorter may be lost to rounding


@inner
def _look(
    courses: PackedCourses, laws: PackedLaws, tolerance: float, now: FleetWindow, grid: WindowGrid,
    search: PairSearch, best: Floats, pair: Ints,
) -> int:  # fmt: skip
    """Look at all pairs of robots whose discs are near in a window. How many those are."""
    mask, disc, met = grid.head.shape[0] - 1, now.disc, 0
    for i in range(grid.following.shape[0]):
        if now.node[i, 0] == GONE:
            continue
        for beside in range(9):
            x, y = grid.square[i, 0] + beside // 3 - 1, grid.square[i, 1] + beside % 3 - 1
            j = grid.head[bucket_of(x, y, mask), 0]
            while j > i:  # a bucket has its robots from the last one on
                near = courses.reach[i] + courses.reach[j] + max(best[0, UPPER], 0.0)
                far = disc[i, 2] + disc[j, 2] + near
                apart = (disc[i, 0] - disc[j, 0]) ** 2 + (disc[i, 1] - disc[j, 1]) ** 2
                if apart < far * far and grid.square[j, 0] == x and grid.square[j, 1] == y:
                    met += 1
                    _look_at(courses, laws, i, j, tolerance, now, near, search, best, pair)
                j = grid.following[j, 0]
    return met


@inlined
def _look_at(
    courses: PackedCourses, laws: PackedLaws, i: int, j: int, tolerance: float, now: FleetWindow,
    near: float, search: PairSearch, best: Floats, pair: Ints,
) -> None:  # fmt: skip
    """Follow two robots in the parts of a window in which their discs are nearer than that [m]."""
    node, disc = now.node, now.part
    for part in range(PARTS):
        k = 3 * part
        if node[i, part] == GONE or node[j, part] == GONE:
            break
        far = disc[i, k + 2] + disc[j, k + 2] + near
        apart = (disc[i, k] - disc[j, k]) ** 2 + (disc[i, k + 1] - disc[j, k + 1]) ** 2
        if apart < far * far:
            follow_pair(
                courses, laws, i, j, node[i, part], node[j, part], now.times[part, 0],
                now.times[part + 1, 0], tolerance, search, best, pair,
            )  # fmt: skip


@inner
def _search_all(
    courses: PackedCourses, laws: PackedLaws, begin: float, end: float, lasts: float,
    tolerance: float, now: FleetWindow, grid: WindowGrid, search: PairSearch, best: Floats,
    pair: Ints,
) -> None:  # fmt: skip
    """Look at all pairs of robots, window by window.

    Args:
        courses: PackedCourses.
        laws: PackedLaws.
        begin: From when on [s].
        end: Until when [s].
        lasts: For how long a part of the first window lasts [s].
        tolerance: How near the least has to be known [m].
        now: Where all robots are before the first window.
        grid: Empty, or as a search before left it.
        search: Room.
        best: What is known so far, (1, BEST_COLUMNS).
        pair: Whose that is, (1, 2).
    """
    least = max((end - begin) / MOST_WINDOWS, SHORTEST * (abs(begin) + abs(end)))
    while True:
        lasts = max(lasts, least)
        for part in range(PARTS + 1):
            now.times[part, 0] = min(begin + part * lasts, end)
        widest = cover_window(courses, laws, now)
        file_window(now, max(widest + max(best[0, UPPER], 0.0), 1e-9), grid)
        met = _look(courses, laws, tolerance, now, grid, search, best, pair)
        begin = now.times[PARTS, 0]
        if begin >= end:
            return
        if met > MANY_MET * courses.reach.shape[0]:
            lasts *= 0.5
        elif met < FEW_MET * courses.reach.shape[0]:
            lasts *= 2.0


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
    now = FleetWindow(
        new_floats(PARTS + 1, 1), new_ints(robots, PARTS + 1), new_floats(robots, 3 * PARTS),
        new_floats(robots, 3),
    )  # fmt: skip
    search = PairSearch(new_floats(DEEPEST + 2, 7), new_floats(1, 4))
    begin, end, lasts = window_times(courses, laws)
    within = 0.25 * max(lasts, 1.0)
    for robot in range(robots):
        if laws.is_timed[robot]:
            within = max(within, 0.5 * courses.reach[robot])
    best[0, UPPER] = np.inf
    while count > 1 and pair[0, 0] < 0:
        best[0, LOWER], best[0, UPPER] = within, within
        for robot in range(robots):
            now.node[robot, PARTS] = courses.first[robot] if laws.is_timed[robot] else GONE
        _search_all(courses, laws, begin, end, lasts, tolerance, now, grid, search, best, pair)
        within *= GROWTH
    return (
        min(best[0, LOWER], best[0, UPPER]), best[0, WHEN], best[0, FIRST_X], best[0, FIRST_Y],
        best[0, SECOND_X], best[0, SECOND_Y], pair[0, 0], pair[0, 1],
    )  # fmt: skip
