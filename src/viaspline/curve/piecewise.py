"""Piecewise cubic curves: the one evaluable face of splines, paths and driven tracks."""

from __future__ import annotations

from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.curve.arguments import call, frozen, outside, working_copy
from viaspline.curve.measured import Measured
from viaspline.errors import GeometryError
from viaspline.handed_in import number_from
from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve import cubic as kernels
from viaspline.kernels.curve import frenet
from viaspline.presentable.compared_by_value import HASH, ComparedByValue
from viaspline.presentable.shown_value import ShownValue


class PiecewiseCubic(Measured, ShownValue, ComparedByValue):
    """A curve of cubic spans, given by their Bézier control polygons. Immutable.

    The parameter u runs from 0 to the number of spans m: ``u = k + w`` is span k at its local
    parameter w in [0, 1]. At a whole u the span on the right counts, at the end the last one.
    A closed curve takes any u and wraps it.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d), m >= 1, d >= 1. Each span starts
            where the one before it ends; a difference that is only rounding (1e-9 m) is closed by
            moving the start of the later one.
        knots: Parameters of the joints in which the curve is C1, shape (m + 1,), if there are
            such; for information. 0, 1, ..., m when not given.
        closed: Whether the last span ends where the first starts.

    Raises:
        GeometryError: When the shape is wrong, a number is not finite or beyond 1e100, or spans
            don't meet; the span is named.

    Example:
        >>> curve = PiecewiseCubic([[[0, 0], [1, 0], [2, 0], [3, 0]]])
        >>> curve.evaluate(0.5), curve.length
        (array([1.5, 0. ]), 3.0)
    """

    def __init__(
        self, spans: ArrayLike, *, knots: ArrayLike | None = None, closed: bool = False
    ) -> None:
        self._adopt(_as_spans(spans), None if knots is None else working_copy(knots), closed)

    def _adopt(self, spans: Floats, knots: Floats | None, closed: bool) -> None:
        """Take over an array that nobody else holds."""
        self._spans = spans
        self._closed = bool(closed)
        self._rows, fault, index = kernels.prepare(spans, self._closed)
        if fault != kernels.FINE:
            _refuse(spans, fault, index)
        if knots is None:
            knots = np.arange(len(spans) + 1.0)
        elif knots.shape != (len(spans) + 1,) or not np.all(np.diff(knots) >= 0):
            raise GeometryError(f"knots have to be {len(spans) + 1} numbers that don't decrease")
        self._knots = frozen(knots)
        self._derived: dict[int, Floats] = {0: self._rows}

    @classmethod
    def _made(cls, spans: Floats, knots: Floats | None, closed: bool = False) -> PiecewiseCubic:
        curve = PiecewiseCubic.__new__(PiecewiseCubic)
        curve._adopt(spans, knots, closed)
        return curve

    def _said(self) -> tuple[object, ...]:
        return self._spans, self._closed, self._knots

    def __hash__(self) -> int:
        """Of its spans alone: a robot among what moves times a new path many times in each step."""
        known = vars(self)
        if HASH not in known:
            known[HASH] = hash((self._spans.shape, (self._spans + 0.0).tobytes()))
        found: int = known[HASH]
        return found

    def __repr__(self) -> str:
        kind = "closed, " if self._closed else ""
        return f"<{type(self).__name__}: {len(self._spans)} spans, {kind}d = {self.dimension}>"

    @property
    def spans(self) -> Floats:
        """The exact curve: Bézier control polygons [m], shape (m, 4, d), read-only."""
        return frozen(self._spans)

    @property
    def knots(self) -> Floats:
        """Parameters of the joints in which the family is C1, shape (m + 1,), read-only."""
        return self._knots

    @property
    def dimension(self) -> int:
        """Number of coordinates d."""
        return int(self._spans.shape[2])

    @property
    def closed(self) -> bool:
        """Whether the end is the start."""
        return self._closed

    @property
    def domain(self) -> tuple[float, float]:
        """The first and the last parameter, (0, m)."""
        return 0.0, float(len(self._spans))

    def evaluate(self, u: ArrayLike, derivative: int = 0) -> Floats:
        """Points of the curve, or derivatives with respect to u.

        Args:
            u: Parameters in the domain; a number or an array of any shape.
            derivative: 0 to 3. Derivatives may jump at a joint: see the class for which side.

        Returns:
            Shape (d,) for a number, (..., d) for an array.

        Raises:
            GeometryError: When a parameter is outside the domain of an open curve or not a number.
        """
        if not isinstance(derivative, int | np.integer):
            raise GeometryError(f"derivative has to be 0, 1, 2 or 3, not {derivative!r:.40}")
        rows = self._derived.get(derivative)
        if rows is None:
            rows = self._derivative(derivative)
        parameters, shape = call(u)
        out = np.empty((parameters.size, self._spans.shape[2]))
        bad = kernels.evaluate(rows, parameters, self._closed, out)
        if bad >= 0:
            raise outside("u", parameters[bad], self.domain)
        return out.reshape((*shape, out.shape[1]))

    def _derivative(self, derivative: int) -> Floats:
        if derivative not in (1, 2, 3):
            raise GeometryError(f"derivative has to be 0, 1, 2 or 3, not {derivative!r}")
        lower = self._derived.get(derivative - 1)
        if lower is None:
            lower = self._derivative(derivative - 1)
        rows = np.zeros_like(lower)
        for power in range(1, 4):
            rows[:, power - 1] = power * lower[:, power]
        self._derived[derivative] = rows
        return rows

    def tangent(self, u: ArrayLike) -> Floats:
        """Unit tangents.

        Where the first derivative vanishes (a polyline's joints, a cusp) it is the limit from the
        right, at the end of the curve that from the left. A span that is a single point takes the
        tangent of its neighbour; a curve that is one has a tangent of zero.

        Args:
            u: Parameters in the domain.

        Returns:
            Shape (d,) for a number, (..., d) for an array.

        Raises:
            GeometryError: See ``evaluate``.
        """
        parameters, shape = call(u)
        out = np.empty((parameters.size, self.dimension))
        bad = frenet.direction(self._spans, parameters, self._closed, out)
        if bad >= 0:
            raise outside("u", parameters[bad], self.domain)
        return out.reshape((*shape, self.dimension))

    def heading(self, u: ArrayLike) -> Any:
        """Headings of the tangents in the x-y plane [rad], anticlockwise from x, in (-pi, pi].

        Args:
            u: Parameters in the domain.

        Returns:
            A number for a number, an array of the same shape for an array.

        Raises:
            GeometryError: See ``evaluate``; and for a curve of one dimension.
        """
        if self.dimension < 2:
            raise GeometryError("a curve of one dimension has no heading")
        tangent = self.tangent(u)
        angle = np.arctan2(tangent[..., 1], tangent[..., 0])
        return float(angle) if np.ndim(angle) == 0 else angle

    def curvature(self, u: ArrayLike) -> Any:
        """Curvatures [1/m]: in the plane positive anticlockwise, in space without sign.

        Zero in one dimension and on straight pieces, a polyline's joints included; infinite at a
        cusp, where the curve turns back on the spot.

        Args:
            u: Parameters in the domain.

        Returns:
            A number for a number, an array of the same shape for an array.

        Raises:
            GeometryError: See ``evaluate``.
        """
        parameters, shape = call(u)
        out = np.empty(parameters.size)
        bad = frenet.curvature(self._spans, parameters, self._closed, False, out)
        if bad >= 0:
            raise outside("u", parameters[bad], self.domain)
        return out.reshape(shape) if shape else float(out[0])

    def split(self, u: float) -> tuple[PiecewiseCubic, PiecewiseCubic]:
        """The part before and the part after a parameter, both open and exact.

        Args:
            u: Parameter inside the domain, neither 0 nor m.

        Returns:
            The two parts.

        Raises:
            GeometryError: When a part would be empty.
        """
        return self.section(0.0, u), self.section(u, self.domain[1])

    def section(self, u0: float, u1: float) -> PiecewiseCubic:
        """The part from u0 to u1, open and exact, by de Casteljau's construction.

        Spans that lie wholly inside are taken over bit by bit. On a closed curve u1 may be
        smaller than u0: the part then runs over the seam.

        Args:
            u0: Where it starts.
            u1: Where it ends.

        Returns:
            The part; it starts at its own parameter 0.

        Raises:
            GeometryError: When a parameter is outside the domain or the part is empty.
        """
        start, end = self.domain
        u0, u1 = number_from("u0", u0), number_from("u1", u1)
        for value in (u0, u1):
            if not start <= value <= end:
                raise outside("u", value, self.domain)
        if u0 < u1:
            return self._section(float(u0), float(u1))
        if not self._closed or u0 == u1 or (u0 == end and u1 == start):
            raise GeometryError(f"the section from u = {u0} to u = {u1} is empty")
        if u0 == end:
            return self._section(start, float(u1))
        if u1 == start:
            return self._section(float(u0), end)
        return self._section(float(u0), end).joined(self._section(start, float(u1)))

    def _section(self, u0: float, u1: float) -> PiecewiseCubic:
        first, last = int(u0), int(np.ceil(u1)) - 1
        spans = self._spans[first : last + 1].copy()
        for k in {first, last}:
            low, high = max(u0 - k, 0.0), min(u1 - k, 1.0)
            if (low, high) != (0.0, 1.0):
                kernels.subspan(self._spans[k], low, high, spans[k - first])
        joints = np.concatenate(((u0,), np.arange(first + 1.0, last + 1.0), (u1,)))
        knots = np.interp(joints, np.arange(0.0, len(self.knots)), self.knots)
        return self._made(spans, np.asarray(knots))

    def joined(self, other: PiecewiseCubic) -> PiecewiseCubic:
        """This curve and then another one that starts where this one ends.

        Args:
            other: An open curve of the same dimension.

        Returns:
            An open curve; its knots run on.

        Raises:
            GeometryError: When the curves don't meet or one is closed.
        """
        if self._closed or other.closed:
            raise GeometryError("a closed curve can't be joined: take a section of it")
        if self.dimension != other.dimension:
            raise GeometryError(
                f"a curve of dimension {other.dimension} can't follow one of {self.dimension}"
            )
        spans = np.concatenate((self._spans, other._spans))
        knots = np.concatenate((self.knots, other.knots[1:] - other.knots[0] + self.knots[-1]))
        return self._made(spans, knots)

    def __copy__(self) -> Self:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        return self


def _as_spans(spans: ArrayLike) -> Floats:
    array: NDArray[np.float64] = working_copy(spans)
    if array.ndim != 3 or array.shape[0] < 1 or array.shape[1] != 4 or array.shape[2] < 1:
        raise GeometryError(f"spans have to be of shape (m, 4, d), not {array.shape}")
    return array


def _refuse(spans: Floats, fault: int, index: int) -> None:
    if fault == kernels.NOT_FINITE:
        raise GeometryError(f"span {index} has a number that is not finite: {spans[index]}")
    before = index - 1 if index > 0 else len(spans) - 1
    gap = float(np.linalg.norm(spans[index, 0] - spans[before, 3]))
    raise GeometryError(f"span {index} starts {gap:.3g} m from where span {before} ends")
