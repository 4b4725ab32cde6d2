"""What a robot is told to do, as ``geometry_msgs/Twist`` or ``TwistStamped``."""

from __future__ import annotations

from typing import Any

from viaspline.robot.state import Command
from viaspline.ros_messages.stamps import header


def twist(along: float, across: float = 0.0, yaw_rate: float = 0.0) -> dict[str, Any]:
    """Speeds along and across the body [m/s] and its yaw rate [rad/s], as a message.

    >>> twist(0.5, yaw_rate=0.1)["angular"]
    {'x': 0.0, 'y': 0.0, 'z': 0.1}
    """
    return {
        "linear": {"x": float(along), "y": float(across), "z": 0.0},
        "angular": {"x": 0.0, "y": 0.0, "z": float(yaw_rate)},
    }


def command_twist(command: Command) -> dict[str, Any]:
    """A command as a message.

    >>> command = Command(
    ...     speed=1.0, acceleration=0.0, curvature=0.5, yaw_rate=0.5, position=(0.0, 0.0),
    ...     heading=0.0, distance=0.0, stopped=False, finished=False, velocity=(1.0, 0.0),
    ... )
    >>> command_twist(command)["linear"]["x"]
    1.0
    """
    return twist(*command.velocity, command.yaw_rate)


def twist_stamped(time: float, frame: str, speeds: dict[str, Any]) -> dict[str, Any]:
    """A twist with a time [s] and the frame of the body.

    >>> twist_stamped(0.0, "base_link", twist(0.5))["twist"]["linear"]["x"]
    0.5
    """
    return {"header": header(time, frame), "twist": speeds}
