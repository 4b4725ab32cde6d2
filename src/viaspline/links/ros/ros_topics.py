"""Which topics a drive over ROS hears and says, with their types, and how they are delivered.

Tested through ``links/ros/test_ros_bridge`` and ``links/ros/test_zenoh_link``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

from viaspline.mission.ros_spec import RosSpec

MARKERS: Final = "/viaspline/markers"
DIAGNOSTICS: Final = "/diagnostics"
FRAME_TOPICS: Final = frozenset({"/tf", "/tf_static"})

TWIST: Final = "geometry_msgs/msg/Twist"
TWIST_STAMPED: Final = "geometry_msgs/msg/TwistStamped"
PATH: Final = "nav_msgs/msg/Path"
ODOMETRY: Final = "nav_msgs/msg/Odometry"
SCAN: Final = "sensor_msgs/msg/LaserScan"
GRID: Final = "nav_msgs/msg/OccupancyGrid"
MARKER_ARRAY: Final = "visualization_msgs/msg/MarkerArray"
DIAGNOSTIC_ARRAY: Final = "diagnostic_msgs/msg/DiagnosticArray"

NEWEST_COUNTS: Final = frozenset({SCAN, GRID})
"""Of messages of these types only the newest counts: older ones that wait needn't be read."""


class Outgoing(NamedTuple):
    """A message to be published: where, its type's full name, and it."""

    topic: str
    kind: str
    message: Mapping[str, Any]


class Qos(NamedTuple):
    """How messages of a topic are delivered.

    Attributes:
        reliable: Whether none may be lost.
        stays: Whether who comes later gets the last ones (transient local).
        depth: How many are kept.
    """

    reliable: bool = True
    stays: bool = False
    depth: int = 10


SENSOR_QOS: Final = Qos(reliable=False, depth=5)
STAYING_QOS: Final = Qos(stays=True, depth=1)


def qos_for(topic: str, kind: str) -> Qos:
    """The QoS with which Nav2 says or hears a topic.

    >>> qos_for("/scan", "sensor_msgs/msg/LaserScan").reliable, qos_for("/tf_static", "").stays
    (False, True)
    """
    if kind in (SCAN, ODOMETRY):
        return SENSOR_QOS
    if kind == GRID or topic == "/tf_static":
        return STAYING_QOS
    return Qos(depth=100) if topic == "/tf" else Qos()


def dds_type(kind: str) -> str:
    """A type's name as DDS has it, and zenoh's keys too.

    >>> dds_type("std_msgs/msg/String")
    'std_msgs::msg::dds_::String_'
    """
    package, room, name = kind.split("/")
    return f"{package}::{room}::dds_::{name}_"


def heard_topics(names: RosSpec, has_lidar: bool) -> dict[str, str]:
    """The topics that a drive has to hear, with their types.

    >>> heard_topics(RosSpec(), has_lidar=True)["/scan"]
    'sensor_msgs/msg/LaserScan'
    """
    topics = {
        names.odom_topic: ODOMETRY,
        **dict.fromkeys(sorted(FRAME_TOPICS), "tf2_msgs/msg/TFMessage"),
        names.initial_pose_topic: "geometry_msgs/msg/PoseWithCovarianceStamped",
        names.goal_topic: "geometry_msgs/msg/PoseStamped",
        names.waypoints_topic: PATH,
    }
    if has_lidar:
        topics[names.scan_topic] = SCAN
    if names.map_topic is not None:
        topics[names.map_topic] = GRID
    return topics


def said_topics(names: RosSpec) -> dict[str, str]:
    """The topics on which a drive says something, with their types.

    >>> said_topics(RosSpec())["/cmd_vel"]
    'geometry_msgs/msg/Twist'
    """
    return {
        names.cmd_vel_topic: TWIST_STAMPED if names.enable_stamped_cmd_vel else TWIST,
        names.path_topic: PATH,
        MARKERS: MARKER_ARRAY,
        DIAGNOSTICS: DIAGNOSTIC_ARRAY,
    }
