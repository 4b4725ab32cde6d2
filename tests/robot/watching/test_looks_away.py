"""A robot that can't turn on the spot and is set down looking another way than its path."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigator import Navigator
from viaspline.robot.state import RobotState
from viaspline.robot.watching.looks_away import looks_away_by, ways_to_path

STEERED = {"ackermann": {"wheelbase_m": 0.5, "max_steer_deg": 30}}


def line() -> Path:
    return Path([[[0, 0], [9, 0], [18, 0], [27, 0]]], vias=[])


def post(x: float, y: float, radius: float = 0.5) -> Obstacle:
    return Obstacle(circle={"center": (x, y), "radius": radius})


def mission(*known: Obstacle, **robot: Any) -> Mission:
    body = {"radius_m": 0.2, "clearance_m": 0.3, "max_speed_mps": 1.0, "tracking_error_m": 0.05}
    return Mission.model_validate(
        {
            "world": {"known": known},
            "robot": {**body, "drive": STEERED, **robot},
            "route": {"start": [0, 0], "goal": [12, 0]},
        }
    )


@given(
    heading=st.floats(-math.pi, math.pi),
    at=st.tuples(st.floats(1.2, 3.0), st.floats(-math.pi, math.pi)),
)
@example(heading=1.5, at=(1.2, 1.571))  # it came to 0.03 m of the post
@settings(deadline=None, max_examples=8)
def test_it_comes_to_its_path_clear_of_all_or_stands_and_says_why(
    loop: Any, cart_of: Any, heading: float, at: tuple[float, float]
) -> None:
    one = post(at[0] * math.cos(at[1]), at[0] * math.sin(at[1]))
    cart = cart_of()
    cart.state = RobotState((0.0, 0.0), heading, 0.0)
    done = loop(Navigator(mission(one)), cart)
    assert done.gap([one], 0.2) > 0.3 - 0.05 - 0.01
    if not done.nav.reached and "deviation" in done.kinds:
        assert done.first("deviation").data["outcome"] in ("stops", "returns")
        assert "route.start.heading_deg" in done.nav.reason


def test_it_goes_on_where_there_is_room_and_keeps_no_more_for_that(loop: Any, cart_of: Any) -> None:
    cart = cart_of()
    cart.state = RobotState((0.0, 0.0), 2.0, 0.0)
    done = loop(Navigator(mission()), cart)
    assert done.nav.reached
    assert done.kinds.count("deviation") == 1
    assert done.first("deviation").message.startswith("looks 115° away from its path, 1.2")
    assert done.nav.allowance == 0.05


@given(
    angle=st.floats(-3.1, 3.1).filter(lambda one: abs(one) > 0.1),
    radius=st.floats(0.5, 5.0),
    at=st.floats(0.0, 20.0),
)
@example(angle=math.pi / 2, radius=2.0, at=1.0)
@settings(deadline=None, max_examples=30)
def test_the_ways_are_arcs_that_end_along_the_path(angle: float, radius: float, at: float) -> None:
    stands = RobotState((at, 0.0), angle, 0.0)
    places = ways_to_path(line(), at, stands, angle, radius, over=1.0)
    steps = np.diff(places[:33], axis=0)
    assert math.hypot(*steps[0]) > 0.0
    first = math.atan2(steps[0, 1], steps[0, 0])
    assert abs(math.remainder(first - angle, math.tau)) < abs(angle) / 32
    assert places[0].tolist() == [at, 0.0]
    assert abs(places[32, 1]) == abs(places[:33, 1]).max() or abs(angle) > math.pi / 2
    assert math.isclose(abs(places[32, 1]), radius * (1.0 - math.cos(angle)), rel_tol=1e-6)


def test_who_turns_on_the_spot_or_looks_nearly_along_does_not_look_away() -> None:
    steered = RobotSpec(drive=STEERED)
    for robot, angle, away in (
        (steered, 1.0, 1.0),
        (steered, 0.3, 0.0),
        (RobotSpec(drive={"differential": {"track_m": 0.5}}), 1.0, 0.0),
        (RobotSpec(), 1.0, 0.0),
        (RobotSpec(min_turn_radius_m=2.0, turn_on_spot="never"), -2.0, -2.0),
        (RobotSpec(drive=STEERED, localization={"heading_noise_deg": 30}), 1.0, 0.0),
    ):
        state = RobotState((3.0, 0.0), angle, 0.0)
        assert looks_away_by(robot, line(), 3.0, state) == away
