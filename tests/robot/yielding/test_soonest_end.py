"""No time law ends before what is told of a path, so that none is missed that would be taken."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import viaspline as vs
from viaspline.curve.path import Path
from viaspline.machine.machine_limits import limits_of
from viaspline.planner import plan
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.robot.navigation.drive_task import DriveTask, requirements_under_way
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.perception.belief import Belief
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.yielding import ways_past
from viaspline.robot.yielding.soonest_end import least_time, soonest_end
from viaspline.robot.yielding.swerves import Swerves
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.retime import retime
from viaspline.world.world import World

MISSION = vs.Mission.model_validate(
    {
        "robot": {"sensor": {"range_m": 20}, "max_speed_mps": 2, "max_accel_mps2": 1},
        "route": {"start": [0, 0], "via": [[30, 6]], "goal": [60, 0]},
    }
)
TASK = DriveTask(
    MISSION, requirements_under_way(MISSION, 0.0), limits_of(MISSION.robot), reaction=0.1
)


@pytest.fixture(scope="module")
def context() -> ReplanContext:
    made = plan(MISSION)
    progress = Progress(10.0, float(made.trajectory.distance_at(10.0)), last_via=0)
    schedule = Schedule(made.path, made.trajectory, laid_in=made.world)
    return ReplanContext.of(TASK, progress, Knowledge(made.world, frozenset()), schedule)


@given(st.floats(0.05, 60.0), st.floats(0.0, 1.0), st.floats(0.2, 3.0), st.floats(0.2, 3.0))
def test_the_fastest_law_on_a_straight_way_takes_just_the_least_time(
    length: float, share: float, accel: float, brake: float
) -> None:
    limits = Limits(max_speed=2.0, max_accel=accel, max_brake=brake)
    speed = share * min(2.0, 0.999 * math.sqrt(2.0 * brake * length))
    line = Path(np.linspace((0.0, 0.0), (length, 0.0), 4)[None], vias=[])
    law = retime(line, limits, start_speed=speed)
    assert least_time(limits, length, speed) == pytest.approx(law.duration, rel=1e-9, abs=1e-6)


@given(st.floats(1.0, 12.0), st.floats(-6.0, 6.0), st.floats(0.0, 3.0))
def test_a_law_in_bends_takes_no_less_however_fast_it_begins(
    ahead: float, aside: float, speed: float
) -> None:
    limits = Limits(max_speed=2.0, max_accel=1.0, max_lateral_accel=1.0)
    bent = Path([[[0, 0], [ahead, 0], [ahead, aside], [2.0 * ahead, aside]]], vias=[])
    room = math.sqrt(2.0 * bent.length)
    law = retime(bent, limits, start_speed=min(speed, 0.999 * room))
    least = least_time(limits, bent.length, min(speed, 0.999 * room))
    assert least <= law.duration + 1e-6


def test_a_way_too_short_to_stop_on_takes_no_less_than_at_full_speed() -> None:
    assert least_time(Limits(max_speed=2.0, max_accel=1.0), 1.0, 2.0) == 0.5


def test_a_robot_under_way_is_at_the_end_of_its_plan_when_that_says(context: ReplanContext) -> None:
    law = context.schedule.trajectory
    assert law.end_time - 0.5 < soonest_end(context, context.schedule.path) < law.end_time


def test_nothing_is_said_where_a_law_may_end_before_its_path(context: ReplanContext) -> None:
    path = context.schedule.path
    lidar = vs.Mission.model_validate(
        {
            "robot": {"sensor": {"lidar": {"range_m": 10}}},
            "route": {"start": [0, 0], "goal": [9, 0]},
        }
    )
    belief = Belief.at_start(World(), lidar.robot)
    by_lidar = replace(context, knowledge=replace(context.knowledge, belief=belief))
    assert soonest_end(by_lidar, path) == -math.inf
    committed = replace(context, schedule=replace(context.schedule, committed_until=11.0))
    assert soonest_end(committed, path) == -math.inf


def test_a_way_is_timed_if_it_may_be_soon_enough_and_left_out_if_it_cannot(
    context: ReplanContext, monkeypatch: pytest.MonkeyPatch
) -> None:
    timed: list[Path] = []

    def driven(_: ReplanContext, solution: Any) -> None:
        timed.append(solution.path)

    monkeypatch.setattr(ways_past, "driven", driven)
    path = context.schedule.path
    monkeypatch.setattr(ways_past, "meeting_ahead", lambda *_: SimpleNamespace())
    paths: Any = Swerves(context)
    monkeypatch.setattr(Swerves, "path", lambda *_: SimpleNamespace(path=path))
    monkeypatch.setattr(Swerves, "fastest", lambda *_: SimpleNamespace(end_time=-math.inf))
    soonest, spent = soonest_end(context, path), []
    for before in (soonest, soonest + 1e-3):
        budget = WorkBudget(1.0)
        first, *_ = ways_past.ways_past(context, context.schedule.trajectory, paths, before)
        assert first(budget) is None
        spent.append(budget.spent)
        assert timed == ([] if before == soonest else [path])
    assert spent[0] == spent[1] > 0.0
    timed.clear()
    monkeypatch.setattr(Swerves, "fastest", lambda *_: None)
    first, *_ = ways_past.ways_past(context, context.schedule.trajectory, paths, soonest + 1e-3)
    assert first(budget) is None
    assert timed == []  # no law at all: none past what moves is asked for
