"""Orders on straight lines turned round: sooner, still apart, and whole at any moment."""

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
from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.turned_orders import turned_orders
from viaspline.kernels.fleet.yielding_ride import timed_in_order


def copied(laws: PackedLaws) -> PackedLaws:
    return PackedLaws(*(one.copy() for one in laws))


def before_and_after(
    lines: list[Line], work: int, fixed: tuple[int, ...] = ()
) -> tuple[PackedCourses, PackedLaws, PackedLaws]:
    """Laws of robots timed one after the other, and what comes of turning orders round."""
    courses = courses_on(lines, REACH)
    rides, laws = rides_on(courses), no_laws(courses)
    crossings = crossings_on(courses)
    passages = passages_of(courses, crossings)
    timed_in_order(courses, crossings, passages, rides, laws, np.arange(len(lines)))
    alone = np.add.reduceat(rides.lasts, courses.first[:-1])
    movable = laws.is_timed.copy()
    movable[list(fixed)] = False
    better = copied(laws)
    turned_orders(
        courses, crossings, passages, rides, better, alone, np.ones(len(lines)), movable, work,
        np.array([1]),
    )  # fmt: skip
    return courses, laws, better


def total(courses: PackedCourses, laws: PackedLaws) -> float:
    return float(laws.arrive[courses.first[1:] - 1][laws.is_timed].sum())


@pytest.mark.slow
@pytest.mark.long_without_jit
@given(seed=st.integers(0, 10_000))
@settings(max_examples=12, deadline=None)
@example(seed=14)
def test_laws_get_no_later_and_stay_apart(seed: int) -> None:
    courses, laws, better = before_and_after(lines_without_rests_in_the_way(seed, 9), 200_000)
    assert total(courses, better) <= total(courses, laws) + 1e-9
    assert (better.is_timed == laws.is_timed).all()
    assert nearest_two(courses, better) >= 2.0 * REACH


@pytest.mark.long_without_jit
def test_one_that_waits_for_many_is_let_pass_by_them() -> None:
    streets: list[Line] = [((6.0 * k, 4.0 - 10.0 * k), (6.0 * k, 60.0)) for k in range(1, 7)]
    across: list[Line] = [((0.0, 0.0), (50.0, 0.0))]
    courses, laws, better = before_and_after(streets + across, 400_000)
    assert total(courses, better) < total(courses, laws) - 1.0


def test_those_that_are_fixed_keep_their_laws_to_the_bit() -> None:
    lines: list[Line] = [((0.0, 0.0), (40.0, 0.0)), ((20.0, -19.0), (20.0, 20.0))]
    courses, laws, better = before_and_after(lines, 50_000, fixed=(0,))
    nodes = slice(0, courses.first[1])
    assert laws.arrive[nodes].tobytes() == better.arrive[nodes].tobytes()


@pytest.mark.long_without_jit
def test_the_same_work_gives_the_same_bytes() -> None:
    lines = lines_without_rests_in_the_way(3, 9)
    _, _, one = before_and_after(lines, 100_000)
    _, _, other = before_and_after(lines, 100_000)
    assert one.arrive.tobytes() == other.arrive.tobytes()
