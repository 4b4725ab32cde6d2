"""Where a new path leaves an old one: position, heading and curvature go on as they were.

A cardinal spline that starts at a given place can be given a heading there, but not a curvature.
So the old curve runs out first: a cubic that takes over its position, heading and curvature, and
whose second derivative falls linearly to nothing at its end. From there the new spline goes on
with the heading that is reached.

Tested through ``planning/replanning/test_replan``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats

LEAST_DERIVATIVE_M = 1e-9  # below which a curve has no curvature there
MAX_TURN_RAD = 0.5  # of the heading while running out


@dataclass(frozen=True)
class RunOut:
    """A cubic that takes over a curve's position, heading and curvature.

    Attributes:
        span: Bézier control polygon [m], shape (4, d).
        tangent: Unit direction at its far end, shape (d,).
    """

    span: Floats
    tangent: Floats

    @property
    def end(self) -> Floats:
        """Its far end [m], shape (d,)."""
        end: Floats = self.span[3]
        return end

    def reversed(self) -> RunOut:
        """The cubic the other way: it runs in to where it started."""
        return RunOut(self.span[::-1].copy(), -self.tangent)


def run_out(curve: PiecewiseCubic, u: float, length: float, *, sense: int = 1) -> RunOut:
    """Continue a curve from ``u`` with its curvature easing off to nothing.

    Args:
        curve: The curve that is left.
        u: Where; at a joint, the span after it counts.
        length: About how long the run-out is [m]; it is shorter where the curve turns sharply.
        sense: 1 to go on along the curve, -1 to go back along it.

    Example:
        >>> curve = PiecewiseCubic([[[0, 0], [1, 0], [2, 1], [3, 3]]])
        >>> out = PiecewiseCubic(run_out(curve, 0.5, 1.0).span[None])
        >>> bool(abs(out.curvature(0.0) - curve.curvature(0.5)) < 1e-12)
        True
    """
    place = np.asarray(curve.evaluate(u))
    velocity = np.asarray(curve.evaluate(u, 1))
    speed = float(np.linalg.norm(velocity))
    if speed > LEAST_DERIVATIVE_M:
        tangent = sense * velocity / speed
        bend = np.asarray(curve.evaluate(u, 2)) / speed**2
        bend = bend - (bend @ tangent) * tangent
    else:  # a polyline's corner
        tangent = sense * np.asarray(curve.tangent(u))
        bend = np.zeros_like(place)
    sharpness = float(np.linalg.norm(bend))
    reach = min(length, 2 * MAX_TURN_RAD / sharpness) if sharpness > 0 else length
    first = place + reach / 3 * tangent
    second = 2 * first - place + reach**2 / 6 * bend
    end = 2 * second - first
    leaving = end - second
    return RunOut(np.array([place, first, second, end]), leaving / np.linalg.norm(leaving))
