"""How a drive moves on under its commands: as a controller predicts it, and as it truly is."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.tracking.drive_model import (
    NOISE_TIME_S,
    DriveModel,
    is_steered,
    limited,
    moved,
    noise_share,
    respond,
    yaw_rate_of,
)

SUBSTEP_S = 0.01
"""Longest step of the motion [s]."""

# the state of a drive: pose, speed along the body, turn, noise of speed and yaw rate, speed across
X, Y, HEADING, ALONG, TURN, SPEED_OFF, YAW_OFF, ACROSS = range(8)
STATE = 8

# a command: when it was given, and what it was
GIVEN_AT, TO_ALONG, TO_ACROSS, TO_TURN = range(4)
COMMAND = 4

# a row of a track: when, the pose, and the velocity of the body and the yaw rate before
ROW_TIME, ROW_X, ROW_Y, ROW_HEADING, ROW_ALONG, ROW_YAW_RATE, ROW_ACROSS = range(7)
ROW = 7


@inner
def carried(
    model: DriveModel, pose: Floats, begin: float, end: float, commands: Floats, count: int
) -> None:
    """Let a drive go on from ``begin`` to ``end`` by the commands that take effect then.

    Args:
        model: Without its noise.
        pose: X, Y, HEADING, ALONG, TURN and ACROSS, changed in place.
        begin: [s].
        end: [s].
        commands: In the order in which they were given, the first ``count`` of them, shape
            (n, COMMAND).
        count: How many commands there are.
    """
    if end <= begin:
        return
    steps = math.ceil((end - begin) / SUBSTEP_S - 1e-6)
    seconds = (end - begin) / steps
    k = count - 1
    while k >= 0 and commands[k, GIVEN_AT] + model.delay > begin + 0.5 * seconds:
        k -= 1
    for i in range(steps):
        now = begin + (i + 0.5) * seconds
        while k + 1 < count and commands[k + 1, GIVEN_AT] + model.delay <= now:
            k += 1
        to_along, to_across, to_turn = pose[ALONG], pose[ACROSS], pose[TURN]
        if k >= 0:
            to_along, to_across, to_turn = limited(
                model, commands[k, TO_ALONG], commands[k, TO_ACROSS], commands[k, TO_TURN]
            )
        along, across, turn = respond(
            model, pose[ALONG], pose[ACROSS], pose[TURN], to_along, to_across, to_turn, seconds
        )
        mean, aside = 0.5 * (pose[ALONG] + along), 0.5 * (pose[ACROSS] + across)
        rate = yaw_rate_of(model, mean, 0.5 * (pose[TURN] + turn))
        pose[X], pose[Y], pose[HEADING] = moved(
            pose[X], pose[Y], pose[HEADING], mean, aside, rate, seconds
        )
        pose[ALONG], pose[ACROSS], pose[TURN] = along, across, turn


@kernel
def predict(model: DriveModel, pose: Floats, begin: float, end: float, commands: Floats) -> Floats:
    """Where a drive will be by the commands that it was given, as its controller knows it.

    Args:
        model: Without its noise.
        pose: X, Y, HEADING, ALONG, TURN and ACROSS at ``begin``, shape (STATE,).
        begin: [s].
        end: [s].
        commands: In the order in which they were given, shape (n, COMMAND).

    Returns:
        The same at ``end``, shape (STATE,).
    """
    later = pose.copy()
    carried(model, later, begin, end, commands, commands.shape[0])
    return later


@inner
def move_into(
    model: DriveModel,
    state: Floats,
    begin: float,
    seconds: float,
    first: int,
    last: int,
    commands: Floats,
    count: int,
    noise: Floats,
    track: Floats,
) -> None:
    """The true motion in the steps ``first`` to ``last``; see ``move``."""
    fade = math.exp(-seconds / NOISE_TIME_S)
    fresh = math.sqrt(1.0 - fade * fade)
    k = count - 1
    while k >= 0 and commands[k, GIVEN_AT] + model.delay > begin + 0.5 * seconds:
        k -= 1
    for i in range(first, last):
        end = begin + (i - first + 1) * seconds
        while k + 1 < count and commands[k + 1, GIVEN_AT] + model.delay <= end - 0.5 * seconds:
            k += 1
        to_along, to_across, to_turn = 0.0, 0.0, 0.0
        if is_steered(model):  # wheels stay as they were turned
            to_turn = state[TURN]
        if k >= 0:
            to_along, to_across, to_turn = limited(
                model, commands[k, TO_ALONG], commands[k, TO_ACROSS], commands[k, TO_TURN]
            )
        along, across, turn = respond(
            model, state[ALONG], state[ACROSS], state[TURN], to_along, to_across, to_turn, seconds
        )
        mean, aside = 0.5 * (state[ALONG] + along), 0.5 * (state[ACROSS] + across)
        rate = yaw_rate_of(model, mean, 0.5 * (state[TURN] + turn))
        state[ALONG], state[ACROSS], state[TURN] = along, across, turn
        state[SPEED_OFF] = fade * state[SPEED_OFF] + fresh * model.speed_noise * noise[i, 0]
        state[YAW_OFF] = fade * state[YAW_OFF] + fresh * model.yaw_noise * noise[i, 1]
        share = noise_share(model, mean, aside, rate)
        off = share * state[SPEED_OFF]
        if aside == 0.0:
            mean += off
        else:  # it is off along the direction of travel
            ground = math.hypot(mean, aside)
            mean, aside = mean + off * mean / ground, aside + off * aside / ground
        rate += share * state[YAW_OFF]
        state[X], state[Y], state[HEADING] = moved(
            state[X], state[Y], state[HEADING], mean, aside, rate, seconds
        )
        track[i, ROW_TIME], track[i, ROW_X], track[i, ROW_Y] = end, state[X], state[Y]
        track[i, ROW_HEADING], track[i, ROW_ALONG] = state[HEADING], mean
        track[i, ROW_YAW_RATE], track[i, ROW_ACROSS] = rate, aside


@kernel
def move(
    model: DriveModel,
    state: Floats,
    begin: float,
    seconds: float,
    commands: Floats,
    noise: Floats,
) -> Floats:
    """The true motion of a drive, as it is commanded.

    Args:
        model: The drive, with its noise.
        state: Shape (STATE,), changed in place.
        begin: [s].
        seconds: Each step takes [s].
        commands: When each was given [s], increasing, and the velocity along and across the body
            [m/s] and the turn that it asked for, shape (k, COMMAND).
        noise: Standard normal numbers for speed and yaw rate in every step, shape (n, 2).

    Returns:
        After every step time, x, y, heading, and the speed along the body, the yaw rate and the
        speed across the body in it, shape (n, ROW).
    """
    n = noise.shape[0]
    track = np.empty((n, ROW))
    move_into(model, state, begin, seconds, 0, n, commands, commands.shape[0], noise, track)
    return track
