"""Where something is and how fast it goes, with how certain that is: a Kalman filter.

Between looks it goes straight on, but for an acceleration that is white noise: its velocity
wanders, by ``wander`` in one second (Bar-Shalom, Li and Kirubarajan: *Estimation with applications
to tracking and navigation*, 6.2).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats


@dataclass(frozen=True, eq=False)
class MotionEstimate:
    """What is believed of one thing's motion at an instant.

    Attributes:
        time: [s].
        mean: A place [m], then a velocity [m/s]: x, y, vx, vy in the plane, x, y, z, vx, vy, vz in
            space; shape (2d,).
        covariance: Of these, shape (2d, 2d).

    Example:
        >>> first = MotionEstimate.at_first_sight(0.0, (0.0, 0.0), 0.01, 2.0)
        >>> later = first.foreseen(1.0, wander=0.1).with_place((1.0, 0.0), 0.01)
        >>> later.velocity.round(3).tolist()
        [1.0, 0.0]
    """

    time: float
    mean: Floats
    covariance: Floats

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
        return cls(time, mean, np.diag(_variances(mean.size // 2, place_error, velocity_error)))

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
        """The standard deviation of its place in the direction in which that is largest [m]."""
        return _largest_deviation(self._of_place)

    @property
    def velocity_error(self) -> float:
        """The standard deviation of its velocity where that is largest [m/s]."""
        return _largest_deviation(self._of_velocity)

    @property
    def significance(self) -> float:
        """Squared Mahalanobis distance of the velocity from none: chi squared of d if it stands.

        >>> still = MotionEstimate(0.0, np.array((0.0, 0.0, 0.3, 0.0)), 0.01 * np.eye(4))
        >>> round(still.significance, 6)
        9.0
        """
        return float(self.velocity @ np.linalg.solve(self._of_velocity, self.velocity))

    @property
    def _of_place(self) -> Floats:
        """The covariance of the place, (d, d)."""
        return self.covariance[: self.dimension, : self.dimension]

    @property
    def _of_velocity(self) -> Floats:
        """The covariance of the velocity, (d, d)."""
        return self.covariance[self.dimension :, self.dimension :]

    def foreseen(self, time: float, wander: float) -> MotionEstimate:
        """What it will be at a later instant.

        Args:
            time: Not before its own [s].
            wander: By how much each coordinate of its velocity changes in a second, in standard
                deviations [m/s per square root of s].
        """
        late, d = time - self.time, self.dimension
        ahead = np.eye(2 * d, k=d)
        step = np.eye(2 * d) + late * ahead
        noise = np.diag([late**3 / 3.0] * d + [late] * d) + late**2 / 2.0 * (ahead + ahead.T)
        covariance = step @ self.covariance @ step.T + wander**2 * noise
        return MotionEstimate(time, step @ self.mean, covariance)

    def with_place(self, place: tuple[float, ...] | Floats, error: float) -> MotionEstimate:
        """What is believed after its place was measured.

        Args:
            place: [m], shape (d,).
            error: Standard deviation of each coordinate of that, above 0 [m].
        """
        d = self.dimension
        return self._corrected(np.asarray(place), np.eye(d, 2 * d), error**2 * np.eye(d))

    def with_place_and_velocity(
        self, measured: Floats, place_error: float, velocity_error: float
    ) -> MotionEstimate:
        """What is believed after its place and its velocity were measured.

        Args:
            measured: A place [m], then a velocity [m/s], shape (2d,).
            place_error: Standard deviation of each coordinate of the place, above 0 [m].
            velocity_error: Standard deviation of each coordinate of the velocity, above 0 [m/s].
        """
        variances = _variances(self.dimension, place_error, velocity_error)
        return self._corrected(measured, np.eye(measured.size), np.diag(variances))

    def distance_to(self, place: Floats, error: float) -> tuple[float, float]:
        """How far a measured place is from where it should be.

        Args:
            place: [m], shape (d,).
            error: Standard deviation of each coordinate of that [m].

        Returns:
            (squared Mahalanobis distance, logarithm of the determinant of what that is measured
            by): the first says whether it may be the same thing, their sum how likely that is.
        """
        spread = self._of_place + error**2 * np.eye(self.dimension)
        away = place - self.place
        return float(away @ np.linalg.solve(spread, away)), math.log(np.linalg.det(spread))

    def _corrected(self, measured: Floats, shown: Floats, noise: Floats) -> MotionEstimate:
        """After a measurement; by Joseph's form, which leaves no negative variance."""
        spread = shown @ self.covariance @ shown.T + noise
        gain = np.linalg.solve(spread, shown @ self.covariance).T
        left = np.eye(self.mean.size) - gain @ shown
        mean = self.mean + gain @ (measured - shown @ self.mean)
        covariance = left @ self.covariance @ left.T + gain @ noise @ gain.T
        return MotionEstimate(self.time, mean, 0.5 * (covariance + covariance.T))


def _variances(dimension: int, place_error: float, velocity_error: float) -> Floats:
    """Of place and velocity, (2d,)."""
    variances: Floats = np.repeat((place_error, velocity_error), dimension) ** 2
    return variances


def _largest_deviation(covariance: Floats) -> float:
    """The square root of the greatest eigenvalue of a covariance (d, d)."""
    if covariance.shape[0] > 2:
        return math.sqrt(max(float(np.linalg.eigvalsh(covariance)[-1]), 0.0))
    a, b, c = covariance[0, 0], covariance[0, 1], covariance[1, 1]
    return math.sqrt(0.5 * (a + c) + math.hypot(0.5 * (a - c), b))
