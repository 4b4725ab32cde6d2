"""Where on its path a robot is, by what was measured."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.navigation.track_path import project, track
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
