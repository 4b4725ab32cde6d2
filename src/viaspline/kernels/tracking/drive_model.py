"""How machines move: what actuators make of a command, and the arc that follows from it."""

from __future__ import annotations

import math
from typing import NamedTuple

from viaspline.kernels.jit import inlined, kernel

POINT, DIFFERENTIAL, ACKERMANN, SKID_STEER = 0, 1, 2, 3

BREATH = 0.5  # correlation time of the noise of a drive [s]
AWAKE = 0.1  # speed of a wheel from which on the noise acts in full [m/s]


class Machine(NamedTuple):
    """What a kernel has to know of a drive; limits that it lacks are infinite.

    ``turn`` stands for what makes it turn: the steering angle [rad] of an Ackermann drive, the
    yaw rate [rad/s] of all others.

    Attributes:
        kind: POINT, DIFFERENTIAL, ACKERMANN or SKID_STEER.
        length: Wheelbase of an Ackermann drive, else the distance between the wheels [m].
        grip: Part of the yaw rate that is left after slipping.
        wheel: Greatest speed of a wheel [m/s].
        turn: Greatest ``turn``.
        turn_rate: Greatest change of it per second.
        speed: Greatest speed [m/s].
        accel: Greatest change of the speed [m/s²].
        delay: From a command to its effect [s].
        lag: Time constant with which speed and ``turn`` follow [s].
        spot: Yaw rate on the spot [rad/s].
        aim_time: A deviation dies out over what is driven in this time [s],
        aim: and at least over this distance [m].
        gain: From an error along the path to a speed [1/s].
        turn_gain: From an error of the heading to a yaw rate, on the spot [1/s].
        room: How far the robot may lag behind before its clock waits, at rest [m],
        room_time: and per speed [s].
        speed_noise: Standard deviation of the speed [m/s].
        yaw_noise: Standard deviation of the yaw rate [rad/s].
    """

    kind: int
    length: float
    grip: float
    wheel: float
    turn: float
    turn_rate: float
    speed: float
    accel: float
    delay: float
    lag: float
    spot: float
    aim_time: float
    aim: float
    gain: float
    turn_gain: float
    room: float
    room_time: float
    speed_noise: float
    yaw_noise: float


@inlined
def clip(value: float, least: float, most: float) -> float:
    """A value between two limits."""
    return min(max(value, least), most)


@kernel
def limited(machine: Machine, speed: float, turn: float) -> tuple[float, float]:
    """The command that the actuators can follow: where a wheel is too fast, both get slower.

    So the curvature of the arc stays as it was commanded.
    """
    speed = clip(speed, -machine.speed, machine.speed)
    turn = clip(turn, -machine.turn, machine.turn)
    if machine.kind == DIFFERENTIAL or machine.kind == SKID_STEER:
        fastest = abs(speed) + 0.5 * abs(turn) * machine.length / machine.grip
        if fastest > machine.wheel:
            speed *= machine.wheel / fastest
            turn *= machine.wheel / fastest
    return speed, turn


@kernel
def respond(
    machine: Machine, speed: float, turn: float, to_speed: float, to_turn: float, seconds: float
) -> tuple[float, float]:
    """Speed and turn after some time under a command: a lag of first order, and limited slopes."""
    share = 1.0
    if machine.lag > 0.0:
        share = 1.0 - math.exp(-seconds / machine.lag)
    most, widest = machine.accel * seconds, machine.turn_rate * seconds
    return (
        speed + clip((to_speed - speed) * share, -most, most),
        turn + clip((to_turn - turn) * share, -widest, widest),
    )


@kernel
def turning(machine: Machine, speed: float, turn: float) -> float:
    """The yaw rate that belongs to a speed and a turn [rad/s]."""
    if machine.kind == ACKERMANN:
        return speed * math.tan(turn) / machine.length
    return turn


@kernel
def moved(
    x: float, y: float, heading: float, speed: float, rate: float, seconds: float
) -> tuple[float, float, float]:
    """The pose after some time at a constant speed and yaw rate: exactly an arc."""
    half = 0.5 * rate * seconds
    chord = speed * seconds
    if abs(half) > 1e-4:
        chord *= math.sin(half) / half
    else:
        chord *= 1.0 - half * half / 6.0
    along = heading + half
    return x + chord * math.cos(along), y + chord * math.sin(along), heading + 2.0 * half


@inlined
def awake(machine: Machine, speed: float, rate: float) -> float:
    """How much of the noise acts, 0 to 1: a robot that stands is not shaken."""
    wheel = abs(speed)
    if machine.kind != ACKERMANN:
        wheel += 0.5 * abs(rate) * max(machine.length, 0.2)
    return min(wheel / AWAKE, 1.0)
