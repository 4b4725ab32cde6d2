"""What can be proven of any curve: cubics that it is nowhere far from, by what it states of itself.

Between values alone nothing can be proven. A piecewise cubic is what it says. Polynomials are
cubics, or near them by their fourth derivative. Any other curve has to state how large its second
derivative may be: between two of its points it is then no farther from their chord than h²/8 times
that, h being the parameter's step.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import ArrayLike

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.curve.polynomial_curve import polynomial_from
from viaspline.errors import GeometryError
from viaspline.handed_in import check_answers, number_from, numbers_from
from viaspline.kernels.arrays import Floats

CHORD_OFF_M: Final = 1e-4
"""How far chords may be from a curve that states its second derivative [m]."""
FIRST_CHORDS: Final = 64
MOST_CHORDS: Final = 200_000
ROUNDED: Final = 1e-9
"""Part of a length by which a curve's own arithmetic may be off what it states."""


class StatedCurve(Protocol):
    """A curve that states how much it bends, besides what ``retime`` takes."""

    @property
    def domain(self) -> tuple[float, float]:
        """First and last parameter."""

    def evaluate(self, u: ArrayLike, derivative: int = 0) -> Floats:
        """Points or derivatives at parameters (n,), shape (n, d)."""

    def second_derivative_bound(self, u0: float, u1: float) -> float:
        """What the length of the second derivative is nowhere above between two parameters."""


@dataclass(frozen=True, eq=False)
class ProvableCurve:
    """Cubics, and how far a curve is from them.

    Attributes:
        cubics: They.
        off: No place of the curve is farther from them [m].
        joints: The curve's parameters at their ends, (m + 1,).
        has_its_tangents: Whether they are the curve but for rounding, so that a body that looks
            along them looks along it.
    """

    cubics: PiecewiseCubic
    off: float
    joints: Floats
    has_its_tangents: bool

    def parameter(self, u: float) -> float:
        """The curve's own parameter at one of the cubics."""
        return float(np.interp(u, np.arange(float(len(self.joints))), self.joints))


def provable_curve(curve: Any) -> ProvableCurve:
    """A curve as cubics that it is nowhere far from.

    Args:
        curve: A piecewise cubic, or anything with its ``spans``; a ``PPoly``, ``BPoly`` or
            ``BSpline`` of scipy; or a ``StatedCurve``.

    Raises:
        GeometryError: It is none of them, states what isn't so, or can't be followed.

    Example:
        >>> class Circle:
        ...     domain = (0.0, 2 * np.pi)
        ...     def evaluate(self, u, derivative=0):
        ...         turned = np.asarray(u) + derivative * np.pi / 2
        ...         return 5 * np.stack((np.cos(turned), np.sin(turned)), axis=-1)
        ...     def second_derivative_bound(self, u0, u1):
        ...         return 5.0
        >>> found = provable_curve(Circle())
        >>> found.off <= 1e-4, round(found.cubics.length, 2)
        (True, 31.42)
    """
    if isinstance(curve, PiecewiseCubic):
        return ProvableCurve(curve, 0.0, np.arange(len(curve.spans) + 1.0), True)
    polynomial = polynomial_from(curve)
    if polynomial is not None:
        return ProvableCurve(*polynomial.cubics(), polynomial.is_cubic)
    check_answers("curve", curve, "domain", "give a CardinalSpline, or the path of a plan")
    first, last = _domain(curve)
    if hasattr(curve, "spans"):
        cubics = PiecewiseCubic(curve.spans)
        joints = np.linspace(first, last, len(cubics.spans) + 1)
        return ProvableCurve(cubics, 0.0, joints, True)
    check_answers("curve", curve, "evaluate", "give a CardinalSpline, or the path of a plan")
    if not hasattr(curve, "second_derivative_bound"):
        raise GeometryError(
            f"curve is of the class {type(curve).__name__}, of which only values are known, and "
            "between them it may be anywhere; give it second_derivative_bound(u0, u1), or give a "
            "piecewise cubic, a PPoly or a BSpline"
        )
    return _chords(curve, first, last)


def _domain(curve: Any) -> tuple[float, float]:
    ends = numbers_from("curve.domain", curve.domain)
    if ends.shape != (2,) or not np.isfinite(ends).all() or not ends[0] < ends[1]:
        raise GeometryError(f"curve.domain is {curve.domain!r:.40}; give its two ends, in order")
    return float(ends[0]), float(ends[1])


def _chords(curve: StatedCurve, first: float, last: float) -> ProvableCurve:
    """Chords of a curve, as short as what it states of itself asks for."""
    joints = np.linspace(first, last, FIRST_CHORDS + 1)
    bows = _bows(curve, joints)
    while len(bows) < MOST_CHORDS and (bows > CHORD_OFF_M).any():
        long = np.flatnonzero(bows > CHORD_OFF_M)
        long = long[np.argsort(-bows[long], kind="stable")][: MOST_CHORDS - len(bows)]
        halves = np.sort(0.5 * (joints[long] + joints[long + 1]))
        refined = np.union1d(joints, halves)
        if len(refined) == len(joints):
            break  # parameters are as near as numbers can be
        joints, bows = refined, _renewed(curve, joints, bows, refined)
    points = _points(curve, joints)
    middles = _points(curve, 0.5 * (joints[:-1] + joints[1:]))
    size = float(np.abs(points).max())
    strays = np.linalg.norm(middles - 0.5 * (points[:-1] + points[1:]), axis=1)
    if (strays > bows + ROUNDED * (1.0 + size)).any():
        k = int(np.argmax(strays - bows))
        raise GeometryError(
            f"curve.second_derivative_bound isn't a bound: between {joints[k]:g} and "
            f"{joints[k + 1]:g} the curve bends more than it says"
        )
    ends = points[:-1], points[1:]
    spans = np.stack([(1 - w) * ends[0] + w * ends[1] for w in (0.0, 1 / 3, 2 / 3, 1.0)], axis=1)
    spans[1:, 0] = spans[:-1, 3]
    off = float(bows.max()) + ROUNDED * (1.0 + size)
    return ProvableCurve(PiecewiseCubic(spans), off, joints, False)


def _bows(curve: StatedCurve, joints: Floats) -> Floats:
    """How far a curve may be from its chords, between every two parameters [m]."""
    return np.array([_bow(curve, a, b) for a, b in pairwise(joints.tolist())])


def _renewed(curve: StatedCurve, joints: Floats, bows: Floats, refined: Floats) -> Floats:
    """As ``_bows``, for more parameters: asked only where there are new ones."""
    index = np.searchsorted(joints, refined[:-1], side="right") - 1
    is_old = (joints[index] == refined[:-1]) & (joints[index + 1] == refined[1:])
    found = bows[index]
    for k in np.flatnonzero(~is_old).tolist():
        found[k] = _bow(curve, refined[k], refined[k + 1])
    return found


def _bow(curve: StatedCurve, a: float, b: float) -> float:
    bound = number_from(
        "curve.second_derivative_bound", curve.second_derivative_bound(float(a), float(b))
    )
    if not 0.0 <= bound < math.inf:
        raise GeometryError(
            f"curve.second_derivative_bound is {bound} between {a:g} and {b:g}; give a finite "
            "number of 0 or more"
        )
    return bound * (b - a) ** 2 / 8.0


def _points(curve: StatedCurve, u: Floats) -> Floats:
    points = numbers_from("curve.evaluate", curve.evaluate(u, 0))
    if points.ndim != 2 or len(points) != len(u):
        raise GeometryError(
            f"curve.evaluate gives an array of shape {points.shape} for {len(u)} parameters; "
            "give (n, d)"
        )
    if not np.isfinite(points).all():
        raise GeometryError("curve.evaluate gives points that are nowhere; give finite numbers")
    return points
