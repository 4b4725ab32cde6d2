"""From progress along a path to what the robot's wheels are to do."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from viaspline.robot.journey import Journey
from viaspline.robot.progress import ON_PATH
from viaspline.robot.state import Command, RobotState

Floats = NDArray[np.float64]

NEAREST_AIM = 1.0  # a robot beside its path comes back to it over at least this distance [m]
AIM_TIME = 1.0  # and over what it drives in this time [s]


def steer(journey: Journey, state: RobotState) -> Command:
    """The command for a robot at this point of its journey.

    On the path it is the path's own curvature. Beside it, with the offset e to the left of the
    path and the heading error h, it is curvature - e/L² - 2h/L: both errors die out, critically
    damped, over a distance of about L.
    """
    distance, speed, acceleration = (float(x) for x in journey.law.state_at(journey.time))
    if journey.off > ON_PATH:
        distance = journey.distance
        speed = float(journey.law.speed_at(distance))
    path = journey.path
    u = float(path.parameter(distance))
    position = np.asarray(path.evaluate(u))
    heading, curvature = float(path.heading(u)), float(path.curvature(u))
    if not math.isfinite(curvature):
        curvature = 0.0  # a cusp, where the robot turns on the spot
    if path.dimension > 2:
        curvature = _ground_curvature(journey, u)
    if journey.off > ON_PATH:
        curvature -= _correction(state, position, heading)
    return Command(
        speed=speed,
        acceleration=acceleration,
        curvature=curvature,
        yaw_rate=speed * curvature,
        position=tuple(position.tolist()),
        heading=heading,
        distance=distance,
        stopped=speed == 0.0 and acceleration == 0.0,
        finished=journey.finished,
    )


def _correction(state: RobotState, position: Floats, heading: float) -> float:
    aside = np.asarray(state.position)[:2] - position[:2]
    offset = float(aside[1] * math.cos(heading) - aside[0] * math.sin(heading))
    error = math.remainder(state.heading - heading, math.tau)
    aim = max(NEAREST_AIM, AIM_TIME * state.speed)
    return offset / aim**2 + 2.0 * error / aim


def _ground_curvature(journey: Journey, u: float) -> float:
    """Curvature of the ground track of a curve in space, left is positive [1/m]."""
    first = np.asarray(journey.path.evaluate(u, 1))[:2]
    second = np.asarray(journey.path.evaluate(u, 2))[:2]
    speed = float(np.linalg.norm(first))
    cross = float(first[0] * second[1] - first[1] * second[0])
    return cross / speed**3 if speed > 0.0 else 0.0
