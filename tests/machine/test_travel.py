"""Which way a body went: against the places where it was."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.tracking.actuators import Actuators
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.kernels.tracking.drive_motion import ROW_HEADING, STATE, move
from viaspline.machine.travel import travel_of

INF = float("inf")


def model(actuators: Actuators) -> DriveModel:
    return DriveModel(
        actuators, INF, INF, 2.0, 1.5, 0.0, 0.1, 1.0, 0.6, 0.3, 1.0, 2.0, 0.05, 0.15, 0.0, 0.0
    )


def driven(actuators: Actuators) -> np.ndarray:
    """It stands, goes a turning way to the left and back, and stands again."""
    commands = np.array(
        [[0.2, 0.3, 0.6, 0.5], [1.5, -0.8, 0.4, 0.5], [3.0, -0.5, -0.6, -0.8], [4.0, 0, 0, 0]]
    )
    return move(model(actuators), np.zeros(STATE), 0.0, 0.01, commands, np.zeros((500, 2)))


def test_the_course_is_the_direction_from_place_to_place() -> None:
    actuators = Actuators(max_along=2.0, max_across=2.0)
    rows = driven(actuators)
    travel = travel_of(model(actuators), rows)
    steps = np.diff(rows[:, 1:3], axis=0)
    lengths = np.hypot(*steps.T)
    fast = lengths > 1e-4
    ways = np.arctan2(steps[:, 1], steps[:, 0])
    half_a_step = 0.5 * 0.01 * np.abs(rows[1:, 5]).max() + 1e-9
    off = np.remainder(travel.courses[1:] - ways + np.pi, 2 * np.pi) - np.pi
    assert np.abs(off[fast]).max() <= half_a_step
    assert np.abs(travel.speeds[1:] * 0.01 - lengths).max() < 1e-6


def test_a_body_that_stands_has_the_course_on_which_it_will_go_on() -> None:
    actuators = Actuators(max_along=2.0, max_across=2.0)
    rows = driven(actuators)
    courses = travel_of(model(actuators), rows).courses
    first = int(np.flatnonzero(np.hypot(rows[:, 4], rows[:, 6]) > 0.0)[0])
    assert np.ptp(courses[: first + 1]) == 0.0


def test_the_course_turns_as_fast_as_it_is_said_to() -> None:
    actuators = Actuators(max_along=2.0, max_across=2.0)
    rows = driven(actuators)
    travel = travel_of(model(actuators), rows)
    turned = np.cumsum(travel.turn_rates) * 0.01
    assert np.abs(turned - (travel.courses - travel.courses[0])).max() < 1e-9


def test_a_body_that_looks_where_it_goes_has_its_heading_for_a_course() -> None:
    rows = driven(Actuators())
    rows[:, 6] = 0.0
    travel = travel_of(model(Actuators()), rows)
    assert np.array_equal(travel.courses, rows[:, ROW_HEADING])
    assert np.array_equal(travel.speeds, rows[:, 4])
    assert np.array_equal(travel.turn_rates, rows[:, 5])


def test_a_body_that_never_moved_has_its_heading() -> None:
    actuators = Actuators(max_along=2.0, max_across=2.0)
    rows = np.zeros((5, 7))
    rows[:, 0], rows[:, ROW_HEADING] = np.arange(5.0), 0.7
    travel = travel_of(model(actuators), rows)
    assert travel.courses.tolist() == [0.7] * 5
    assert not travel.speeds.any()
