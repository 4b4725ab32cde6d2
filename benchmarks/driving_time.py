"""The least time along a curve that is given as points close together: forwards, then backwards."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

import viaspline as vs


@dataclass(frozen=True, kw_only=True)
class DrivingLimits:
    """What a robot can do.

    Attributes:
        speed: [m/s].
        accel: Along the path, speeding up [m/s²].
        brake: Along the path, slowing down [m/s²].
        lateral: Across the path [m/s²].
        curvature: Of the tightest circle [1/m]; infinite where there is none.
    """

    speed: float
    accel: float
    brake: float
    lateral: float
    curvature: float = math.inf

    @classmethod
    def of(cls, robot: vs.RobotSpec) -> DrivingLimits:
        """Those of a mission's robot; across the path as along it where it doesn't say."""
        top = vs.Limits.of(robot).max_speed
        return cls(
            speed=top,
            accel=robot.max_accel_mps2,
            brake=robot.max_brake_mps2 or robot.max_accel_mps2,
            lateral=robot.max_lateral_accel_mps2 or robot.max_accel_mps2,
            curvature=math.inf if robot.turn_radius is None else 1.0 / robot.turn_radius,
        )


def squares_of_speed(
    steps: np.ndarray, curvature: np.ndarray, rests: np.ndarray, limits: DrivingLimits
) -> np.ndarray:
    """The greatest v² at every point [m²/s²], (n,).

    Args:
        steps: From each point to the next [m], (n - 1,).
        curvature: [1/m], (n,).
        rests: True where the robot stands still, (n,).
        limits: To be kept.
    """
    bent = np.maximum(np.abs(curvature), 1e-12)
    found = np.where(rests, 0.0, np.minimum(limits.speed**2, limits.lateral / bent)).tolist()
    for i, step in enumerate(steps.tolist()):
        found[i + 1] = min(found[i + 1], found[i] + 2.0 * limits.accel * step)
    for i in range(len(steps) - 1, -1, -1):
        found[i] = min(found[i], found[i + 1] + 2.0 * limits.brake * float(steps[i]))
    return np.array(found)


def driving_time(
    along: np.ndarray, curvature: np.ndarray, rests: np.ndarray, limits: DrivingLimits
) -> float:
    """The least time from the first point to the last [s], at rest in both; dwells left out.

    Args:
        along: Distance of every point from the start [m], (n,).
        curvature: [1/m], (n,).
        rests: Distances at which the robot stands still on the way [m], (k,).
        limits: To be kept.
    """
    still = np.zeros(len(along), bool)
    still[np.searchsorted(along, rests).clip(0, len(along) - 1)] = True
    still[[0, -1]] = True
    steps = np.diff(along)
    speeds = np.sqrt(squares_of_speed(steps, curvature, still, limits))
    moving = steps > 0.0
    return float((2.0 * steps[moving] / (speeds[:-1] + speeds[1:])[moving]).sum())


def straight_time(distance: float, limits: DrivingLimits) -> float:
    """Rest to rest along a straight line [s]."""
    share = 0.5 * limits.speed**2 * (1.0 / limits.accel + 1.0 / limits.brake)
    if share <= distance:
        ramps = limits.speed * (1.0 / limits.accel + 1.0 / limits.brake)
        return ramps + (distance - share) / limits.speed
    top = math.sqrt(2.0 * distance / (1.0 / limits.accel + 1.0 / limits.brake))
    return top * (1.0 / limits.accel + 1.0 / limits.brake)
