"""What the robot's motors and its stations ask of the time law."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viaspline.errors import GeometryError
from viaspline.handed_in import number_from
from viaspline.mission.robot_parts import RobotSpec
from viaspline.presentable.told_in_lines import told_in_lines

REACTION_S = 0.1
"""Longest time between two looks of the sensor for which speeds are planned [s]."""

YAW_SETTLE_S = 0.1
"""Time in which a robot takes up the yaw rate of the next piece where the curvature jumps [s]."""

LIMITS = (1e-12, 1e12)
"""The least and the greatest limit along a path, in its own unit: none of any robot lies beyond."""

_ALONG = (
    "max_speed",
    "max_accel",
    "max_lateral_accel",
    "max_brake",
    "max_yaw_rate",
    "max_yaw_accel",
    "max_jerk",
    "max_steer_rate",
    "wheelbase",
)


@told_in_lines
@dataclass(frozen=True, kw_only=True)
class Limits:
    """Limits along a path. None: no limit.

    Attributes:
        max_speed: [m/s], more than 0.
        max_accel: Along the path, speeding up [m/s²], more than 0.
        max_lateral_accel: Across the path, v² times curvature [m/s²].
        max_brake: Along the path, slowing down [m/s²]. None: as ``max_accel``.
        max_yaw_rate: Of the path's heading over the ground [rad/s].
        max_yaw_accel: Change of that [rad/s²]. At a place where the curvature jumps, as it does at
            the via points of a cardinal spline, the yaw rate would have to jump as well; the robot
            is so slow there that the jump is what this limit allows in ``YAW_SETTLE_S`` seconds.
        max_jerk: Change of the acceleration along the path [m/s³].
        max_steer_rate: How fast steered wheels turn [rad/s]; with ``wheelbase``. Where the
            curvature jumps the robot is so slow that while they turn it rolls no farther than at
            full speed in ``YAW_SETTLE_S`` seconds.
        wheelbase: From the reference point, on the rear axle, to the steered wheels [m].
        axis_speed: Along every coordinate axis [m/s]: one number, or one for each axis.
        axis_accel: Along every coordinate axis [m/s²], the acceleration across the path included.
        axis_heading: By which the first two of these axes are turned, anticlockwise [rad]: so they
            are limits along and across a body that keeps this heading.

    Raises:
        GeometryError: When a limit is not a finite number above 0, or one that no robot has; or a
            steering rate has no wheelbase.

    Example:
        >>> Limits(max_speed=2.0, max_accel=1.0, axis_accel=[0.5, 0.7]).axis_accel
        (0.5, 0.7)
    """

    max_speed: float
    max_accel: float
    max_lateral_accel: float | None = None
    max_brake: float | None = None
    max_yaw_rate: float | None = None
    max_yaw_accel: float | None = None
    max_jerk: float | None = None
    max_steer_rate: float | None = None
    wheelbase: float | None = None
    axis_speed: float | Sequence[float] | NDArray[np.float64] | None = None
    axis_accel: float | Sequence[float] | NDArray[np.float64] | None = None
    axis_heading: float = 0.0

    def __post_init__(self) -> None:
        for name in _ALONG:
            value = getattr(self, name)
            if value is not None:
                value = number_from(name, value)
            if value is not None and not 0 < value < math.inf:
                raise GeometryError(f"{name} is {value}; give a finite number above 0")
            if value is not None and not LIMITS[0] <= value <= LIMITS[1]:
                raise GeometryError(
                    f"{name} is {value:g}; give a number from {LIMITS[0]:g} to {LIMITS[1]:g}"
                )
            if value is not None:
                object.__setattr__(self, name, float(value))
        if self.max_steer_rate is not None and self.wheelbase is None:
            raise GeometryError("max_steer_rate needs the wheelbase; give wheelbase in metres")
        if not math.isfinite(self.axis_heading):
            raise GeometryError(f"axis_heading is {self.axis_heading}; give an angle in radians")
        for name in ("axis_speed", "axis_accel"):
            value = getattr(self, name)
            if value is None or isinstance(value, float):
                axes = () if value is None else (value,)
            elif np.ndim(value) == 0:
                axes = (float(value),)
                object.__setattr__(self, name, axes[0])
            else:
                axes = tuple(np.asarray(value, dtype=float).ravel().tolist())
                object.__setattr__(self, name, axes)
            if not all(0 < limit < math.inf for limit in axes):
                raise GeometryError(f"{name} is {value}; give finite numbers above 0")

    @property
    def brake(self) -> float:
        """Largest deceleration along the path [m/s²]."""
        return self.max_accel if self.max_brake is None else self.max_brake

    def of_axes(self, name: str, dimension: int) -> NDArray[np.float64]:
        """``axis_speed`` or ``axis_accel`` for every axis of a path; nothing if there is no limit.

        Args:
            name: Which of the two.
            dimension: Of the path, d.

        Returns:
            Shape (d,), or (0,).

        Raises:
            GeometryError: When there is a number for each axis of another kind of path.
        """
        value = getattr(self, name)
        if value is None:
            return np.empty(0)
        if isinstance(value, float):
            return np.full(dimension, value)
        axes = np.atleast_1d(np.asarray(value, dtype=float))
        if axes.size not in (1, dimension):
            raise GeometryError(
                f"{name} has {axes.size} numbers and the path {dimension} axes; give one number, "
                "or one for each axis"
            )
        return np.full(dimension, axes[0]) if axes.size == 1 else axes

    def conflicts(self, turning_radius: float) -> tuple[str, ...]:
        """What these limits never allow where a robot turns as tightly as it can.

        Args:
            turning_radius: Of its tightest turn [m], more than 0.

        Returns:
            A sentence for each limit of the speed that another one never lets the robot reach
            there; none if all agree.

        Example:
            >>> Limits(max_speed=3, max_accel=1, max_lateral_accel=0.5).conflicts(2.0)
            ('max_speed 3 m/s is never reached on a turn of 2 m: max_lateral_accel 0.5 m/s² allows
             1 m/s there; a radius of 18 m would allow it',)
        """
        if not 0 < turning_radius < math.inf:
            raise GeometryError(f"turning_radius is {turning_radius}; give a radius above 0")
        found = []
        lateral, rate, top = self.max_lateral_accel, self.max_yaw_rate, self.max_speed
        if lateral is not None and (slow := math.sqrt(lateral * turning_radius)) < top:
            found.append(
                f"max_speed {top:g} m/s is never reached on a turn of {turning_radius:g} m: "
                f"max_lateral_accel {lateral:g} m/s² allows {slow:.3g} m/s there; "
                f"a radius of {top * top / lateral:.3g} m would allow it"
            )
        if rate is not None and (slow := rate * turning_radius) < top:
            found.append(
                f"max_speed {top:g} m/s is never reached on a turn of {turning_radius:g} m: "
                f"max_yaw_rate {math.degrees(rate):.3g} deg/s allows {slow:.3g} m/s there; "
                f"a radius of {top / rate:.3g} m would allow it"
            )
        return tuple(found)

    @classmethod
    def of(cls, robot: RobotSpec, reaction: float = REACTION_S) -> Limits:
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
            brake = robot.max_brake_mps2 or robot.max_accel_mps2
            top = min(top, stopping_speed(room, brake, reaction))
        return cls(
            max_speed=top,
            max_accel=robot.max_accel_mps2,
            max_lateral_accel=robot.lateral_accel,
            max_brake=robot.max_brake_mps2,
            max_yaw_rate=_radians(robot.max_yaw_rate_degps),
            max_yaw_accel=_radians(robot.max_yaw_accel_degps2),
            max_jerk=robot.max_jerk_mps3,
        )


def _radians(degrees: float | None) -> float | None:
    return None if degrees is None else math.radians(degrees)


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
    """A stop on the path.

    Attributes:
        distance: Where it is along the path [m].
        dwell: How long the robot stays there [s].
        name: What it is called in reports.

    Raises:
        GeometryError: A number isn't finite, or below 0.

    >>> Station(12.5, dwell=20.0, name="pump")
    Station(distance=12.5, dwell=20.0, name='pump')
    """

    distance: float
    dwell: float = 0.0
    name: str = ""

    def __post_init__(self) -> None:
        for key in ("distance", "dwell"):
            object.__setattr__(self, key, number_from(f"Station.{key}", getattr(self, key)))
