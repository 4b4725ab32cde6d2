"""Two slipping sides: what slipping takes of a turn is asked for in addition."""

from __future__ import annotations

import pytest

from viaspline.mission.drives.skid_steer import SkidSteer


@pytest.mark.parametrize("slip", [0.0, 0.3, 0.9])
def test_what_slipping_leaves_of_the_turn_is_what_was_asked_for(slip: float) -> None:
    told = SkidSteer(track_m=0.6, slip=slip).actuator_values(0.5, -0.7)
    left, right = told["left_wheel_mps"], told["right_wheel_mps"]
    assert 0.5 * (left + right) == pytest.approx(0.5)
    assert (right - left) / 0.6 * (1.0 - slip) == pytest.approx(-0.7)


def test_a_side_turns_less_than_a_wheel_that_grips() -> None:
    slipping = SkidSteer(track_m=0.6, slip=0.5, max_wheel_speed_mps=1.0).limits(5.0, 1.0)
    gripping = SkidSteer(track_m=0.6, max_wheel_speed_mps=1.0).limits(5.0, 1.0)
    assert slipping.max_yaw_rate == pytest.approx(0.5 * (gripping.max_yaw_rate or 0.0))
    assert slipping.max_speed == gripping.max_speed
