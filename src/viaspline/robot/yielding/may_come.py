"""What may come towards a robot, by what it knows and sees: the premises of passive safety.

Tested through ``robot/yielding/test_stoppable``.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.moving.foretell import foretold
from viaspline.robot.perception.moving.mouths import reach_and_mouths
from viaspline.robot.state import RobotState
from viaspline.tracks.foresight import Foresight
from viaspline.trajectory.passive_premises import PassivePremises

NARROWEST_M = 0.2
"""Nothing that moves comes through a gap that is narrower [m]."""

ANY_ACCEL_MPS2 = 1e6
"""What moves may turn at will: nothing is taken for granted but its greatest speed."""


@dataclass(frozen=True)
class Sight:
    """How much of the world a look has shown.

    Attributes:
        eye: Where it was taken [m].
        time: When [s]; a robot with a delay makes up its mind about a later time.
        reach: All that is there and nearer was seen, or is behind a mouth [m].
        mouths: Lines through which what was hidden may come [m], (k, 4).
    """

    eye: tuple[float, ...]
    time: float
    reach: float
    mouths: Floats = field(default_factory=lambda: np.empty((0, 4)))


def sight_of(robot: RobotSpec, sensed: object, measured: RobotState, time: float) -> Sight:
    """What a look shows of the world: a scan what its beams passed, a range sensor all around.

    Args:
        robot: With its sensor; one without sees nothing.
        sensed: What was shown.
        measured: Where the robot is.
        time: Of the look [s].
    """
    if isinstance(sensed, Scan):
        return Sight(sensed.position, time, *reach_and_mouths(sensed, NARROWEST_M))
    reach = 0.0 if robot.sensor is None else robot.sensor.reach
    return Sight(measured.position, time, reach)


@dataclass(frozen=True, eq=False)
class WhatMayCome:
    """What may come, by all that is known and what a look has shown.

    Attributes:
        knowledge: All that is known, with what was just seen.
        top_speed: Nothing that isn't on the map is faster [m/s].
        sight: What the look has shown.
    """

    knowledge: Knowledge
    top_speed: float
    sight: Sight

    @cached_property
    def premises(self) -> PassivePremises:
        """Against which passive safety is proven: put together once, where it is asked for."""
        knowledge, sight = self.knowledge, self.sight
        tracks = knowledge.hits.tracks if knowledge.hits is not None else ()
        told = knowledge.tracked.tracks
        strict = Foresight(top_speed=self.top_speed, accel=ANY_ACCEL_MPS2)
        return PassivePremises(
            foretold((*tracks, *told), sight.time, strict), sight.time, self.top_speed, sight.eye,
            sight.reach, sight.mouths, knowledge.charted_moving,
        )  # fmt: skip


def kept_to_what_comes(task: DriveTask) -> float:
    """What is kept from it: the body's radius and how far beside its path it may be [m]."""
    return task.requirements.outer_radius + task.requirements.tracking_error
