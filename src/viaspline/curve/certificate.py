"""The clearance certificate: a proven lower bound over the whole continuous curve."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.kernels import clearance as kernels
from viaspline.world.world import World

TOLERANCE = 1e-3  # between the proven bound and the true clearance [m]
SPARE = 1e-6  # what a proof may lack of what is required: a curve that just touches it [m]


@dataclass(frozen=True)
class Certificate:
    """What is proven of a curve's clearance.

    Attributes:
        clearance: Proven lower bound of the distance between the robot's body and every obstacle
            and the bounds [m]; never above the true one, and within 1 mm of it (less exact where
            a curve runs for kilometres inside of something). Infinite when there is nothing to
            keep clear of.
        required: The clearance that was asked for [m].
        tightest_at: Where it is tightest [m], shape (d,).
        tightest_u: The same as a parameter of the curve.
        tightest_distance: The same as a distance along the curve [m].
        obstacle: The name of the obstacle that is nearest there; None when there is none.
    """

    clearance: float
    required: float
    tightest_at: tuple[float, ...]
    tightest_u: float
    tightest_distance: float
    obstacle: str | None

    @property
    def holds(self) -> bool:
        """Whether the proven clearance is the one that was asked for, to a micrometre."""
        return self.clearance >= self.required - SPARE


def certify(
    curve: PiecewiseCubic, world: World, clearance: float, *, radius: float = 0.0
) -> Certificate:
    """Prove how far the whole continuous curve stays from everything in the world.

    Pieces of the curve are bounded by their control polygons and halved until the bound is within
    a millimetre of a distance that is really attained: conservative advancement, with a
    second-order step beside obstacles.

    Args:
        curve: Any piecewise cubic; of a curve in space, its ground track counts.
        world: The obstacles and bounds.
        clearance: What is to be kept free between the body and everything [m].
        radius: The robot's body, a disc [m].

    Returns:
        A certificate, whether it holds or not: see ``Certificate.holds``.

    Raises:
        GeometryError: When the curve is not in the plane or in space, or clearance or radius is
            not a finite number.

    Example:
        >>> from viaspline.curve.cardinal import CardinalSpline
        >>> from viaspline.mission.parts import Obstacle
        >>> world = World([Obstacle(circle={"center": (5, 3), "radius": 1})])
        >>> certificate = certify(CardinalSpline([(0, 0), (5, 0), (10, 0)]), world, 1.0, radius=0.5)
        >>> round(certificate.clearance, 3), certificate.tightest_at, certificate.holds
        (1.5, (5.0, 0.0), True)
    """
    if curve.dimension not in (2, 3):
        raise GeometryError(
            f"a curve of dimension {curve.dimension} can't be certified; 2 or 3 can"
        )
    required = float(clearance) + float(radius)
    if not math.isfinite(required):
        raise GeometryError(f"clearance {clearance} and radius {radius} have to be finite")
    spans = np.array(curve.spans)  # numba compiles read-only arrays once more
    tolerance = TOLERANCE
    lower, upper, span, w, index = kernels.tightest(world.packed, spans, tolerance)
    while math.isinf(lower) and math.isfinite(upper):
        tolerance *= 10.0
        lower, upper, span, w, index = kernels.tightest(world.packed, spans, tolerance)
    for tolerance in (0.01 * TOLERANCE, 0.1 * SPARE):
        if lower >= required - SPARE or upper < required - SPARE:
            break
        finer, upper, span, w, index = kernels.tightest(world.packed, spans, tolerance)
        lower = max(lower, finer)
    u = float(span + w)
    at = np.asarray(curve.evaluate(u))
    return Certificate(
        clearance=float(lower) - float(radius),
        required=float(clearance),
        tightest_at=tuple(at.tolist()),
        tightest_u=u,
        tightest_distance=float(curve.distance(u)),
        obstacle=None if index == -1 else world.name(int(index)),
    )
