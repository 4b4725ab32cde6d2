"""Where a robot is, by what it was commanded and what was measured.

A measurement alone is off by its noise. What is tried out from a state that is off by as much would
show what the noise does, and not what the path asks.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.drive_model import NOISE_TIME_S
from viaspline.kernels.tracking.drive_motion import ACROSS, ALONG, HEADING, X, Y
from viaspline.machine.drive_noise import MAX_DEVIATIONS
from viaspline.mission.robot_parts import RobotSpec

MIN_GAIN = 0.1
"""So much of a measurement is always believed."""


@dataclass(frozen=True)
class PoseFilter:
    """How predictions and measurements of a pose are weighed.

    What was measured is as far off as its noise, what was predicted as far as that of the drive
    lets it get. Between both it is the steady state of a Kalman filter of one dimension.

    Attributes:
        noise: Of a measured position [m] and heading [rad].
        gains: How much of what a measurement shows is believed, of both, ``MIN_GAIN`` to 1.

    Example:
        >>> PoseFilter.of(RobotSpec(drive={"differential": {"track_m": 0.5}}), 0.05).gains
        (1.0, 1.0)
        >>> PoseFilter.of(RobotSpec(localization={"position_noise_m": 0.1}), 0.05).gains
        (0.1, 1.0)
    """

    noise: tuple[float, float] = (0.0, 0.0)
    gains: tuple[float, float] = (1.0, 1.0)

    @classmethod
    def of(cls, robot: RobotSpec, period: float) -> PoseFilter:
        """The filter of a robot.

        Args:
            robot: Its drive and localisation.
            period: From one measurement to the next [s].
        """
        drive, place = robot.drive, robot.localization
        slip = 0.0 if drive is None else drive.speed_noise_mps
        turned = 0.0 if drive is None else math.radians(drive.yaw_rate_noise_degps)
        position = 0.0 if place is None else place.position_noise_m
        heading = 0.0 if place is None else math.radians(place.heading_noise_deg)
        # noise that keeps for a while adds up faster than noise that averages out
        kept = math.sqrt(period * max(NOISE_TIME_S, period))
        gains = _gain(slip * kept, position), _gain(turned * kept, heading)
        return cls((position, heading), gains)

    def first(self, start: Floats, measured: Floats) -> Floats:
        """The pose at the first measurement: the start, unless that is off by more than noise.

        Args:
            start: Where the robot should be, shape (STATE,).
            measured: Shape (STATE,).

        Returns:
            Shape (STATE,).
        """
        position, heading = (MAX_DEVIATIONS * size for size in self.noise)
        pose = measured.copy()
        off = np.abs(measured[[X, Y]] - start[[X, Y]]).max()
        turned = math.remainder(measured[HEADING] - start[HEADING], math.tau)
        if off <= position:
            pose[[X, Y]] = start[[X, Y]]
        if abs(turned) <= heading:
            pose[HEADING] = measured[HEADING] - turned
        return pose

    def updated(self, predicted: Floats, measured: Floats) -> Floats:
        """The pose after one more measurement.

        Args:
            predicted: By what was commanded since the one before, shape (STATE,).
            measured: Shape (STATE,).

        Returns:
            Shape (STATE,); speeds are as measured.
        """
        position, heading = self.gains
        pose = predicted.copy()
        pose[[X, Y]] += position * (measured - predicted)[[X, Y]]
        turned = math.remainder(measured[HEADING] - predicted[HEADING], math.tau)
        pose[HEADING] += heading * turned
        pose[[ALONG, ACROSS]] = measured[[ALONG, ACROSS]]
        return pose


def _gain(drift: float, noise: float) -> float:
    """Steady gain of a filter whose state drifts by so much between measurements."""
    if noise == 0.0:
        return 1.0
    drift, noise = drift * drift, noise * noise
    spread = 0.5 * (drift + math.sqrt(drift * drift + 4.0 * drift * noise))
    return max(spread / (spread + noise), MIN_GAIN)
