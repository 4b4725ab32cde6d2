"""Robots on straight lines that can't arrive in the order that is asked; graphlib is the oracle."""

import sys
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

sys.path.insert(0, str(Path(__file__).parent))
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
from viaspline.kernels.fleet.circular_orders import never_arrive
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.rides_in_order import rides_in_order

TRIANGLE: list[Line] = [
    ((-20.0, 0.0), (40.0, 0.0)), ((25.0, -10.0), (-5.0, 35.0)), ((15.0, 35.0), (-5.0, -20.0))
]  # fmt: skip
"""Each comes to the next one's line first, and then to that of the one before."""


def passes_second(crossings: PackedCrossings, first: list[int]) -> Flags:
    """Of every box whether its robot isn't the one that passes its crossing first."""
    robot = np.repeat(np.arange(crossings.box_first.size - 1), np.diff(crossings.box_first))
    return np.array(robot != np.array(first)[crossings.crossing], np.bool_)


def has_circle(courses: PackedCourses, crossings: PackedCrossings, second: Flags) -> bool:
    """Whether nodes wait for each other in a circle."""
    before: dict[int, set[int]] = {}
    for r in range(courses.first.size - 1):
        for node in range(courses.first[r] + 1, courses.first[r + 1]):
            before.setdefault(node, set()).add(node - 1)
    for b in np.flatnonzero(second):
        nodes = slice(courses.first[crossings.other[b]], courses.first[crossings.other[b] + 1])
        reached = int((courses.distance[nodes][:-1] <= crossings.high[b]).sum()) - 1
        before.setdefault(int(crossings.cell[b]), set()).add(nodes.start + max(reached, 0))
    try:
        TopologicalSorter(before).prepare()
    except CycleError:
        return True
    return False


def keep_order(courses: PackedCourses, crossings: PackedCrossings, second: Flags) -> Flags:
    """Which robots have a law in the order that is asked."""
    order = np.arange(courses.first.size - 1)
    rides, laws = rides_on(courses), no_laws(courses)
    return rides_in_order(courses, crossings, rides, laws, second, order, 100)


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
    stuck = never_arrive(courses, crossings, second)
    assert stuck.any() == has_circle(courses, crossings, second)
    if stuck.any():
        assert not keep_order(courses, crossings, second)[stuck].any()


def test_three_that_each_wait_for_the_next_never_arrive() -> None:
    courses = courses_on(TRIANGLE, REACH)
    crossings = crossings_on(courses)
    pairs = [tuple(pair) for pair in crossings.robots.tolist()]
    one_way = {(0, 1): 1, (0, 2): 0, (1, 2): 2}
    other_way = {(0, 1): 0, (0, 2): 2, (1, 2): 1}
    found = []
    for winners in (one_way, other_way):
        second = passes_second(crossings, [winners[pair] for pair in pairs])
        found.append(never_arrive(courses, crossings, second).tolist())
        assert keep_order(courses, crossings, second).tolist() == [not one for one in found[-1]]
    assert sorted(found) == [[False] * 3, [True] * 3]


def test_who_waits_for_what_is_before_a_circle_arrives() -> None:
    lines = [*TRIANGLE, ((-15.0, -10.0), (-15.0, 10.0))]
    courses = courses_on(lines, REACH)
    crossings = crossings_on(courses)
    pairs = [tuple(pair) for pair in crossings.robots.tolist()]
    for circle in ({(0, 1): 1, (0, 2): 0, (1, 2): 2}, {(0, 1): 0, (0, 2): 2, (1, 2): 1}):
        second = passes_second(crossings, [{**circle, (0, 3): 0}[pair] for pair in pairs])
        stuck = never_arrive(courses, crossings, second)
        assert not stuck[3]
