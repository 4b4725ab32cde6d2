"""What a control loop tells of what moves: sense by any clock, nonsense refused by name."""

from __future__ import annotations

import math
from typing import Any

import pytest

import viaspline as vs
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.moving.motion_sensor import MovingSighting

CART = Obstacle.model_validate({"name": "cart", "circle": {"center": (0, 0), "radius": 0.4}})
STATE = vs.RobotState(position=(0.0, 0.0), heading=0.0, speed=0.0)


@pytest.fixture(scope="module")
def at_start() -> vs.Navigator:
    robot = {
        "radius_m": 0.25,
        "sensor": {"range_m": 10},
        "moving": {"max_speed_mps": 2, "safety": "passive"},
    }
    route = {"start": (0, 0), "goal": (15, 0)}
    return vs.Navigator(vs.Mission.model_validate({"robot": robot, "route": route}))


def crossing(nav: vs.Navigator, begin: float) -> list[float]:
    speeds = []
    for i in range(20):
        seen = MovingSighting(0, CART, (8.0, 3.0 - 0.05 * i, 0.0), (0.0, -1.0))
        command, nav = nav.step(STATE, [seen], begin + 0.05 * i)
        speeds.append(command.speed)
    return speeds


@pytest.mark.parametrize("begin", [1.7e9, -1.7e9])
def test_the_clock_may_count_from_1970(at_start: vs.Navigator, begin: float) -> None:
    """A bare traceback: no mission's clock goes so far, but a control loop's does."""
    assert crossing(at_start, begin) == pytest.approx(crossing(at_start, 0.0), abs=1e-5)


@pytest.mark.parametrize("begin", [1e300, -1e300, math.nan, math.inf])
def test_a_clock_by_which_no_step_can_be_told_is_refused(
    at_start: vs.Navigator, begin: float
) -> None:
    with pytest.raises(vs.GeometryError, match="time"):
        at_start.step(STATE, [MovingSighting(0, CART, (5, 3, 0), (0, -1))], begin)


def test_time_that_runs_backwards_or_stands_still_stops_nothing_for_good(
    at_start: vs.Navigator,
) -> None:
    def seen(y: float) -> list[MovingSighting]:
        return [MovingSighting(0, CART, (5.0, y, 0.0), (0.0, -1.0))]

    _, nav = at_start.step(STATE, seen(3.0), 1.0)
    _, back = nav.step(STATE, seen(3.0), 0.5)
    assert [event.kind for event in back.events] == ["clock"]
    _, on = back.step(STATE, seen(2.9), 1.1)
    assert not on.finished
    _, same = nav.step(STATE, seen(3.0), 1.0)
    assert not same.finished
    _, jumped = same.step(STATE, seen(1.0), 1.0)
    assert ["jumped" in event.message for event in jumped.events] == [True]


@pytest.mark.parametrize(
    ("frame", "velocity", "words"),
    [
        ((5, 3, 0), (math.nan, 0), "finite numbers"),
        ((5, 3, 0), (1e300, 0), "nothing goes over 10000 m/s"),
        ((5, 3, 0), (8e3, 8e3), "nothing goes over 10000 m/s"),
        ((5e300, 3, 0), (0, 0), "give a place within"),
    ],
)
def test_a_sighting_of_what_there_is_not_is_refused(
    frame: tuple[float, ...], velocity: tuple[float, ...], words: str
) -> None:
    with pytest.raises(vs.GeometryError, match=words):
        MovingSighting(0, CART, frame, velocity)  # type: ignore[arg-type]


def test_what_goes_as_fast_as_anything_is_reckoned_with(at_start: vs.Navigator) -> None:
    nav = at_start
    for i in range(4):
        seen = MovingSighting(0, CART, (5.0 + 500.0 * i, 3.0, 0.0), (1e4, 0.0))
        command, nav = nav.step(STATE, [seen], 0.05 * i)
    assert math.isfinite(command.speed)


def test_one_thing_is_told_of_once_in_a_look(at_start: vs.Navigator) -> None:
    twice = [MovingSighting(3, CART, (5, y, 0), (0, 0)) for y in (3, -3)]
    with pytest.raises(vs.GeometryError, match="two sightings of moving thing 3"):
        at_start.step(STATE, twice, 0.0)


def test_an_obstacle_with_a_motion_is_no_sighting(at_start: vs.Navigator) -> None:
    """It was taken to stand where its frame begins, there on the robot."""
    motion: dict[str, Any] = {"keyframes": [(0, 9, 5), (5, 9, -5)], "after": "stay"}
    data = {"circle": {"center": (0, 0), "radius": 0.4}, "motion": motion}
    with pytest.raises(vs.GeometryError, match=r"sensed\[0\] has a motion"):
        at_start.step(STATE, [Obstacle.model_validate(data)], 0.0)


@pytest.mark.parametrize("told_every", [1, 4, 8])
def test_who_follows_things_may_be_slower_than_the_robot_steps(
    at_start: vs.Navigator, told_every: int
) -> None:
    """In each step without news it was forgotten: told of at 2.5 Hz, it was touched at 2 m/s."""
    nav, gaps = at_start, []
    for i in range(200):
        time = 0.05 * i
        place = (7.0, 4.0 - 0.9 * time)
        seen = [MovingSighting(0, CART, (*place, 0.0), (0.0, -0.9))] if i % told_every == 0 else []
        state = nav.reference(time)
        gaps.append(math.dist(state.position, place) - 0.65)
        _, nav = nav.step(state, seen, time)
    assert min(gaps) > 1.0
    assert nav.distance > 5.0
