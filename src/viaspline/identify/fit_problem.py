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
    WheelLimits,
    fine_times,
    held,
    response,
    summed,
    wheel_response,
)
from viaspline.kernels.arrays import Floats, Ints

WINDOW_S = 0.5
"""What is driven in so long is compared [s]."""

LEAST_DRIVEN = 0.2
"""Metres, and radians, that have to be driven at least."""

DELAY, LAG, SPEED_SHARE, YAW_SHARE, TOP, ACCEL, YAW_ACCEL, WHEEL_ACCEL, ARM = range(9)
"""The parameters of a drive: the first four always, the limits where a log shows them. Those of the
speed and of the yaw rate are apart, or both are the wheels', which act an arm from the middle."""

PARAMETERS = 9


@dataclass(frozen=True)
class FitProblem:
    """A log, prepared; parameters are an array of shape (PARAMETERS,).

    Attributes:
        log: It.
        times: Fine ones [s].
        step: Between them [s].
        told: Commanded speed and yaw rate at those.
        first: Speed and yaw rate at first.
        starts: Rows at which windows begin.
        ends: Rows at which they end.
        driven: Along and turned in each window.
        scale: By which both are divided.
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

    def motion(self, p: Floats) -> tuple[Floats, Floats]:
        """Speed and yaw rate without delay, fine."""
        speed = ChannelLimits(float(p[SPEED_SHARE]), float(p[ACCEL]), float(p[TOP]))
        yaw = ChannelLimits(float(p[YAW_SHARE]), float(p[YAW_ACCEL]))
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
            np.interp(late, self.times, summed(one, self.step)) + before * first
            for one, first in zip(self.motion(p), self.first, strict=True)
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


def fit_problem(log: DriveLog) -> FitProblem:
    """A log, prepared.

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
    first = tuple(
        float((one[soon] - one[0]) / (log.times[soon] - log.times[0])) for one in (along, turned)
    )
    scale = tuple(float(np.sqrt(np.mean(one**2))) + 1e-9 for one in driven)
    return FitProblem(
        log, times, float(times[1] - times[0]),
        (held(log, log.speeds, times), held(log, log.yaw_rates, times)),
        (first[0], first[1]), starts, ends, (driven[0], driven[1]), (scale[0], scale[1]),
    )  # fmt: skip
