"""Robots on straight lines whose orders are settled as they meet; looked at instant by instant."""

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

from viaspline.kernels.fleet.first_come_laws import first_come_laws
from viaspline.kernels.fleet.foreseen_waits import SeenAhead
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.yielding_ride import timed_in_order

ACROSS: list[Line] = [((0.0, 0.0), (40.0, 0.0)), ((20.0, -20.0), (20.0, 20.0))]
HEAD_ON: list[Line] = [((0.0, 0.0), (40.0, 0.0)), ((40.0, 0.0), (0.0, 0.0))]


def sight_of(robots: int, share: float = 0.0) -> SeenAhead:
    """What lies ahead counts so much, and then some of it is left to chance."""
    return SeenAhead(share, 1.5 * share, np.zeros(robots), np.array([1], np.int64))


def timed(
    lines: list[Line],
    weight: list[float] | None = None,
    depart: float | list[float] = 0.0,
    settled: tuple[int, ...] = (),
    foreseen: float = 0.0,
) -> tuple[PackedCourses, PackedRides, PackedLaws]:
    """The laws of robots on lines, some of which have theirs before the others."""
    courses = courses_on(lines, REACH)
    rides, laws = rides_on(courses, depart=depart), no_laws(courses)
    crossings = crossings_on(courses)
    passages = passages_of(courses, crossings)
    timed_in_order(courses, crossings, passages, rides, laws, np.array(settled, np.int64))
    movable = ~laws.is_timed
    weights = np.ones(len(lines)) if weight is None else np.array(weight)
    sight = sight_of(len(lines), foreseen)
    first_come_laws(courses, crossings, passages, rides, laws, weights, movable, sight)
    return courses, rides, laws


def arrivals(courses: PackedCourses, laws: PackedLaws) -> list[float]:
    found: list[float] = laws.arrive[courses.first[1:] - 1].tolist()
    return found


@pytest.mark.long_without_jit
@given(seed=st.integers(0, 10_000), count=st.integers(1, 9), foreseen=st.sampled_from([0.0, 0.2]))
@settings(max_examples=40, deadline=None)
@example(seed=3, count=9, foreseen=0.0)
@example(seed=3, count=9, foreseen=0.2)
def test_robots_with_a_law_stay_apart_and_are_nearly_always_all(
    seed: int, count: int, foreseen: float
) -> None:
    courses, _, laws = timed(lines_without_rests_in_the_way(seed, count), foreseen=foreseen)
    assert nearest_two(courses, laws) >= 2.0 * REACH
    assert laws.is_timed.sum() >= laws.is_timed.size - 1


@pytest.mark.long_without_jit
@given(seed=st.integers(0, 10_000))
@settings(max_examples=25, deadline=None)
def test_laws_keep_speeds_and_accelerations_and_are_never_earlier_than_alone(seed: int) -> None:
    courses, rides, laws = timed(lines_without_rests_in_the_way(seed, 9))
    for r in np.flatnonzero(laws.is_timed):
        nodes = slice(courses.first[r], courses.first[r + 1])
        lasts = laws.arrive[nodes][1:] - laws.leave[nodes][:-1]
        rise = np.diff(laws.speed[nodes] ** 2) / (2.0 * np.diff(courses.distance[nodes]))
        assert (laws.leave[nodes] >= laws.arrive[nodes]).all()
        assert (np.abs(rise) <= 1.0 + 1e-9).all()
        assert (lasts >= rides.lasts[nodes][:-1] - 1e-12).all()


def test_who_would_be_held_up_longer_passes_first() -> None:
    for late, first in ((0.6, 0), (-0.6, 1)):
        courses, _, laws = timed(ACROSS, depart=[1.0, 1.0 + late])
        took = np.array(arrivals(courses, laws)) - [1.0, 1.0 + late]
        assert took[first] == pytest.approx(22.0)
        assert 0.5 < took[1 - first] - 22.0 < 2.5


def test_who_counts_more_passes_first_even_if_it_comes_later() -> None:
    courses, _, laws = timed(ACROSS, weight=[1.0, 2.0], depart=[0.0, 0.5])
    one, other = arrivals(courses, laws)
    assert other == pytest.approx(22.5)
    assert one > 22.0 + 2.0


def test_a_law_that_is_given_is_kept_to_the_bit() -> None:
    alone = courses_on(ACROSS, REACH)
    courses, rides, laws = timed(ACROSS, weight=[1.0, 9.0], settled=(0,))
    nodes = slice(0, alone.first[1])
    assert (laws.speed[nodes] == np.sqrt(rides.square[nodes])).all()
    assert arrivals(courses, laws)[1] > 22.5


def test_of_two_that_meet_head_on_the_one_that_counts_less_gets_no_law() -> None:
    for heavy in (0, 1):
        courses, _, laws = timed(HEAD_ON, weight=[1.0 + (k == heavy) for k in (0, 1)])
        assert laws.is_timed.tolist() == [k == heavy for k in (0, 1)]
        assert arrivals(courses, laws)[heavy] == pytest.approx(22.0)


def test_who_would_have_to_pass_one_that_stands_for_ever_gets_no_law() -> None:
    for stands in (0, 1):
        courses = courses_on(HEAD_ON, REACH)
        rides, laws, crossings = rides_on(courses), no_laws(courses), crossings_on(courses)
        laws.arrive[:], laws.leave[:] = np.inf, np.inf
        laws.arrive[courses.first[stands]] = -np.inf
        laws.is_timed[stands] = True
        movable = ~laws.is_timed
        passages = passages_of(courses, crossings)
        first_come_laws(courses, crossings, passages, rides, laws, np.ones(2), movable, sight_of(2))
        assert laws.is_timed.tolist() == [k == stands for k in (0, 1)]


@pytest.mark.long_without_jit
def test_fleets_are_less_late_than_if_one_is_timed_after_the_other() -> None:
    both = np.zeros(2)
    for seed in range(20):
        lines = lines_without_rests_in_the_way(seed, 9)
        courses, rides, laws = timed(lines)
        by_turns, crossings = no_laws(courses), crossings_on(courses)
        passages = passages_of(courses, crossings)
        timed_in_order(courses, crossings, passages, rides, by_turns, np.arange(len(lines)))
        if laws.is_timed.all() and by_turns.is_timed.all():
            both += [sum(arrivals(courses, one)) for one in (laws, by_turns)]
    assert both[0] < both[1] - 1.0
