"""When a robot must not be in a cell, because others that have their law pass nearby.

Tested through ``kernels/fleet/test_yielding_ride``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.jit import inner


@inner
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


@inner
def _since_node(courses: PackedCourses, laws: PackedLaws, k: int, place: float) -> float:
    """How long a robot takes from a node to a place in the cell that begins there [s]."""
    gone = place - courses.distance[k]
    width = courses.distance[k + 1] - courses.distance[k]
    here, there = laws.speed[k], laws.speed[k + 1]
    then = math.sqrt(here * here + (there * there - here * here) * min(gone / width, 1.0))
    return 2.0 * gone / (here + then) if here + then > 0.0 else 0.0


@inner
def comes_to(courses: PackedCourses, laws: PackedLaws, robot: int, place: float) -> float:
    """When a robot comes to a place [m] of its course [s]; at its start it has always been."""
    first, last = courses.first[robot], courses.first[robot + 1] - 1
    if place <= courses.distance[first]:
        return -np.inf
    k = node_before(courses.distance, first, last, place)
    if place <= courses.distance[k]:
        return laws.arrive[k]
    return laws.leave[k] + _since_node(courses, laws, k, place)


@inner
def goes_from(courses: PackedCourses, laws: PackedLaws, robot: int, place: float) -> float:
    """When a robot goes on from a place [m] of its course [s]; infinite where it stays."""
    first, last = courses.first[robot], courses.first[robot + 1] - 1
    if place >= courses.distance[last]:
        return laws.leave[last]
    k = node_before(courses.distance, first, last, place)
    if place <= courses.distance[k]:
        return laws.leave[k]
    if laws.speed[k] == 0.0 and laws.speed[k + 1] == 0.0:
        return laws.arrive[k + 1]
    return laws.leave[k] + _since_node(courses, laws, k, place)


@inner
def blocked_times(
    courses: PackedCourses, crossings: PackedCrossings, laws: PackedLaws, robot: int
) -> Floats:
    """From when to when each box of a robot is blocked by a robot that has its law [s], (boxes, 2).

    Where the other one has none, the box is never blocked: from infinity to minus infinity.
    """
    begin, end = crossings.box_first[robot], crossings.box_first[robot + 1]
    times = np.empty((end - begin, 2))
    for b in range(begin, end):
        other = crossings.other[b]
        if laws.is_timed[other]:
            times[b - begin, 0] = comes_to(courses, laws, other, crossings.low[b])
            times[b - begin, 1] = goes_from(courses, laws, other, crossings.high[b])
        else:
            times[b - begin, 0] = np.inf
            times[b - begin, 1] = -np.inf
    return times
