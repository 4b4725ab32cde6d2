"""A trial drive: a robot follows a path with its time law, with nothing else to look at."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.closed_loop import drive
from viaspline.kernels.tracking.control_law import LAST_TURN, LATE, MEMORY
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.kernels.tracking.drive_motion import (
    COMMAND,
    HEADING,
    ROW,
    ROW_HEADING,
    ROW_TIME,
    ROW_X,
    ROW_Y,
    ROW_YAW_RATE,
    STATE,
    SUBSTEP_S,
    TURN,
    X,
    Y,
)
from viaspline.kernels.tracking.reference_path import ReferencePath
from viaspline.kernels.tracking.reference_timing import SpeedProfile
from viaspline.machine.drive_noise import DriveNoise
from viaspline.machine.reference import reference_path_of
from viaspline.machine.robot_model import drive_model_of
from viaspline.machine.tracking import Tracking
from viaspline.machine.travel import travel_of
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.spot_turning import PERIOD_S
from viaspline.trajectory.trajectory import Trajectory

MAX_DURATIONS, MAX_OVERTIME_S = 1.5, 60.0
"""A trial drive is broken off after so many planned durations, and so much longer [s]."""

USUAL_OVERTIME_S = 3.0
"""By so much most drives are longer than planned at most [s]: no more noise is drawn for them."""


@dataclass(frozen=True, eq=False)
class Track:
    """A drive as it truly was, at every step of the motion.

    Attributes:
        times: [s], shape (n,).
        positions: Of the reference point [m], shape (n, 2).
        headings: Running on over whole turns [rad], shape (n,).
        speeds: Over the ground, in the step that ends there [m/s], shape (n,).
        yaw_rates: Of the body, in that step [rad/s], shape (n,).
        tracking: What it was off from its path.
        finished: Whether it came to the end of the time law.
    """

    times: Floats
    positions: Floats
    headings: Floats
    speeds: Floats
    yaw_rates: Floats
    tracking: Tracking
    finished: bool


def follow(
    path: PiecewiseCubic,
    trajectory: Trajectory,
    robot: RobotSpec,
    *,
    seed: int = 0,
    period: float = PERIOD_S,
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> Track:
    """Drive along a path in simulation, closed loop, with the delays and the noise of the drive.

    The robot's clock waits while the robot is too far behind: so a robot that is slower than
    its time law comes to the end later, not on another way.

    Args:
        path: In the plane.
        trajectory: Its time law.
        robot: Its drive and localisation.
        seed: Of the noise.
        period: Of the controller [s].
        offset: Where the robot is at first, ahead and left of the start of the path [m], and by
            what its heading is off [rad].

    Raises:
        GeometryError: When the path has heights or the period is not above 0.

    Example:
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.trajectory.retime import retime
        >>> line = PiecewiseCubic([[[0, 0], [10, 0], [20, 0], [30, 0]]])
        >>> robot = RobotSpec(drive={"differential": {"track_m": 0.5}, "delay_s": 0.1})
        >>> trajectory = retime(line, Limits(max_speed=2.0, max_accel=1.0))
        >>> track = follow(line, trajectory, robot, offset=(0.0, 0.5, 0.0))
        >>> track.finished, bool(abs(track.tracking.cross_track[-1]) < 0.01)
        (True, True)
    """
    model, reference = drive_model_of(robot, _sound(period)), reference_path_of(path)
    start = start_of(model, reference, offset)
    faults = DriveNoise(robot, seed)
    rows, notes, finished = _driven(model, reference, trajectory, start, faults, period)
    rows = np.concatenate((first_row(start), rows))
    travel = travel_of(model, rows)
    return Track(
        rows[:, ROW_TIME], rows[:, [ROW_X, ROW_Y]], rows[:, ROW_HEADING], travel.speeds,
        rows[:, ROW_YAW_RATE], Tracking.of(model, reference, notes, rows), finished,
    )  # fmt: skip


def trackings(
    path: PiecewiseCubic, trajectory: Trajectory, robot: RobotSpec, seeds: Iterable[int]
) -> Iterator[tuple[Tracking, bool]]:
    """What drives as of ``follow`` are off from their path, looked at once in every period.

    Args:
        path: In the plane.
        trajectory: Its time law.
        robot: Its drive and localisation.
        seeds: Of the noise, one for each drive.

    Yields:
        The errors, and whether the drive came to the end of the time law.

    Raises:
        GeometryError: When the path has heights.
    """
    model, reference = drive_model_of(robot), reference_path_of(path)
    start = start_of(model, reference)
    for seed in seeds:
        faults = DriveNoise(robot, seed)
        rows, notes, finished = _driven(model, reference, trajectory, start, faults, PERIOD_S)
        ends = np.ascontiguousarray(rows[::-1][:: len(rows) // len(notes)][::-1])
        yield Tracking.of(model, reference, notes, ends), finished


def _sound(period: float) -> float:
    if not 0.0 < period < math.inf:
        raise GeometryError(f"period is {period}; give a time above 0 s")
    return period


def _driven(
    model: DriveModel,
    reference: ReferencePath,
    trajectory: Trajectory,
    start: Floats,
    faults: DriveNoise,
    period: float,
) -> tuple[Floats, Floats, bool]:
    """Every step of a drive and what was noted in every period; whether it came to its end.

    Noise is drawn for as long as drives usually take, and more where one takes longer.
    """
    profile = speed_profile_of(trajectory.delayed(-trajectory.start_time))
    substeps = max(math.ceil(period / SUBSTEP_S - 1e-9), 1)
    measured, driven = np.empty((0, 3)), np.empty((0, 2))
    for durations, overtime in ((1.0, USUAL_OVERTIME_S), (MAX_DURATIONS, MAX_OVERTIME_S)):
        most = durations * trajectory.duration + overtime + model.delay
        more = math.ceil(most / period) - len(measured)
        measured = np.concatenate((measured, faults.measured(more)))
        driven = np.concatenate((driven, faults.driven(more * substeps)))
        memory = np.zeros(MEMORY)
        memory[LATE], memory[LAST_TURN] = model.delay, start[TURN]
        rows, notes, ticks = drive(
            model, reference, profile, start.copy(), memory, np.empty((0, COMMAND)), 0.0, math.inf,
            period, substeps, measured, driven,
        )  # fmt: skip
        if ticks >= 0:
            return rows[: ticks * substeps], notes[:ticks], True
    return rows, notes, False


PROFILE_STEP_S = 0.02
"""For so long an acceleration that changes is taken for constant [s]."""


def speed_profile_of(trajectory: Trajectory) -> SpeedProfile:
    """A time law for kernels, which want arrays that they may write to.

    Where the acceleration changes it is taken for constant over short times.
    """
    if trajectory.changes is None:
        return SpeedProfile(
            np.array(trajectory.distances),
            np.array(trajectory.speeds),
            np.array(trajectory.times),
            np.array(trajectory.accelerations),
        )
    even = np.arange(trajectory.start_time, trajectory.end_time, PROFILE_STEP_S)
    times = np.unique(np.concatenate((trajectory.times, even)))
    distances, speeds, _ = trajectory.state_at(times)
    return SpeedProfile(distances, speeds, times, np.diff(speeds) / np.diff(times))


def start_of(
    model: DriveModel,
    reference: ReferencePath,
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> Floats:
    """The state of a drive that stands at the start of a path, or off it.

    Args:
        model: The drive.
        reference: The path.
        offset: Ahead and to the left of its start [m], and by what the heading is off [rad].
    """
    ahead, left, turned = offset
    state, way = np.zeros(STATE), reference.heading[0]
    held = model.actuators.held_heading
    state[X] = reference.x[0] + ahead * math.cos(way) - left * math.sin(way)
    state[Y] = reference.y[0] + ahead * math.sin(way) + left * math.cos(way)
    state[HEADING] = (way if math.isnan(held) else held) + turned
    return state


def first_row(state: Floats) -> Floats:
    """The row of a track at time 0, of a drive that stands, shape (1, ROW)."""
    row = np.zeros((1, ROW))
    row[0, [ROW_X, ROW_Y, ROW_HEADING]] = state[[X, Y, HEADING]]
    return row
