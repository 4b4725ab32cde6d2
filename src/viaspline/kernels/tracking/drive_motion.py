"""How a machine moves on under its commands: as a controller predicts it, and as it truly is."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.tracking.drive_model import (
    ACKERMANN,
    BREATH,
    Machine,
    awake,
    limited,
    moved,
    respond,
    turning,
)

SUBSTEP = 0.01
"""Longest step of the motion [s]."""

# the state of a machine: pose, speed, turn, and the noise of speed and yaw rate
X, Y, HEADING, V, W, SPEED_OFF, YAW_OFF = range(7)
STATE = 7


@inner
def carried(
    machine: Machine,
    pose: Floats,
    begin: float,
    end: float,
    times: Floats,
    speeds: Floats,
    turns: Floats,
    count: int,
) -> None:
    """Let a machine go on from ``begin`` to ``end`` by the commands that take effect then.

    Args:
        machine: Without its noise.
        pose: X, Y, HEADING, V and W, changed in place.
        begin: [s].
        end: [s].
        times: When each command was given, increasing, the first ``count`` of them [s].
        speeds: [m/s].
        turns: As the machine's.
        count: How many commands there are.
    """
    if end <= begin:
        return
    steps = math.ceil((end - begin) / SUBSTEP - 1e-6)
    seconds = (end - begin) / steps
    k = count - 1
    while k >= 0 and times[k] + machine.delay > begin + 0.5 * seconds:
        k -= 1
    for i in range(steps):
        now = begin + (i + 0.5) * seconds
        while k + 1 < count and times[k + 1] + machine.delay <= now:
            k += 1
        to_speed, to_turn = pose[V], pose[W]
        if k >= 0:
            to_speed, to_turn = limited(machine, speeds[k], turns[k])
        v, w = respond(machine, pose[V], pose[W], to_speed, to_turn, seconds)
        mean = 0.5 * (pose[V] + v)
        rate = turning(machine, mean, 0.5 * (pose[W] + w))
        pose[X], pose[Y], pose[HEADING] = moved(
            pose[X], pose[Y], pose[HEADING], mean, rate, seconds
        )
        pose[V], pose[W] = v, w


@inner
def move_into(
    machine: Machine,
    state: Floats,
    begin: float,
    seconds: float,
    first: int,
    last: int,
    times: Floats,
    speeds: Floats,
    turns: Floats,
    count: int,
    noise: Floats,
    track: Floats,
) -> None:
    """The true motion in the steps ``first`` to ``last``; see ``move``."""
    fade = math.exp(-seconds / BREATH)
    fresh = math.sqrt(1.0 - fade * fade)
    k = count - 1
    while k >= 0 and times[k] + machine.delay > begin + 0.5 * seconds:
        k -= 1
    for i in range(first, last):
        end = begin + (i - first + 1) * seconds
        while k + 1 < count and times[k + 1] + machine.delay <= end - 0.5 * seconds:
            k += 1
        to_speed, to_turn = 0.0, state[W]
        if machine.kind != ACKERMANN:
            to_turn = 0.0
        if k >= 0:
            to_speed, to_turn = limited(machine, speeds[k], turns[k])
        v, w = respond(machine, state[V], state[W], to_speed, to_turn, seconds)
        mean = 0.5 * (state[V] + v)
        rate = turning(machine, mean, 0.5 * (state[W] + w))
        state[V], state[W] = v, w
        state[SPEED_OFF] = fade * state[SPEED_OFF] + fresh * machine.speed_noise * noise[i, 0]
        state[YAW_OFF] = fade * state[YAW_OFF] + fresh * machine.yaw_noise * noise[i, 1]
        share = awake(machine, mean, rate)
        mean += share * state[SPEED_OFF]
        rate += share * state[YAW_OFF]
        state[X], state[Y], state[HEADING] = moved(
            state[X], state[Y], state[HEADING], mean, rate, seconds
        )
        track[i, 0], track[i, 1], track[i, 2], track[i, 3] = end, state[X], state[Y], state[HEADING]
        track[i, 4], track[i, 5] = mean, rate


@kernel
def move(
    machine: Machine,
    state: Floats,
    begin: float,
    seconds: float,
    times: Floats,
    speeds: Floats,
    turns: Floats,
    noise: Floats,
) -> Floats:
    """The true motion of a machine, as it is commanded.

    Args:
        machine: The drive, with its noise.
        state: Shape (STATE,), changed in place.
        begin: [s].
        seconds: Each step takes [s].
        times: When the commands were given [s], increasing, shape (k,).
        speeds: What they were [m/s], shape (k,).
        turns: As the machine's, shape (k,).
        noise: Standard normal numbers for speed and yaw rate in every step, shape (n, 2).

    Returns:
        After every step time, x, y, heading, and the speed and yaw rate in it, shape (n, 6).
    """
    n = noise.shape[0]
    track = np.empty((n, 6))
    move_into(
        machine, state, begin, seconds, 0, n, times, speeds, turns, times.shape[0], noise, track
    )
    return track
