"""A drive that is under way, tried out ahead: how far beside a path it would get from here.

It is the closed loop of the trial drives, begun in the state in which the robot is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.closed_loop import drive
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.kernels.tracking.drive_motion import SUBSTEP_S
from viaspline.kernels.tracking.reference_path import ReferencePath
from viaspline.kernels.tracking.reference_timing import SpeedProfile
from viaspline.machine.drive_noise import DriveNoise
from viaspline.machine.tracking import Tracking
from viaspline.mission.robot_parts import RobotSpec

MAX_DURATIONS, MAX_OVERTIME_S = 1.5, 5.0
"""It is broken off after so many planned durations, and so much longer [s]."""


@dataclass(frozen=True, eq=False)
class DriveState:
    """A drive under way, as its controller knows it.

    Attributes:
        pose: Where the robot is taken to be, and how it moves, shape (STATE,).
        memory: Of the controller, shape (MEMORY,).
        given: Commands that were given, in order, shape (k, COMMAND).
        time: Now [s].
        period: From one command to the next [s].
    """

    pose: Floats
    memory: Floats
    given: Floats
    time: float
    period: float


def drive_ahead(
    model: DriveModel,
    robot: RobotSpec,
    reference: ReferencePath,
    profile: SpeedProfile,
    state: DriveState,
    until: float,
    seed: int,
) -> Tracking | None:
    """What a drive would be off from a path on which it goes on.

    Args:
        model: The drive.
        robot: Its body, drive and localisation.
        reference: The path; it begins with what was driven so far.
        profile: The time law, of which the robot is at ``state.time`` and its delay.
        state: How it begins.
        until: Distance along the path as far as which it is looked at [m].
        seed: Of the noise.

    Returns:
        Its errors; None if it never comes so far.
    """
    period = state.period
    substeps = max(math.ceil(period / SUBSTEP_S - 1e-9), 1)
    left = max(float(profile.time[-1]) - state.time, 0.0)
    count = math.ceil((MAX_DURATIONS * left + MAX_OVERTIME_S) / period)
    faults = DriveNoise(robot, seed)
    rows, notes, ticks = drive(
        model, reference, profile, state.pose.copy(), state.memory.copy(), state.given.copy(),
        state.time, until, period, substeps, faults.measured(count),
        faults.driven(count * substeps),
    )  # fmt: skip
    if ticks < 1:
        return None
    return Tracking.of(model, reference, notes[:ticks], rows[: ticks * substeps])


def is_random(robot: RobotSpec) -> bool:
    """Whether one drive of a robot differs from the next.

    Example:
        >>> is_random(RobotSpec()), is_random(RobotSpec(localization={"position_noise_m": 0.1}))
        (False, True)
    """
    drive, place = robot.drive, robot.localization
    noise = [0.0] if place is None else [place.position_noise_m, place.heading_noise_deg]
    if drive is not None:
        noise += [drive.speed_noise_mps, drive.yaw_rate_noise_degps]
    return any(size > 0.0 for size in noise)
