"""What passes between a robot and its navigator.

Tested through ``robot/test_navigator``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from viaspline.handed_in import numbers_from
from viaspline.presentable.compared_by_value import ComparedByValue


@dataclass(frozen=True)
class RobotState:
    """Where the robot is, as measured.

    Attributes:
        position: Of its centre [m], shape (d,); an array is kept as the tuple of its numbers.
        heading: Of its body, anticlockwise from x [rad].
        speed: Forward, along its body [m/s].
        speed_across: To the left, across its body [m/s]; 0 of a robot that can't.
        stamp: When that was measured, by the clock of the steps [s]; None: now, whenever it is
            handed in. What is older than 0.2 s stops the robot, and what is stamped as far ahead.

    Raises:
        GeometryError: When the position is no row of numbers.

    >>> RobotState((3.0, 4.0), heading=1.57, speed=0.8, stamp=12.05).position
    (3.0, 4.0)
    """

    position: tuple[float, ...]
    heading: float
    speed: float
    speed_across: float = 0.0
    stamp: float | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.position, tuple):
            place = numbers_from("position", self.position).ravel()
            object.__setattr__(self, "position", tuple(place.tolist()))

    @property
    def ground_speed(self) -> float:
        """Over the ground, whichever way [m/s].

        >>> RobotState((3.0, 4.0), heading=0.0, speed=-0.6, speed_across=0.8).ground_speed
        1.0
        """
        return math.hypot(self.speed, self.speed_across)

    def speed_towards(self, way: float) -> float:
        """That part of its velocity that leads one way [rad] over the ground [m/s].

        >>> RobotState((3.0, 4.0), heading=0.5, speed=0.6, speed_across=2.0).speed_towards(0.5)
        0.6
        """
        turned = way - self.heading
        return self.speed * math.cos(turned) + self.speed_across * math.sin(turned)


@dataclass(frozen=True, eq=False)
class Command(ComparedByValue):
    """What the robot is to do until the next step.

    For a robot with a drive, velocity and yaw rate are what the drive is to be given now: its
    delay, its lag and its limits have been seen to. ROS's Twist takes ``velocity`` as its
    ``linear.x`` and ``linear.y``, and ``yaw_rate`` as its ``angular.z``.

    Attributes:
        speed: Over the ground, now [m/s].
        acceleration: By which that speed changes from now on [m/s²].
        curvature: Of the arc to drive until the next step, left is positive [1/m]; it leads back
            to the path if the measured state is off it.
        yaw_rate: Of the body [rad/s]. Where the robot stands and looks another way than it is to
            go, it turns on the spot first; without a drive as fast as ``max_yaw_rate_degps``
            allows, or 1 rad/s if that isn't said, and it sets off when it has turned.
        position: The path's point that belongs to the robot's progress [m], shape (d,).
        heading: The heading that the body should have there [rad].
        distance: The progress along all that is driven [m].
        stopped: Whether the robot is to stand: it dwells, turns on the spot to ``heading``, or
            its drive is over.
        finished: Whether its drive is over, at the goal or not.
        velocity: Forward and to the left, in the frame of the body [m/s]. Without a drive it is
            what brings the robot to where it should be at the next step, if it is held until then.
        actuators: What the actuators of its drive are to be given, by names with their units, such
            as ``steer_rad`` or ``left_wheel_mps``; nothing of a robot that has none to name.
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
    velocity: tuple[float, float] = (0.0, 0.0)
    actuators: Mapping[str, float] = field(default_factory=dict)
