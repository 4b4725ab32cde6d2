"""Where a robot is and how fast it goes, as ``nav_msgs/Odometry``, and back."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from viaspline.robot.state import RobotState
from viaspline.ros_messages.pose_message import heading_of, pose
from viaspline.ros_messages.stamps import BASE_FRAME, ODOM_FRAME, header
from viaspline.ros_messages.twist_message import twist

_UNKNOWN: Final = np.zeros(36)
"""A covariance of nothing: it isn't said."""
_UNKNOWN.flags.writeable = False


def odometry(
    time: float,
    state: RobotState,
    yaw_rate: float,
    *,
    frame: str = ODOM_FRAME,
    child: str = BASE_FRAME,
) -> dict[str, Any]:
    """A robot's state as a message.

    Args:
        time: Of the measurement [s].
        state: What was measured.
        yaw_rate: Of the body [rad/s].
        frame: In which the pose is.
        child: The frame of the body, in which the speeds are.

    >>> message = odometry(0.0, RobotState((1.0, 2.0), 0.0, 0.5), 0.1)
    >>> message["twist"]["twist"]["linear"]["x"]
    0.5
    """
    speeds = twist(state.speed, state.speed_across, yaw_rate)
    return {
        "header": header(time, frame),
        "child_frame_id": child,
        "pose": {"pose": pose(state.position, state.heading), "covariance": _UNKNOWN},
        "twist": {"twist": speeds, "covariance": _UNKNOWN},
    }


def state_from(message: Mapping[str, Any]) -> RobotState:
    """The state that a message of odometry tells; its pose is in the message's frame.

    >>> state_from(odometry(0.0, RobotState((1.0, 2.0), 0.5, 0.25), 0.1))
    RobotState(position=(1.0, 2.0), heading=0.5, speed=0.25, speed_across=0.0, stamp=None)
    """
    where, linear = message["pose"]["pose"], message["twist"]["twist"]["linear"]
    place = where["position"]
    return RobotState(
        (float(place["x"]), float(place["y"])),
        heading_of(where["orientation"]),
        float(linear["x"]),
        float(linear["y"]),
    )
