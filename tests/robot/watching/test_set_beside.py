"""Robots that are pushed beside a post: they get on from there, and touch nothing on their way."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigator import Navigator
from viaspline.robot.state import RobotState
from viaspline.robot.watching.set_beside import way_back

BODY_M = 0.3
PUSHED_AT_S = 6.0


def yard(seed: int, drive: Any, sensed: bool) -> tuple[Mission, list[Obstacle]]:
    """Posts on the way from 0 to 16 m, on the map or in sight of a range sensor."""
    chance = np.random.default_rng(seed)
    posts = [
        {"circle": {"center": chance.uniform((4, -2.5), (13, 2.5)).tolist(), "radius": radius}}
        for radius in chance.uniform(0.1, 0.5, 5).tolist()
    ]
    robot = {"radius_m": BODY_M, "clearance_m": 0.15, "max_speed_mps": 1.0, "drive": drive}
    if sensed:
        robot["sensor"] = {"range_m": 4.0}
    mission = Mission.model_validate(
        {
            "world": {"unseen" if sensed else "known": posts},
            "robot": robot,
            "route": {"start": {"at": [0, 0], "heading_deg": 0}, "goal": [16, 0]},
        }
    )
    return mission, [Obstacle.model_validate(post) for post in posts]


def room(posts: list[Obstacle], at: tuple[float, float]) -> float:
    """Between the body and the nearest post [m]."""
    rounds = [post.circle for post in posts if post.circle is not None]
    return min(math.dist(at, post.center) - post.radius for post in rounds) - BODY_M


def beside_a_post(seed: int, posts: list[Obstacle]) -> tuple[float, float]:
    """A place where the body has little room."""
    chance = np.random.default_rng((seed, 1))
    for _ in range(1000):
        post = posts[chance.integers(len(posts))].circle
        assert post is not None
        away, angle = (
            post.radius + BODY_M + chance.uniform(0.02, 0.1),
            chance.uniform(0.0, math.tau),
        )
        at = (post.center[0] + away * math.cos(angle), post.center[1] + away * math.sin(angle))
        if room(posts, at) > 0.015:
            return at
    raise AssertionError("no place beside a post is free")


@given(
    st.integers(0, 10_000), st.sampled_from([None, {"differential": {"track_m": 0.4}}]),
    st.just(False),
)  # fmt: skip
@example(1, None, False)
@example(1, {"differential": {"track_m": 0.4}}, False)
@example(3, None, True)
@example(148, {"differential": {"track_m": 0.4}}, True)  # what it saw there only came too late
@settings(deadline=None, max_examples=6, suppress_health_check=list(HealthCheck))
def test_one_that_is_pushed_beside_a_post_gets_on_from_there(
    cart_of: Any, loop: Any, seed: int, drive: Any, sensed: bool
) -> None:
    """It stood there for good: straight back to its path something was in its way."""
    mission, posts = yard(seed, drive, sensed)
    cart, place = cart_of(), beside_a_post(seed, posts)
    pushed = False

    def sense(state: RobotState, tick: int, time: float) -> list[Obstacle]:
        return [post for post in posts if sensed and room([post], state.position) <= 3.7]

    def measure(state: RobotState, time: float) -> RobotState:
        nonlocal pushed
        if not pushed and time > PUSHED_AT_S:
            cart.state, pushed = RobotState(place, state.heading, 0.0), True
            cart.driven.append((time, *place, 0.0))
        return cart.state

    done = loop(Navigator(mission, period=0.05), cart, sense=sense, measure=measure)
    assert pushed
    told = [event.message for event in done.book.events]
    assert done.nav.reached or done.nav.reason, told
    since = done.track[done.track[:, 0] > PUSHED_AT_S + 0.05]
    assert min(room(posts, (x, y)) for _, x, y, _ in since.tolist()) > 0.0, told
    assert done.nav.reached, (done.nav.reason, told)


@given(st.floats(0.05, 5.0), st.floats(0.3, 2.0), st.floats(-1.0, 1.0))
def test_the_way_back_ends_on_the_path_and_never_leads_more_steeply_than_the_law(
    off: float, over: float, looks: float
) -> None:
    path = Path([[[0, 0], [30, 0], [60, 0], [90, 0]]], vias=[])
    back = way_back(path, 1.0, np.array([1.0, off]), over, looks=looks)
    assert back[0].tolist() == [1.0, off]
    slopes = np.abs(np.diff(back[:, 1]) / np.diff(back[:, 0]))
    assert slopes.max() <= math.tan(1.0) + 1e-9
    assert abs(back[-1, 1]) <= 0.15 * max(off, over)
