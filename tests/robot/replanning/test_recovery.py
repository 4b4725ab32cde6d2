"""The way out for a robot that stands too close to something, and on from there."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely

from viaspline.machine.machine_limits import limits_of
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planner import plan
from viaspline.robot.navigation.drive_task import DriveTask, requirements_under_way
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import ReducedClearance, Schedule
from viaspline.robot.replanning.first_way_on import first_candidate
from viaspline.robot.replanning.recovery import restore_clearance, way_out
from viaspline.robot.replanning.replan_context import Obstruction, ReplanContext
from viaspline.world.world import World

MISSION = Mission.model_validate(
    {
        "robot": {"radius_m": 0.3, "clearance_m": 0.2},
        "route": {"start": [0, 0], "goal": [20, 0]},
    }
)
TASK = DriveTask(
    MISSION, requirements_under_way(MISSION, 0.0), limits_of(MISSION.robot), reaction=0.1
)
POST = Obstacle.model_validate({"circle": {"center": (0.1, 1.4), "radius": 1.0}, "name": "post"})
GAP = math.hypot(0.1, 1.4) - 1.0
"""Between the robot's centre and the post, where it stands [m]."""


@pytest.fixture(scope="module")
def context() -> ReplanContext:
    made, world = plan(MISSION), World([POST])
    schedule = Schedule(made.path, made.trajectory, laid_in=made.world)
    context = ReplanContext.of(
        TASK, Progress(0.0, last_via=0), Knowledge(world, frozenset()), schedule
    )
    return replace(context, obstruction=Obstruction(world, ("post",), 0.0), floor=GAP - 1e-3)


def gaps(points: np.ndarray) -> np.ndarray:
    """Distances to the post, by shapely."""
    return shapely.distance(shapely.points(points), shapely.Point(0.1, 1.4)) - 1.0


def test_it_goes_straight_to_where_there_is_room_and_keeps_its_clearance_from_there(
    context: ReplanContext,
) -> None:
    required, floor = TASK.requirements.required, GAP - 1e-3
    candidate = way_out(context, TASK.requirements, floor)
    assert candidate is not None
    assert candidate.mode == "from_rest"
    assert candidate.reduced is not None
    assert candidate.reduced.floor == floor
    path, until = candidate.solution.path, candidate.reduced.until
    assert 0.0 < until <= 2.0 * required
    out = np.asarray(path.at_distance(np.linspace(0.0, until, 200)))
    ahead, off = out[-1] - out[0], out - out[0]
    assert np.abs(off[:, 0] * ahead[1] - off[:, 1] * ahead[0]).max() < 1e-9
    assert gaps(out).min() >= floor - 1e-9
    on = np.asarray(path.at_distance(np.linspace(until, path.length, 2000)))
    assert gaps(on).min() >= required - 1e-6
    assert candidate.turns == (0.0, until)


def test_where_nothing_near_has_room_there_is_no_way_out(context: ReplanContext) -> None:
    roomy = replace(TASK.requirements, clearance=50.0)
    world = World([*context.knowledge.world.obstacles], bounds=(-20, -20, 30, 20))
    closed = replace(context, knowledge=Knowledge(world, frozenset()))
    assert way_out(closed, roomy, GAP - 1e-3) is None


def test_a_path_keeps_less_only_as_far_as_it_must(context: ReplanContext) -> None:
    floor, required = GAP - 1e-3, TASK.requirements.required
    eased = replace(TASK.requirements, clearance=floor - TASK.requirements.radius)
    close = replace(
        context,
        schedule=replace(context.schedule, reduced=ReducedClearance(math.inf, floor)),
        requirements=eased,
    )
    first = first_candidate(close, context.knowledge.world)
    assert first.reduced == ReducedClearance(math.inf, floor)
    restored = restore_clearance(close, first, TASK.requirements, floor, 0.05, ())
    assert restored.reduced is not None
    path, until = restored.solution.path, restored.reduced.until
    assert until < 3.0
    on = np.asarray(path.at_distance(np.linspace(until, path.length, 2000)))
    assert gaps(on).min() >= required - 1e-6
    before = np.asarray(path.at_distance(np.linspace(0.0, until, 200)))
    assert gaps(before).min() >= floor - 1e-6
