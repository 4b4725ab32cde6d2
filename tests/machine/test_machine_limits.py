"""What a drive asks of the time law beside what the robot asks: the less of the two."""

from __future__ import annotations

import math
from typing import Any

import pytest

from viaspline.machine.machine_limits import limits_of
from viaspline.mission.robot_parts import RobotSpec
from viaspline.trajectory.limits import Limits


def test_a_robot_that_follows_exactly_has_its_own_limits() -> None:
    robot = RobotSpec(max_speed_mps=3.0)
    assert limits_of(robot) == Limits.of(robot)


def test_a_driven_robot_has_an_end_of_what_it_stands_across(robot_of: Any) -> None:
    unlimited = robot_of("point", max_lateral_accel_mps2="unlimited")
    assert limits_of(unlimited).max_lateral_accel == 5.0
    assert limits_of(robot_of("point", max_lateral_accel_mps2=0.4)).max_lateral_accel == 0.4


def test_the_lower_yaw_rate_counts(robot_of: Any) -> None:
    wheels = limits_of(robot_of("differential")).max_yaw_rate
    assert wheels is not None
    lower = limits_of(robot_of("differential", max_yaw_rate_degps=5)).max_yaw_rate
    assert lower == pytest.approx(math.radians(5))
    assert limits_of(robot_of("differential", max_yaw_rate_degps=1e4)).max_yaw_rate == wheels


def test_the_time_to_a_stop_grows_by_the_delay_and_the_lag_of_the_drive(robot_of: Any) -> None:
    sight: dict[str, Any] = {"sensor": {"range_m": 3.0}, "max_speed_mps": 20.0}
    slow = limits_of(robot_of("differential", delay_s=0.4, lag_s=0.3, **sight)).max_speed
    wheels = RobotSpec.model_validate(sight)
    assert slow == pytest.approx(min(Limits.of(wheels, 0.8).max_speed, 2.0))


def test_steered_wheels_ask_for_their_rate(robot_of: Any) -> None:
    limits = limits_of(robot_of("ackermann"))
    assert (limits.max_steer_rate, limits.wheelbase) == (pytest.approx(math.pi / 2), 1.0)
    assert limits.axis_speed is None
