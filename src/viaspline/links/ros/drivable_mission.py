"""Which missions can be driven over ROS.

Tested through ``links/ros/test_ros_bridge``.
"""

from __future__ import annotations

from viaspline.errors import LinkError
from viaspline.mission.model import Mission
from viaspline.mission.spot_turning import is_driven


def check_for_ros(mission: Mission) -> None:
    """Refuse what can't be driven over ROS.

    Raises:
        LinkError: The mission is one in space, says nothing of how the robot drives, has a sensor
            that tells of whole obstacles, or has things that move by a clock of their own.
    """
    robot = mission.robot
    if mission.is_spatial:
        raise LinkError("--ros", "the mission is one in space", "give one in the plane")
    if robot.drive is None or not is_driven(robot):
        remedy = "give robot.drive, such as {differential: {track_m: 0.5}, delay_s: 0.1}"
        raise LinkError("--ros", "the mission doesn't say how the robot drives", remedy)
    if robot.sensor is not None and robot.sensor.lidar is None:
        remedy = "give robot.sensor.lidar, or no sensor"
        raise LinkError("--ros", "no topic tells of whole obstacles", remedy)
    if mission.world.moving:
        remedy = "leave out what moves on the map"
        raise LinkError("--ros", "things on the map move by a clock that isn't the robot's", remedy)
