"""Where a robot under way can stop and turn off, and up to where its path is free."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.machine.machine_limits import limits_of
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planner import plan
from viaspline.robot.navigation.drive_task import DriveTask, requirements_under_way
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Dwell, Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.replanning.replan_context import Obstruction, ReplanContext
from viaspline.world.world import World

MISSION = Mission.model_validate(
    {
        "robot": {"sensor": {"range_m": 20}},
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


def test_a_robot_stops_by_its_brake_and_leaves_after_its_reaction(context: ReplanContext) -> None:
    here, speed = context.progress.distance, context.speed
    assert speed == pytest.approx(2.0)
    assert context.stop == pytest.approx(here + speed**2 / (2.0 * TASK.limits.brake))
    reaction = 0.1 * speed  # it leaves then, or where it may be slow enough for a sharper bend
    assert context.leaves == pytest.approx((here + reaction, context.stop + reaction))
    assert context.here == pytest.approx(context.schedule.place(here))
    assert [via.name for via, _ in context.vias_ahead] == ["via 1", "goal"]


def test_a_robot_at_a_station_stands(context: ReplanContext) -> None:
    stay = replace(context.progress, dwell=Dwell("pump", context.here, until=99.0))
    at_rest = ReplanContext.of(TASK, stay, context.knowledge, context.schedule)
    assert at_rest.speed == 0.0
    assert at_rest.stop == context.progress.distance
    assert at_rest.leaves == (context.progress.distance,)


@given(st.floats(22, 60), st.floats(-6, 6), st.floats(0.2, 3))
def test_up_to_where_it_is_free_nothing_is_too_near_and_in_the_span_after_it_something_is(
    context: ReplanContext, x: float, y: float, radius: float
) -> None:
    rock = World([Obstacle.model_validate({"circle": {"center": (x, y), "radius": radius}})])
    path, required = context.schedule.path, TASK.requirements.required
    along = np.linspace(context.progress.distance, path.length, 4001)
    gaps = rock.distance(path.at_distance(along)) - required
    free = context.free_until(rock)
    if free is None:
        assert gaps.min() > -1e-6
        return
    before = gaps[along < free]
    assert not before.size or before.min() > -1e-6
    blocked = replace(context, obstruction=Obstruction(rock, ("rock",), free))
    assert blocked.is_clear(free - 1e-3)
    assert not blocked.is_clear(path.length)
    assert gaps.min() < 1e-2


def test_a_place_where_it_turns_on_the_spot_is_not_left_under_way(context: ReplanContext) -> None:
    assert context.clear_leaves() == list(context.leaves)
    turning = replace(context, schedule=replace(context.schedule, turns=context.leaves))
    assert turning.clear_leaves() == []
