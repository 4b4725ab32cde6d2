"""How fast a robot may go, as far as the choice of a path hangs on it.

The time law itself is laid later, with all limits of the drive; here paths are compared.

Tested through ``planning/checking/test_driving_time``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from viaspline.curve.slow_parts import slow_parts
from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.world_spec import SpeedZone

RADII_TRIED: Final = 24
"""Radii of a corner that are compared, evenly in their logarithm."""
SHARES_TRIED: Final = np.linspace(0.0, 1.0, RADII_TRIED)
"""Of the way from the least to the widest, in that."""


@dataclass(frozen=True, kw_only=True)
class Pace:
    """Limits of the speed along a path.

    Attributes:
        speed: [m/s].
        accel: Along the path, speeding up [m/s²].
        brake: Along the path, slowing down [m/s²].
        lateral: Across the path [m/s²]; infinite where there is no limit.
        yaw_rate: [rad/s]; infinite where there is no limit.
        zones: Where the robot has to be slower than that.
    """

    speed: float
    accel: float
    brake: float
    lateral: float
    yaw_rate: float = math.inf
    zones: tuple[SpeedZone, ...] = ()

    @classmethod
    def of(cls, robot: RobotSpec, zones: Sequence[SpeedZone] = ()) -> Pace:
        """The pace of a robot.

        Args:
            robot: Its limits.
            zones: Of its world.
        """
        lateral, rate = robot.lateral_accel, robot.max_yaw_rate_degps
        brake = robot.max_brake_mps2
        return cls(
            speed=robot.max_speed_mps,
            accel=robot.max_accel_mps2,
            brake=robot.max_accel_mps2 if brake is None else brake,
            lateral=math.inf if lateral is None else lateral,
            yaw_rate=math.inf if rate is None else math.radians(rate),
            zones=tuple(zone for zone in zones if zone.max_speed_mps < robot.max_speed_mps),
        )

    @property
    def widest_radius(self) -> float:
        """The radius of turns that are driven at full speed; wider ones are no faster [m]."""
        return max(self.speed**2 / self.lateral, self.speed / self.yaw_rate)

    @property
    def slowing(self) -> float:
        """Curvature beyond which the robot slows down; infinite where it never does [1/m]."""
        return 1.0 / self.widest_radius if self.widest_radius > 0.0 else math.inf

    @property
    def beside_zones(self) -> Pace:
        """This one where there are none."""
        return replace(self, zones=())

    def speeds_at(self, places: Floats) -> Floats:
        """The greatest speed at some places [m/s], (n,).

        Args:
            places: [m], (n, 2).
        """
        speeds = np.full(len(places), self.speed)
        if self.zones:
            standing = np.repeat(places[:, None], 4, axis=1)  # each a span
            for first, _, speed in slow_parts(standing, self.zones):
                speeds[int(first)] = min(speeds[int(first)], speed)
        return speeds

    def widest_radii(self, speeds: Floats) -> Floats:
        """The radii of turns that are driven at given speeds [m], (n,); see ``widest_radius``."""
        return np.maximum(speeds**2 / self.lateral, speeds / self.yaw_rate)

    def corner_radii(self, turns: Floats, kept: Floats, speeds: Floats) -> Floats:
        r"""The radius with which each corner of a taut path is passed in the least time.

        A turn by :math:`\theta` that touches a circle of radius k at its apex is longer with the
        radius R by :math:`(R - k)(\theta - 2 \sin(\theta / 2))` than one that hugs the circle,
        where the lines that lead to it are long: the lines move outwards. It is driven at
        :math:`v_R = \min(v, \sqrt{a R}, \omega R)` in return, and slowing down to that costs
        :math:`(v - v_R)^2 / 2 v` for each metre per second squared, before and after.

        Args:
            turns: By how much the path turns at each [rad], (n,).
            kept: The radius of what it goes round [m], (n,).
            speeds: The greatest there [m/s], (n,).

        Returns:
            [m], (n,), no less than what is kept.
        """
        if self.widest_radius <= 0.0:
            return kept.copy()
        radii, time = self._corners(turns, kept, speeds)
        found: Floats = radii[np.arange(len(radii)), time.argmin(axis=1)]
        return found

    def corner_times(self, turns: Floats) -> Floats:
        """How much later a robot is for turning at places that it runs through [s], (n,).

        No later than for a halt.

        Args:
            turns: By how much the path turns at each [rad], (n,).
        """
        halt = 0.5 * self.speed * (1.0 / self.accel + 1.0 / self.brake)
        if self.widest_radius <= 0.0:
            return np.zeros(len(turns))
        speeds = np.full(len(turns), self.speed)
        _, time = self._corners(turns, np.zeros(len(turns)), speeds)
        found: Floats = np.minimum(time.min(axis=1), halt)
        return found

    def _corners(self, turns: Floats, kept: Floats, speeds: Floats) -> tuple[Floats, Floats]:
        """Radii that are tried at each corner [m], and what time they cost [s], (n, r) both."""
        theta, least, top = np.abs(turns)[:, None], kept[:, None], speeds[:, None]
        widest = np.maximum(least, self.widest_radii(top))
        lowest = np.maximum(least, 1e-3 * widest)
        radii = lowest * (widest / lowest) ** SHARES_TRIED
        driven = np.minimum(np.sqrt(self.lateral * radii), self.yaw_rate * radii)
        driven = np.minimum(driven, top)
        longer = (radii - least) * (theta - 2.0 * np.sin(0.5 * theta))
        slowed = (top - driven) ** 2 / (2.0 * top)
        time: Floats = (
            longer / top
            + slowed * (1.0 / self.accel + 1.0 / self.brake)
            + radii * theta * (1.0 / driven - 1.0 / top)
        )
        return radii, time
