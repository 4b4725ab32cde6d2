"""A curve in axes that are turned in the plane, for limits along and across a held heading."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.trajectory.cells import Evaluable


def turned(points: Floats, angle: float) -> Floats:
    """Points or directions as they are in axes that are turned; heights stay.

    Args:
        points: Shape (..., d), d >= 2.
        angle: Of the axes, anticlockwise [rad]; at 0 the points are handed back as they are.

    Raises:
        GeometryError: When there is no plane to turn in.

    Example:
        >>> turned(np.array([[0.0, 2.0]]), math.pi / 2).round(9).tolist()
        [[2.0, 0.0]]
    """
    if angle == 0.0:
        return points
    if points.shape[-1] < 2:
        raise GeometryError("axis_heading turns axes in the plane; the path has one axis only")
    cosine, sine = math.cos(angle), math.sin(angle)
    x, y = points[..., 0], points[..., 1]
    result = np.array(points, dtype=np.float64)
    result[..., 0], result[..., 1] = cosine * x + sine * y, cosine * y - sine * x
    return result


@dataclass(frozen=True)
class TurnedCurve:
    """Any curve, evaluated in axes that are turned by an angle [rad]."""

    curve: Evaluable
    angle: float

    @property
    def domain(self) -> tuple[float, float]:
        """First and last parameter."""
        return self.curve.domain

    def evaluate(self, u: ArrayLike, derivative: int = 0) -> Floats:
        """Points or derivatives at parameters (n,), shape (n, d)."""
        return turned(np.asarray(self.curve.evaluate(u, derivative)), self.angle)
