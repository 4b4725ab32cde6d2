"""Corners of a path, and how long a robot stays at each of them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from viaspline.curve.cardinal import CardinalSpline
from viaspline.machine.robot_model import drive_model_of
from viaspline.machine.turns_on_spot import corners, turn_time, with_turns
from viaspline.trajectory.limits import Station

SQUARE = CardinalSpline([(0, 0), (4, 0), (4, 4), (0, 4)], tension=1.0)


def test_every_corner_of_a_polyline_is_found_with_its_angle() -> None:
    at, angles = corners(SQUARE)
    assert at == pytest.approx([4.0, 8.0])
    assert angles == pytest.approx([math.pi / 2, math.pi / 2])


def test_a_smooth_curve_has_no_corner(bends: Any) -> None:
    assert corners(bends)[0].size == 0


def test_a_wider_turn_takes_longer_and_steered_wheels_make_none(robot_of: Any) -> None:
    model = drive_model_of(robot_of("differential"))
    assert turn_time(model, -2.0) > turn_time(model, 1.0) > 1.0
    assert turn_time(drive_model_of(robot_of("ackermann")), 1.0) == 0.0


def test_a_body_that_keeps_its_heading_only_comes_to_rest(robot_of: Any) -> None:
    model = drive_model_of(robot_of("point"))
    held = model._replace(actuators=model.actuators._replace(held_heading=0.3), lag=0.2)
    assert turn_time(held, 2.0) == turn_time(held, 0.1) == pytest.approx(0.6)


def test_a_stay_that_is_long_enough_serves_for_the_turn(robot_of: Any) -> None:
    model = drive_model_of(robot_of("differential"))
    stops = with_turns(SQUARE, model, [Station(4.0, 60.0, "dock")])
    assert [(stop.distance, stop.name) for stop in stops] == [
        (pytest.approx(4.0), "dock"), (pytest.approx(8.0), "turn"),
    ]  # fmt: skip
    short = with_turns(SQUARE, model, [Station(4.0, 0.5, "dock")])
    assert sum(s.dwell for s in short[:2]) == pytest.approx(turn_time(model, math.pi / 2))


def test_corners_that_lie_behind_are_left_out(robot_of: Any) -> None:
    stops = with_turns(SQUARE, drive_model_of(robot_of("differential")), [], start=5.0)
    assert np.array([stop.distance for stop in stops]) == pytest.approx([8.0])
