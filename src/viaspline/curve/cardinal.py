"""The cardinal spline through via points."""

from __future__ import annotations

import math
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from viaspline.curve.arguments import frozen, working_copy
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.curve.tangents import ALPHA, PIECES, RULES
from viaspline.errors import GeometryError
from viaspline.handed_in import check_kind
from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cardinal_tangents import knot_spacing

Knots = Literal["uniform", "centripetal", "chordal"]
Tangents = Literal["cardinal", "continuous"]


class CardinalSpline(PiecewiseCubic):
    """A curve through all its via points, in order.

    Tension has two names: ``tension`` t of the paper's Eq. 7 (1 the polyline, 0 Catmull-Rom, -1
    loose) and ``slack`` s = (1 - t) / 2, the parameter of the drawing libraries (0 the polyline,
    0.5 Catmull-Rom, 1 "no tension", above 1 a longer way). Give one.

    A point that is repeated at once: with uniform knots the paper's formula is taken at its word,
    and gives a small loop there (nothing at an end); with the others the repetition adds a span
    of no length and changes nothing else.

    Args:
        points: Via points [m], shape (n, d), n >= 2, d >= 1.
        tension: A number, or one for each span, shape (m,); at most 1.
        slack: The same by its other name, at least 0.
        knots: ``"uniform"`` as in the paper; ``"centripetal"`` or ``"chordal"`` where via points
            are unevenly spaced.
        closed: Whether the curve runs on from the last point to the first (which is not repeated).
        start_heading: Direction at the start: an angle [rad] in the x-y plane, anticlockwise from
            x, for d = 2 and 3, or a vector of shape (d,). Without effect where the end span's
            tension is 1.
        end_heading: Direction at the end, likewise.
        tangents: ``"cardinal"``, or ``"continuous"`` for curvature that does not jump at the via
            points, with three cubics between them: see ``viaspline.curve.tangents``.

    Raises:
        GeometryError: When an argument makes no sense; it is named, with what would be right.

    Example:
        >>> spline = CardinalSpline([(0, 0), (1, 1), (2, 0)], tension=0.0)
        >>> spline.evaluate([0, 0.5, 1])
        array([[0.    , 0.    ],
               [0.4375, 0.5625],
               [1.    , 1.    ]])
        >>> round(float(spline.heading(1)), 3)
        0.0
    """

    def __init__(
        self,
        points: ArrayLike,
        tension: ArrayLike = 0.0,
        *,
        slack: ArrayLike | None = None,
        knots: Knots = "uniform",
        closed: bool = False,
        start_heading: ArrayLike | None = None,
        end_heading: ArrayLike | None = None,
        tangents: Tangents = "cardinal",
    ) -> None:
        self._points = _as_points(points)
        check_kind("closed", closed, (bool, np.bool_), "give True or False")
        count, dimension = self._points.shape
        self._slack = _as_slack(tension, slack, count if closed else count - 1)
        if closed and not (start_heading is None and end_heading is None):
            raise GeometryError("a closed curve has no end headings")
        start = _as_direction("start_heading", start_heading, dimension)
        end = _as_direction("end_heading", end_heading, dimension)
        has_start = start_heading is not None
        has_end = end_heading is not None
        try:
            rule, alpha = RULES[str(tangents)], ALPHA[str(knots)]
        except KeyError:
            raise GeometryError(
                f"tangents = {tangents!r} has to be one of {list(RULES)}, "
                f"knots = {knots!r} one of {list(ALPHA)}"
            ) from None
        self._alpha = alpha
        self._pieces = PIECES[tangents]
        spans = rule(
            self._points, alpha, self._slack, start, end, has_start, has_end, bool(closed)
        )  # fmt: skip
        self._adopt(spans, None, closed)

    def _said(self) -> tuple[object, ...]:
        return *super()._said(), self._points, self._slack, self._alpha, self._pieces

    @property
    def points(self) -> Floats:
        """The via points [m], shape (n, d), read-only; see ``via_parameters``."""
        return frozen(self._points)

    @property
    def via_parameters(self) -> Floats:
        """Parameters u of the via points, shape (n,), read-only.

        Example:
            >>> CardinalSpline([(0, 0), (1, 1), (2, 0)], tangents="continuous").via_parameters
            array([0., 3., 6.])
        """
        return frozen(self._pieces * np.arange(float(len(self._points))))

    @property
    def slack(self) -> Floats:
        """Slack from every via point to the next, shape (n - 1,) or (n,), read-only."""
        return frozen(self._slack)

    @property
    def tension(self) -> Floats:
        """Tension from every via point to the next, shape (n - 1,) or (n,), read-only."""
        return frozen(1.0 - 2.0 * self._slack)

    @cached_property
    def _family_knots(self) -> Floats:
        spacing = knot_spacing(self._points, self._alpha, self._closed) / self._pieces
        spacing = np.repeat(spacing, self._pieces)
        return frozen(np.concatenate(([0.0], np.cumsum(spacing))))

    @property
    def knots(self) -> Floats:
        """Parameters of the joints in which the curve is C1, shape (m + 1,), read-only."""
        return self._family_knots


def _as_points(points: ArrayLike) -> Floats:
    array = working_copy(points)
    if array.ndim != 2 or array.shape[0] < 2 or array.shape[1] < 1:
        raise GeometryError(f"points have to be of shape (n, d) with n >= 2, not {array.shape}")
    if not np.isfinite(array).all():
        index = int(np.flatnonzero(~np.isfinite(array).all(axis=1))[0])
        raise GeometryError(f"point {index} is not finite: {array[index].tolist()}")
    return array


def _as_slack(tension: ArrayLike, slack: ArrayLike | None, spans: int) -> Floats:
    if slack is None:
        name, given = "tension", working_copy(tension)
        values = 0.5 - 0.5 * given
    else:
        if not (isinstance(tension, float | int) and tension == 0.0):
            raise GeometryError("tension and slack are two names of one thing: give one of them")
        name, given = "slack", working_copy(slack)
        values = given
    if values.ndim > 1 or (values.ndim == 1 and values.shape != (spans,)):
        raise GeometryError(f"{name} has to be a number or {spans} of them, not {given.shape}")
    if not ((values >= 0.0) & (values <= 1e6)).all():
        right = "at most 1 (the polyline)" if slack is None else "at least 0 (the polyline)"
        raise GeometryError(f"{name} = {given.tolist()} has to be {right}")
    return np.full(spans, values) if values.ndim == 0 else values


def _as_direction(name: str, heading: ArrayLike | None, dimension: int) -> Floats:
    direction = np.zeros(dimension)
    if heading is None:
        return direction
    given = working_copy(heading)
    if not np.isfinite(given).all():
        raise GeometryError(f"{name} = {heading!r} is not finite")
    if given.ndim == 0 and dimension in (2, 3):
        direction[0] = math.cos(given)
        direction[1] = math.sin(given)
        return direction
    length = float(np.linalg.norm(given))
    if given.shape != (dimension,) or length == 0.0:
        angle = "an angle [rad] or " if dimension in (2, 3) else ""
        raise GeometryError(f"{name} has to be {angle}a vector of {dimension} numbers, not 0")
    return given / length
