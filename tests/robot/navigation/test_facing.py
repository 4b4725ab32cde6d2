"""A robot without a drive takes its time to turn on the spot, whichever law it drives by."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs

ALMOST_RAD = 0.1
WALL = {"polygon": [[3, -3], [3.2, -3], [3.2, 3], [3, 3]]}
SENSORS = ({"range_m": 6}, {"lidar": {"range_m": 6, "fov_deg": 360}})


def asked(rate: float, sensor: dict[str, Any], safety: str, **more: Any) -> vs.Mission:
    robot = {
        "radius_m": 0.3, "max_speed_mps": 1.0, "max_accel_mps2": 1.0, "max_yaw_rate_degps": rate,
        "sensor": sensor, "moving": {"max_speed_mps": 0.5, "safety": safety},
    }  # fmt: skip
    return vs.Mission.model_validate({"robot": robot, "spline": {"tension": 1}, **more})


def turns_too_fast(run: vs.Run, rate: float) -> list[tuple[float, float]]:
    """Times between which a robot stood and turned faster than it may."""
    rolls = np.flatnonzero(run.speeds >= 0.02)
    return [
        (float(run.times[i]), float(run.times[j]))
        for i, j in pairwise(rolls)
        if j > i + 1
        and abs(math.remainder(float(run.headings[j] - run.headings[i]), math.tau))
        > math.radians(rate) * (run.times[j] - run.times[i]) + ALMOST_RAD
    ]


@settings(max_examples=6, deadline=None)
@given(
    angle=st.floats(-170.0, 170.0),
    rate=st.floats(15.0, 120.0),
    sensor=st.sampled_from(SENSORS),
    safety=st.sampled_from(("none", "passive")),
)
def test_a_corner_of_its_path_takes_as_long_as_planned(
    angle: float, rate: float, sensor: dict[str, Any], safety: str
) -> None:
    """By laws that are found anew in every step it turned in no time."""
    goal = [4 + 4 * math.cos(math.radians(angle)), 4 * math.sin(math.radians(angle))]
    route = {"start": {"at": [0, 0]}, "via": [{"at": [4, 0]}], "goal": {"at": goal}}
    run = vs.simulate(asked(rate, sensor, safety, route=route, world={}))
    assert run.reached
    assert run.duration >= run.plan.trajectory.duration - 1e-6


@pytest.mark.parametrize("safety", [pytest.param("none", marks=pytest.mark.slow), "passive"])
@pytest.mark.parametrize("sensor", SENSORS)
def test_the_first_turn_of_a_path_that_is_laid_from_rest_takes_its_time(
    sensor: dict[str, Any], safety: str
) -> None:
    route = {"start": {"at": [0, 0]}, "goal": {"at": [10, 0]}}
    run = vs.simulate(asked(30.0, sensor, safety, route=route, world={"unseen": [WALL]}))
    assert run.reached
    assert run.replans
    assert turns_too_fast(run, 30.0) == []


def test_a_stay_at_a_station_is_enough_for_a_shorter_turn() -> None:
    route = {"start": {"at": [0, 0]}, "via": [{"at": [4, 0], "dwell_s": 5}], "goal": {"at": [4, 4]}}
    for sensor in SENSORS:
        run = vs.simulate(asked(30.0, sensor, "none", route=route, world={}))
        assert run.duration == pytest.approx(5.0 + 5.0 + 5.0, abs=1e-6)
