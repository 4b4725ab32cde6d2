"""Passive safety under way: the robot stands before anything can touch it.

Tested through ``robot/yielding/test_stoppable``.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.reschedule import rescheduled
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.moving.foretell import Foresight, foretold
from viaspline.robot.perception.moving.mouths import reach_and_mouths
from viaspline.robot.state import RobotState
from viaspline.trajectory.passive_safety import PassivePremises, passive_law, stop_of
from viaspline.world.moving_obstacles import MovingObstacles

LASTING_S = 1.0
"""A law goes on for so long if it may, and then stops; there is another look long before [s]."""

NARROWEST_M = 0.2
"""Nothing that moves comes through a gap that is narrower [m]."""

ANY_ACCEL_MPS2 = 1e6
"""What moves may turn at will: nothing is taken for granted but its greatest speed."""


@dataclass(frozen=True)
class Sight:
    """How much of the world a look has shown.

    Attributes:
        eye: Where it was taken [m].
        reach: All that is there and nearer was seen, or is behind a mouth [m].
        mouths: Lines through which what was hidden may come [m], (k, 4).
    """

    eye: tuple[float, ...]
    reach: float
    mouths: Floats = field(default_factory=lambda: np.empty((0, 4)))


def sight_of(robot: RobotSpec, sensed: object, measured: RobotState) -> Sight:
    """What a look shows of the world: a scan what its beams passed, a range sensor all around.

    Args:
        robot: With its sensor; one without sees nothing.
        sensed: What was shown.
        measured: Where the robot is.
    """
    if isinstance(sensed, Scan):
        return Sight(sensed.position, *reach_and_mouths(sensed, NARROWEST_M))
    return Sight(measured.position, 0.0 if robot.sensor is None else robot.sensor.reach)


def stoppable(
    task: DriveTask,
    progress: Progress,
    knowledge: Knowledge,
    before: Schedule,
    after: Schedule,
    sight: Sight,
) -> Schedule:
    """A schedule by which the robot is at rest before anything that it may meet touches it.

    It goes on by what it means to do as far as that is proven: nothing is faster than the mission
    says, and nothing appears inside of what its sensor sees. Where not even braking at once is, it
    stops as was proven by an earlier look.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        knowledge: All that is known, with what was just seen.
        before: What it meant to do before this look.
        after: What it would do if nothing could come.
        sight: What this look has shown.
    """
    robot = task.mission.robot
    things = robot.moving
    has_law = after.giving_up is None and not progress.finished and progress.dwell is None
    if things is None or things.safety == "none" or not has_law:
        return after
    if after.trajectory.changes is not None:
        return after
    speed = float(before.trajectory.state_at(progress.time)[1])
    meant = after
    if after.trajectory is before.trajectory:
        meant = rescheduled(task, progress, knowledge, after, speed)
    strict = Foresight(top_speed=things.max_speed_mps, accel=ANY_ACCEL_MPS2)
    premises = PassivePremises(
        _tubes(knowledge, progress.time, strict), progress.time, things.max_speed_mps, sight.eye,
        sight.reach, sight.mouths,
    )  # fmt: skip
    limits = (task.limits.max_accel, task.limits.brake)
    keep = task.requirements.outer_radius + task.requirements.tracking_error
    law, proven = passive_law(
        meant.path, meant.trajectory, premises, keep, limits, progress.time, LASTING_S
    )
    if not proven and before.path is meant.path:
        law = stop_of(before.trajectory, progress.time, task.limits.brake)
    return replace(meant, trajectory=law)


def _tubes(knowledge: Knowledge, now: float, strict: Foresight) -> MovingObstacles:
    """Where everything that was seen to move may be from now on."""
    tracks = knowledge.hits.tracks if knowledge.hits is not None else ()
    told = knowledge.tracked.tracks if knowledge.tracked is not None else ()
    return foretold((*tracks, *told), now, strict)
