"""Robots on straight lines let each other pass; what they do is looked at instant by instant."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from straight_fleets import (
    REACH,
    Line,
    courses_on,
    crossings_on,
    lines_without_rests_in_the_way,
    nearest_two,
    no_laws,
    rides_on,
)

from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.yielding_ride import timed_in_order


def timed(
    lines: list[Line], depart: float | list[float] = 0.0
) -> tuple[PackedCourses, PackedRides, PackedLaws, list[int]]:
    courses = courses_on(lines, REACH)
    rides, laws = rides_on(courses, depart=depart), no_laws(courses)
    crossings = crossings_on(courses)
    passages = passages_of(courses, crossings)
    found = timed_in_order(courses, crossings, passages, rides, laws, np.arange(len(lines)))
    return courses, rides, laws, found.tolist()


@pytest.mark.long_without_jit
@given(seed=st.integers(0, 10_000), count=st.integers(1, 9))
@settings(max_examples=40, deadline=None)
@example(seed=3, count=9)
@example(seed=1, count=9)
@example(seed=14, count=9)
def test_where_no_path_passes_a_rest_all_are_served_and_stay_apart(seed: int, count: int) -> None:
    courses, _, laws, found = timed(lines_without_rests_in_the_way(seed, count))
    assert found == [-1] * len(found)
    assert nearest_two(courses, laws) >= 2.0 * REACH


@pytest.mark.long_without_jit
@given(seed=st.integers(0, 10_000))
@settings(max_examples=25, deadline=None)
def test_laws_keep_speeds_and_accelerations_and_are_never_earlier_than_alone(seed: int) -> None:
    courses, rides, laws, _ = timed(lines_without_rests_in_the_way(seed, 9))
    for r in range(courses.reach.size):
        nodes = slice(courses.first[r], courses.first[r + 1])
        lasts = laws.arrive[nodes][1:] - laws.leave[nodes][:-1]
        rise = np.diff(laws.speed[nodes] ** 2) / (2.0 * np.diff(courses.distance[nodes]))
        assert (laws.leave[nodes] >= laws.arrive[nodes]).all()
        assert (laws.speed[nodes] <= np.sqrt(rides.square[nodes]) + 1e-12).all()
        assert (np.abs(rise) <= 1.0 + 1e-9).all()
        assert (lasts >= rides.lasts[nodes][:-1] - 1e-12).all()


def test_who_is_alone_drives_as_if_alone() -> None:
    courses, rides, laws, _ = timed([((0.0, 0.0), (30.0, 0.0)), ((0.0, 9.0), (30.0, 9.0))])
    assert laws.arrive[courses.first[1] - 1] == pytest.approx(17.0)
    assert (laws.speed == np.sqrt(rides.square)).all()


def test_the_second_comes_to_a_crossing_with_a_running_start() -> None:
    courses, _, laws, _ = timed([((0.0, 0.0), (40.0, 0.0)), ((20.0, -20.0), (20.0, 20.0))])
    second = slice(courses.first[1], courses.first[2])
    late = laws.arrive[second][-1] - 22.0
    assert 1.0 < late < 3.0  # four metres to be left by the first one at 2 m/s, and a cell or two
    entry = np.flatnonzero(courses.distance[second] >= 17.5)[0]
    assert laws.speed[second][entry] == pytest.approx(2.0)


def test_who_begins_where_another_passes_can_not_let_it_pass() -> None:
    *_, found = timed([((0.0, 0.0), (40.0, 0.0)), ((20.0, 0.5), (20.0, 20.0))], [0.0, 30.0])
    assert found[0] == -1
    assert found[1] >= 0


def test_two_that_meet_head_on_can_not_both_be_served() -> None:
    *_, found = timed([((0.0, 0.0), (40.0, 0.0)), ((40.0, 0.0), (0.0, 0.0))])
    assert found[0] == -1
    assert found[1] >= 0


def test_one_behind_another_stays_behind_without_stopping() -> None:
    courses, _, laws, found = timed([((5.0, 0.0), (60.0, 0.0)), ((0.0, 0.0), (50.0, 0.0))])
    assert found == [-1, -1]
    assert nearest_two(courses, laws) >= 2.0 * REACH
    assert laws.arrive[-1] < 27.0 + 3.0


def test_who_is_under_way_and_can_no_more_slow_down_has_no_law() -> None:
    lines: list[Line] = [((0.0, 0.0), (30.0, 0.0)), ((6.0, -6.0), (6.0, 24.0))]
    courses = courses_on(lines, REACH)
    crossings = crossings_on(courses)
    alone, laws = rides_on(courses), no_laws(courses)
    square = alone.square.copy()
    nodes = slice(int(courses.first[1]), int(courses.first[2]))
    square[nodes] = np.maximum(square[nodes], 25.0)  # 5 m/s, all the way
    rides = alone._replace(square=square)
    found = timed_in_order(
        courses, crossings, passages_of(courses, crossings), rides, laws, np.arange(2)
    )
    begins = laws.arrive[nodes][0]
    assert found[0] == -1
    assert found[1] >= 0
    assert begins == 0.0
    assert not laws.is_timed[1]
