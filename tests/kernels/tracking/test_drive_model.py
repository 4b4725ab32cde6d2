"""What actuators make of a command, and the arc that follows from it: against closed forms."""

from __future__ import annotations

import math

import pytest

from viaspline.kernels.tracking.drive_model import (
    ACKERMANN,
    DIFFERENTIAL,
    POINT,
    SKID_STEER,
    Machine,
    limited,
    moved,
    respond,
    turning,
)

INF = math.inf


def machine(kind: int = DIFFERENTIAL, **changes: float) -> Machine:
    plain = Machine(
        kind, 0.5, 1.0, INF, INF, INF, 2.0, INF, 0.0, 0.0, 1.0, 0.6, 0.3, 1.0, 2.0, 0.05, 0.15,
        0.0, 0.0,
    )  # fmt: skip
    return plain._replace(**changes)


@pytest.mark.parametrize("rate", [0.0, 1e-9, 1e-3, 0.5, -2.0, 6.0])
def test_a_step_is_exactly_an_arc(rate: float) -> None:
    x, y, heading = moved(1.0, 2.0, 0.3, 1.5, rate, 0.8)
    assert heading == pytest.approx(0.3 + 0.8 * rate)
    if abs(rate) < 1e-6:
        assert (x, y) == pytest.approx((1 + 1.2 * math.cos(0.3), 2 + 1.2 * math.sin(0.3)))
    else:
        radius = 1.5 / rate
        assert x == pytest.approx(1.0 + radius * (math.sin(heading) - math.sin(0.3)), abs=1e-9)
        assert y == pytest.approx(2.0 - radius * (math.cos(heading) - math.cos(0.3)), abs=1e-9)


def test_a_wheel_that_is_too_fast_slows_the_robot_and_keeps_the_arc() -> None:
    v, w = limited(machine(wheel=1.0), 1.0, 2.0)
    assert w / v == pytest.approx(2.0)
    assert v + 0.25 * w == pytest.approx(1.0)
    v, w = limited(machine(SKID_STEER, wheel=1.0, grip=0.5), 0.0, 9.0)
    assert (v, w) == (0.0, pytest.approx(2.0))  # a side at 1 m/s, half of the turn lost
    assert limited(machine(POINT, length=0.0), 1.0, 50.0) == (1.0, 50.0)


def test_steering_has_an_end_and_a_rate() -> None:
    drive = machine(ACKERMANN, turn=0.6, turn_rate=0.5)
    assert limited(drive, 1.0, 2.0) == (1.0, 0.6)
    assert respond(drive, 1.0, 0.0, 1.0, 0.6, 0.1) == (1.0, pytest.approx(0.05))
    assert turning(drive, 1.0, 0.6) == pytest.approx(math.tan(0.6) / 0.5)
