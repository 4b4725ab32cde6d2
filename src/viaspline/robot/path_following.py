"""The command that follows a path: from progress along it to what the robot is to do.

Tested through ``robot/test_navigator``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.control_law import turn_law
from viaspline.kernels.tracking.drive_model import ACKERMANN, DIFFERENTIAL, SKID_STEER, turning
from viaspline.robot.controller import Controller
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.navigation.track_path import ON_PATH_M
from viaspline.robot.state import Command, RobotState

MIN_AIM_M = 1.0
"""A robot beside its path comes back to it over at least this distance [m],"""

AIM_TIME_S = 1.0
"""and over what it drives in this time [s]."""


def command_for(progress: Progress, schedule: Schedule, measured: RobotState) -> Command:
    """The command for a robot at this point of its path.

    On the path it is the path's own curvature; beside it the control law leads back. The same
    law drives robots with a drive, whose controller has decided already.
    """
    path, trajectory, controller = schedule.path, schedule.trajectory, progress.controller
    distance, speed, acceleration = (float(x) for x in trajectory.state_at(progress.time))
    beside = progress.cross_track > ON_PATH_M and controller is None
    if beside:
        distance = progress.distance
        speed = float(trajectory.speed_at(distance))
    u = float(path.parameter(distance))
    position = np.asarray(path.evaluate(u))
    heading, curvature = float(path.heading(u)), float(path.curvature(u))
    if not math.isfinite(curvature):
        curvature = 0.0  # a cusp, where the robot turns on the spot
    if path.dimension > 2:
        curvature = _ground_curvature(path, u)
    stopped = speed == 0.0 and acceleration == 0.0
    steered, wheels, rate = None, None, None
    if controller is not None:
        speed, rate, steered, wheels = _driven(controller)
        curvature = rate / speed if speed > 0.0 else curvature
    elif beside:
        curvature = _led_back(curvature, measured, position, heading)
    return Command(
        speed=speed,
        acceleration=acceleration,
        curvature=curvature,
        yaw_rate=speed * curvature if rate is None else rate,
        position=tuple(position.tolist()),
        heading=heading,
        distance=distance,
        stopped=stopped,
        finished=progress.finished,
        steer=steered,
        wheels=wheels,
    )


def _driven(
    controller: Controller,
) -> tuple[float, float, float | None, tuple[float, float] | None]:
    """Speed, yaw rate, angle of the front wheels, speeds of the left and right wheels."""
    machine, (speed, turn) = controller.machine, controller.command
    rate = float(turning(machine, speed, turn))
    if machine.kind == ACKERMANN:
        return speed, rate, turn, None
    if machine.kind in (DIFFERENTIAL, SKID_STEER):
        apart = 0.5 * rate * machine.length / machine.grip
        return speed, rate, None, (speed - apart, speed + apart)
    return speed, rate, None, None


def _led_back(curvature: float, state: RobotState, position: Floats, heading: float) -> float:
    aside = np.asarray(state.position)[:2] - position[:2]
    offset = float(aside[1] * math.cos(heading) - aside[0] * math.sin(heading))
    error = math.remainder(state.heading - heading, math.tau)
    return turn_law(curvature, offset, error, max(MIN_AIM_M, AIM_TIME_S * state.speed))


def _ground_curvature(path: Path, u: float) -> float:
    """Curvature of the ground track of a curve in space, left is positive [1/m]."""
    first = np.asarray(path.evaluate(u, 1))[:2]
    second = np.asarray(path.evaluate(u, 2))[:2]
    speed = float(np.linalg.norm(first))
    cross = float(first[0] * second[1] - first[1] * second[0])
    return cross / speed**3 if speed > 0.0 else 0.0
