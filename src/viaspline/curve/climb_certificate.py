"""What is proven of how steeply a curve climbs and descends."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.handed_in import check_answers
from viaspline.kernels.space.climb_slope import steepest_climb

CLIMB_TOLERANCE_RAD = 1e-4  # between the proven angle and the true one [rad]


@dataclass(frozen=True, slots=True)
class ClimbCertificate:
    """How steep a curve is at most, upwards and downwards.

    Angles are against the level, 0 where it nowhere climbs, or descends, and pi / 2 where it
    stands upright. They bound rates as well: at a speed v along the curve it climbs by no more than
    v sin(climb).

    Attributes:
        climb: Proven upper bound of the angle upwards [rad], within 0.1 mrad of the true one.
        climb_u: Where it is that steep, as a parameter of the curve.
        descent: Proven upper bound of the angle downwards [rad].
        descent_u: Where it is that steep.
    """

    climb: float
    climb_u: float
    descent: float
    descent_u: float

    def keeps(self, climb: float, descent: float) -> bool:
        """Whether the curve is nowhere steeper than this, upwards and downwards [rad]."""
        return self.climb <= climb and self.descent <= descent


def certify_climb(curve: PiecewiseCubic) -> ClimbCertificate:
    """Prove how steeply the whole continuous curve climbs and descends.

    Where the curve stands still between two directions (a cusp), it counts as upright.

    Args:
        curve: A piecewise cubic in space.

    Returns:
        The certificate.

    Raises:
        GeometryError: When the curve isn't in space.

    Example:
        >>> from viaspline.curve.cardinal import CardinalSpline
        >>> found = certify_climb(CardinalSpline([(0, 0, 0), (10, 0, 10)]))
        >>> round(math.degrees(found.climb), 2), round(math.degrees(found.descent), 2)
        (45.0, 0.0)
    """
    check_answers("curve", curve, "dimension", "give a CardinalSpline, or the path of a plan")
    if curve.dimension != 3:
        raise GeometryError(f"a curve of dimension {curve.dimension} climbs nowhere; give it z")
    spans = np.array(curve.spans)  # numba compiles read-only arrays once more
    _, climb, rises, w_up = steepest_climb(spans, 1.0, CLIMB_TOLERANCE_RAD)
    _, descent, falls, w_down = steepest_climb(spans, -1.0, CLIMB_TOLERANCE_RAD)
    return ClimbCertificate(
        min(climb, 0.5 * math.pi), float(rises + w_up),
        min(descent, 0.5 * math.pi), float(falls + w_down),
    )  # fmt: skip
