"""The sensors of a robot in the whole world.

Tested through ``robot/test_simulator``.
"""

from __future__ import annotations

from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.perception.range_sensor import RangeSensor
from viaspline.world.world import World


def sensors_of(
    mission: Mission, world: World, seed: int
) -> tuple[LidarSensor | None, RangeSensor | None]:
    """The sensor that a robot has: a lidar, one that tells it of obstacles, or neither.

    Args:
        mission: What is driven.
        world: Everything that is there.
        seed: Of the lidar's noise.
    """
    sensor = mission.robot.sensor
    if sensor is None:
        return None, None
    if sensor.lidar is not None:
        return LidarSensor(world.obstacles, sensor.lidar, seed), None
    return None, RangeSensor(_named_unseen(mission, world), sensor.reach)


def _named_unseen(mission: Mission, world: World) -> tuple[Obstacle, ...]:
    """The unseen obstacles, each with the name that it has in the whole world."""
    first = len(mission.world.standing)
    return tuple(
        obstacle.model_copy(update={"name": world.name(first + i)})
        for i, obstacle in enumerate(mission.world.unseen_standing)
    )
