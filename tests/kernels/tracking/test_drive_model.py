"""What actuators make of a command, and the arc that follows from it: against closed forms."""

from __future__ import annotations

import math
from typing import Any

import pytest

from viaspline.kernels.tracking.actuators import Actuators
from viaspline.kernels.tracking.drive_model import (
    DriveModel,
    limited,
    moved,
    respond,
    yaw_rate_of,
)

INF = math.inf
WHEELS = Actuators(track=0.5, max_wheel_speed=1.0)
STEERED = Actuators(wheelbase=0.5)
ANY_WAY = Actuators(max_along=1.0, max_across=0.5)


def model(actuators: Actuators = WHEELS, **changes: Any) -> DriveModel:
    plain = DriveModel(
        actuators, INF, INF, 2.0, INF, 0.0, 0.0, 1.0, 0.6, 0.3, 1.0, 2.0, 0.05, 0.15, 0.0, 0.0
    )
    return plain._replace(**changes)


@pytest.mark.parametrize("rate", [0.0, 1e-9, 1e-3, 0.5, -2.0, 6.0])
def test_a_step_is_exactly_an_arc(rate: float) -> None:
    x, y, heading = moved(1.0, 2.0, 0.3, 1.5, 0.0, rate, 0.8)
    assert heading == pytest.approx(0.3 + 0.8 * rate)
    if abs(rate) < 1e-6:
        assert (x, y) == pytest.approx((1 + 1.2 * math.cos(0.3), 2 + 1.2 * math.sin(0.3)))
    else:
        radius = 1.5 / rate
        assert x == pytest.approx(1.0 + radius * (math.sin(heading) - math.sin(0.3)), abs=1e-9)
        assert y == pytest.approx(2.0 - radius * (math.cos(heading) - math.cos(0.3)), abs=1e-9)


@pytest.mark.parametrize("rate", [0.0, 1e-5, 0.5, -2.0])
def test_a_step_to_the_left_is_one_ahead_of_a_body_that_looks_that_way(rate: float) -> None:
    x, y, heading = moved(1.0, 2.0, 0.3, 0.0, 1.5, rate, 0.8)
    ahead = moved(1.0, 2.0, 0.3 + math.pi / 2, 1.5, 0.0, rate, 0.8)
    assert (x, y, heading + math.pi / 2) == pytest.approx(ahead, abs=1e-12)


def test_a_wheel_that_is_too_fast_slows_the_robot_and_keeps_the_arc() -> None:
    v, _, w = limited(model(), 1.0, 0.0, 2.0)
    assert w / v == pytest.approx(2.0)
    assert v + 0.25 * w == pytest.approx(1.0)
    v, _, w = limited(model(WHEELS._replace(grip=0.5)), 0.0, 0.0, 9.0)
    assert (v, w) == (0.0, pytest.approx(2.0))  # a side at 1 m/s, half of the turn lost
    assert limited(model(Actuators()), 1.0, 0.0, 50.0) == (1.0, 0.0, 50.0)


def test_a_body_that_moves_any_way_is_slowed_along_and_across_alike() -> None:
    assert limited(model(ANY_WAY), 0.6, 0.3, 0.0) == (0.6, 0.3, 0.0)
    assert limited(model(ANY_WAY), -0.8, 1.0, 0.0) == pytest.approx((-0.4, 0.5, 0.0))
    assert limited(model(ANY_WAY), 2.0, -0.4, 0.0) == pytest.approx((1.0, -0.2, 0.0))


def test_steering_has_an_end_and_a_rate() -> None:
    drive = model(STEERED, max_turn=0.6, max_turn_rate=0.5)
    assert limited(drive, 1.0, 0.0, 2.0) == (1.0, 0.0, 0.6)
    assert respond(drive, 1.0, 0.0, 0.0, 1.0, 0.0, 0.6, 0.1) == (1.0, 0.0, pytest.approx(0.05))
    assert yaw_rate_of(drive, 1.0, 0.6) == pytest.approx(math.tan(0.6) / 0.5)
