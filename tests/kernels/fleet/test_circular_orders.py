"""Robots on straight lines that wait for each other in a circle; graphlib and scipy are oracles."""

from graphlib import CycleError, TopologicalSorter
from itertools import pairwise
from typing import TypeAlias

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from straight_fleets import (
    REACH,
    Line,
    courses_on,
    crossings_on,
    lines_without_rests_in_the_way,
    no_laws,
    rides_on,
)

from viaspline.kernels.arrays import Flags
from viaspline.kernels.fleet.circular_orders import box_waits, in_circles
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.rides_in_order import rides_in_order

Pair: TypeAlias = tuple[int, int]
TRIANGLE: list[Line] = [
    ((-20.0, 0.0), (40.0, 0.0)), ((25.0, -10.0), (-5.0, 35.0)), ((15.0, 35.0), (-5.0, -20.0))
]  # fmt: skip
"""Each comes to the next one's line first, and then to that of the one before."""


def passes_second(crossings: PackedCrossings, first: list[int]) -> Flags:
    """Of every box whether its robot isn't the one that passes its crossing first."""
    robot = np.repeat(np.arange(crossings.box_first.size - 1), np.diff(crossings.box_first))
    return np.array(robot != np.array(first)[crossings.crossing], np.bool_)


def waits_of(courses: PackedCourses, crossings: PackedCrossings, second: Flags) -> list[Pair]:
    """Pairs of nodes of which the one has to be reached before the other."""
    pairs = []
    for r in range(courses.first.size - 1):
        pairs += [(k - 1, k) for k in range(courses.first[r] + 1, courses.first[r + 1])]
    for b in np.flatnonzero(second):
        nodes = slice(courses.first[crossings.other[b]], courses.first[crossings.other[b] + 1])
        reached = int((courses.distance[nodes][:-1] <= crossings.high[b]).sum()) - 1
        pairs.append((nodes.start + max(reached, 0), int(crossings.cell[b])))
    return [(int(one), int(other)) for one, other in pairs]


def has_circle(pairs: list[Pair]) -> bool:
    """Whether nodes wait for each other in a circle."""
    before: dict[int, set[int]] = {}
    for one, other in pairs:
        before.setdefault(other, set()).add(one)
    try:
        TopologicalSorter(before).prepare()
    except CycleError:
        return True
    return False


def strongly_connected(pairs: list[Pair], count: int) -> Flags:
    """The nodes that are part of a circle, (count,)."""
    rows, columns = np.array(pairs).T
    graph = coo_matrix((np.ones(len(pairs)), (rows, columns)), shape=(count, count))
    _, label = connected_components(graph, connection="strong")
    alone = rows == columns
    return np.array((np.bincount(label) > 1)[label], np.bool_) | np.isin(
        np.arange(count), rows[alone]
    )


def keep_order(courses: PackedCourses, crossings: PackedCrossings, second: Flags) -> Flags:
    """Which robots have a law in the order that is asked."""
    order = np.arange(courses.first.size - 1)
    rides, laws = rides_on(courses), no_laws(courses)
    return rides_in_order(courses, crossings, rides, laws, second, order, 100)


def circles_of(courses: PackedCourses, crossings: PackedCrossings, second: Flags) -> Flags:
    """The nodes that are in circles, or between two."""
    return in_circles(courses, crossings, box_waits(courses, crossings), second)


def robots_of(courses: PackedCourses, nodes: Flags) -> list[bool]:
    """Whether each robot has one of some nodes."""
    return [bool(nodes[a:b].any()) for a, b in pairwise(courses.first.tolist())]


@pytest.mark.long_without_jit
@given(seed=st.integers(0, 10_000), count=st.integers(2, 7), turns=st.integers(0, 2**21))
@settings(max_examples=25, deadline=None)
def test_there_is_a_circle_just_where_nodes_cannot_be_sorted(
    seed: int, count: int, turns: int
) -> None:
    courses = courses_on(lines_without_rests_in_the_way(seed, count), REACH)
    crossings = crossings_on(courses)
    first = [int(pair[turns >> k & 1]) for k, pair in enumerate(crossings.robots)]
    second = passes_second(crossings, first)
    circles = circles_of(courses, crossings, second)
    pairs = waits_of(courses, crossings, second)
    assert circles.any() == has_circle(pairs)
    assert circles[strongly_connected(pairs, courses.distance.size)].all()
    if circles.any():
        assert not keep_order(courses, crossings, second)[robots_of(courses, circles)].any()


def test_three_that_each_wait_for_the_next_are_in_a_circle() -> None:
    courses = courses_on(TRIANGLE, REACH)
    crossings = crossings_on(courses)
    pairs = [tuple(pair) for pair in crossings.robots.tolist()]
    one_way = {(0, 1): 1, (0, 2): 0, (1, 2): 2}
    other_way = {(0, 1): 0, (0, 2): 2, (1, 2): 1}
    found = []
    for winners in (one_way, other_way):
        second = passes_second(crossings, [winners[pair] for pair in pairs])
        found.append(robots_of(courses, circles_of(courses, crossings, second)))
        assert keep_order(courses, crossings, second).tolist() == [not one for one in found[-1]]
    assert sorted(found) == [[False] * 3, [True] * 3]


def test_who_is_met_before_or_after_a_circle_is_not_in_it() -> None:
    lines = [*TRIANGLE, ((-15.0, -10.0), (-15.0, 10.0))]
    courses = courses_on(lines, REACH)
    crossings = crossings_on(courses)
    pairs = [tuple(pair) for pair in crossings.robots.tolist()]
    some = False
    for circle in ({(0, 1): 1, (0, 2): 0, (1, 2): 2}, {(0, 1): 0, (0, 2): 2, (1, 2): 1}):
        for leader in (0, 3):
            winners = {**circle, (0, 3): leader}
            second = passes_second(crossings, [winners[pair] for pair in pairs])
            circles = circles_of(courses, crossings, second)
            assert not robots_of(courses, circles)[3]
            some |= bool(circles.any())
    assert some
