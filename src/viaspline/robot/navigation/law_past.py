"""The time law of what lies ahead past what moves.

Tested through ``robot/yielding/test_give_way``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.planning.problem.method import Found, GaveUp, Outcome
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.robot.navigation.body_past import body_keeps_clear
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.schedule import Schedule
from viaspline.trajectory.limits import Station
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.law_among import law_among
from viaspline.trajectory.yielding.no_law import Unserved
from viaspline.world.moving_obstacles import MovingObstacles

LAW_WORK_S = 0.02
"""What the search for a law under way may spend [s of the reference machine]: a step needs some.

A finer lattice isn't tried: that finds one more law in fifty, for as much work again."""


def law_past(
    task: DriveTask,
    moving: MovingObstacles,
    schedule: Schedule,
    path: Path,
    stops: Sequence[Station],
    part: tuple[float, float],
    motion: tuple[float, float],
    time: float,
) -> Trajectory:
    """The law of a part of a path, to rest at its end, on which nothing that moves is met.

    Args:
        task: What is asked of the drive.
        moving: What moves.
        schedule: What the robot means to do up to now.
        path: What is driven.
        stops: On the part.
        part: From where to where [m].
        motion: Speed and acceleration at its start [m/s], [m/s²].
        time: There [s].

    Raises:
        GeometryError: When there is no such law, or none was found.
    """
    distance, end = part
    timed = path
    if end < path.length:
        timed, stops = part_until(path, stops, end)
    hold = task.mission.route.hold_s if end >= path.length else 0.0

    def law(required: float) -> Outcome[Trajectory]:
        return law_among(
            timed, task.limits, stops, moving=moving, required=required,
            zones=task.mission.world.speed_zones, slow=schedule.slow,
            start=min(distance, timed.length), start_speed=motion[0], start_time=time,
            hold=hold, budget=WorkBudget(LAW_WORK_S), halvings=0, explained=_unexplained,
        )  # fmt: skip

    outcome = law(task.kept_to_moving)
    if isinstance(outcome, Found):
        return outcome.value
    for required in task.kept_by_body:
        other = law(required)
        if isinstance(other, Found) and body_keeps_clear(task, moving, timed, other.value, hold):
            return other.value
    raise GeometryError(f"no law past what moves: {outcome.reason}")


def _unexplained(_: Unserved) -> GaveUp:
    """That no law was found: under way it isn't proven that there is none, nor is anybody told."""
    return GaveUp(
        ("waiting, slowing down and passing before on a lattice of times and speeds",),
        "another path",
        reason="no law was found on this path among what moves",
    )


def spans_until(path: Path, stops: Sequence[Station], end: float) -> tuple[Path, Sequence[Station]]:
    """The spans of a path up to the joint behind a distance [m], and the stops on them.

    They are whole, so a law to rest at that distance is the same on them as on all of the path.
    """
    joint = math.floor(float(path.parameter(end))) + 1.0
    if joint >= path.domain[1]:
        return path, stops
    part = Path(path.section(0.0, joint).spans, [])
    return part, [stop for stop in stops if stop.distance < part.length]


def part_until(path: Path, stops: Sequence[Station], end: float) -> tuple[Path, Sequence[Station]]:
    """The part of a path up to a distance [m], and the stops on it."""
    part = Path(path.section(0.0, float(path.parameter(end))).spans, [])
    return part, [stop for stop in stops if stop.distance < part.length]
