"""How machines move on under their commands: against scipy's integrator."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from viaspline.kernels.tracking.actuators import Actuators
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.kernels.tracking.drive_motion import ACROSS, STATE, move

INF = math.inf


WHEELS = Actuators(track=0.5)


def model(actuators: Actuators = WHEELS, **changes: Any) -> DriveModel:
    plain = DriveModel(
        actuators, INF, INF, 2.0, INF, 0.0, 0.0, 1.0, 0.6, 0.3, 1.0, 2.0, 0.05, 0.15, 0.0, 0.0
    )
    return plain._replace(**changes)


def commanded(along: float, turn: float, across: float = 0.0) -> np.ndarray:
    """One command, at the start."""
    return np.array([[0.0, along, across, turn]])


@pytest.mark.parametrize("wheelbase", [0.0, 1.2])
def test_a_lagging_machine_moves_as_its_differential_equation_says(wheelbase: float) -> None:
    drive = model(Actuators(wheelbase=wheelbase), lag=0.3)
    to_speed, to_turn = 1.6, 0.4

    def slope(_: float, state: np.ndarray) -> list[float]:
        _, _, heading, v, w = state
        rate = v * math.tan(w) / 1.2 if wheelbase else w
        return [v * math.cos(heading), v * math.sin(heading), rate,
                (to_speed - v) / 0.3, (to_turn - w) / 0.3]  # fmt: skip

    exact = solve_ivp(slope, (0.0, 2.0), [0.0] * 5, rtol=1e-10, atol=1e-12).y[:, -1]
    state = np.zeros(STATE)
    rows = move(drive, state, 0.0, 0.01, commanded(to_speed, to_turn), np.zeros((200, 2)))
    assert state[:5] == pytest.approx(exact, abs=2e-4)
    assert rows[-1, 1:4] == pytest.approx(exact[:3], abs=2e-4)


def test_a_command_acts_after_the_delay() -> None:
    drive = model(delay=0.25)
    rows = move(drive, np.zeros(STATE), 0.0, 0.01, commanded(1.0, 0.0), np.zeros((60, 2)))
    assert np.all(rows[:25, 1] == 0.0)
    assert rows[-1, 1] == pytest.approx(0.35, abs=0.006)


def test_a_standing_robot_is_not_shaken_by_noise() -> None:
    rng = np.random.default_rng(0)
    state = np.zeros(STATE)
    drive = model(speed_noise=0.5, yaw_noise=1.0)
    rows = move(drive, state, 0.0, 0.01, np.empty((0, 4)), rng.standard_normal((100, 2)))
    assert np.all(rows[:, 1:4] == 0.0)


@pytest.mark.long_without_jit
def test_the_noise_of_a_drive_has_its_standard_deviation() -> None:
    rng = np.random.default_rng(1)
    drive = model(speed_noise=0.1, yaw_noise=0.2)
    rows = move(
        drive, np.zeros(STATE), 0.0, 0.01, commanded(1.0, 0.3), rng.standard_normal((60_000, 2))
    )
    assert rows[1000:, 4].std() == pytest.approx(0.1, rel=0.1)
    assert rows[1000:, 5].std() == pytest.approx(0.2, rel=0.1)
    assert rows[1000:, 4].mean() == pytest.approx(1.0, abs=0.02)


def test_a_body_that_moves_any_way_moves_as_its_differential_equation_says() -> None:
    drive = model(Actuators(max_along=2.0, max_across=2.0), lag=0.3)
    to_along, to_across, to_turn = 1.2, -0.9, 0.5

    def slope(_: float, state: np.ndarray) -> list[float]:
        _, _, heading, u, v, w = state
        return [u * math.cos(heading) - v * math.sin(heading),
                u * math.sin(heading) + v * math.cos(heading), w,
                (to_along - u) / 0.3, (to_across - v) / 0.3, (to_turn - w) / 0.3]  # fmt: skip

    exact = solve_ivp(slope, (0.0, 2.0), [0.0] * 6, rtol=1e-10, atol=1e-12).y[:, -1]
    state = np.zeros(STATE)
    rows = move(
        drive, state, 0.0, 0.01, commanded(to_along, to_turn, to_across), np.zeros((200, 2))
    )
    assert rows[-1, 1:4] == pytest.approx(exact[:3], abs=2e-4)
    assert state[ACROSS] == pytest.approx(exact[4], abs=2e-4)


@pytest.mark.long_without_jit
def test_noise_of_the_speed_acts_the_way_that_a_body_goes() -> None:
    rng = np.random.default_rng(2)
    drive = model(Actuators(max_along=2.0, max_across=2.0), speed_noise=0.1)
    rows = move(
        drive,
        np.zeros(STATE),
        0.0,
        0.01,
        commanded(0.6, 0.0, 0.8),
        rng.standard_normal((60_000, 2)),
    )
    assert np.hypot(rows[1000:, 4], rows[1000:, 6]).std() == pytest.approx(0.1, rel=0.1)
    assert rows[:, 6] * 0.6 == pytest.approx(rows[:, 4] * 0.8, abs=1e-9)
