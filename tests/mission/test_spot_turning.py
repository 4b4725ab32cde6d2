"""How long a robot takes to turn where it stands, and what is foreseen where that isn't said."""

from __future__ import annotations

import math
from typing import Any

import pytest

from viaspline.machine.robot_model import drive_model_of
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.spot_turning import SpotTurning, foreseen_turning, is_driven, told_rate_of

DIFFERENTIAL = {"differential": {"track_m": 0.5, "max_wheel_speed_mps": 2.5}}
HELD = {"omnidirectional": {"max_speed_along_mps": 2.0, "max_speed_across_mps": 1.0,
                            "hold_heading_deg": 30}}  # fmt: skip
STEERED = {"ackermann": {"wheelbase_m": 1.0, "max_steer_deg": 35}}


def robot(**keys: Any) -> RobotSpec:
    return RobotSpec.model_validate(keys)


def test_a_robot_is_driven_that_has_a_drive_or_does_not_know_where_it_is() -> None:
    assert not is_driven(RobotSpec())
    assert is_driven(robot(localization={}))
    assert is_driven(robot(drive=DIFFERENTIAL))


@pytest.mark.parametrize("lag", [0.0, 0.2])
@pytest.mark.parametrize("drive", [DIFFERENTIAL, HELD, STEERED])
def test_the_mission_tells_what_the_model_of_its_drive_does(drive: Any, lag: float) -> None:
    keys = {"drive": {**drive, "lag_s": lag}, "max_yaw_rate_degps": 40}
    driven = robot(**keys)
    assert SpotTurning.of(driven) == SpotTurning.of_model(drive_model_of(driven))


def test_a_wider_turn_takes_longer_and_steered_wheels_make_none() -> None:
    turning = SpotTurning.of(robot(drive=DIFFERENTIAL))
    assert turning.time(-2.0) > turning.time(1.0) > 1.0
    assert SpotTurning.of(robot(drive=STEERED)).time(1.0) == 0.0


def test_a_body_that_keeps_its_heading_only_comes_to_rest() -> None:
    turning = SpotTurning.of(robot(drive={**HELD, "lag_s": 0.2}))
    assert turning.time(2.0) == turning.time(0.1) == pytest.approx(0.6)


def test_a_robot_without_a_drive_is_foreseen_to_turn_as_it_is_told_to() -> None:
    assert SpotTurning.of(RobotSpec()).time(math.pi) == 0.0
    assert foreseen_turning(RobotSpec()).time(math.pi) == math.pi / told_rate_of(RobotSpec())
    slow = robot(max_yaw_rate_degps=45)
    assert foreseen_turning(slow) == SpotTurning.of(slow)
    driven = robot(drive=DIFFERENTIAL)
    assert foreseen_turning(driven) == SpotTurning.of(driven)
