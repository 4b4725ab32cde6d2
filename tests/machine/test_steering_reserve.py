"""How much steering a bend leaves to correct with."""

from __future__ import annotations

import math
from typing import Any

import pytest
from scipy.integrate import quad

from viaspline.kernels.tracking.drive_model import NOISE_TIME_S
from viaspline.machine.robot_model import drive_model_of
from viaspline.machine.steering_reserve import (
    ENOUGH_RESERVE,
    MAX_WIDENING,
    curvature_asked,
    roomy_turn_radius,
    steering_reserve,
)
from viaspline.mission.robot_parts import RobotSpec

CIRCLE = 1.7 / math.tan(math.radians(32))


def rover(noise: float = 3.0, place: dict[str, float] | None = None, **drive: Any) -> RobotSpec:
    """A steered robot with noise of its yaw rate [deg/s]."""
    steering = {"wheelbase_m": 1.7, "max_steer_deg": 32}
    return RobotSpec.model_validate(
        {
            "drive": {"ackermann": steering, "yaw_rate_noise_degps": noise, **drive},
            "localization": place,
        }
    )


@pytest.mark.parametrize("speed", [0.3, 1.0, 2.0])
def test_what_control_asks_for_is_that_of_the_loop_at_all_frequencies(speed: float) -> None:
    """The spectrum of the noise through the loop, integrated; the law is a closed form."""
    robot = rover(lag_s=0.3)
    model = drive_model_of(robot)
    near = 1.0 / max(model.convergence_distance, model.convergence_time * speed)
    fading = 1.0 / (speed * NOISE_TIME_S)

    def density(w: float) -> float:
        loop = (2j * near * w + near**2) / (1j * w + near) ** 2
        return abs(loop) ** 2 * 2.0 * fading / (w**2 + fading**2) / math.pi

    share = quad(density, 0.0, math.inf)[0]
    expected = math.sqrt(share) * math.radians(3.0) / speed
    assert curvature_asked(robot, model, speed) == pytest.approx(expected, rel=1e-6)


def test_the_roomy_circle_leaves_just_enough() -> None:
    robot = rover()
    radius = roomy_turn_radius(robot)
    assert CIRCLE < radius < MAX_WIDENING * CIRCLE
    assert steering_reserve(robot, 1.0 / radius) == pytest.approx(ENOUGH_RESERVE, abs=0.02)
    assert roomy_turn_radius(robot, 0.5 * ENOUGH_RESERVE) < radius


def test_what_is_off_at_random_asks_for_a_wider_circle() -> None:
    lost = {"position_noise_m": 0.03, "heading_noise_deg": 1.0}
    radii = [
        roomy_turn_radius(robot)
        for robot in (rover(0.0), rover(0.5), rover(2.0), rover(2.0, lost), rover(4.0, lost))
    ]
    assert radii[0] == pytest.approx(CIRCLE)
    assert radii == sorted(set(radii))


def test_a_circle_is_not_widened_without_end_nor_twice() -> None:
    robot = rover(60.0)
    widest = roomy_turn_radius(robot)
    assert widest == pytest.approx(MAX_WIDENING * CIRCLE, rel=2e-3)
    eased = robot.model_copy(update={"min_turn_radius_m": widest})
    assert roomy_turn_radius(eased) == pytest.approx(widest, rel=2e-3)


def test_a_bend_at_the_stop_leaves_nothing_and_wheels_that_do_not_steer_lack_nothing() -> None:
    assert steering_reserve(rover(), 1.0 / CIRCLE) == pytest.approx(0.0, abs=1e-9)
    assert steering_reserve(rover(), 1.1 / CIRCLE) < 0.0
    wheels = {"differential": {"track_m": 0.5}, "yaw_rate_noise_degps": 3}
    assert steering_reserve(RobotSpec.model_validate({"drive": wheels}), 5.0) == math.inf
