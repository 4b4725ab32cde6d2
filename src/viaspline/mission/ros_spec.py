"""How a robot's ROS 2 calls its topics and frames.

Tested through ``links/ros/test_ros_bridge``.
"""

from __future__ import annotations

from viaspline.mission.fields import Name
from viaspline.mission.value import Value


class RosSpec(
    Value,
    expected="a mapping such as {odom_topic: /odom, robot_base_frame: base_link}",
    examples=(
        {
            "odom_topic": "/odometry/filtered",
            "scan_topic": "/front/scan",
            "map_topic": "/map",
            "goal_topic": "/goal_pose",
            "waypoints_topic": "/waypoints",
            "initial_pose_topic": "/initialpose",
            "cmd_vel_topic": "/cmd_vel_nav",
            "enable_stamped_cmd_vel": True,
            "path_topic": "/plan",
            "global_frame": "map",
            "odom_frame": "odom",
            "robot_base_frame": "base_footprint",
        },
    ),
):
    """How a robot's ROS 2 calls its topics and frames; the defaults are Nav2's names.

    Attributes:
        odom_topic: Where the robot is and how fast (nav_msgs/Odometry).
        scan_topic: What its lidar measures (sensor_msgs/LaserScan).
        map_topic: What is known besides the mission (nav_msgs/OccupancyGrid), ``/map`` in Nav2. It
            is waited for. None: nothing.
        goal_topic: Where to go in place of the mission (geometry_msgs/PoseStamped).
        waypoints_topic: Through which points to go in place of it (nav_msgs/Path).
        initial_pose_topic: Where the robot is on the map (geometry_msgs/PoseWithCovarianceStamped),
            where nothing tells it by tf.
        cmd_vel_topic: What the robot is told (geometry_msgs/Twist).
        enable_stamped_cmd_vel: Whether it is told so by TwistStamped.
        path_topic: The path that it drives (nav_msgs/Path).
        global_frame: The frame of the mission.
        odom_frame: That of the odometry, where its messages don't say.
        robot_base_frame: That of the body.
    """

    odom_topic: Name = "/odom"
    scan_topic: Name = "/scan"
    map_topic: Name | None = None
    goal_topic: Name = "/goal_pose"
    waypoints_topic: Name = "/waypoints"
    initial_pose_topic: Name = "/initialpose"
    cmd_vel_topic: Name = "/cmd_vel"
    enable_stamped_cmd_vel: bool = False
    path_topic: Name = "/plan"
    global_frame: Name = "map"
    odom_frame: Name = "odom"
    robot_base_frame: Name = "base_link"
