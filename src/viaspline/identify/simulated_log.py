"""A log of commands that a simulated robot drives: as its mission says, with its noise."""

from __future__ import annotations

import math

import numpy as np

from viaspline.identify.drive_log import DriveLog
from viaspline.identify.standard_drive import as_log
from viaspline.identify.steered_turn import angles_for
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.drive_motion import (
    HEADING,
    ROW_HEADING,
    ROW_X,
    ROW_Y,
    STATE,
    SUBSTEP_S,
    move,
)
from viaspline.machine.drive_noise import DriveNoise
from viaspline.machine.robot_model import drive_model_of
from viaspline.mission.robot_parts import RobotSpec


def simulated_log(robot: RobotSpec, commands: Floats, seed: int = 0) -> DriveLog:
    """What a robot of a mission makes of commands, from a standstill at the origin.

    Args:
        robot: Its drive and localisation.
        commands: Time [s], speed [m/s] and yaw rate [rad/s], evenly, shape (n, 3).
        seed: Of its noise.

    Example:
        >>> from viaspline.identify.standard_drive import standard_commands
        >>> robot = RobotSpec(drive={"differential": {"track_m": 0.5}, "delay_s": 0.2})
        >>> log = simulated_log(robot, standard_commands(1.0, 0.8, 0.05))
        >>> round(log.seconds, 2), bool(log.along[-1] > 20.0)
        (42.85, True)
    """
    period = float(commands[1, 0] - commands[0, 0])
    model, faults = drive_model_of(robot, period), DriveNoise(robot, seed)
    substeps = max(math.ceil(period / SUBSTEP_S - 1e-9), 1)
    count = len(commands)
    turn = commands[:, 2]
    wheelbase = model.actuators.wheelbase
    if wheelbase > 0.0:
        turn = angles_for(commands[:, 1], turn, wheelbase)
    given = np.column_stack((commands[:, 0], commands[:, 1], np.zeros(count), turn))
    state = np.zeros(STATE)
    state[HEADING] = 0.0
    rows = move(
        model, state, float(commands[0, 0]), period / substeps, np.ascontiguousarray(given),
        faults.driven((count - 1) * substeps),
    )  # fmt: skip
    each = np.vstack((np.zeros((1, rows.shape[1])), rows[substeps - 1 :: substeps]))
    noise = faults.measured(count)
    places = each[:, [ROW_X, ROW_Y]] + noise[:, :2]
    return as_log(commands, places, each[:, ROW_HEADING] + noise[:, 2])
