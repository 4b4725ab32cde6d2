"""Routes that a person asks for over ROS, and the mission from where the robot stands.

Tested through ``links/ros/test_ros_bridge``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from viaspline.errors import LinkError
from viaspline.links.ros.frame_tree import PlanarPose, pose_from
from viaspline.links.ros.ros_map import grid_from
from viaspline.mission.model import Mission
from viaspline.mission.route_spec import EndPoint, Route
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.state import RobotState


def mission_to(
    mission: Mission, poses: Sequence[Mapping[str, Any]], frame: str, within: PlanarPose | None
) -> Mission:
    """A mission with another route: through places to the last of them.

    Args:
        mission: With its route until now; where that starts is kept.
        poses: Messages ``geometry_msgs/Pose``; the last is the goal.
        frame: In which they are.
        within: Where that frame is on the map; None if they aren't connected.

    Raises:
        LinkError: They aren't connected, or a place isn't finite.
    """
    remedy = "give it in a frame that tf connects to the map"
    if within is None:
        raise LinkError("--ros", f"the goal's frame '{frame}' isn't connected to the map", remedy)
    places = [within.then(pose_from(pose)) for pose in poses]
    if not all(math.isfinite(value) for place in places for value in place):
        raise LinkError("--ros", "the goal isn't finite", "give numbers")
    *vias, goal = places
    route = Route.model_validate(
        {
            "start": mission.route.start,
            "via": [(via.x, via.y) for via in vias],
            "goal": {"at": (goal.x, goal.y), "heading_deg": math.degrees(goal.heading)},
        }
    )
    return mission.model_copy(update={"route": route})


def mission_from_here(
    mission: Mission, state: RobotState, chart: Mapping[str, Any] | None
) -> Mission:
    """A mission from where a robot stands, in the world that it was told of.

    Args:
        mission: As it was asked for.
        state: Of the robot.
        chart: The map, a message ``nav_msgs/OccupancyGrid``; None: none.

    Raises:
        GeometryError: The map makes no grid.
    """
    start = EndPoint(at=state.position, heading_deg=math.degrees(state.heading))
    route = mission.route.model_copy(update={"start": start})
    mission = mission.model_copy(update={"route": route})
    if chart is None:
        return mission
    known = (*mission.world.known, Obstacle(grid=grid_from(chart), name="map"))
    world = mission.world.model_copy(update={"known": known})
    return mission.model_copy(update={"world": world})
