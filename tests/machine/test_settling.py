"""A drive with a lag stands when a command says, by the law that the simulated drive follows."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.kernels.tracking.drive_model import DriveModel, respond
from viaspline.machine.robot_model import drive_model_of
from viaspline.machine.settling import (
    STILL_MPS,
    settled_after_law,
    settling_time,
    stilling_command,
)
from viaspline.mission.robot_parts import RobotSpec

PERIOD_S = 0.05
MOST_ROLLED_M = 1e-9


def model_of(lag: float) -> DriveModel:
    drive = {"differential": {"track_m": 0.4}, "lag_s": lag}
    return drive_model_of(RobotSpec.model_validate({"max_accel_mps2": 1.0, "drive": drive}))


@given(st.floats(0.0, 0.5), st.floats(-1.0, 1.0))
def test_it_stands_as_soon_as_its_drive_can_brake_it(lag: float, speed: float) -> None:
    model, now, spent = model_of(lag), speed, 0.0
    while abs(now) >= STILL_MPS:
        command = stilling_command(model, now, PERIOD_S)
        after = respond(model, now, 0.0, 0.0, command, 0.0, 0.0, PERIOD_S)[0]
        assert after * now >= -MOST_ROLLED_M  # it never goes back
        now, spent = after, spent + PERIOD_S
    assert spent <= settling_time(model, abs(speed), PERIOD_S)


def test_one_without_a_lag_and_one_that_stands_are_told_to_stand() -> None:
    assert stilling_command(model_of(0.0), 1.0, PERIOD_S) == 0.0
    assert stilling_command(model_of(0.2), 0.5 * STILL_MPS, PERIOD_S) == 0.0


@pytest.mark.parametrize("lag", [0.02, 0.1, 0.3])
def test_after_its_law_it_is_no_faster_than_what_is_reckoned_with(lag: float) -> None:
    """It follows a braking law by that law's speed and acceleration, as its controller does."""
    model, brake, now, speed = model_of(lag), 1.0, 0.0, 1.0
    while now < 1.0:
        command = max(1.0 - brake * (now + 0.5 * PERIOD_S) - lag * brake, 0.0)
        speed = respond(model, speed, 0.0, 0.0, command, 0.0, 0.0, PERIOD_S)[0]
        now += PERIOD_S
    needs = PERIOD_S + settling_time(model, speed, PERIOD_S)
    assert needs <= settled_after_law(model, brake, PERIOD_S) + PERIOD_S
    assert math.isfinite(needs)
