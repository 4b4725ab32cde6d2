"""Turns are wide where there is room, but nobody drives much longer for it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.turning.affordable_room import affordable_radii

MOST_LATER = 1.008  # wide and gentle turns together may cost that much of the time


@settings(max_examples=100, deadline=None, derandomize=True)
@given(
    st.lists(
        st.tuples(st.floats(0, 6), st.floats(0.1, 9), st.floats(0.1, 9)), min_size=1, max_size=9
    ),
    st.floats(1e-3, 5.0),
)
def test_all_turns_together_are_little_longer(
    turns: list[tuple[float, float, float]], spent: float
) -> None:
    angles, radii, soonest = np.array(turns).T
    most = affordable_radii(angles, radii, soonest, spent)
    assert (most >= soonest).all()
    widened = np.maximum(np.minimum(radii, most) - soonest, 0.0)
    assert (widened * (angles - 2.0 * np.sin(0.5 * angles))).sum() <= 2.0 * spent + 1e-9


def duration(optimise: str, route: dict[str, Any], **robot: Any) -> float:
    plan = vs.plan(
        vs.Mission.model_validate({
            "route": route | {"optimise": optimise},
            "robot": {"radius_m": 0.4, "clearance_m": 0.1, "max_speed_mps": 0.5} | robot,
        })
    )  # fmt: skip
    assert plan.drivability.verdict == "good"
    return plan.trajectory.duration


@settings(max_examples=15, deadline=None, derandomize=True)
@given(
    st.lists(st.tuples(st.floats(6, 15), st.floats(-1.2, 1.2)), min_size=2, max_size=4),
    st.booleans(),
    st.sampled_from((0.2, 0.5)),
)
@example([(8.0, 0.1), (8.0, 0.1)], False, 0.5)
def test_who_turns_back_at_via_points_is_not_later_than_by_the_shortest_path(
    legs: list[tuple[float, float]], has_circle: bool, speed: float
) -> None:
    """Slow robots turned back in circles of three required distances: some took 6 % longer."""
    places = [(0.0, 0.0)]
    for k, (length, askew) in enumerate(legs):
        heading = askew + math.pi * (k % 2)
        x, y = places[-1]
        places.append((x + length * math.cos(heading), y + length * math.sin(heading)))
    route = {"start": places[0], "via": places[1:-1], "goal": places[-1]}
    circle = {"min_turn_radius_m": 0.4} if has_circle else {}
    by_time, by_length = (
        duration(optimise, route, max_speed_mps=speed, max_accel_mps2=1.0, **circle)
        for optimise in ("time", "length")
    )
    assert by_time <= MOST_LATER * by_length


@pytest.mark.parametrize("turned", [0.0, 37.0])
def test_a_round_is_not_later_than_the_shortest_one(turned: float) -> None:
    places = np.array([[11.6, 11.0], [8.0, 9.2], [12.8, 3.6]])
    angle = math.radians(turned)
    cos, sin = math.cos(angle), math.sin(angle)
    start, *via = (places @ np.array([[cos, sin], [-sin, cos]])).tolist()
    route = {"start": start, "via": via, "closed": True}
    by_time, by_length = duration("time", route), duration("length", route)
    assert by_time <= MOST_LATER * by_length
