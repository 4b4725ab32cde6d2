"""All parts of a mission, before it is known whether they go together.

Lengths are metres, angles in files are degrees (the key says so), the frame is ENU: x east,
y north, headings anticlockwise from x. What one part means to another is held in ``model``.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

from viaspline.mission import others_words
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.ros_spec import RosSpec
from viaspline.mission.route_spec import Route
from viaspline.mission.spline_spec import SplineSpec, Tangents
from viaspline.mission.value import Value
from viaspline.mission.world_spec import WorldSpec


class MissionParts(
    Value,
    foreign=others_words.MISSION,
    examples=(
        {
            "world": {"known": [{"circle": {"center": [20, 1], "radius": 3}}]},
            "robot": {"radius_m": 0.4, "max_speed_mps": 1.5},
            "route": {"start": [0, 0], "via": [[20, 8]], "goal": [40, 0]},
            "spline": {"tension": 0.1},
            "ros": {"odom_topic": "/odom"},
        },
    ),
):
    """All parts of a mission, each sound by itself.

    Attributes:
        world: The known map, and what is there but not on the map.
        robot: The robot's body, limits and sensor.
        route: The points that the path runs through.
        spline: The curve's shape.
        ros: How the robot's ROS 2 calls its topics and frames.
    """

    world: WorldSpec = WorldSpec()
    robot: RobotSpec = RobotSpec()
    route: Route
    spline: SplineSpec = SplineSpec()
    ros: RosSpec = RosSpec()

    @property
    def is_spatial(self) -> bool:
        """Whether any key says something of heights, so that it is planned in space.

        Points of three numbers alone don't: their heights are carried along as ever. Every obstacle
        is asked, as a copy with other parts may be another kind of mission.

        >>> route = {"start": [0, 0, 5], "goal": [9, 0, 6]}
        >>> MissionParts.model_validate({"route": route}).is_spatial
        False
        >>> MissionParts.model_validate({"route": {**route, "yaw": "along"}}).is_spatial
        True
        """
        return self.robot.is_spatial or self.route.is_spatial or self.world.is_spatial

    @property
    def tangents(self) -> Tangents:
        """Those of the spline, as it says; without jumps of the curvature if it doesn't."""
        return "continuous" if self.spline.tangents is None else self.spline.tangents
