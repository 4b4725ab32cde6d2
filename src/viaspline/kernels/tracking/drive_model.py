"""A model of a drive: what its actuators make of a command, and the arc that follows from it.

A command is a velocity of the body, along and across it, and a turn: a steering angle where wheels
steer, a yaw rate where none do. Which of it a drive can follow is said by numbers (see
``Actuators``), not by its kind.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from viaspline.kernels.jit import inlined, kernel
from viaspline.kernels.tracking.actuators import Actuators

NOISE_TIME_S = 0.5
"""Correlation time of the noise of a drive [s]."""

FULL_NOISE_SPEED_MPS = 0.1
"""Speed of a wheel from which on the noise acts in full [m/s]."""

LEAST_TRACK_M = 0.2
"""Between the wheels of a drive of which that is not known, for what noise does to it [m]."""


class DriveModel(NamedTuple):
    """A drive with its limits, its faults and the gains of its control; infinite: no limit.

    ``turn`` is what makes it turn: the steering angle [rad] where wheels steer, else the yaw rate
    [rad/s].

    Attributes:
        actuators: What they can do.
        max_turn: Greatest ``turn``.
        max_turn_rate: Greatest change of it per second.
        max_speed: Greatest speed [m/s].
        max_accel: Greatest change of the speed, along the body and across it [m/s²].
        delay: From a command to its effect [s].
        lag: Time constant with which velocity and ``turn`` follow [s].
        spot_rate: Yaw rate on the spot [rad/s].
        convergence_time: A deviation dies out over what is driven in this time [s],
        convergence_distance: and at least over this distance [m].
        along_gain: From an error along the path to a speed [1/s].
        heading_gain: From an error of the heading to a yaw rate, on the spot [1/s].
        slack: How far the robot may lag behind before its clock waits, at rest [m],
        slack_time: and per speed [s].
        speed_noise: Standard deviation of the speed [m/s].
        yaw_noise: Standard deviation of the yaw rate [rad/s].
    """

    actuators: Actuators
    max_turn: float
    max_turn_rate: float
    max_speed: float
    max_accel: float
    delay: float
    lag: float
    spot_rate: float
    convergence_time: float
    convergence_distance: float
    along_gain: float
    heading_gain: float
    slack: float
    slack_time: float
    speed_noise: float
    yaw_noise: float


@inlined
def clip(value: float, least: float, most: float) -> float:
    """A value between two limits."""
    return min(max(value, least), most)


@inlined
def is_steered(model: DriveModel) -> bool:
    """Whether wheels steer, so that it turns only while it moves."""
    return model.actuators.wheelbase > 0.0


@inlined
def moves_across(model: DriveModel) -> bool:
    """Whether its body moves any way, without turning."""
    return model.actuators.max_across > 0.0


@inlined
def wanted_heading(model: DriveModel, tangent: float) -> float:
    """The heading of the body where the path has this one [rad]."""
    held = model.actuators.held_heading
    return tangent if math.isnan(held) else held


@kernel
def limited(
    model: DriveModel, along: float, across: float, turn: float
) -> tuple[float, float, float]:
    """The command that the actuators can follow: where it is too fast, all of it gets slower.

    So the direction of travel, and where a wheel is too fast the curvature, stay as commanded.
    """
    along = clip(along, -model.max_speed, model.max_speed)
    turn = clip(turn, -model.max_turn, model.max_turn)
    actuators = model.actuators
    if moves_across(model):
        share = max(abs(along) / actuators.max_along, abs(across) / actuators.max_across)
        if share > 1.0:
            along, across = along / share, across / share
    fastest = abs(along) + 0.5 * abs(turn) * actuators.track / actuators.grip
    if fastest > actuators.max_wheel_speed:
        along *= actuators.max_wheel_speed / fastest
        turn *= actuators.max_wheel_speed / fastest
    return along, across, turn


@inlined
def followed(now: float, to: float, share: float, most: float) -> float:
    """A value that goes a share of the way to another, by a limited step."""
    return now + clip((to - now) * share, -most, most)


@kernel
def respond(
    model: DriveModel,
    along: float,
    across: float,
    turn: float,
    to_along: float,
    to_across: float,
    to_turn: float,
    seconds: float,
) -> tuple[float, float, float]:
    """Velocity and turn after some time under a command: a lag of first order, limited slopes."""
    share = 1.0
    if model.lag > 0.0:
        share = 1.0 - math.exp(-seconds / model.lag)
    most, widest = model.max_accel * seconds, model.max_turn_rate * seconds
    return (
        followed(along, to_along, share, most),
        followed(across, to_across, share, most),
        followed(turn, to_turn, share, widest),
    )


@kernel
def yaw_rate_of(model: DriveModel, along: float, turn: float) -> float:
    """The yaw rate that belongs to a speed and a turn [rad/s]."""
    if is_steered(model):
        return along * math.tan(turn) / model.actuators.wheelbase
    return turn


@kernel
def moved(
    x: float, y: float, heading: float, along: float, across: float, rate: float, seconds: float
) -> tuple[float, float, float]:
    """The pose after some time at a constant velocity of the body and yaw rate: exactly an arc."""
    half = 0.5 * rate * seconds
    chord = along * seconds
    aside = across * seconds
    if abs(half) > 1e-4:
        share = math.sin(half) / half
    else:
        share = 1.0 - half * half / 6.0
    chord *= share
    aside *= share
    middle = heading + half
    cosine, sine = math.cos(middle), math.sin(middle)
    return (
        x + chord * cosine - aside * sine,
        y + chord * sine + aside * cosine,
        heading + 2.0 * half,
    )


@inlined
def noise_share(model: DriveModel, along: float, across: float, rate: float) -> float:
    """How much of the noise acts, 0 to 1: a robot that stands is not shaken."""
    wheel = abs(along) + abs(across)
    if not is_steered(model):
        wheel += 0.5 * abs(rate) * max(model.actuators.track, LEAST_TRACK_M)
    return min(wheel / FULL_NOISE_SPEED_MPS, 1.0)
