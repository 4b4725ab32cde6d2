"""A log, prepared for a fit: what was driven over short times, and what a model drives in them.

Tested through ``identify/test_fit_drive``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.identify.drive_log import DriveLog, DriveLogError
from viaspline.identify.drive_response import (
    ChannelLimits,
    fine_times,
    held,
    response,
    summed,
)
from viaspline.identify.steered_turn import angles_for, yaw_rates_of
from viaspline.identify.wheel_response import WheelLimits, wheel_response
from viaspline.kernels.arrays import Floats, Ints

WINDOW_S = 0.5
"""What is driven in so long is compared [s]."""

STOOD_SHARE = 0.1
"""Of the greatest speed that is commanded: what is slower at first says nothing of its steering."""

LEAST_DRIVEN = 0.2
"""Metres, and radians, that have to be driven at least."""

DELAY, LAG, SPEED_SHARE, YAW_SHARE = range(4)
"""The parameters of a drive that every log shows."""

TOP, ACCEL, TURN_MOST, TURN_SLOPE, WHEEL_ACCEL, ARM = range(4, 10)
"""Its limits, where a log shows them: the greatest speed and its change, the greatest turn (a yaw
rate, or a steering angle) and its change; or of wheels, which act an arm from the middle."""

PARAMETERS = 10


@dataclass(frozen=True)
class FitProblem:
    """A log, prepared; parameters are an array of shape (PARAMETERS,).

    Attributes:
        log: It.
        times: Fine ones [s].
        step: Between them [s].
        told: Commanded speed and turn at those.
        first: Speed and turn at first.
        starts: Rows at which windows begin.
        ends: Rows at which they end.
        driven: Along and turned in each window.
        scale: By which both are divided.
        wheelbase: Of a robot that steers, whose turn is a steering angle [m]; 0: it is a yaw rate.
    """

    log: DriveLog
    times: Floats
    step: float
    told: tuple[Floats, Floats]
    first: tuple[float, float]
    starts: Ints
    ends: Ints
    driven: tuple[Floats, Floats]
    scale: tuple[float, float]
    wheelbase: float

    def motion(self, p: Floats) -> tuple[Floats, Floats]:
        """Speed and yaw rate without delay, fine."""
        speed, turn = self.channels(p)
        if self.wheelbase > 0.0:
            turn = p[YAW_SHARE] * yaw_rates_of(speed, turn, self.wheelbase)
        return speed, turn

    def channels(self, p: Floats) -> tuple[Floats, Floats]:
        """Speed and turn without delay, fine."""
        speed = ChannelLimits(float(p[SPEED_SHARE]), float(p[ACCEL]), float(p[TOP]))
        share = 1.0 if self.wheelbase > 0.0 else float(p[YAW_SHARE])
        yaw = ChannelLimits(share, float(p[TURN_SLOPE]), float(p[TURN_MOST]))
        lag = float(p[LAG])
        if has_wheels(p):
            wheels = WheelLimits(float(p[ARM]), float(p[WHEEL_ACCEL]))
            return wheel_response(self.told, self.step, lag, (speed, yaw), wheels, self.first)
        return (
            response(self.told[0], self.step, lag, speed, self.first[0]),
            response(self.told[1], self.step, lag, yaw, self.first[1]),
        )

    def modelled(self, p: Floats) -> tuple[Floats, Floats]:
        """What the model drives along and turns, at every row of the log."""
        late = self.log.times - p[DELAY]
        before = np.minimum(late - self.times[0], 0.0)  # as it was at first
        along, turned = (
            np.interp(late, self.times, summed(one, self.step)) + before * one[0]
            for one in self.motion(p)
        )
        return along, turned

    def residuals(self, p: Floats) -> Floats:
        """Of both, in every window, shape (2 w,)."""
        rest = [
            (one[self.ends] - one[self.starts] - driven) / scale
            for one, driven, scale in zip(self.modelled(p), self.driven, self.scale, strict=True)
        ]
        return np.concatenate(rest)


def has_wheels(p: Floats) -> bool:
    """Whether the limits of parameters are those of wheels."""
    return math.isfinite(p[WHEEL_ACCEL])


def fit_problem(log: DriveLog, wheelbase: float) -> FitProblem:
    """A log, prepared.

    Args:
        log: Of a drive.
        wheelbase: Of a robot that steers [m], else 0.

    Raises:
        DriveLogError: When the robot hardly moves or hardly turns, or its commands never change.
    """
    along, turned = log.along, log.headings - log.headings[0]
    far, angle = float(np.abs(np.diff(along)).sum()), float(np.ptp(turned))
    changes = np.ptp(log.speeds), np.ptp(log.yaw_rates)
    if far < LEAST_DRIVEN or angle < LEAST_DRIVEN or min(changes) == 0.0:
        raise DriveLogError(
            f"the log shows {far:.2f} m and {angle:.2f} rad of driving, with commands of "
            f"{log.speeds.min():.2g} to {log.speeds.max():.2g} m/s, {log.yaw_rates.min():.2g} to "
            f"{log.yaw_rates.max():.2g} rad/s: that is too little to fit a drive; drive the "
            "commands that viaspline identify --drive writes"
        )
    times = fine_times(log)
    starts = np.flatnonzero(log.times <= log.times[-1] - WINDOW_S)
    ends = np.searchsorted(log.times, log.times[starts] + WINDOW_S - 1e-9)
    driven = tuple(one[ends] - one[starts] for one in (along, turned))
    soon = int(np.searchsorted(log.times, log.times[0] + 0.15))
    begun = log.times[soon] - log.times[0]
    first = np.array([(one[soon] - one[0]) / begun for one in (along, turned)])
    scale = tuple(float(np.sqrt(np.mean(one**2))) + 1e-9 for one in driven)
    turns = log.yaw_rates
    if wheelbase > 0.0:
        turns = angles_for(log.speeds, turns, wheelbase)
        moved = abs(first[0]) > STOOD_SHARE * np.abs(log.speeds).max()
        first[1] = angles_for(first[:1], first[1:], wheelbase)[0] if moved else 0.0
    return FitProblem(
        log, times, float(times[1] - times[0]),
        (held(log, log.speeds, times), held(log, turns, times)),
        (float(first[0]), float(first[1])), starts, ends, (driven[0], driven[1]),
        (scale[0], scale[1]), wheelbase,
    )  # fmt: skip
