"""Whether a robot without a drive turns before it sets off, where it looks another way."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigator import Navigator
from viaspline.robot.state import RobotState

POST = {"name": "post", "circle": {"center": [0, 1.2], "radius": 0.5}}
HUT = {"name": "hut", "circle": {"center": [10, 0.3], "radius": 1}}


def mission(**robot: Any) -> Mission:
    """Past a post, to a station from which the way on is square to the way there."""
    body = {"radius_m": 0.2, "clearance_m": 0.3, "max_speed_mps": 1.0, "tracking_error_m": 0.05}
    return Mission.model_validate(
        {
            "world": {"known": [POST, HUT]},
            "robot": {**body, **robot},
            "route": {"start": [0, 0], "via": [{"at": [5, 0], "dwell_s": 2}], "goal": [5, 5]},
        }
    )


@given(
    heading=st.floats(-3.14, 3.14),
    most=st.sampled_from([None, 20.0, 90.0]),
    period=st.floats(0.03, 0.12),
)
@example(heading=1.5, most=None, period=0.05)  # it came to 0.19 m of the post
@example(heading=3.1, most=60.0, period=0.05)  # it stood for good, beside its path
@settings(deadline=None, max_examples=8)
def test_a_robot_that_looks_another_way_turns_and_stays_on_its_path(
    loop: Any, cart_of: Any, heading: float, most: float | None, period: float
) -> None:
    """The cart obeys velocity and yaw rate, as the README has it, and nothing else."""
    asked = mission(max_yaw_rate_degps=most)
    cart = cart_of()
    cart.state = RobotState((0.0, 0.0), heading, 0.0)
    done = loop(Navigator(asked), cart, period=lambda _: period)
    obstacles = [one for one in asked.world.known if isinstance(one, Obstacle)]
    assert done.nav.reached
    assert "deviation" not in done.kinds
    assert done.gap(obstacles, 0.2) > 0.3 - 0.05


def test_it_turns_before_it_leaves_a_rest_that_its_law_only_touches(
    loop: Any, cart_of: Any
) -> None:
    """A way on from rest led back where the robot came, and it drove on to what it braked for."""
    wall = Obstacle(name="wall", polygon=[(20, -4), (20.5, -4), (20.5, 4), (20, 4)])
    robot = {"radius_m": 0.2, "clearance_m": 0.2, "max_speed_mps": 3.0, "tracking_error_m": 0.1}
    asked = Mission.model_validate(
        {
            "world": {"unseen": [wall]},
            "robot": {**robot, "sensor": {"range_m": 4.0}},
            "route": {"start": {"at": [0, 0], "heading_deg": 0}, "goal": [40, 0]},
        }
    )

    def sense(state: RobotState, *_: Any) -> list[Obstacle]:
        return [wall] if 20.0 - state.position[0] <= 4.0 else []

    done = loop(Navigator(asked), cart_of(), sense=sense)
    assert done.nav.reached
    assert "deviation" not in done.kinds
    assert "from_rest" in [replan.mode for replan in done.book.replans]
    beside = [x for _, x, y, _ in done.track.tolist() if abs(y) <= 4.0 and x < 20.25]
    assert max(beside) < 20.0 - 0.2 - 0.2 + 0.1


def test_it_is_not_waited_for_longer_than_a_turn_takes(loop: Any, cart_of: Any) -> None:
    """One that holds its heading, whatever it is told, isn't held up for ever."""
    nav, state, time = Navigator(mission()), RobotState((0.0, 0.0), 2.0, 0.0), 0.0
    while not nav.finished and time < 60.0:
        command, nav = nav.step(state, [], time)
        ahead = command.speed * 0.05  # as a trolley on rails goes
        place = nav.path.at_distance(min(command.distance + ahead, nav.path.length))
        state, time = (
            replace(state, position=tuple(place.tolist()), speed=command.speed),
            time + 0.05,
        )
    assert nav.reached
    assert 14.2 + 5.0 < time < 14.2 + 2 * (2.0 + 1.5 * math.pi) + 1.0


@pytest.mark.parametrize("keys", [{"turn_on_spot": "never"}, {}])
def test_a_robot_that_follows_exactly_is_not_held_up(keys: dict[str, Any]) -> None:
    nav = Navigator(mission(**keys))
    end, time = nav.trajectory.end_time, 0.0
    while not nav.finished:
        command, nav = nav.step(nav.reference(time), [], time)
        held = command.velocity[0]
        assert command.yaw_rate == pytest.approx(held * command.curvature, abs=1e-9)
        time += 0.05
    assert nav.trajectory.end_time == end
    assert time == pytest.approx(end, abs=0.11)


def test_the_command_says_so_while_it_stands() -> None:
    nav = Navigator(mission())
    state = replace(nav.reference(0.0), heading=nav.reference(0.0).heading + 2.0)
    for k in range(10):
        command, nav = nav.step(state, [], 0.05 * k)
        assert command.velocity == (0.0, 0.0)
        assert command.yaw_rate == -1.0
    lagging = replace(state, heading=state.heading - 2.0 + 0.01)
    command, nav = nav.step(lagging, [], 0.5)
    command, nav = nav.step(lagging, [], 0.55)
    assert command.velocity[0] > 0.0
    assert math.isclose(nav.trajectory.start_time, 0.45)
