"""Where laws are dear they are found for a part of the path, and not at every look."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.mission.model import Mission
from viaspline.robot.navigation.law_horizon import (
    RENEWAL_S,
    is_in_parts,
    reach_ahead,
    reach_of_all,
    renewed_at,
)
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.trajectory.retime import retime

Make = Callable[..., Mission]
STEP, TURN_DEGPS2 = 0.05, 30.0
LIDAR = {"lidar": {"range_m": 60, "beams": 90}}
DEAR = ({"max_jerk_mps3": 1.0}, {"max_yaw_accel_degps2": TURN_DEGPS2})


def drive(mission: Mission, ticks: int = 2000) -> list[Navigator]:
    """The navigator after every step of a robot that follows exactly."""
    sensor = LidarSensor((), mission.robot.sensor.lidar)
    nav, navs = Navigator(mission), []
    for tick in range(ticks):
        state = nav.reference(tick * STEP)
        scan = sensor.scan(state.position, state.heading, tick)
        _, nav = nav.step(state, scan, tick * STEP)
        navs.append(nav)
        if nav.finished:
            break
    return navs


@pytest.mark.parametrize("limit", DEAR)
def test_a_dear_law_reaches_as_far_as_the_robot_can_use_however_long_the_path_is(
    mission_of: Make, limit: dict[str, float]
) -> None:
    reaches = []
    for length in (60, 600):
        nav = Navigator(mission_of([0, 0], [length / 2, 4], [length, 0], **limit))
        task, schedule = nav._task, nav._state.schedule
        assert is_in_parts(task.limits, schedule.path)
        assert math.isinf(reach_of_all(schedule))
        reaches.append(reach_ahead(task, schedule))
    assert reaches[0] == reaches[1] < 20.0


def test_a_cheap_law_is_for_all_of_the_path_and_never_ends_too_soon(mission_of: Make) -> None:
    nav = Navigator(mission_of([0, 0], [30, 4], [60, 0], max_lateral_accel_mps2=0.5))
    task, state = nav._task, nav._state
    assert not is_in_parts(task.limits, state.schedule.path)
    assert math.isinf(reach_ahead(task, state.schedule))
    assert math.isinf(renewed_at(task, state.knowledge, state.schedule))


def test_with_a_limit_of_the_yaw_acceleration_a_look_times_no_more_than_a_part(
    mission_of: Make,
) -> None:
    """Each look timed all of the way that was seen: 0.1 s on a path of some hundred metres."""
    limit = {"max_yaw_accel_degps2": TURN_DEGPS2}
    mission = mission_of([0, 0], [20, 5], [40, 0], [60, 5], sensor=LIDAR, **limit)
    navs = drive(mission, ticks=200)
    reach = reach_ahead(navs[0]._task, navs[0]._state.schedule)
    for nav in navs:
        assert float(nav.trajectory.distances[-1]) - nav.distance <= reach + 1e-6
    changed = sum(a.trajectory is not b.trajectory for a, b in pairwise(navs))
    assert changed <= len(navs) * STEP / RENEWAL_S + 5


def test_from_part_to_part_the_yaw_acceleration_keeps_its_limit(mission_of: Make) -> None:
    limit: dict[str, Any] = {"max_yaw_accel_degps2": TURN_DEGPS2, "max_lateral_accel_mps2": 0.8}
    navs = drive(mission_of([0, 0], [12, 5], [24, 0], sensor=LIDAR, **limit))
    assert navs[-1].reached, navs[-1].reason
    rates, fine = [], np.arange(0.0, STEP - 1e-9, STEP / 5)
    for tick, nav in enumerate(navs[:-1]):
        place, speed, _ = nav.trajectory.state_at(tick * STEP + fine)
        bend = nav.path.curvature(nav.path.parameter(np.minimum(place, nav.path.length)))
        rates.append(np.asarray(speed) * np.asarray(bend))
    turned = np.diff(np.concatenate(rates)) / (STEP / 5)
    assert np.abs(turned).max() <= math.radians(TURN_DEGPS2) * 1.02


def test_in_parts_a_drive_takes_no_longer_than_by_one_law(mission_of: Make) -> None:
    limit: dict[str, Any] = {"max_yaw_accel_degps2": TURN_DEGPS2, "max_lateral_accel_mps2": 0.8}
    points = ([0, 0], [12, 5], [24, 0])
    planned = Navigator(mission_of(*points, **limit)).trajectory.duration
    navs = drive(mission_of(*points, sensor=LIDAR, **limit))
    assert len(navs) * STEP <= planned * 1.03 + 0.5


def test_where_a_path_bends_at_once_a_law_under_way_has_few_points_and_is_no_slower() -> None:
    """A law had 1,860 while its part ended by its length alone; the drive took 18.9 s."""
    robot = {
        "max_speed_mps": 0.9, "max_accel_mps2": 0.6, "max_jerk_mps3": 2.0, "sensor": LIDAR,
        "max_yaw_accel_degps2": 45.0, "max_lateral_accel_mps2": 1.4,
    }  # fmt: skip
    route = {"start": [0, 0], "via": [[4, 0], [4.2, 0.4]], "goal": [0, 1]}
    data = {"world": {}, "robot": robot, "route": route, "spline": {"tension": 0.93}}
    navs = drive(Mission.model_validate(data))
    assert navs[-1].reached, navs[-1].reason
    renewed = [b.trajectory for a, b in pairwise(navs) if b.trajectory is not a.trajectory]
    assert max(law.times.size for law in renewed) < 1000
    assert len(navs) * STEP <= 18.9 * 1.03


@given(st.floats(0.5, 3.0), st.floats(0.3, 2.0), st.floats(0.3, 1.0))
@example(2.0, 0.8, 0.7)  # was known at its very end alone: a rounding less than by the limit
@settings(max_examples=20, deadline=None)
def test_a_part_is_renewed_before_the_robot_brakes_for_its_end(
    speed: float, brake: float, across: float
) -> None:
    wheels = {
        "max_speed_along_mps": speed, "max_speed_across_mps": across * speed,
        "hold_heading_deg": 20,
    }  # fmt: skip
    robot = {
        "max_speed_mps": speed, "max_accel_mps2": brake, "drive": {"omnidirectional": wheels},
        "tracking_error_m": 0.05,
    }  # fmt: skip
    route = {"start": [0, 0], "goal": [100, 0]}
    nav = Navigator(Mission.model_validate({"route": route, "robot": robot}))
    task, state = nav._task, nav._state
    law = retime(Path([[(k * 40 / 3, 0.0) for k in range(4)]], []), task.limits)
    brakes = law.end_time - law.speeds.max() / brake  # at full speed, as hard as it may
    schedule = replace(state.schedule, trajectory=law)
    sooner = brakes - renewed_at(task, state.knowledge, schedule)
    assert 0.8 * RENEWAL_S <= sooner <= RENEWAL_S + 0.1 * (law.end_time - brakes) + 0.05
