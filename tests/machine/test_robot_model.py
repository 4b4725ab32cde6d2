"""The drive model of a robot: its numbers are the mission's, and gains are slower than its lag."""

from __future__ import annotations

import math
from typing import Any

import pytest

from viaspline.machine.robot_model import drive_model_of
from viaspline.mission.robot_parts import RobotSpec


def test_steered_wheels_turn_by_an_angle_and_all_others_by_a_yaw_rate(robot_of: Any) -> None:
    limits = {"max_yaw_rate_degps": 30.0, "max_yaw_accel_degps2": 60.0}
    steered = drive_model_of(robot_of("ackermann", **limits))
    assert steered.max_turn == pytest.approx(math.radians(35))
    assert steered.max_turn_rate == pytest.approx(math.radians(90))
    turned = drive_model_of(robot_of("differential", **limits))
    assert turned.max_turn == pytest.approx(1.25 * math.radians(30))
    assert turned.max_turn_rate == pytest.approx(1.25 * math.radians(60))


def test_on_the_spot_no_wheel_is_faster_than_it_can(robot_of: Any) -> None:
    narrow = {"differential": {"track_m": 2.0, "max_wheel_speed_mps": 0.3}}
    assert drive_model_of(RobotSpec(drive=narrow)).spot_rate == pytest.approx(0.3)
    assert drive_model_of(robot_of("point")).spot_rate == 1.0
    assert drive_model_of(robot_of("point", max_yaw_rate_degps=10)).spot_rate == pytest.approx(
        math.radians(10)
    )


@pytest.mark.parametrize("lag", [0.0, 0.1, 0.5])
def test_the_loops_are_four_times_slower_than_the_lag(robot_of: Any, lag: float) -> None:
    model = drive_model_of(robot_of("differential", lag_s=lag))
    assert model.along_gain * lag <= 0.25
    assert model.heading_gain * lag <= 0.25
    assert model.convergence_time >= 4.0 * lag
