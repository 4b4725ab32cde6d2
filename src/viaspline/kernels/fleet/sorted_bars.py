"""The bars of a fleet in the order in which each robot comes to them.

Most of them lie in that order already, robot by robot: runs that are in order aren't merged.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints, Steps
from viaspline.kernels.jit import kernel, uncounted


@uncounted
def _comes_later(who: Ints, where: Floats, bar: int, other: int) -> bool:
    """Whether a robot comes to a bar after another one of its own."""
    if where[bar, 0] != where[other, 0]:
        return where[bar, 0] > where[other, 0]
    if who[bar, 2] != who[other, 2]:
        return who[bar, 2] > who[other, 2]
    return where[bar, 1] > where[other, 1]


@uncounted
def _merge(
    who: Ints, where: Floats, order: Ints, room: Ints, begin: int, middle: int, end: int
) -> None:
    """Merge two runs of bars that follow each other, each of which is in order."""
    one, two = begin, middle
    for at in range(begin, end):
        if two == end or (one < middle and not _comes_later(who, where, order[one], order[two])):
            room[at] = order[one]
            one += 1
        else:
            room[at] = order[two]
            two += 1
    for at in range(begin, end):
        order[at] = room[at]


@kernel
def sorted_bars(
    who: Ints, where: Floats, robots: int
) -> tuple[Ints, Steps, Steps, Floats, Floats]:  # fmt: skip
    """Bars by their robots, places, crossings, and by where the others have passed them.

    Args:
        who: Robot, other robot and crossing of each bar, (bars, 3).
        where: Its place, and where the other has passed it [m], (bars, 2).
        robots: How many there are.

    Returns:
        Where the bars of each robot begin (n + 1,); the other robot, the crossing, the place [m],
        and where the other has passed [m] of each, (bars,).
    """
    count = who.shape[0]
    first = np.zeros(robots + 1, np.int64)
    for bar in range(count):
        first[who[bar, 0] + 1] += 1
    for robot in range(robots):
        first[robot + 1] += first[robot]
    order, room, at = np.empty(count, np.int64), np.empty(count, np.int64), first.copy()
    for bar in range(count):
        robot = who[bar, 0]
        order[at[robot]] = bar
        at[robot] += 1
    for robot in range(robots):
        size, end = 1, first[robot + 1]
        while size < end - first[robot]:
            for begin in range(first[robot], end - size, 2 * size):
                middle = begin + size
                if _comes_later(who, where, order[middle - 1], order[middle]):
                    _merge(who, where, order, room, begin, middle, min(middle + size, end))
            size *= 2
    other, crossing = np.empty(count, np.int32), np.empty(count, np.int32)
    place, passed = np.empty(count), np.empty(count)
    for k in range(count):
        bar = order[k]
        other[k], crossing[k] = who[bar, 1], who[bar, 2]
        place[k], passed[k] = where[bar, 0], where[bar, 1]
    return first, other, crossing, place, passed
