"""Where something is and how fast it goes, with how certain that is: a Kalman filter.

Between looks it goes straight on, but for an acceleration that is white noise: its velocity
wanders, by ``wander`` in one second (Bar-Shalom, Li and Kirubarajan: *Estimation with applications
to tracking and navigation*, 6.2). It wanders alike along every axis, and what is measured is
measured alike along every axis: so all axes have one covariance, and none has to do with another.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats


class AxisCovariance(NamedTuple):
    """How certain a place and a velocity along one axis are.

    Attributes:
        place: Variance of the place [m²].
        both: Covariance of place and velocity [m²/s].
        velocity: Variance of the velocity [m²/s²].
    """

    place: float
    both: float
    velocity: float

    @property
    def determinant(self) -> float:
        """Of the covariance; never below 0, whatever rounding makes of it."""
        return max(self.place * self.velocity - self.both**2, 0.0)


@dataclass(frozen=True, eq=False)
class MotionEstimate:
    """What is believed of one thing's motion at an instant.

    Attributes:
        time: [s].
        mean: A place [m], then a velocity [m/s]: x, y, vx, vy in the plane, x, y, z, vx, vy, vz in
            space; shape (2d,).
        axis: How certain these are along each axis.

    Example:
        >>> first = MotionEstimate.at_first_sight(0.0, (0.0, 0.0), 0.01, 2.0)
        >>> later = first.foreseen(1.0, wander=0.1).with_place((1.0, 0.0), 0.01)
        >>> later.velocity.round(3).tolist()
        [1.0, 0.0]
    """

    time: float
    mean: Floats
    axis: AxisCovariance

    @classmethod
    def at_first_sight(
        cls, time: float, place: tuple[float, ...], place_error: float, speed_error: float
    ) -> MotionEstimate:
        """Something that was seen once.

        Args:
            time: [s].
            place: Where it was [m], d numbers.
            place_error: Standard deviation of each coordinate of that [m].
            speed_error: Standard deviation of each coordinate of its velocity, about none [m/s].
        """
        mean = np.array((*place, *(0.0 for _ in place)))
        return cls.measured(time, mean, place_error, speed_error)

    @classmethod
    def measured(
        cls, time: float, mean: Floats, place_error: float, velocity_error: float
    ) -> MotionEstimate:
        """Something of which place and velocity were measured once.

        Args:
            time: [s].
            mean: Place [m] and velocity [m/s], shape (2d,).
            place_error: Standard deviation of each coordinate of the place [m].
            velocity_error: Standard deviation of each coordinate of the velocity [m/s].
        """
        return cls(time, mean, AxisCovariance(place_error**2, 0.0, velocity_error**2))

    @property
    def dimension(self) -> int:
        """Of the place: 2 or 3."""
        return self.mean.size // 2

    @property
    def place(self) -> Floats:
        """Where it is [m], shape (d,)."""
        return self.mean[: self.dimension]

    @property
    def velocity(self) -> Floats:
        """How fast it goes [m/s], shape (d,)."""
        return self.mean[self.dimension :]

    @property
    def place_error(self) -> float:
        """The standard deviation of its place along any axis [m]."""
        return math.sqrt(self.axis.place)

    @property
    def velocity_error(self) -> float:
        """The standard deviation of its velocity along any axis [m/s]."""
        return math.sqrt(self.axis.velocity)

    @property
    def significance(self) -> float:
        """Squared Mahalanobis distance of the velocity from none: chi squared of d if it stands.

        >>> moving, sure = np.array((0.0, 0.0, 0.3, 0.0)), AxisCovariance(0.01, 0.0, 0.01)
        >>> round(MotionEstimate(0.0, moving, sure).significance, 6)
        9.0
        """
        return float(self.velocity @ self.velocity) / self.axis.velocity

    def foreseen(self, time: float, wander: float) -> MotionEstimate:
        """What it will be at a later instant.

        Args:
            time: Not before its own [s].
            wander: By how much each coordinate of its velocity changes in a second, in standard
                deviations [m/s per square root of s].
        """
        late, noise, d = time - self.time, wander**2, self.dimension
        place, both, velocity = self.axis
        later = AxisCovariance(
            place + late * (2.0 * both + late * velocity) + noise * late**3 / 3.0,
            both + late * velocity + noise * late**2 / 2.0,
            velocity + noise * late,
        )
        mean = self.mean.copy()
        mean[:d] += late * mean[d:]
        return MotionEstimate(time, mean, later)

    def with_place(self, place: tuple[float, ...] | Floats, error: float) -> MotionEstimate:
        """What is believed after its place was measured.

        Args:
            place: [m], shape (d,).
            error: Standard deviation of each coordinate of that, above 0 [m].
        """
        off = np.asarray(place) - self.place
        before, both, velocity = self.axis
        spread = before + error**2
        gain, gain_of_velocity = before / spread, both / spread
        axis = AxisCovariance(
            error**2 * gain,
            error**2 * gain_of_velocity,
            (velocity * error**2 + self.axis.determinant) / spread,
        )
        mean = self.mean + np.concatenate((gain * off, gain_of_velocity * off))
        return MotionEstimate(self.time, mean, axis)

    def with_place_and_velocity(
        self, measured: Floats, place_error: float, velocity_error: float
    ) -> MotionEstimate:
        """What is believed after its place and its velocity were measured.

        Args:
            measured: A place [m], then a velocity [m/s], shape (2d,).
            place_error: Standard deviation of each coordinate of the place, above 0 [m].
            velocity_error: Standard deviation of each coordinate of the velocity, above 0 [m/s].
        """
        place, both, velocity = self.axis
        of_place, of_velocity = place_error**2, velocity_error**2
        known = self.axis.determinant
        spread = known + place * of_velocity + velocity * of_place + of_place * of_velocity
        axis = AxisCovariance(
            of_place * (known + place * of_velocity) / spread,
            of_place * of_velocity * both / spread,
            of_velocity * (known + velocity * of_place) / spread,
        )
        d, off = self.dimension, measured - self.mean
        mean = self.mean.copy()
        mean[:d] += (axis.place / of_place) * off[:d] + (axis.both / of_velocity) * off[d:]
        mean[d:] += (axis.both / of_place) * off[:d] + (axis.velocity / of_velocity) * off[d:]
        return MotionEstimate(self.time, mean, axis)

    def distance_to(self, place: Floats, error: float) -> tuple[float, float]:
        """How far a measured place is from where it should be.

        Args:
            place: [m], shape (d,).
            error: Standard deviation of each coordinate of that [m].

        Returns:
            (squared Mahalanobis distance, logarithm of the determinant of what that is measured
            by): the first says whether it may be the same thing, their sum how likely that is.
        """
        spread, away = self.axis.place + error**2, place - self.place
        return float(away @ away) / spread, self.dimension * math.log(spread)
