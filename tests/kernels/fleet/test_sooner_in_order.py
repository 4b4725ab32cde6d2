"""Robots on straight lines timed one after the other, while that is sooner than what there is."""

import numpy as np
import pytest
from straight_fleets import REACH, Line, courses_on, crossings_on, no_laws, rides_on

from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.sooner_in_order import sooner_in_order
from viaspline.kernels.fleet.yielding_ride import timed_in_order

ACROSS: list[Line] = [((0.0, 0.0), (40.0, 0.0)), ((20.0, -20.0), (20.0, 20.0))]
HEAD_ON: list[Line] = [((0.0, 0.0), (40.0, 0.0)), ((40.0, 0.0), (0.0, 0.0))]


def timed(lines: list[Line], room: float) -> tuple[bool, bool, float]:
    """Whether it is sooner, whether its laws are those of one after the other, and how late."""
    courses = courses_on(lines, REACH)
    rides, crossings = rides_on(courses), crossings_on(courses)
    passages = passages_of(courses, crossings)
    laws, other, order = no_laws(courses), no_laws(courses), np.arange(len(lines))
    timed_in_order(courses, crossings, passages, rides, other, order)
    weight = np.ones(len(lines))
    found = sooner_in_order(courses, crossings, passages, rides, laws, order, weight, room)
    late = other.arrive[courses.first[1:] - 1].sum() - rides.lasts.sum()
    return found, all(map(np.array_equal, laws, other)), float(late)


def test_laws_are_those_of_one_after_the_other_where_there_is_room_for_their_lateness() -> None:
    _, _, late = timed(ACROSS, np.inf)
    assert late > 1.0
    assert timed(ACROSS, late + 1e-6)[:2] == (True, True)
    assert not timed(ACROSS, late - 1e-6)[0]


@pytest.mark.parametrize("room", [1.0, np.inf])
def test_it_ends_with_a_robot_that_gets_no_law(room: float) -> None:
    assert not timed(HEAD_ON, room)[0]
