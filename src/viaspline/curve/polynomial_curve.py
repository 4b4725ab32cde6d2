"""Polynomials of scipy, piece by piece, as curves: exactly cubics, or cubics very near to them.

A piece of degree three or less is a cubic. One of a higher degree is cut into parts; the cubic with
a part's ends and tangents is nowhere farther from it than h⁴/384 times the largest fourth
derivative on it, h being the part's length (Peano's kernel has one sign, so that holds of vectors
as well).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError, with_article
from viaspline.handed_in import numbers_from
from viaspline.kernels.arrays import Floats

CUBIC_OFF_M: Final = 1e-7
"""How far a cubic may be from a polynomial that it stands for [m]."""
ROUNDED: Final = 1e-13
"""Part of the largest coordinate by which the change of basis may round."""
MOST_PARTS: Final = 1_000_000
LARGEST: Final = 1e100
"""Coefficients beyond that are no lengths."""


@dataclass(frozen=True, eq=False)
class PolynomialCurve:
    """A curve of polynomials, as ``scipy.interpolate.PPoly`` has it.

    Attributes:
        pieces: The coefficients of each piece in its local parameter, the highest power first,
            (k, m, d).
        ends: Where pieces begin and end, increasing, (m + 1,).

    Example:
        >>> from scipy.interpolate import make_interp_spline
        >>> spline = make_interp_spline([0, 1, 2, 3], [(0, 0), (1, 2), (3, 2), (4, 0)], k=3)
        >>> curve = polynomial_from(spline)
        >>> curve.domain, curve.evaluate(2.0).round(12)
        ((0.0, 3.0), array([3., 2.]))
        >>> cubics, off, ends = curve.cubics()
        >>> len(cubics.spans), off < 1e-9
        (1, True)
    """

    pieces: Floats
    ends: Floats

    @property
    def domain(self) -> tuple[float, float]:
        """The first and the last parameter."""
        return float(self.ends[0]), float(self.ends[-1])

    @property
    def is_cubic(self) -> bool:
        """Whether each piece is a cubic, or less."""
        return len(self.pieces) <= 4

    def evaluate(self, u: ArrayLike, derivative: int = 0) -> Floats:
        """Points, or derivatives, at parameters in the domain: (d,) for a number, else (..., d)."""
        from scipy.interpolate import PPoly

        at = numbers_from("u", u)
        found: Floats = np.asarray(PPoly(self.pieces, self.ends)(at, derivative))
        return found

    def cubics(self) -> tuple[PiecewiseCubic, float, Floats]:
        """Cubics that run along it at the same parameters.

        Returns:
            They, how far any place of it is from the same place of theirs at most [m], and the
            parameters between which each runs, (n + 1,).

        Raises:
            GeometryError: It has gaps, isn't finite, or bends too much to be followed.
        """
        widths = np.diff(self.ends)
        degree = len(self.pieces) - 1
        counts = np.ones(len(widths), np.int64)
        fourth = np.zeros(len(widths))
        if degree > 3:
            fourth = _fourth_derivative(self.pieces, widths)
            parts = widths * (fourth / (384.0 * CUBIC_OFF_M)) ** 0.25
            if not float(np.sum(parts)) < MOST_PARTS:
                raise GeometryError(
                    f"the polynomials bend so much that more than {MOST_PARTS} cubics would be "
                    "needed to follow them; give a gentler curve"
                )
            counts = np.maximum(np.ceil(parts), 1).astype(np.int64)
        off = float(np.max((widths / counts) ** 4 * fourth / 384.0))
        starts = np.concatenate([
            self.ends[i] + widths[i] * np.arange(count) / count for i, count in enumerate(counts)
        ])  # fmt: skip
        joints = np.append(starts, self.ends[-1])
        index = np.repeat(np.arange(len(widths)), counts)
        local = starts - self.ends[index]
        step = (widths / counts)[index]
        points, slopes = (
            [_value(self.pieces[:, index], local + part * step, order) for part in (0.0, 1.0)]
            for order in (0, 1)
        )
        third = step[:, None] / 3.0
        spans = np.stack(
            (points[0], points[0] + third * slopes[0], points[1] - third * slopes[1], points[1]),
            axis=1,
        )
        size = float(np.abs(spans).max(initial=0.0))
        _check_gaps(points, joints, size)
        spans[1:, 0] = spans[:-1, 3]
        return PiecewiseCubic(spans), off + ROUNDED * (1.0 + size), joints


def polynomial_from(curve: object) -> PolynomialCurve | None:
    """A curve of scipy as polynomials; None for anything else.

    Args:
        curve: A ``PPoly`` or what is one (``CubicSpline``, ``Akima1DInterpolator``,
            ``PchipInterpolator``), a ``BPoly`` or a ``BSpline`` with values of d coordinates.

    Raises:
        GeometryError: It is one without coordinates, or its parameters don't increase.
    """
    if not any(made.__module__.startswith("scipy.interpolate") for made in type(curve).__mro__):
        return None
    from scipy.interpolate import BPoly, BSpline, PPoly

    given: Any = curve
    if isinstance(given, BSpline):
        given = _of_spline(given)
    elif isinstance(given, BPoly):
        given = PPoly.from_bernstein_basis(given)
    if not isinstance(given, PPoly):
        return None
    pieces, ends = np.asarray(given.c), np.asarray(given.x, np.float64)
    if pieces.ndim != 3 or np.iscomplexobj(pieces):
        name = with_article(type(curve).__name__)
        raise GeometryError(
            f"{name} with values of shape {pieces.shape[2:]} isn't a curve; give "
            "one with values [x, y] or [x, y, z]"
        )
    is_sane = np.isfinite(ends).all() and (np.abs(pieces) <= LARGEST).all()  # NaN isn't, either
    if not is_sane or not (np.diff(ends) > 0.0).all():
        raise GeometryError(
            f"the {type(curve).__name__} isn't finite, is beyond {LARGEST:g}, or its parameters "
            "don't increase"
        )
    return PolynomialCurve(np.asarray(pieces, np.float64), ends)


def curve_from(curve: Any) -> Any:
    """A curve as it was handed in; one of scipy as what the package takes.

    Raises:
        GeometryError: See ``polynomial_from``.
    """
    polynomial = polynomial_from(curve)
    if polynomial is None:
        return curve
    return polynomial.cubics()[0] if polynomial.is_cubic else polynomial


def _of_spline(spline: Any) -> Any:
    """A B-spline as polynomials: by its derivatives at the beginning of each piece."""
    from scipy.interpolate import PPoly

    inner = np.asarray(spline.t[spline.k : len(spline.t) - spline.k], np.float64)
    ends = np.unique(inner)
    if len(ends) < 2:
        raise GeometryError("the BSpline has no piece with a width; give more knots")
    powers = range(spline.k, -1, -1)
    pieces = [np.asarray(spline(ends[:-1], power)) / math.factorial(power) for power in powers]
    return PPoly(np.array(pieces), ends, extrapolate=False)


def _value(pieces: Floats, at: Floats, derivative: int) -> Floats:
    """Polynomials (k, n, d) at a local parameter each, (n,): (n, d)."""
    degree = len(pieces) - 1
    found = np.zeros(pieces.shape[1:])
    for row, power in zip(pieces, range(degree, -1, -1), strict=True):
        if power >= derivative:
            found = found * at[:, None] + math.perm(power, derivative) * row
    return found


def _fourth_derivative(pieces: Floats, widths: Floats) -> Floats:
    """A bound of the length of the fourth derivative on each piece, (m,)."""
    degree = len(pieces) - 1
    bound = np.zeros(len(widths))
    for row, power in zip(pieces, range(degree, -1, -1), strict=True):
        if power >= 4:
            bound += math.perm(power, 4) * np.linalg.norm(row, axis=1) * widths ** (power - 4)
    return bound


def _check_gaps(points: list[Floats], joints: Floats, size: float) -> None:
    """See that each part ends where the next one begins."""
    gaps = np.linalg.norm(points[0][1:] - points[1][:-1], axis=1)
    if gaps.size and not gaps.max() <= 1e-9 * (1.0 + size):
        k = int(np.argmax(gaps))
        raise GeometryError(
            f"the curve jumps by {gaps[k]:.3g} m at its parameter {joints[k + 1]:g}; give one "
            "without gaps"
        )
