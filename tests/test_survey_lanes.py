"""Lanes of a survey are no longer than they are: on the ground, with heights, and in space."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs

LANE_M, APART_M = 400.0, 30.0


def lanes(count: int, *heights: float, **parts: Any) -> dict[str, Any]:
    """A mission there and back, APART_M beside each other; heights in turn, none on the ground."""
    ends = [(x, APART_M * k) for k in range(count) for x in (0.0, LANE_M)[:: -1 if k % 2 else 1]]
    places = [[*end, *heights[k % len(heights) :][:1]] if heights else list(end)
              for k, end in enumerate(ends)]  # fmt: skip
    route = {"start": places[0], "via": places[1:-1], "goal": places[-1]}
    robot = {"radius_m": 0.5, "clearance_m": 0.5, "max_speed_mps": 2.0}
    return {"route": route, "robot": robot, **parts}


SKY = {"ground": {"flat_m": 0}}


@pytest.mark.parametrize("heights", [(), (60.0,), (60.0, 62.0, 64.0)])
@pytest.mark.parametrize("objective", ["time", "length"])
def test_no_lane_swings_out_at_its_ends(heights: tuple[float, ...], objective: str) -> None:
    """They did with heights: by 19 % of the length, and 26 % of lanes of 5 km."""
    for world in ({}, SKY) if heights else ({},):
        data = lanes(6, *heights, world=world)
        data["route"]["optimise"] = objective
        plan = vs.plan(vs.Mission.model_validate(data))
        assert plan.path.length < 1.01 * (6 * LANE_M + 5 * APART_M)
        assert plan.drivability.curvature_jumps == 0
        assert plan.drivability.sharpest_radius > 0.5


@pytest.mark.parametrize("world", [{}, SKY])
def test_a_tension_that_is_stated_is_the_one_of_lanes_with_heights(world: dict[str, Any]) -> None:
    data = lanes(4, 60.0, world=world, spline={"tension": 0.0})
    plan = vs.plan(vs.Mission.model_validate(data))
    assert plan.path.length > 1.1 * (4 * LANE_M + 3 * APART_M)


@given(seed=st.integers(0, 10_000))
@settings(max_examples=12, deadline=None, derandomize=True)
def test_without_a_tension_a_flight_is_no_later_than_with_that_of_the_paper(seed: int) -> None:
    rng = np.random.default_rng(seed)
    places = rng.uniform((0, 0, 20), (300, 300, 60), (int(rng.integers(3, 9)), 3)).round(1).tolist()
    data: dict[str, Any] = {
        "world": SKY,
        "robot": {"radius_m": 0.5, "max_speed_mps": 4.0, "max_climb_mps": 2.0},
        "route": {"start": places[0], "via": places[1:-1], "goal": places[-1]},
    }
    free = vs.plan(vs.Mission.model_validate(data))
    spline = vs.plan(vs.Mission.model_validate({**data, "spline": {"tension": 0.0}}))
    assert free.trajectory.duration <= 1.001 * spline.trajectory.duration
