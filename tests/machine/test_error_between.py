"""Errors that are kept between one that isn't enough and one with which there is no path."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import viaspline as vs
from viaspline.machine.error_between import ERRORS_BETWEEN, planned_between

BODY = [[-0.3, -0.35], [1.2, -0.35], [1.2, 0.35], [-0.3, 0.35]]


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_the_least_error_is_kept_that_is_enough_and_not_refused(
    needed: float, falls: float, most: float
) -> None:
    tried: list[float] = []

    def plan_with(error: float) -> float:
        tried.append(error)
        if error > most:
            raise vs.NoPathError("narrow", remedy="less", where=(0.0, 0.0))
        return error

    def gets_beside(error: float) -> float:
        return needed * (1.0 - falls * error)

    found = planned_between(0.0, 1.0, plan_with, gets_beside)
    enough = [k / ERRORS_BETWEEN for k in range(1, ERRORS_BETWEEN)]
    enough = [error for error in enough if error <= most and gets_beside(error) <= error]
    assert found == (pytest.approx(enough[0]) if enough else None)
    assert sum(error > most for error in tried) <= 1


@pytest.mark.slow
def test_a_path_that_needs_more_than_any_keeps_is_no_proof_that_there_is_none() -> None:
    """Past what moves it needed 6 cm; with 2 cm another path is driven, which needs no more."""
    known: list[dict[str, Any]] = [
        {"circle": {"center": [16.87, 16.19], "radius": 1.415}},
        {"circle": {"center": [6.88, 14.19], "radius": 0.832}},
        {"circle": {"center": [11.73, 10.62], "radius": 1.579}, "pass_on": "right"},
        {"capsule": {"from": [0.092, -0.353], "to": [-0.092, 0.353], "radius": 0.091},
         "motion": {"from": [11.03, 12.8], "velocity_mps": [0.26, 0.16]}},
    ]  # fmt: skip
    robot = {"max_speed_mps": 1.957, "max_accel_mps2": 1.0, "max_jerk_mps3": 0.584,
             "footprint": BODY, "clearance_m": 0.121,
             "drive": {"ackermann": {"wheelbase_m": 1, "max_steer_deg": 32}, "delay_s": 0.1,
                       "lag_s": 0.1}}  # fmt: skip
    route = {"start": {"at": [5.13, 5.86], "heading_deg": 78.206}, "goal": [0.94, 12.25],
             "via": [[15.52, 12.89], [6.962313101456759, 12.857776479997776]],
             "detours": "short"}  # fmt: skip
    bounds = [-6.0, -6.0, 24.0, 24.0]
    asked = {"world": {"bounds": bounds, "known": known}, "robot": robot, "route": route}
    plan = vs.plan(vs.Mission.model_validate(asked))
    assert plan.certificate.holds
    assert 0.0 < plan.tracking_error < 0.05
