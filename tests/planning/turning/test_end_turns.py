"""Turns into given headings: to the side, and as wide, as is driven soonest."""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.checking.driving_time import leg_time
from viaspline.planning.problem.path_pace import Pace
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.turning.bend_row import HEADING, Bends, bend
from viaspline.planning.turning.end_turns import soonest_end_turns
from viaspline.planning.turning.turn_path import with_sides
from viaspline.planning.turning.wide_turns import WideTurns

PACE = Pace(speed=2.0, accel=1.0, brake=1.0, lateral=0.5)
TURNS = WideTurns(PACE, least=0.5, sharpest=0.5, roomy=0.5, own=0.5)
NEEDS = Requirements(radius=0.5, clearance=0.5)


@cache
def open_world() -> vs.World:
    return vs.World([])


def row(*places: tuple[float, float], leaves: float = math.nan, comes: float = math.nan) -> Bends:
    """Via points, with the headings at their ends [rad]."""
    rows = np.array([bend(*place) for place in places])
    rows[0, HEADING], rows[-1, HEADING] = leaves, comes
    return Bends.free(rows, np.arange(len(places)))


def test_a_robot_that_stops_turns_narrowly_into_its_heading() -> None:
    bends = row((0.0, 0.0), (60.0, 0.0), comes=math.radians(60))
    stops = soonest_end_turns(TURNS, bends, open_world(), NEEDS, (False, True))
    goes_on = soonest_end_turns(TURNS, bends, open_world(), NEEDS, (False, False))
    assert stops is not None
    assert goes_on is not None
    assert stops.length < goes_on.length - 0.3
    assert leg_time(stops.spans, PACE, (False, True)) < leg_time(goes_on.spans, PACE, (False, True))


@settings(max_examples=40, deadline=None)
@given(
    st.floats(-math.pi, math.pi), st.floats(-math.pi, math.pi), st.floats(-math.pi, math.pi),
    st.floats(15.0, 80.0), st.booleans(), st.booleans(),
)  # fmt: skip
def test_no_side_and_no_width_between_is_much_sooner(
    leaves: float, comes: float, towards: float, far: float, begins: bool, ends: bool
) -> None:
    goal = far * math.cos(towards), far * math.sin(towards)
    bends, rests = row((0.0, 0.0), goal, leaves=leaves, comes=comes), (begins, ends)
    found = soonest_end_turns(TURNS, bends, open_world(), NEEDS, rests)
    assert found is not None
    time = leg_time(found.spans, PACE, rests)
    for sided in with_sides(bends):
        wide = TURNS.narrowed(sided, open_world(), NEEDS)
        assert wide is None or time <= 1.003 * leg_time(wide.spans, PACE, rests)


@pytest.mark.parametrize("heading", [10, 45, 90, 150, -120])
def test_a_given_heading_at_the_goal_costs_little_time(heading: float) -> None:
    def planned(**more: Any) -> float:
        mission = vs.Mission.model_validate(
            {
                "world": {"known": [{"circle": {"center": [30, 0.5], "radius": 5}}]},
                "robot": {"radius_m": 0.5, "clearance_m": 0.5, "max_speed_mps": 2,
                          "max_accel_mps2": 1, "max_lateral_accel_mps2": 0.5},
                "route": {"start": [0, 0], "goal": {"at": [100, 0], **more}},
            }
        )  # fmt: skip
        return vs.plan(mission).trajectory.duration

    assert planned(heading_deg=heading) < planned() + 0.04 * abs(heading)
