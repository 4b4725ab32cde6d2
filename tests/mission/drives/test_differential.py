"""Two wheels on an axle: their speeds give back the motion that was asked for."""

from __future__ import annotations

import math

import pytest

from viaspline.mission.drives.differential import Differential


@pytest.mark.parametrize(("speed", "yaw_rate"), [(1.0, 0.0), (0.5, -0.8), (0.0, 1.2)])
def test_the_wheels_make_the_motion_that_was_asked_for(speed: float, yaw_rate: float) -> None:
    told = Differential(track_m=0.4).actuator_values(speed, yaw_rate)
    left, right = told["left_wheel_mps"], told["right_wheel_mps"]
    assert 0.5 * (left + right) == pytest.approx(speed)
    assert (right - left) / 0.4 == pytest.approx(yaw_rate)


def test_wheels_without_a_limit_are_as_fast_as_you_like() -> None:
    actuators = Differential(track_m=0.4).actuators()
    assert actuators.max_wheel_speed == math.inf
    assert (actuators.track, actuators.grip, actuators.wheelbase) == (0.4, 1.0, 0.0)
