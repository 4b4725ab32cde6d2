"""A flight that comes back to where it began: as a round that goes on, or to land there."""

from __future__ import annotations

from typing import Any

import numpy as np

import viaspline as vs
from viaspline.mission.model import Mission

VIA = [{"at": [40, 0, 10]}, {"at": [40, 30, 10]}]


def planned(**route: Any) -> vs.SpatialPlan:
    asked = {
        "world": {"ground": {"flat_m": 0}, "known": []},
        "robot": {"radius_m": 0.5, "max_speed_mps": 5, "max_accel_mps2": 2},
        "route": {"takeoff": {"to_agl_m": 10}, "start": {"at": [0, 0]}, "via": VIA, **route},
    }
    plan = vs.plan(Mission.model_validate(asked))
    assert isinstance(plan, vs.SpatialPlan)
    return plan


def way_at(plan: vs.SpatialPlan, distance: float) -> np.ndarray:
    step = plan.path.at_distance([distance, distance + 0.01])
    return np.asarray((step[1] - step[0]) / np.linalg.norm(step[1] - step[0]))


def test_a_round_closes_smoothly() -> None:
    plan = planned(closed=True, laps=2)
    begins, ends = plan.airborne
    assert np.allclose(way_at(plan, begins), way_at(plan, ends - 0.01), atol=0.02)


def test_what_lands_where_it_began_comes_straight_back() -> None:
    plan = planned(land={"at": [0, 0]})
    _, ends = plan.airborne
    back = np.array([-40.0, -30, 0]) / 50.0
    assert way_at(plan, ends - 0.01) @ back > 0.9
    assert plan.path.length < 1.04 * (10.0 + 40.0 + 30.0 + 50.0 + 10.0)
