"""The carts in other people's simulators that ``benchmarks/sims.py`` drives: they touch and see."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

BENCHMARKS = Path(__file__).resolve().parents[1] / "benchmarks"
POSTS = np.array([[3.0, 0.1, 0.075], [1.0, -1.5, 0.075]])
DRIVES = {
    "mujoco": {"differential": {"track_m": 0.26}, "delay_s": 0.02, "lag_s": 0.1},
    "irsim": {"differential": {"track_m": 0.26}, "lag_s": 0.12, "speed_noise_mps": 0.04},
}
"""About what ``viaspline identify`` says of their test drives."""


@pytest.fixture(params=["mujoco", "irsim"])
def simulator(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    pytest.importorskip(request.param, reason="needs the extra sim")
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    return str(request.param)


def cart_in(simulator: str) -> Any:
    module = importlib.import_module(f"{simulator}_cart")
    kind = {"mujoco": "MujocoCart", "irsim": "IrsimCart"}[simulator]
    return getattr(module, kind)(POSTS, (0.0, 0.0, 0.0), seed=1)


def test_the_lidar_sees_a_post_where_it_is_and_nothing_else(simulator: str) -> None:
    cart = cart_in(simulator)
    ranges = cart.ranges()
    nearest = np.isfinite(ranges) & (np.abs(cart.angles) < 0.2)
    assert ranges[nearest].min() == pytest.approx(np.hypot(3.0, 0.1) - 0.075, abs=0.05)
    assert np.degrees(cart.angles[nearest]).mean() == pytest.approx(1.9, abs=1.5)
    assert np.isinf(ranges[np.abs(cart.angles - 0.5) < 0.3]).all()


def test_who_drives_into_a_post_touches_it_and_is_told(simulator: str) -> None:
    cart = cart_in(simulator)
    sim_drive = importlib.import_module("sim_drive")
    for _ in range(20):
        cart.drive(0.8, 0.0)
    assert cart.contacts == 0
    assert sim_drive.kept(cart) > 1.0
    for _ in range(100):
        cart.drive(0.8, 0.0)
    assert cart.contacts > 0
    assert abs(sim_drive.kept(cart)) < 0.01


def test_the_cart_reaches_its_goal_round_a_post_and_keeps_its_clearance(simulator: str) -> None:
    sim_drive = importlib.import_module("sim_drive")
    cart = cart_in(simulator)
    keys = {"drive": DRIVES[simulator], "max_accel_mps2": 0.5, "max_yaw_accel_degps2": 60}
    task = sim_drive.mission(keys, len(cart.angles), (0.0, 0.0), (5.0, 0.0), heading_deg=0)
    driven = sim_drive.drive(1, cart, task)
    assert driven.reached, driven.reason
    assert driven.contacts == 0
    assert driven.kept >= sim_drive.CLEARANCE
