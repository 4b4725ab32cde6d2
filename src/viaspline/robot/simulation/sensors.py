"""The sensors of a robot in the whole world.

Tested through ``robot/test_simulator``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.lidar import LidarSensor, Scan
from viaspline.robot.perception.moving.motion_sensor import MotionSensor, MovingSighting
from viaspline.robot.perception.range_sensor import RangeSensor
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World


@dataclass(frozen=True)
class Senses:
    """What a robot is shown at every step.

    Attributes:
        lidar: It shows surfaces; None without one.
        standing: It tells of obstacles; None without one.
        moving: It tells of what moves; None where nothing unseen does, or without one.
    """

    lidar: LidarSensor | None = None
    standing: RangeSensor | None = None
    moving: MotionSensor | None = None

    @property
    def all_moving(self) -> MovingObstacles:
        """All that moves and could be shown."""
        shows = self.moving if self.lidar is None else self.lidar
        return MovingObstacles() if shows is None else shows.moving

    @property
    def reach(self) -> float:
        """How far off what moves is shown [m]; 0: it isn't."""
        if self.lidar is not None:
            return self.lidar.spec.range_m
        return 0.0 if self.moving is None else self.moving.range

    def at(
        self, place: tuple[float, ...], heading: float, tick: int, time: float
    ) -> Sequence[Obstacle | MovingSighting] | Scan:
        """What is shown at a place [m] with a heading [rad], at a step and its time [s]."""
        if self.lidar is not None:
            return self.lidar.scan(place, heading, tick, time)
        seen = () if self.standing is None else self.standing.seen(place)
        moving = () if self.moving is None else self.moving.seen(place, time, tick)
        return (*seen, *moving)


def senses_of(mission: Mission, world: World, seed: int) -> Senses:
    """The sensor that a robot has: a lidar, one that tells it of obstacles, or neither.

    Args:
        mission: What is driven.
        world: Everything that is there and stands.
        seed: Of the sensor's noise.
    """
    sensor = mission.robot.sensor
    if sensor is None:
        return Senses()
    if sensor.lidar is not None:
        everything = MovingObstacles.everything(mission)
        return Senses(LidarSensor(world.obstacles, sensor.lidar, seed, everything))
    unseen = MovingObstacles(mission.world.unseen_moving)
    moving = MotionSensor(unseen, sensor.reach, sensor.velocity_noise_mps, seed)
    standing = RangeSensor(_named_unseen(mission, world), sensor.reach)
    return Senses(None, standing, moving if len(unseen) else None)


def _named_unseen(mission: Mission, world: World) -> tuple[Obstacle, ...]:
    """The unseen obstacles, each with the name that it has in the whole world."""
    first = len(mission.world.standing)
    return tuple(
        obstacle.model_copy(update={"name": world.name(first + i)})
        for i, obstacle in enumerate(mission.world.unseen_standing)
    )
