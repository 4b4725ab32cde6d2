"""How much steering a bend leaves to correct with, and the turning circle that leaves enough.

On a path that is bent as tightly as the wheels steer, a robot that noise throws to the outside
can't come back: it drifts off for as long as the bend lasts.
"""

from __future__ import annotations

import math

from viaspline.kernels.tracking.drive_model import FULL_NOISE_SPEED_MPS, NOISE_TIME_S, DriveModel
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.robot_model import drive_model_of
from viaspline.mission.robot_parts import RobotSpec

ENOUGH_RESERVE = 2.0
"""Steering that is left, in standard deviations of what control asks for beside the path: with less
the largest deviations of drives grow faster than their median, see benchmarks/README.md."""

MAX_WIDENING = 1.7
"""A circle is no more than so many times as wide as the steering's: beyond it detours grow faster
than the reserve does."""

RADIUS_TOLERANCE = 1e-3
"""To this part of it a radius is found."""


def steering_reserve(robot: RobotSpec, curvature: float) -> float:
    """What a bend leaves of the steering, in standard deviations of what control asks for.

    The bend is driven as fast as it may be.

    Args:
        robot: Its drive, localisation and limits.
        curvature: Of the bend, without its sign [1/m].

    Returns:
        Infinite where nothing steers or nothing is random; below 0 where the bend is too tight.

    Example:
        >>> steering = {"wheelbase_m": 1.7, "max_steer_deg": 32}
        >>> rover = RobotSpec(drive={"ackermann": steering, "yaw_rate_noise_degps": 2})
        >>> [round(steering_reserve(rover, bend), 1) for bend in (0.0, 0.3, 0.36)]
        [23.2, 3.9, 0.4]
    """
    own = None if robot.drive is None else robot.drive.kind.turn_radius
    if own is None:
        return math.inf
    limits = limits_of(robot)
    speed = limits.max_speed
    if limits.max_lateral_accel is not None and curvature > 0.0:
        speed = min(speed, math.sqrt(limits.max_lateral_accel / curvature))
    asked = curvature_asked(robot, drive_model_of(robot), max(speed, FULL_NOISE_SPEED_MPS))
    return (1.0 / own - curvature) / asked if asked > 0.0 else math.inf


def roomy_turn_radius(robot: RobotSpec, reserve: float = ENOUGH_RESERVE) -> float:
    """The radius of the tightest circle that leaves a robot so much steering [m].

    Args:
        robot: With a turning circle.
        reserve: See ``steering_reserve``.

    Returns:
        The robot's own turning circle where that does; at most ``MAX_WIDENING`` of its steering's.

    Example:
        >>> steering = {"wheelbase_m": 1.7, "max_steer_deg": 32}
        >>> still = RobotSpec(drive={"ackermann": steering})
        >>> shaken = RobotSpec(drive={"ackermann": steering, "yaw_rate_noise_degps": 2})
        >>> round(roomy_turn_radius(still), 2), round(roomy_turn_radius(shaken), 2)
        (2.72, 3.02)
    """
    own = robot.turn_radius
    assert own is not None
    if steering_reserve(robot, 1.0 / own) >= reserve:
        return own
    assert robot.drive is not None
    assert robot.drive.kind.turn_radius is not None
    low, high = own, max(own, MAX_WIDENING * robot.drive.kind.turn_radius)
    while high - low > RADIUS_TOLERANCE * low:
        middle = 0.5 * (low + high)
        enough = steering_reserve(robot, 1.0 / middle) >= reserve
        low, high = (low, middle) if enough else (middle, high)
    return high


def with_steering_to_spare(robot: RobotSpec) -> RobotSpec:
    """A robot whose wheels steer to half of its turning circle; the same if none steer.

    Example:
        >>> rover = RobotSpec(drive={"ackermann": {"wheelbase_m": 1.7, "max_steer_deg": 32}})
        >>> round(rover.turn_radius, 2), round(with_steering_to_spare(rover).turn_radius, 2)
        (2.72, 1.36)
    """
    steered = None if robot.drive is None else robot.drive.ackermann
    if robot.drive is None or steered is None:
        return robot
    angle = math.degrees(math.atan(2.0 * math.tan(math.radians(steered.max_steer_deg))))
    spare = steered.model_copy(update={"max_steer_deg": angle})
    return robot.model_copy(update={"drive": robot.drive.model_copy(update={"ackermann": spare})})


def curvature_asked(robot: RobotSpec, model: DriveModel, speed: float) -> float:
    r"""The standard deviation of the curvature that control asks for beside that of a path [1/m].

    For the offset e and the heading error h it asks for :math:`-e/L^2 - 2h/L`, with the distance L
    over which a deviation dies out. Noise of the yaw rate with the standard deviation σ, which
    keeps for the time τ, turns a robot of the speed v like a curvature of σ/v that keeps over v τ.
    With :math:`a = 1/L` and :math:`b = 1/(v τ)` the loop answers it with
    :math:`\frac{a (2 a + 5 b)}{2 (a + b)^2}` of its variance. To what is measured wrong of the
    place and of the heading it answers at once.

    Args:
        robot: Of which the localisation is looked at.
        model: Its drive.
        speed: Above 0 [m/s].
    """
    over = max(model.convergence_distance, model.convergence_time * speed)
    back, fading = 1.0 / over, 1.0 / (speed * NOISE_TIME_S)
    answered = back * (2.0 * back + 5.0 * fading) / (2.0 * (back + fading) ** 2)
    place = robot.localization
    position = 0.0 if place is None else place.position_noise_m
    heading = 0.0 if place is None else math.radians(place.heading_noise_deg)
    return math.hypot(
        math.sqrt(answered) * model.yaw_noise / speed, position / over**2, 2.0 * heading / over
    )
