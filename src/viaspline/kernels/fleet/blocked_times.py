"""When a robot must not be in a cell, because others that have their law pass nearby.

Most passages are over long before the other robot comes, or begin long after: that is told by two
nodes of its law. Box by box only the rest is looked at.

Tested through ``kernels/fleet/test_yielding_ride``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.jit import inlined, inner

ROUNDING_S = 1e-6
"""By so much more passages are taken to be blocked than nodes have it."""


@inlined
def node_before(distance: Floats, first: int, last: int, place: float) -> int:
    """The last node of a course at a place or before it, but not its last one."""
    low, high = first, last - 1
    while low < high:
        middle = (low + high + 1) // 2
        if distance[middle] <= place:
            low = middle
        else:
            high = middle - 1
    return low


@inlined
def _since_node(courses: PackedCourses, laws: PackedLaws, k: int, place: float) -> float:
    """How long a robot takes from a node to a place in the cell that begins there [s]."""
    gone = place - courses.distance[k]
    width = courses.distance[k + 1] - courses.distance[k]
    here, there = laws.speed[k], laws.speed[k + 1]
    then = math.sqrt(here * here + (there * there - here * here) * min(gone / width, 1.0))
    return 2.0 * gone / (here + then) if here + then > 0.0 else 0.0


@inlined
def node_near(distance: Floats, first: int, last: int, k: int, place: float) -> int:
    """As ``node_before``, sought from a node nearby on."""
    while k + 1 < last and distance[k + 1] <= place:
        k += 1
    while k > first and distance[k] > place:
        k -= 1
    return k


@inlined
def comes_in_cell(
    courses: PackedCourses, laws: PackedLaws, robot: int, k: int, place: float
) -> float:
    """As ``comes_to``, where the last node before a place is known."""
    if place <= courses.distance[courses.first[robot]]:
        return -np.inf
    if place <= courses.distance[k]:
        return laws.arrive[k]
    return laws.leave[k] + _since_node(courses, laws, k, place)


@inlined
def goes_in_cell(
    courses: PackedCourses, laws: PackedLaws, robot: int, k: int, place: float
) -> float:
    """As ``goes_from``, where the last node before a place is known."""
    last = courses.first[robot + 1] - 1
    if place >= courses.distance[last]:
        return laws.leave[last]
    if place <= courses.distance[k]:
        return laws.leave[k]
    if laws.speed[k] == 0.0 and laws.speed[k + 1] == 0.0:
        return laws.arrive[k + 1]
    return laws.leave[k] + _since_node(courses, laws, k, place)


@inner
def comes_to(courses: PackedCourses, laws: PackedLaws, robot: int, place: float) -> float:
    """When a robot comes to a place [m] of its course [s]; at its start it has always been."""
    first, last = courses.first[robot], courses.first[robot + 1] - 1
    k = node_before(courses.distance, first, last, place)
    return comes_in_cell(courses, laws, robot, k, place)


@inner
def goes_from(courses: PackedCourses, laws: PackedLaws, robot: int, place: float) -> float:
    """When a robot goes on from a place [m] of its course [s]; infinite where it stays."""
    first, last = courses.first[robot], courses.first[robot + 1] - 1
    k = node_before(courses.distance, first, last, place)
    return goes_in_cell(courses, laws, robot, k, place)


class Blocks(NamedTuple):
    """When the others are in the passages of one robot; all of it is written to.

    Attributes:
        begin: The first passage of the robot.
        since: When the other one may come to each of its passages at the earliest [s], (p,).
        until: When it has gone at the latest [s], (p,).
        is_known: Whether the times of a passage's boxes are reckoned, (p,).
        times: From when to when each box is blocked [s], passage by passage, (boxes, 2).
    """

    begin: int
    since: Floats
    until: Floats
    is_known: Flags
    times: Floats


@inner
def blocks_of(
    courses: PackedCourses, passages: PackedPassages, laws: PackedLaws, robot: int
) -> Blocks:
    """When the passages of a robot are blocked, at most; their boxes are left for later.

    Where the other robot has no law, a passage is never blocked: from infinity to minus infinity.
    """
    begin, end = passages.first[robot], passages.first[robot + 1]
    count = end - begin
    boxes = passages.box_first[end] - passages.box_first[begin]
    blocks = Blocks(
        begin, np.empty(count), np.empty(count), np.zeros(count, np.bool_), np.empty((boxes, 2))
    )
    for i in range(count):
        p = begin + i
        other = passages.other[p]
        blocks.since[i], blocks.until[i] = np.inf, -np.inf
        if laws.is_timed[other]:
            low, after = passages.low[p], passages.high[p] + 1
            comes = laws.arrive[low] if low > courses.first[other] else -np.inf
            is_last = after == courses.first[other + 1] - 1
            goes = laws.leave[after] if is_last else laws.arrive[after]
            blocks.since[i], blocks.until[i] = comes - ROUNDING_S, goes + ROUNDING_S
    return blocks


@inner
def know_passage(
    courses: PackedCourses, passages: PackedPassages, laws: PackedLaws, blocks: Blocks, i: int
) -> int:
    """Reckon the times of the boxes of passage i of a robot, once. Where these begin."""
    p = blocks.begin + i
    at = passages.box_first[p] - passages.box_first[blocks.begin]
    if not blocks.is_known[i]:
        blocks.is_known[i] = True
        other = passages.other[p]
        is_timed = laws.is_timed[other]
        first, last = courses.first[other], courses.first[other + 1] - 1
        low = high = passages.low[p]
        begin = passages.box_first[p]
        for k in range(passages.box_first[p + 1] - begin):
            blocks.times[at + k, 0], blocks.times[at + k, 1] = np.inf, -np.inf
            if is_timed:
                since, until = passages.interval[begin + k, 0], passages.interval[begin + k, 1]
                low = node_near(courses.distance, first, last, low, since)
                high = node_near(courses.distance, first, last, high, until)
                blocks.times[at + k, 0] = comes_in_cell(courses, laws, other, low, since)
                blocks.times[at + k, 1] = goes_in_cell(courses, laws, other, high, until)
    return at
