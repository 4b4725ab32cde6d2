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
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.spot_turning import told_rate_of
from viaspline.robot.controller import Controller
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.navigation.track_path import ON_PATH_M
from viaspline.robot.state import Command, RobotState
from viaspline.robot.watching.turned_first import AT_REST_MPS, LEAVING_RAD
from viaspline.trajectory.trajectory import Trajectory

MIN_CONVERGENCE_M, CONVERGENCE_TIME_S = 1.0, 1.0
"""A robot beside its path comes back to it over at least this distance [m], and over what it drives
in this time [s]."""

PERIODS_PER_RETURN = 4.0
"""And over what it drives in so many steps: arcs that are held for a step would overshoot."""

CATCH_UP_PER_S = 1.0
"""A robot without a drive that is behind its law is told so much more speed for each metre [1/s],
but no more than the law has for where it is."""

SIMPSON = np.array([1.0, 4.0, 2.0, 4.0, 1.0]) / 12.0
"""Weights of curvatures at even places, for the mean of them (Simpson's rule, applied twice)."""

SPOT_GAIN = 4.0
"""A robot that stands and looks another way than it should turns so fast for its error [1/s], and
never farther in a step than that."""


class _Motion(NamedTuple):
    """What a robot is to do until the next step: in its body's frame, and by its actuators."""

    velocity: tuple[float, float]
    yaw_rate: float
    curvature: float
    actuators: Mapping[str, float]


class _Place(NamedTuple):
    """Where a robot is on its path: along it [m], there [m], shape (d,), and its heading [rad]."""

    distance: float
    position: Floats
    heading: float

    @classmethod
    def of(cls, path: Path, distance: float) -> _Place:
        """The place of a distance along a path [m]."""
        u = float(path.parameter(distance))
        return cls(distance, np.asarray(path.evaluate(u)), float(path.heading(u)))


def command_for(
    task: DriveTask, progress: Progress, schedule: Schedule, measured: RobotState
) -> Command:
    """The command for a robot at this point of its path.

    On the path it is the path's own curvature; beside it the control law leads back. The same
    law drives robots with a drive, whose controller has decided already. One without is told what
    brings it to where it should be at the next step, if it holds that until then.
    """
    robot, path, controller = task.mission.robot, schedule.path, progress.controller
    distance, speed, acceleration = (float(x) for x in schedule.trajectory.state_at(progress.time))
    if progress.cross_track > ON_PATH_M and controller is None:
        distance = progress.distance
        speed = float(schedule.trajectory.speed_at(distance))
    place = _Place.of(path, distance)
    stopped = speed == 0.0 and acceleration == 0.0
    if controller is not None:
        motion = _driven(controller, robot, path, distance)
        speed = math.hypot(*motion.velocity)
    else:
        motion = _held(task, progress, schedule, measured, place)
    if controller is None and speed <= AT_REST_MPS:
        motion = _from_rest(task, motion, heading_onward(path, distance), measured)
        stopped = motion.velocity == (0.0, 0.0)
        acceleration = 0.0 if stopped else acceleration
    if controller is None and progress.cross_track > ON_PATH_M:
        speed = max(speed, motion.velocity[0])
    heading = heading_onward(path, distance) if stopped else place.heading
    return Command(
        speed=speed,
        acceleration=acceleration,
        curvature=motion.curvature,
        yaw_rate=motion.yaw_rate,
        position=tuple(place.position.tolist()),
        heading=heading if robot.held_heading is None else robot.held_heading,
        distance=schedule.driven + distance,
        stopped=stopped,
        finished=progress.finished,
        velocity=motion.velocity,
        actuators=motion.actuators,
    )


def _driven(controller: Controller, robot: RobotSpec, path: Path, distance: float) -> _Motion:
    """What the controller has decided, in words of the drive."""
    along, across, turn = controller.command
    rate = float(yaw_rate_of(controller.model, along, turn))
    speed = math.hypot(along, across)
    if robot.held_heading is None and speed > 0.0:
        curvature = rate / speed
    else:
        curvature = float(_curvatures(path, np.array([distance]))[0])
    actuators = {} if robot.drive is None else robot.drive.kind.actuator_values(along, turn)
    return _Motion((along, across), rate, curvature, actuators)


def _held(
    task: DriveTask, progress: Progress, schedule: Schedule, measured: RobotState, place: _Place
) -> _Motion:
    """What brings a robot without a drive to where it should be at the next step.

    Args:
        task: What is asked of it.
        progress: How far it has come.
        schedule: What it means to do.
        measured: Where it is.
        place: Where that is on its path.
    """
    path, law, distance = schedule.path, schedule.trajectory, place.distance
    now, then = law.distance_at([progress.time, progress.time + task.period])
    onward = max(float(then) - float(now), 0.0)
    places = np.linspace(distance, min(distance + onward, path.length), len(SIMPSON))
    curvature = float(SIMPSON @ _curvatures(path, places))
    speed = onward / task.period
    if progress.cross_track > ON_PATH_M:
        curvature = _led_back(task, curvature, place, measured)
        # who is to stand before something doesn't go on to where it should have stood
        stands = progress.finished or schedule.giving_up is not None
        if not stands and math.isinf(schedule.held_at):
            speed = _caught_up(task, law, speed, place, measured)
    most = math.radians(task.mission.robot.max_yaw_rate_degps or math.inf)
    rate = min(max(speed * curvature, -most), most)
    return _Motion((speed, 0.0), rate, curvature, {})


def _from_rest(task: DriveTask, motion: _Motion, way: float, measured: RobotState) -> _Motion:
    """What a robot without a drive does where it stands: first it turns to its way on, if it can.

    Args:
        task: What is asked of it.
        motion: By which it sets off, where it looks that way.
        way: The heading with which its path leads on [rad].
        measured: Where it is.
    """
    error = math.remainder(way - measured.heading, math.tau)
    most, gain = told_rate_of(task.mission.robot), min(SPOT_GAIN, 1.0 / task.period)
    turned = 0.0 if abs(error) <= HEADING_DEADBAND_RAD else min(max(gain * error, -most), most)
    if motion.velocity[0] == 0.0 or (most > 0.0 and abs(error) > LEAVING_RAD):
        return motion._replace(velocity=(0.0, 0.0), yaw_rate=turned)
    return motion._replace(yaw_rate=motion.yaw_rate + turned)


def _curvatures(path: Path, distances: Floats) -> Floats:
    """Curvatures of a path, over the ground [1/m]; 0 at a cusp, where a robot turns."""
    parameters = np.asarray(path.parameter(distances))
    if path.dimension > 2:
        curvatures = np.array([_ground_curvature(path, u) for u in parameters.tolist()])
    else:
        curvatures = np.asarray(path.curvature(parameters))
    curvatures[~np.isfinite(curvatures)] = 0.0
    return curvatures


def _led_back(task: DriveTask, curvature: float, place: _Place, state: RobotState) -> float:
    """The curvature of the arc that leads a robot back to its path [1/m].

    Args:
        task: What is asked of it.
        curvature: Of the path until the next step [1/m].
        place: Where it is on that.
        state: Where it is.
    """
    aside, heading = np.asarray(state.position)[:2] - place.position[:2], place.heading
    offset = float(aside[1] * math.cos(heading) - aside[0] * math.sin(heading))
    error = math.remainder(state.heading - heading, math.tau)
    seconds = max(CONVERGENCE_TIME_S, PERIODS_PER_RETURN * task.period)
    return turn_law(curvature, offset, error, max(MIN_CONVERGENCE_M, seconds * state.speed))


def _caught_up(
    task: DriveTask, law: Trajectory, speed: float, place: _Place, state: RobotState
) -> float:
    """The speed of a robot that drives less than it is told, and would stop short [m/s].

    Args:
        task: What is asked of it.
        law: Its time law.
        speed: By which it would be where its law has it at the next step, if it were there now.
        place: Where its law has it.
        state: Where it is.
    """
    behind = place.position[:2] - np.asarray(state.position)[:2]
    # where it looks another way than its path leads, going on would not bring it there
    ways = (place.heading, state.heading)
    short = min(float(behind[0] * math.cos(way) + behind[1] * math.sin(way)) for way in ways)
    if short <= 0.0:
        return speed
    most = float(law.speed_at(max(place.distance - short, 0.0)))
    gain = min(CATCH_UP_PER_S, 1.0 / task.period)
    return max(speed, min(speed + gain * short, most))


def _ground_curvature(path: Path, u: float) -> float:
    """Curvature of the ground track of a curve in space, left is positive [1/m]."""
    first = np.asarray(path.evaluate(u, 1))[:2]
    second = np.asarray(path.evaluate(u, 2))[:2]
    speed = float(np.linalg.norm(first))
    cross = float(first[0] * second[1] - first[1] * second[0])
    return cross / speed**3 if speed > 0.0 else 0.0
