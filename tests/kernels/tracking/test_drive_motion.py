"""How machines move on under their commands: against scipy's integrator."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from viaspline.kernels.tracking.drive_model import ACKERMANN, DIFFERENTIAL, Machine
from viaspline.kernels.tracking.drive_motion import STATE, move

INF = math.inf


def machine(kind: int = DIFFERENTIAL, **changes: float) -> Machine:
    plain = Machine(
        kind, 0.5, 1.0, INF, INF, INF, 2.0, INF, 0.0, 0.0, 1.0, 0.6, 0.3, 1.0, 2.0, 0.05, 0.15,
        0.0, 0.0,
    )  # fmt: skip
    return plain._replace(**changes)


@pytest.mark.parametrize("kind", [DIFFERENTIAL, ACKERMANN])
def test_a_lagging_machine_moves_as_its_differential_equation_says(kind: int) -> None:
    drive = machine(kind, lag=0.3, length=1.2)
    to_speed, to_turn = 1.6, 0.4

    def slope(_: float, state: np.ndarray) -> list[float]:
        _, _, heading, v, w = state
        rate = v * math.tan(w) / 1.2 if kind == ACKERMANN else w
        return [v * math.cos(heading), v * math.sin(heading), rate,
                (to_speed - v) / 0.3, (to_turn - w) / 0.3]  # fmt: skip

    exact = solve_ivp(slope, (0.0, 2.0), [0.0] * 5, rtol=1e-10, atol=1e-12).y[:, -1]
    state = np.zeros(STATE)
    rows = move(
        drive, state, 0.0, 0.01, np.array([0.0]), np.array([to_speed]), np.array([to_turn]),
        np.zeros((200, 2)),
    )  # fmt: skip
    assert state[:5] == pytest.approx(exact, abs=2e-4)
    assert rows[-1, 1:4] == pytest.approx(exact[:3], abs=2e-4)


def test_a_command_acts_after_the_delay() -> None:
    drive = machine(delay=0.25)
    rows = move(
        drive, np.zeros(STATE), 0.0, 0.01, np.array([0.0]), np.array([1.0]),
        np.array([0.0]), np.zeros((60, 2)),
    )  # fmt: skip
    assert np.all(rows[:25, 1] == 0.0)
    assert rows[-1, 1] == pytest.approx(0.35, abs=0.006)


def test_a_standing_robot_is_not_shaken_by_noise() -> None:
    rng = np.random.default_rng(0)
    state = np.zeros(STATE)
    drive = machine(speed_noise=0.5, yaw_noise=1.0)
    none = np.empty(0)
    rows = move(drive, state, 0.0, 0.01, none, none, none, rng.standard_normal((100, 2)))
    assert np.all(rows[:, 1:4] == 0.0)


def test_the_noise_of_a_drive_has_its_standard_deviation() -> None:
    rng = np.random.default_rng(1)
    drive = machine(speed_noise=0.1, yaw_noise=0.2)
    rows = move(
        drive, np.zeros(STATE), 0.0, 0.01, np.array([0.0]), np.array([1.0]),
        np.array([0.3]), rng.standard_normal((60_000, 2)),
    )  # fmt: skip
    assert rows[1000:, 4].std() == pytest.approx(0.1, rel=0.1)
    assert rows[1000:, 5].std() == pytest.approx(0.2, rel=0.1)
    assert rows[1000:, 4].mean() == pytest.approx(1.0, abs=0.02)
