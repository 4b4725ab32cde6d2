"""A robot passes what it knows on the side that it meant to."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigator import Navigator

Make = Callable[..., Mission]
Shape = Callable[..., dict[str, Any]]
Drive = Callable[..., tuple[Navigator, list[Navigator]]]
SidesAt = Callable[[Sequence[Navigator], float], list[int]]
LIDAR = {"range_m": 6.0, "fov_deg": 270.0, "beams": 541}
ROBOT = {"radius_m": 0.3, "clearance_m": 0.1, "sensor": {"lidar": LIDAR}}
STEP = 0.05


def changes(values: Sequence[int]) -> int:
    return sum(a != b for a, b in itertools.pairwise(values))


def test_a_wall_straight_ahead_is_passed_on_one_side(
    drive: Drive, sides_at: SidesAt, mission_of: Make, box_at: Shape
) -> None:
    wall = box_at(12, -7, 12.4, 7.02, "wall")
    mission = mission_of([0, 0], [24, 0], unseen=[wall], **ROBOT)
    nav, states = drive(mission, lambda _: mission.world.unseen)
    assert nav.reached, nav.reason
    assert changes(sides_at(states, 12.2)) <= 1


@pytest.mark.parametrize("period", [1, 3])
def test_a_sensor_that_flickers_makes_no_oscillation(
    drive: Drive, sides_at: SidesAt, mission_of: Make, disc_at: Shape, period: int
) -> None:
    mission = mission_of([0, 0], [20, 0], unseen=[disc_at(10, 0.0, 1)], **ROBOT)
    post = mission.world.unseen
    nav, states = drive(mission, lambda time: post if round(time / STEP) // period % 2 else ())
    assert nav.reached, nav.reason
    assert sum(len(nav.replans) for nav in states) <= 8
    assert changes(sides_at(states, 10.0)) == 0


def test_a_side_that_a_step_has_no_time_to_compare_is_asked_about_first_in_the_next(
    drive: Drive, mission_of: Make, disc_at: Shape
) -> None:
    mission = mission_of([0, 0], [20, 0], unseen=[disc_at(10, -0.02, 2.5)], **ROBOT)
    route = mission.route.model_copy(update={"detours": "local"})  # which is the longer search
    mission = mission.model_copy(update={"route": route})
    post = mission.world.unseen
    _, states = drive(mission, lambda time: post if round(time / STEP) // 3 % 2 else ())
    pending = [nav._state.schedule.pending for nav in states]
    doubts = [one.doubt for one in pending if one is not None and one.doubt is not None]
    assert doubts
    assert all(one.is_open and one.side == "right" for one in doubts)  # it meant that one
    x, y = np.array([one.place for one in doubts]).T
    assert np.hypot(x - 10.0, y).max() < 2.6  # which is on the post


def test_a_thing_that_is_told_again_and_again_a_little_elsewhere_makes_no_oscillation(
    sides_at: SidesAt, mission_of: Make, disc_at: Shape
) -> None:
    mission = mission_of([0, 0], [60, 0], sensor={"range_m": 25.0})
    nav, states, rng = Navigator(mission), [], np.random.default_rng(0)
    for tick in range(2000):
        state = nav.reference(tick * 0.1)
        near = abs(state.position[0] - 30.0) < 20.0
        place = (30.0 + rng.normal(0, 0.05), rng.normal(0, 0.05), 2.0)
        told = [Obstacle.model_validate(disc_at(*place))] if near and tick % 2 else []
        _, nav = nav.step(state, told, tick * 0.1)
        states.append(nav)
        if nav.finished:
            break
    assert nav.reached, nav.reason
    assert changes(sides_at(states, 30.0)) == 0
