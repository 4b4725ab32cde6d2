"""The way back out of a pocket whose mouth has become too narrow."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import shapely
import shapely.affinity

from viaspline.curve.path import Path
from viaspline.machine.machine_limits import limits_of
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planner import plan
from viaspline.robot.navigation.drive_task import DriveTask, requirements_under_way
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.replan_search import ReplanResult, search
from viaspline.robot.replanning.retreat import retreat
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
THICK, HERE, MOUTH = 0.1, 6.0, 3.0
LEAST = 0.45
"""So much the mouth has to leave on either side of the robot's middle [m]."""

Line = list[tuple[float, float]]


def pocket(room: float, end: float = 8.0) -> Line:
    """A wall about the robot, with a mouth that leaves it so much on either side [m]."""
    lip = room + THICK
    return [(MOUTH, lip), (MOUTH, 1.5), (end, 1.5), (end, -1.5), (MOUTH, -1.5), (MOUTH, -lip)]


def context_in(wall: Line, more: Line = ()) -> ReplanContext:
    """A robot that has driven straight into a pocket and stands there."""
    made = plan(MISSION)
    segments = [*pairwise(wall), *pairwise(more)]
    world = World(
        Obstacle.model_validate({"capsule": {"from": a, "to": b, "radius": THICK}})
        for a, b in segments
    )
    trajectory = made.trajectory.until(HERE)
    progress = Progress(trajectory.end_time, distance=HERE, last_via=0)
    schedule = Schedule(made.path, trajectory, laid_in=made.world)
    context = ReplanContext.of(TASK, progress, Knowledge(world, frozenset()), schedule)
    return replace(context, floor=TASK.requirements.required)


def back_from(context: ReplanContext, attempt: int = 0, **keys: object) -> ReplanResult:
    return retreat(context, replace(TASK.requirements, **keys), LEAST, attempt)


def test_it_drives_back_as_it_came_and_keeps_its_clearance_from_there() -> None:
    wall = pocket(0.49)
    context = context_in(wall)
    assert search(context).candidate is None
    candidate = back_from(context).candidate
    assert candidate is not None
    assert candidate.reduced is not None
    path, until = candidate.solution.path, candidate.reduced.until
    assert candidate.turns == (HERE, until)
    assert candidate.solution.changed_from == HERE
    back = np.asarray(path.at_distance(np.linspace(HERE, until, 500)))
    assert np.abs(back[:, 1]).max() < 1e-9
    assert (np.diff(back[:, 0]) < 0.0).all()
    assert back[-1, 0] < MOUTH
    shape = shapely.LineString(wall)

    def room(points: np.ndarray) -> float:
        return float(shapely.distance(shape, shapely.points(points)).min()) - THICK

    assert room(back) >= candidate.reduced.floor
    on = np.asarray(path.at_distance(np.linspace(until, path.length, 4000)))
    assert room(on) >= TASK.requirements.required - 1e-6
    assert np.allclose(on[-1], (20.0, 0.0))


def test_the_robot_waits_at_the_end_of_the_way_back_to_turn() -> None:
    candidate = back_from(context_in(pocket(0.49))).candidate
    assert candidate is not None
    trajectory, turns = candidate.trajectory, candidate.turns
    assert float(trajectory.speed_at(turns[1])) == pytest.approx(0.0, abs=1e-6)


def test_what_was_not_there_when_it_came_is_not_driven_through() -> None:
    assert back_from(context_in(pocket(LEAST - 0.01))).candidate is None


def test_a_mouth_that_is_wide_enough_is_no_way_to_go_back_to() -> None:
    context = context_in(pocket(0.6))
    assert search(context).candidate is not None
    assert back_from(context) == ReplanResult(None)


def test_one_that_leads_nowhere_says_why_and_the_next_one_is_tried_next() -> None:
    outer = [(1.0, 0.59), (1.0, 3.0), (9.0, 3.0), (9.0, -3.0), (1.0, -3.0), (1.0, -0.59)]
    context = context_in(pocket(0.49), outer)
    nearest = back_from(context, attempt=0)
    assert nearest.candidate is None
    assert nearest.refusal
    assert back_from(context, attempt=1).candidate is not None


BODY = ((0.45, 0.3), (-0.35, 0.3), (-0.35, -0.3), (0.45, -0.3))


def outlines(path: Path, along: np.ndarray) -> list[shapely.Polygon]:
    """The body's outline at places of a path, by shapely."""
    found = []
    for u in np.asarray(path.parameter(along)).tolist():
        x, y = np.asarray(path.evaluate(u)).tolist()
        turned = shapely.affinity.rotate(
            shapely.Polygon(BODY), float(path.heading(u)), origin=(0, 0), use_radians=True
        )
        found.append(shapely.affinity.translate(turned, x, y))
    return found


def test_a_body_with_corners_turns_where_it_stands_and_goes_back_as_well() -> None:
    wall = pocket(0.49)
    candidate = back_from(context_in(wall), footprint=BODY).candidate
    assert candidate is not None
    assert candidate.reduced is not None
    path, until, floor = candidate.solution.path, candidate.reduced.until, candidate.reduced.floor
    shape = shapely.LineString(wall)
    back = [
        float(shape.distance(body)) - THICK
        for body in outlines(path, np.linspace(HERE + 1e-6, until, 700))
    ]
    assert min(back) >= floor - TASK.requirements.radius > 0.15
    on = [
        float(shape.distance(body)) - THICK
        for body in outlines(path, np.linspace(until + 1e-6, path.length, 2000))
    ]
    assert min(on) >= TASK.requirements.clearance - 1e-6


def test_a_body_that_is_too_long_to_turn_where_it_stands_does_not_go_back() -> None:
    """Its mouth would let it pass, and so would all of its way there."""
    long = ((0.3, 0.25), (-1.1, 0.25), (-1.1, -0.25), (0.3, -0.25))
    context = context_in(pocket(0.49))
    assert back_from(context, footprint=long).candidate is not None
    posts = [(HERE, 1.4), (HERE, 1.2)], [(HERE, -1.4), (HERE, -1.2)]
    for post in posts:
        context = context_in(pocket(0.49), post)
        assert back_from(context, footprint=BODY).candidate is not None
    both = [*posts[0], (9.0, 1.2), (9.0, -1.2), *reversed(posts[1])]
    assert back_from(context_in(pocket(0.49), both), footprint=long) == ReplanResult(None)


def test_a_robot_that_cannot_turn_round_where_it_stands_does_not_go_back() -> None:
    keys = {"turn_radius": 1.0, "turns_on_spot": "never"}
    assert back_from(context_in(pocket(0.49)), **keys) == ReplanResult(None)
