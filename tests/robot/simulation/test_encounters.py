"""How near a drive came to what moves, against sums by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viaspline as vs
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.simulation.encounters import DrivenStates, encounters, touched_by
from viaspline.world.moving_obstacles import MovingObstacles

ROBOT = RobotSpec(radius_m=0.5)


def cart(velocity: tuple[float, float], start: tuple[float, float]) -> MovingObstacles:
    motion = {"from": start, "velocity_mps": velocity}
    data = {"circle": {"center": (0, 0), "radius": 1.0}, "name": "cart", "motion": motion}
    return MovingObstacles([Obstacle.model_validate(data)])


def straight(speed: float, seconds: float) -> DrivenStates:
    def state_at(times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        places = np.column_stack((speed * times, np.zeros_like(times)))
        return places, np.full(times.shape, speed)

    return DrivenStates(0.0, seconds, state_at)


def test_the_clearance_is_proven_and_near_the_true_one() -> None:
    met = encounters(straight(2.0, 10.0), ROBOT, cart((0.0, 1.0), (10.0, -8.0)))
    times = np.linspace(0.0, 10.0, 1_000_001)
    truth = np.hypot(2.0 * times - 10.0, 8.0 - times).min() - 1.5
    assert truth - 3e-3 < met.clearance <= truth
    assert met.obstacle == "cart"
    assert met.contacts == ()
    assert touched_by(met) is None


def test_a_touch_under_way_ends_a_drive_in_words_and_one_at_rest_does_not() -> None:
    moving = encounters(straight(2.0, 10.0), ROBOT, cart((0.0, 1.0), (10.0, -5.0)))
    [contact] = moving.contacts
    assert contact.robot_speed == 2.0
    reason = touched_by(moving)
    assert reason is not None
    assert "the robot touched 'cart'" in reason
    standing = encounters(straight(0.0, 10.0), ROBOT, cart((1.0, 0.0), (-5.0, 0.0)))
    [contact] = standing.contacts
    assert contact.time == pytest.approx(3.5, abs=2e-3)
    assert contact.robot_speed == 0.0
    assert touched_by(standing) is None


def test_where_nothing_moves_nothing_is_met() -> None:
    assert encounters(straight(1.0, 1.0), ROBOT, MovingObstacles()).clearance == math.inf


def test_a_run_past_what_is_known_to_move_keeps_what_its_plan_proves() -> None:
    mission = vs.Mission.model_validate(
        {
            "world": {
                "known": [
                    {
                        "name": "cart",
                        "circle": {"center": [0, 0], "radius": 1},
                        "motion": {"keyframes": [[0, 10, -9], [9, 10, 9]], "after": "stay"},
                    }
                ]
            },
            "route": {"start": [0, 0], "goal": [20, 0], "depart_s": 1.0},
        }
    )
    run = vs.simulate(mission)
    certificate = run.plan.moving_certificate
    assert run.reached
    assert run.encounters is not None
    assert certificate is not None
    assert run.encounters.clearance == pytest.approx(certificate.clearance, abs=5e-3)
    assert run.encounters.clearance >= 0.5 - 5e-3
    assert run.encounters.contacts == ()
