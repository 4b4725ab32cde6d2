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

PLACE = np.eye(2, 4)
"""What of a state a measured place shows, (2, 4)."""


@dataclass(frozen=True, eq=False)
class MotionEstimate:
    """What is believed of one thing's motion at an instant.

    Attributes:
        time: [s].
        mean: x, y [m], vx, vy [m/s], shape (4,).
        covariance: Of these, shape (4, 4).

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
        cls, time: float, place: tuple[float, float], place_error: float, speed_error: float
    ) -> MotionEstimate:
        """Something that was seen once.

        Args:
            time: [s].
            place: Where it was [m].
            place_error: Standard deviation of each coordinate of that [m].
            speed_error: Standard deviation of each coordinate of its velocity, about none [m/s].
        """
        variances = np.array((place_error, place_error, speed_error, speed_error)) ** 2
        return cls(time, np.array((*place, 0.0, 0.0)), np.diag(variances))

    @property
    def place(self) -> Floats:
        """Where it is [m], shape (2,)."""
        return self.mean[:2]

    @property
    def velocity(self) -> Floats:
        """How fast it goes [m/s], shape (2,)."""
        return self.mean[2:]

    @property
    def place_error(self) -> float:
        """The standard deviation of its place in the direction in which that is largest [m]."""
        return _largest_deviation(self.covariance[:2, :2])

    @property
    def velocity_error(self) -> float:
        """The standard deviation of its velocity where that is largest [m/s]."""
        return _largest_deviation(self.covariance[2:, 2:])

    @property
    def significance(self) -> float:
        """Squared Mahalanobis distance of the velocity from none: chi squared of two if it stands.

        >>> still = MotionEstimate(0.0, np.array((0.0, 0.0, 0.3, 0.0)), 0.01 * np.eye(4))
        >>> round(still.significance, 6)
        9.0
        """
        return float(self.velocity @ np.linalg.solve(self.covariance[2:, 2:], self.velocity))

    def foreseen(self, time: float, wander: float) -> MotionEstimate:
        """What it will be at a later instant.

        Args:
            time: Not before its own [s].
            wander: By how much each coordinate of its velocity changes in a second, in standard
                deviations [m/s per square root of s].
        """
        late = time - self.time
        step = np.eye(4)
        step[0, 2] = step[1, 3] = late
        noise = np.kron([[late**3 / 3.0, late**2 / 2.0], [late**2 / 2.0, late]], np.eye(2))
        covariance = step @ self.covariance @ step.T + wander**2 * noise
        return MotionEstimate(time, step @ self.mean, covariance)

    def with_place(self, place: tuple[float, float] | Floats, error: float) -> MotionEstimate:
        """What is believed after its place was measured.

        Args:
            place: [m], shape (2,).
            error: Standard deviation of each coordinate of that, above 0 [m].
        """
        return self._corrected(np.asarray(place), PLACE, error**2 * np.eye(2))

    def with_place_and_velocity(
        self, measured: Floats, place_error: float, velocity_error: float
    ) -> MotionEstimate:
        """What is believed after its place and its velocity were measured.

        Args:
            measured: x, y [m], vx, vy [m/s], shape (4,).
            place_error: Standard deviation of each coordinate of the place, above 0 [m].
            velocity_error: Standard deviation of each coordinate of the velocity, above 0 [m/s].
        """
        variances = np.array((place_error, place_error, velocity_error, velocity_error)) ** 2
        return self._corrected(measured, np.eye(4), np.diag(variances))

    def distance_to(self, place: Floats, error: float) -> tuple[float, float]:
        """How far a measured place is from where it should be.

        Args:
            place: [m], shape (2,).
            error: Standard deviation of each coordinate of that [m].

        Returns:
            (squared Mahalanobis distance, logarithm of the determinant of what that is measured
            by): the first says whether it may be the same thing, their sum how likely that is.
        """
        spread = self.covariance[:2, :2] + error**2 * np.eye(2)
        away = place - self.place
        return float(away @ np.linalg.solve(spread, away)), math.log(np.linalg.det(spread))

    def _corrected(self, measured: Floats, shown: Floats, noise: Floats) -> MotionEstimate:
        """After a measurement; by Joseph's form, which leaves no negative variance."""
        spread = shown @ self.covariance @ shown.T + noise
        gain = np.linalg.solve(spread, shown @ self.covariance).T
        left = np.eye(4) - gain @ shown
        mean = self.mean + gain @ (measured - shown @ self.mean)
        covariance = left @ self.covariance @ left.T + gain @ noise @ gain.T
        return MotionEstimate(self.time, mean, 0.5 * (covariance + covariance.T))


def _largest_deviation(covariance: Floats) -> float:
    """The square root of the greater eigenvalue of a covariance (2, 2)."""
    a, b, c = covariance[0, 0], covariance[0, 1], covariance[1, 1]
    return math.sqrt(0.5 * (a + c) + math.hypot(0.5 * (a - c), b))
