"""What a drive asks of the time law of its robot."""

from __future__ import annotations

from typing import NamedTuple


class DriveLimits(NamedTuple):
    """Limits that a drive sets beside those of its robot. None: no limit.

    Attributes:
        max_speed: Along the path [m/s].
        max_lateral_accel: Across the path [m/s²].
        max_yaw_rate: Of the body [rad/s].
        max_steer_rate: How fast steered wheels turn [rad/s]; with ``wheelbase``.
        wheelbase: From the reference point, on the driven axle, to the steered one [m].
        body_speed: Along and across the body [m/s], where its heading is held.

    Example:
        >>> DriveLimits(max_speed=1.0).max_yaw_rate is None
        True
    """

    max_speed: float | None = None
    max_lateral_accel: float | None = None
    max_yaw_rate: float | None = None
    max_steer_rate: float | None = None
    wheelbase: float | None = None
    body_speed: tuple[float, float] | None = None


def limits_of_sides(
    max_speed: float, track: float, grip: float, max_wheel_speed: float | None
) -> DriveLimits:
    """What wheels or tracks on two sides ask, the outer of which is the faster.

    It runs at v (1 + |curvature| track / 2), so a limit of the speed and one of the yaw rate share
    what it can.

    Args:
        max_speed: Of the robot [m/s].
        track: Distance between the sides [m].
        grip: Part of the yaw rate that is left after slipping.
        max_wheel_speed: Of either side [m/s]; None: no limit.

    Example:
        >>> limits = limits_of_sides(2.0, 0.5, 1.0, 1.0)
        >>> limits.max_speed, round(limits.max_yaw_rate, 9)
        (0.8, 0.8)
    """
    if max_wheel_speed is None:
        return DriveLimits()
    speed = min(max_speed, STRAIGHT_SHARE * max_wheel_speed)
    rate = 2.0 * grip * (max_wheel_speed - speed) / track
    return DriveLimits(max_speed=speed, max_yaw_rate=rate)


STRAIGHT_SHARE = 0.8
"""Part of a wheel's speed that is used at most on the straight; the rest is for turning."""
