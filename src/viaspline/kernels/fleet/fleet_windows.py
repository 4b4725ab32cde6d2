"""Windows of time in which robots of a fleet are looked at: discs that hold their ways, in a grid.

A window has parts, so that pairs which are far apart all the while are seldom met, and others are
looked at for a short while each.

From one node of its course to another one a curve of length L is nowhere farther than L / 2 from
the middle between them, for the ways to both ends are no longer than L together.

Tested through ``fleet/test_fleet_certificate``.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.jit import inlined, inner

PARTS: Final = 8  # of a window
PART_REACHES = 2.0  # how far robots go in a part of the first window in the mean, in mean reaches
MOST_WINDOWS = 200_000
PRIME_X: Final = 73856093
PRIME_Y: Final = 19349663
GONE: Final = -1  # the node of a robot that isn't in the world


class FleetWindow(NamedTuple):
    """What robots do in a window of time.

    Attributes:
        times: When its parts begin, and the last one ends [s], (PARTS + 1, 1).
        node: The node at which each robot is as a part begins, or has been last, and as the last
            one ends; or GONE, (n, PARTS + 1).
        part: What holds its way in each part: x, y, radius [m], (n, 3 PARTS).
        disc: What holds its way in the whole window, alike, (n, 3).
    """

    times: Floats
    node: Ints
    part: Floats
    disc: Floats


class WindowGrid(NamedTuple):
    """The robots of one window by the squares in which the middles of their discs lie.

    Attributes:
        square: (n, 2).
        head: The last robot of a bucket, or -1, (buckets, 1); the buckets are a power of two.
        following: The one before it in its bucket, or -1, (n, 1).
    """

    square: Ints
    head: Ints
    following: Ints


@inlined
def disc_of(courses: PackedCourses, begin: int, end: int) -> tuple[float, float, float]:
    """What holds a course between two of its nodes: x, y, radius [m]."""
    place = courses.place
    return (
        0.5 * (place[begin, 0] + place[end, 0]), 0.5 * (place[begin, 1] + place[end, 1]),
        0.5 * (courses.distance[end] - courses.distance[begin]),
    )  # fmt: skip


@inlined
def _put_disc(table: Floats, row: int, column: int, disc: tuple[float, float, float]) -> None:
    table[row, column], table[row, column + 1], table[row, column + 2] = disc


@inner
def cover_window(courses: PackedCourses, laws: PackedLaws, now: FleetWindow) -> float:
    """Move all robots on into a window that begins where the one before ended, and cover its ways.

    Args:
        courses: PackedCourses.
        laws: PackedLaws.
        now: Its times, and nodes at its beginning or before; filled.

    Returns:
        How wide the widest disc of a whole window is, grown by its robot's reach [m].
    """
    widest, node, times = 0.0, now.node, now.times
    for robot in range(courses.reach.shape[0]):
        at, last = node[robot, PARTS], courses.first[robot + 1] - 1
        begin, until = at, at
        for part in range(PARTS + 1):
            instant = times[part, 0]
            while at != GONE and at < last and laws.arrive[at + 1] <= instant:
                at += 1
            if at == last and laws.leave[last] < instant:
                at = GONE  # from now on
            node[robot, part] = at
            if part == 0:
                begin, until = at, at
            elif node[robot, part - 1] != GONE:
                until = last
                if at != GONE:
                    until = at if at == last or laws.leave[at] >= instant else at + 1
                disc = disc_of(courses, node[robot, part - 1], until)
                _put_disc(now.part, robot, 3 * (part - 1), disc)
        if begin != GONE:
            disc = disc_of(courses, begin, until)
            _put_disc(now.disc, robot, 0, disc)
            widest = max(widest, 2.0 * (disc[2] + courses.reach[robot]))
    return widest


@inlined
def bucket_of(x: int, y: int, mask: int) -> int:
    """The bucket of a square of the grid."""
    return ((x * PRIME_X) ^ (y * PRIME_Y)) & mask


@inner
def file_window(now: FleetWindow, side: float, grid: WindowGrid) -> None:
    """Put the discs of a window into the grid, each by its middle.

    Args:
        now: The window.
        side: Of the squares [m].
        grid: Filled; empty, or as a window before left it.
    """
    mask = grid.head.shape[0] - 1
    for robot in range(grid.following.shape[0]):  # those of the window before
        grid.head[bucket_of(grid.square[robot, 0], grid.square[robot, 1], mask), 0] = -1
    for robot in range(grid.following.shape[0]):
        if now.node[robot, 0] == GONE:
            continue
        x, y = math.floor(now.disc[robot, 0] / side), math.floor(now.disc[robot, 1] / side)
        grid.square[robot, 0], grid.square[robot, 1] = x, y
        bucket = bucket_of(x, y, mask)
        grid.following[robot, 0] = grid.head[bucket, 0]
        grid.head[bucket, 0] = robot


@inner
def window_times(courses: PackedCourses, laws: PackedLaws) -> tuple[float, float, float]:
    """When the first robot departs, when the last one arrives, and for how long a part lasts."""
    begin, end, speed, reach = np.inf, -np.inf, 0.0, 0.0
    for robot in range(courses.reach.shape[0]):
        if laws.is_timed[robot]:
            first, last = courses.first[robot], courses.first[robot + 1] - 1
            reach += courses.reach[robot]
            begin = min(begin, laws.leave[first])
            while last > first and laws.arrive[last] == np.inf:
                last -= 1  # it stands for ever before that
            if laws.arrive[last] < np.inf:
                end = max(end, laws.arrive[last])
                drives = laws.arrive[last] - laws.leave[first]
                if drives > 0.0:
                    speed += courses.distance[last] / drives
    if not begin <= end:
        return 0.0, 0.0, 0.0
    lasts = end - begin
    if speed > 0.0 and reach > 0.0:
        lasts = min(lasts, PART_REACHES * reach / speed)
    return begin, end, lasts
