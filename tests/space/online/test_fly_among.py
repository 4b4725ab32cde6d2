"""Flights past what isn't on the map and what moves at once, against exact gaps every 10 ms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st

from viaspline.errors import GaveUpError
from viaspline.mission.model import Mission
from viaspline.space.online.fly import fly
from viaspline.space.plan_spatial import plan_spatial
from viaspline.space.spatial_run import SpatialRun

RADIUS, CLEARANCE = 0.5, 1.0


def mission(unseen: list[dict[str, Any]], moving: list[dict[str, Any]], **route: Any) -> Mission:
    return Mission.model_validate(
        {
            "world": {"ground": {"flat_m": 0}, "known": moving, "unseen": unseen,
                      "altitude": {"min_m": 2, "max_m": 60, "above": "home"}},
            "robot": {"radius_m": RADIUS, "clearance_m": CLEARANCE, "max_speed_mps": 5,
                      "max_accel_mps2": 2, "max_climb_mps": 2, "sensor": {"range_m": 20}},
            "route": {"start": [0, 0, 10], "goal": [80, 0, 10], **route},
        }
    )  # fmt: skip


def stands(name: str, x: float, y: float, radius: float) -> dict[str, Any]:
    return {"name": name, "ball": {"center": [x, y, 10.0], "radius": radius}}


def moves(name: str, radius: float, frames: list[list[float]]) -> dict[str, Any]:
    rows = [[t, x, y, 0, z] for t, x, y, z in frames]
    return {"name": name, "ball": {"center": [0, 0, 0], "radius": radius},
            "motion": {"keyframes": rows, "after": "stay"}}  # fmt: skip


def gaps(run: SpatialRun, one: dict[str, Any]) -> np.ndarray:
    """Free space to a ball that moves, at the moments of a flight."""
    rows = np.array(one["motion"]["keyframes"])
    at = np.column_stack([np.interp(run.times, rows[:, 0], rows[:, k]) for k in (1, 2, 4)])
    return np.linalg.norm(run.positions - at, axis=1) - one["ball"]["radius"] - RADIUS


def test_behind_what_was_not_on_the_map_a_robot_still_lets_what_moves_pass() -> None:
    kite = moves("kite", 1.0, [[0, 55, -20, 10], [9, 55, -20, 10], [18, 55, 20, 10]])
    free = fly(plan_spatial(mission([], [kite])))
    run = fly(plan_spatial(mission([stands("crane", 30, 0, 3)], [kite])))
    assert run.reached
    assert [replan.obstacles for replan in run.replans] == [("crane",)]
    assert gaps(run, kite).min() >= CLEARANCE - 1e-6
    assert run.clearance >= CLEARANCE - 1e-6
    assert run.clearance <= min(gaps(run, kite).min(), gaps(free, kite).min()) + 1e-6


@settings(max_examples=10)
@given(seed=st.integers(0, 100_000))
def test_flights_keep_clear_of_what_stands_unseen_and_of_what_moves(seed: int) -> None:
    rng = np.random.default_rng(seed)
    unseen = [
        stands(f"u{k}", float(rng.uniform(20, 65)), float(rng.uniform(-6, 6)),
               float(rng.uniform(0.5, 3)))
        for k in range(2)
    ]  # fmt: skip
    moving = []
    for k in range(2):
        times = np.cumsum(rng.uniform(3, 9, 3))
        at = rng.uniform((20, -15, 6), (65, 15, 14), (3, 3))
        moving.append(
            moves(f"m{k}", float(rng.uniform(0.5, 1.5)),
                  np.column_stack((times, at)).round(3).tolist())
        )  # fmt: skip
    try:
        run = fly(plan_spatial(mission(unseen, moving)), step=0.05)
    except GaveUpError:
        event("gave up")
        return
    event("reached" if run.reached else "stopped")
    least = min(gaps(run, one).min() for one in moving)
    assert least >= run.clearance - 1e-6
    for one in unseen:
        at = np.array(one["ball"]["center"])
        free = np.linalg.norm(run.positions - at, axis=1).min() - one["ball"]["radius"] - RADIUS
        assert free >= run.clearance - 1e-6
    if run.reached:
        assert run.clearance >= CLEARANCE - 1e-6
        assert np.allclose(run.positions[-1], (80, 0, 10), atol=1e-6)
    steps = np.linalg.norm(np.diff(run.positions, axis=0), axis=1) / np.diff(run.times)
    assert steps.max() <= 5 * (1 + 1e-6)


def test_a_goal_that_is_to_stay_free_does_so_on_the_new_path_too() -> None:
    kite = moves("kite", 1.0, [[0, 80, 9, 10], [24, 80, 9, 10], [30, 80, 0, 10], [38, 80, 40, 10]])
    run = fly(plan_spatial(mission([stands("crane", 30, 0, 3)], [kite], hold_s=10)))
    assert run.reached
    assert run.times[-1] > 30
    assert run.times[-1] == pytest.approx(run.times.max())
