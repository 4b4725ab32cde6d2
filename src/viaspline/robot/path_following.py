"""The command that follows a path: from progress along it to what the robot is to do.

Tested through ``robot/test_navigator``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.control_law import HEADING_DEADBAND_RAD, turn_law
from viaspline.kernels.tracking.drive_model import yaw_rate_of
from viaspline.machine.turns_on_spot import heading_onward
from viaspline.mission.drives.drive import Drive
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.spot_turning import told_rate_of
from viaspline.robot.controller import Controller
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.navigation.track_path import ON_PATH_M
from viaspline.robot.state import Command, RobotState
from viaspline.robot.watching.turned_first import AT_REST_MPS

MIN_CONVERGENCE_M, CONVERGENCE_TIME_S = 1.0, 1.0
"""A robot beside its path comes back to it over at least this distance [m], and over what it drives
in this time [s]."""

SPOT_GAIN = 4.0
"""A robot that stands and looks another way than it should turns so fast for its error [1/s]."""


class _Motion(NamedTuple):
    """What a robot with a drive is to do: in its body's frame, and by its actuators."""

    velocity: tuple[float, float]
    yaw_rate: float
    actuators: Mapping[str, float]


def command_for(
    robot: RobotSpec, progress: Progress, schedule: Schedule, measured: RobotState
) -> Command:
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
    if stopped:
        heading = heading_onward(path, distance)
    if controller is not None:
        motion = _driven(controller, robot.drive)
        speed = math.hypot(*motion.velocity)
        if robot.held_heading is None:
            curvature = motion.yaw_rate / speed if speed > 0.0 else curvature
    else:
        if beside:
            curvature = _led_back(curvature, measured, position, heading)
        motion = _Motion((speed, 0.0), _yaw_rate(robot, speed * curvature), {})
        if speed <= AT_REST_MPS:
            rate = _turning_to(heading_onward(path, distance), measured, robot)
            motion = motion._replace(yaw_rate=rate)
    return Command(
        speed=speed,
        acceleration=acceleration,
        curvature=curvature,
        yaw_rate=motion.yaw_rate,
        position=tuple(position.tolist()),
        heading=heading if robot.held_heading is None else robot.held_heading,
        distance=schedule.driven + distance,
        stopped=stopped,
        finished=progress.finished,
        velocity=motion.velocity,
        actuators=motion.actuators,
    )


def _driven(controller: Controller, drive: Drive | None) -> _Motion:
    """What the controller has decided, in words of the drive."""
    along, across, turn = controller.command
    rate = float(yaw_rate_of(controller.model, along, turn))
    actuators = {} if drive is None else drive.kind.actuator_values(along, turn)
    return _Motion((along, across), rate, actuators)


def _turning_to(heading: float, state: RobotState, robot: RobotSpec) -> float:
    """The yaw rate of a robot without a drive where it stands [rad/s]."""
    error, most = math.remainder(heading - state.heading, math.tau), told_rate_of(robot)
    if abs(error) <= HEADING_DEADBAND_RAD:
        return 0.0
    return min(max(SPOT_GAIN * error, -most), most)


def _yaw_rate(robot: RobotSpec, wanted: float) -> float:
    """A yaw rate that the robot may have [rad/s]."""
    most = math.radians(robot.max_yaw_rate_degps or math.inf)
    return min(max(wanted, -most), most)


def _led_back(curvature: float, state: RobotState, position: Floats, heading: float) -> float:
    aside = np.asarray(state.position)[:2] - position[:2]
    offset = float(aside[1] * math.cos(heading) - aside[0] * math.sin(heading))
    error = math.remainder(state.heading - heading, math.tau)
    distance = max(MIN_CONVERGENCE_M, CONVERGENCE_TIME_S * state.speed)
    return turn_law(curvature, offset, error, distance)


def _ground_curvature(path: Path, u: float) -> float:
    """Curvature of the ground track of a curve in space, left is positive [1/m]."""
    first = np.asarray(path.evaluate(u, 1))[:2]
    second = np.asarray(path.evaluate(u, 2))[:2]
    speed = float(np.linalg.norm(first))
    cross = float(first[0] * second[1] - first[1] * second[0])
    return cross / speed**3 if speed > 0.0 else 0.0
