"""What passes between a robot and its navigator.

Tested through ``robot/test_navigator``.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class RobotState:
    """Where the robot is, as measured.

    Attributes:
        position: Of its centre [m], shape (d,).
        heading: Anticlockwise from x [rad].
        speed: Forward [m/s], at least 0.
    """

    position: tuple[float, ...]
    heading: float
    speed: float


@dataclass(frozen=True)
class Command:
    """What the robot is to do until the next step.

    For a robot with a drive, speed and yaw rate are what the drive is to be given now: its delay,
    its lag and its limits have been seen to. ROS's Twist takes ``speed`` and ``yaw_rate``.

    Attributes:
        speed: Forward, now [m/s].
        acceleration: By which that speed changes from now on [m/s²].
        curvature: Of the arc to drive, left is positive [1/m]; it leads back to the path if the
            measured state is off it.
        yaw_rate: Speed times curvature [rad/s].
        position: The path's point that belongs to the robot's progress [m], shape (d,).
        heading: The path's heading there [rad].
        distance: The progress along the path [m].
        stopped: Whether the robot is to stand: it dwells, turns on the spot to ``heading``, or
            its drive is over.
        finished: Whether its drive is over, at the goal or not.
        steer: The angle of the front wheels of a robot with an Ackermann drive, left is positive
            [rad]; None for others.
        wheels: The speeds of the left and the right wheels of a differential or skid-steer drive
            [m/s]; None for others.
    """

    speed: float
    acceleration: float
    curvature: float
    yaw_rate: float
    position: tuple[float, ...]
    heading: float
    distance: float
    stopped: bool
    finished: bool
    steer: float | None = None
    wheels: tuple[float, float] | None = None
