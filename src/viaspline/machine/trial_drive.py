"""A trial drive: a machine follows a path with its time law, with nothing else to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.closed_loop import drive
from viaspline.kernels.tracking.drive_motion import HEADING, STATE, SUBSTEP, X, Y
from viaspline.kernels.tracking.reference_timing import SpeedProfile
from viaspline.machine.drive_noise import DriveNoise
from viaspline.machine.machine import PERIOD, machine_of
from viaspline.machine.reference import reference_path_of
from viaspline.machine.tracking import Tracking
from viaspline.mission.robot_parts import RobotSpec
from viaspline.trajectory.trajectory import Trajectory

LONGER = 1.5  # times the planned duration, and
GRACE = 60.0  # this much longer [s]: then a trial drive is broken off


@dataclass(frozen=True, eq=False)
class Track:
    """A drive as it truly was, at every step of the motion.

    Attributes:
        times: [s], shape (n,).
        positions: Of the reference point [m], shape (n, 2).
        headings: Running on over whole turns [rad], shape (n,).
        speeds: In the step that ends there [m/s], shape (n,).
        yaw_rates: The same [rad/s], shape (n,).
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
    period: float = PERIOD,
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> Track:
    """Drive along a path in simulation, closed loop, with the delays and the noise of the drive.

    The robot's clock waits while the robot is too far behind: so a machine that is slower than
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
        >>> law = retime(line, Limits(max_speed=2.0, max_accel=1.0))
        >>> track = follow(line, law, robot, offset=(0.0, 0.5, 0.0))
        >>> track.finished, bool(abs(track.tracking.cross_track[-1]) < 0.01)
        (True, True)
    """
    if not 0.0 < period < math.inf:
        raise GeometryError(f"period is {period}; give a time above 0 s")
    machine, reference = machine_of(robot, period), reference_path_of(path)
    profile = speed_profile_of(trajectory.delayed(-trajectory.start_time))
    state = start_of(reference.x[0], reference.y[0], reference.heading[0], offset)
    substeps = max(math.ceil(period / SUBSTEP - 1e-9), 1)
    count = math.ceil((LONGER * trajectory.duration + GRACE + machine.delay) / period)
    faults = DriveNoise(robot, seed)
    rows, notes, ticks = drive(
        machine, reference, profile, state.copy(), period, substeps,
        faults.measured(count), faults.driven(count * substeps),
    )  # fmt: skip
    finished = ticks >= 0
    if finished:
        rows, notes = rows[: ticks * substeps], notes[:ticks]
    rows = np.concatenate(([[0.0, *state[:3], 0.0, 0.0]], rows))
    return Track(
        rows[:, 0], rows[:, 1:3], rows[:, 3], rows[:, 4], rows[:, 5],
        Tracking.of(reference, notes, rows), finished,
    )  # fmt: skip


def speed_profile_of(trajectory: Trajectory) -> SpeedProfile:
    """A time law for kernels, which want arrays that they may write to."""
    return SpeedProfile(
        np.array(trajectory.distances),
        np.array(trajectory.speeds),
        np.array(trajectory.times),
        np.array(trajectory.accelerations),
    )


def start_of(
    x: float, y: float, heading: float, offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> Floats:
    """The state of a machine that stands at a pose, or off it: ahead, to the left [m], [rad]."""
    ahead, left, turned = offset
    state = np.zeros(STATE)
    state[X] = x + ahead * math.cos(heading) - left * math.sin(heading)
    state[Y] = y + ahead * math.sin(heading) + left * math.cos(heading)
    state[HEADING] = heading + turned
    return state
