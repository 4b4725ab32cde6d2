"""How far from its straight line something that was seen to move may come to be.

Tested through ``robot/perception/moving/test_foretell``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.mission.motion_spec import MotionError
from viaspline.tracks.motion_estimate import MotionEstimate


@dataclass(frozen=True)
class Foresight:
    """What is taken for granted of what things will do.

    Attributes:
        top_speed: Nothing is faster [m/s].
        accel: Nothing changes its velocity faster than this [m/s²],
        horizon: for so long; later it may be anywhere that ``top_speed`` takes it [s].
        sigmas: Nothing is farther from where it is believed to be, nor its velocity from what that
            is believed to be, than so many standard deviations.
    """

    top_speed: float
    accel: float = 1.0
    horizon: float = 2.0
    sigmas: float = 3.0

    def error(self, estimate: MotionEstimate) -> MotionError:
        """How far from its straight line something may be.

        With x₀ and v₀ as they truly are, p and v as they are believed to be, and an acceleration of
        a at most, for t up to the horizon h:

            |x(t) - p - v t| <= |x₀ - p| + |v₀ - v| t + a t²/2 <= kσ_p + (kσ_v + a h/2) t

        and for all t, as nothing is faster than w:

            |x(t) - p - v t| <= kσ_p + (w + |v|) t.

        The growth is the smaller of the two rates.

        Example:
            >>> still = MotionEstimate.at_first_sight(0.0, (0.0, 0.0), 0.1, 0.2)
            >>> error = Foresight(top_speed=2.0, accel=1.0, horizon=1.0).error(still)
            >>> round(error.position_m, 6), round(error.growth_mps, 6)
            (0.3, 1.1)
        """
        speed = math.hypot(*estimate.velocity.tolist())
        by_estimate = self.sigmas * estimate.velocity_error + 0.5 * self.accel * self.horizon
        return MotionError.model_construct(
            position_m=self.sigmas * estimate.place_error,
            growth_mps=min(by_estimate, self.top_speed + speed),
        )

    def error_after(self, late: float, estimate: MotionEstimate) -> MotionError:
        """How far from there it may be, from so long after the estimate on [s].

        >>> still = MotionEstimate.at_first_sight(0.0, (0.0, 0.0), 0.1, 0.2)
        >>> later = Foresight(top_speed=2.0, accel=1.0, horizon=1.0).error_after(0.5, still)
        >>> round(later.position_m, 6), round(later.growth_mps, 6)
        (0.85, 1.1)
        """
        error = self.error(estimate)
        grown = error.position_m + late * error.growth_mps
        return MotionError.model_construct(position_m=grown, growth_mps=error.growth_mps)
