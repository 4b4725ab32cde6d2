"""Where on its path a robot is, by what was measured."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.robot.navigation.progress import SAME_PLACE_M, Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.navigation.track_path import beyond_corner, project, track
from viaspline.robot.simulator import simulate
from viaspline.robot.state import RobotState

MISSION = Mission.model_validate(
    {"route": {"start": [0, 0], "via": [[20, 8], [40, -8]], "goal": [60, 0]}}
)


@pytest.fixture(scope="module")
def schedule() -> Schedule:
    made = plan(MISSION)
    return Schedule(made.path, made.trajectory, laid_in=made.world)


@given(st.floats(5, 55), st.floats(-2, 2))
def test_the_nearest_place_is_that_of_a_dense_sample(
    schedule: Schedule, at: float, aside: float
) -> None:
    place = np.asarray(schedule.path.at_distance(at)) + np.array((0.0, aside))
    low, high = at - 3.0, at + 3.0
    distance, gap = project(schedule.path, tuple(place.tolist()), low, high)
    along = np.linspace(low, high, 20_001)
    gaps = np.linalg.norm(np.asarray(schedule.path.at_distance(along)) - place, axis=1)
    assert low <= distance <= high
    assert gaps.min() - (along[1] - along[0]) <= gap <= gaps.min() + 1e-6
    assert gap == pytest.approx(math.dist(schedule.place(distance), place), abs=1e-12)


def test_a_robot_where_it_should_be_is_on_time(schedule: Schedule) -> None:
    should = float(schedule.trajectory.distance_at(9.0))
    measured = RobotState(schedule.place(should), 0.0, 2.0)
    progress, after = track(Progress(time=0.0), schedule, measured, 9.0)
    assert progress == Progress(time=9.0, distance=should)
    assert after is schedule


def test_a_robot_beside_its_path_is_on_time_and_says_how_far_beside(schedule: Schedule) -> None:
    should = float(schedule.trajectory.distance_at(9.0))
    heading = float(schedule.path.heading(float(schedule.path.parameter(should))))
    x, y = schedule.place(should)
    beside = (x - 0.3 * math.sin(heading), y + 0.3 * math.cos(heading))
    progress, _ = track(Progress(time=0.0), schedule, RobotState(beside, heading, 2.0), 9.0)
    assert progress.distance == should
    assert progress.along_track == 0.0
    assert progress.cross_track == pytest.approx(0.3, abs=1e-2)


def test_a_robot_that_lags_is_where_it_is_and_says_how_far_behind(schedule: Schedule) -> None:
    should = float(schedule.trajectory.distance_at(9.0))
    measured = RobotState(schedule.place(should - 2.0), 0.0, 2.0)
    progress, _ = track(Progress(time=0.0), schedule, measured, 9.0)
    assert progress.distance == pytest.approx(should - 2.0, abs=1e-5)
    assert progress.along_track == pytest.approx(-2.0, abs=1e-5)


def test_progress_never_goes_back(schedule: Schedule) -> None:
    should = float(schedule.trajectory.distance_at(9.0))
    measured = RobotState(schedule.place(should - 5.0), 0.0, 2.0)
    progress, _ = track(Progress(time=8.9, distance=should - 1.0), schedule, measured, 9.0)
    assert progress.distance == pytest.approx(should - 1.0, abs=1e-5)


def test_a_robot_at_a_corner_is_beyond_it(schedule: Schedule) -> None:
    """Before it, it looked the way that it came, and waited for ever to have turned."""
    corner = replace(schedule, turns=(2.0,))
    for distance in (2.0 - SAME_PLACE_M, 2.0, 2.0 + SAME_PLACE_M):
        beyond = beyond_corner(corner, distance)
        assert 2.0 < beyond <= 2.0 + SAME_PLACE_M
        assert beyond >= distance
    for distance in (1.9, 2.1):
        assert beyond_corner(corner, distance) == distance


def test_a_robot_that_rolls_on_at_every_stop_goes_on_from_where_it_is() -> None:
    """By a narrow lidar it goes on in small steps, and each had brought it a little farther."""
    wheels = {"differential": {"track_m": 0.4}, "delay_s": 0.1, "lag_s": 0.1}
    robot = {
        "radius_m": 0.3, "clearance_m": 0.1, "max_speed_mps": 1.5, "drive": wheels,
        "sensor": {"lidar": {"range_m": 4, "fov_deg": 120}},
    }  # fmt: skip
    route = {"start": {"at": [0, 0], "heading_deg": 0}, "goal": [3, 0]}
    run = simulate(Mission.model_validate({"robot": robot, "route": route}))
    stops = np.flatnonzero(np.diff((run.speeds > 0.02).astype(int)) == -1)
    assert run.reached
    assert len(stops) > 2
    assert not run.excesses
