"""Limits: what they take, what they say, and where a mission's robot puts them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from viaspline.errors import GeometryError
from viaspline.mission.robot_parts import RobotSpec
from viaspline.trajectory.limits import Limits


@pytest.mark.parametrize(
    "name",
    ["max_speed", "max_accel", "max_lateral_accel", "max_brake", "max_yaw_rate", "max_yaw_accel",
     "max_jerk", "axis_speed", "axis_accel"],
)  # fmt: skip
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
def test_a_limit_that_makes_no_sense_is_named(name: str, value: float) -> None:
    with pytest.raises(GeometryError, match=name):
        Limits(**({"max_speed": 1.0, "max_accel": 1.0} | {name: value}))


@pytest.mark.parametrize("value", [1e-300, 1e300])
def test_a_limit_that_no_robot_has_is_named_with_the_range(value: float) -> None:
    with pytest.raises(GeometryError, match=r"max_speed is 1e.*give a number from 1e-12 to"):
        Limits(max_speed=value, max_accel=1.0)


def test_limits_of_axes_are_values_that_compare_and_hash() -> None:
    a = Limits(max_speed=1, max_accel=1, axis_accel=np.array([1, 2]))
    b = Limits(max_speed=1.0, max_accel=1.0, axis_accel=(1.0, 2.0))
    assert a == b
    assert hash(a) == hash(b)
    assert a.of_axes("axis_accel", 2).tolist() == [1, 2]
    assert a.of_axes("axis_speed", 2).size == 0
    assert (
        Limits(max_speed=1, max_accel=1, axis_speed=3).of_axes("axis_speed", 3).tolist() == [3] * 3
    )
    with pytest.raises(GeometryError, match="axis_accel"):
        Limits(max_speed=1, max_accel=1, axis_accel=[1.0, 0.0])


def test_a_mission_gives_degrees_and_limits_take_radians() -> None:
    robot = RobotSpec(
        max_brake_mps2=3, max_yaw_rate_degps=90, max_yaw_accel_degps2=180, max_jerk_mps3=0.5
    )
    limits = Limits.of(robot)
    assert limits.brake == 3
    assert limits.max_yaw_rate == pytest.approx(math.pi / 2)
    assert limits.max_yaw_accel == pytest.approx(math.pi)
    assert limits.max_jerk == 0.5
    assert Limits.of(RobotSpec()).brake == Limits.of(RobotSpec()).max_accel


def test_a_robot_that_brakes_harder_may_drive_faster_on_its_sight() -> None:
    weak = RobotSpec(max_speed_mps=9, sensor={"range_m": 5})
    assert (
        Limits.of(weak).max_speed
        < Limits.of(weak.model_copy(update={"max_brake_mps2": 3.0})).max_speed
    )


def test_what_is_never_reached_on_the_tightest_turn_is_said() -> None:
    limits = Limits(max_speed=10, max_accel=1, max_lateral_accel=0.5, max_yaw_rate=0.5)
    lateral, rate = limits.conflicts(2.0)
    assert "max_lateral_accel 0.5 m/s² allows 1 m/s" in lateral
    assert "max_yaw_rate 28.6 deg/s allows 1 m/s" in rate
    assert limits.conflicts(200.0) == ()
    assert Limits(max_speed=10, max_accel=1).conflicts(0.1) == ()
    with pytest.raises(GeometryError, match="turning_radius"):
        limits.conflicts(0.0)


def test_across_the_path_a_robot_does_what_it_does_along_it_unless_it_says_otherwise() -> None:
    def across(**keys: Any) -> float | None:
        return Limits.of(RobotSpec.model_validate(keys)).max_lateral_accel

    assert across() == 1.0
    assert across(max_accel_mps2=0.4, max_brake_mps2=2.0) == 0.4
    assert across(max_accel_mps2=0.4, max_lateral_accel_mps2=2.5) == 2.5
    assert across(max_lateral_accel_mps2="unlimited") is None
