"""What the robot's motors and its stations ask of the time law."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.errors import GeometryError
from viaspline.mission.robot_parts import RobotSpec

REACTION = 0.1
"""Longest time between two looks of the sensor for which speeds are planned [s]."""


@dataclass(frozen=True, kw_only=True)
class Limits:
    """Limits along a path.

    Attributes:
        max_speed: [m/s], more than 0.
        max_accel: Along the path, speeding up and braking [m/s²], more than 0.
        max_lateral_accel: Across the path, v² times curvature [m/s²]; None: no limit.
    """

    max_speed: float
    max_accel: float
    max_lateral_accel: float | None = None

    def __post_init__(self) -> None:
        for name in ("max_speed", "max_accel", "max_lateral_accel"):
            value = getattr(self, name)
            if value is not None and not 0 < value < float("inf"):
                raise GeometryError(f"{name} is {value}; give a finite number above 0")

    @classmethod
    def of(cls, robot: RobotSpec, reaction: float = REACTION) -> Limits:
        """The limits of a mission's robot, with what its sensor allows.

        A robot with a sensor drives no faster than lets it stop inside what it has seen; one
        without a sensor trusts its map.

        Args:
            robot: The robot of the mission.
            reaction: Time that can pass between two looks of the sensor [s].

        Raises:
            GeometryError: If the sensor sees no farther than the robot's own body.

        Example:
            >>> Limits.of(RobotSpec(max_speed_mps=20, sensor={"range_m": 9})).max_speed
            3.901...
        """
        top = robot.max_speed_mps
        if robot.sensor is not None:
            room = _room_to_stop(robot.sensor.reach, robot.outer_radius, robot.clearance_m)
            top = min(top, stopping_speed(room, robot.max_accel_mps2, reaction))
        return cls(
            max_speed=top,
            max_accel=robot.max_accel_mps2,
            max_lateral_accel=robot.max_lateral_accel_mps2,
        )


def _room_to_stop(sight: float, radius: float, clearance: float) -> float:
    """How far the robot may roll after it has seen something at the limit of its sight [m].

    It stops with its clearance kept. Where the sensor hardly sees past the clearance, a quarter
    of what it sees past the body has to do: the robot then still stops before it touches.
    """
    if sight <= radius:
        raise GeometryError(
            f"the sensor's range_m is {sight:g}, which is not past the robot's own body; "
            f"give more than radius_m, which is {radius:g}"
        )
    return max(sight - radius - clearance, 0.25 * (sight - radius))


def stopping_speed(room: float, accel: float, reaction: float) -> float:
    """The speed v from which the robot stops within ``room``: v²/(2 accel) + v reaction = room.

    Args:
        room: [m], at least 0.
        accel: [m/s²], more than 0.
        reaction: Time that passes before it brakes [s].

    Example:
        >>> stopping_speed(2.0, accel=1.0, reaction=0.0)
        2.0
    """
    lost = accel * reaction
    return math.sqrt(lost * lost + 2.0 * accel * room) - lost


@dataclass(frozen=True)
class Station:
    """A stop on the path: where [m along the path], how long [s], and its name."""

    distance: float
    dwell: float = 0.0
    name: str = ""
