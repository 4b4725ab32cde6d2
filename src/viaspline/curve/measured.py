"""What is measured on a curve in metres: length, distance along it, nearest point, curvature."""

from __future__ import annotations

import math
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from viaspline.curve.arguments import as_point, call, frozen, outside
from viaspline.errors import GeometryError
from viaspline.handed_in import number_from
from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve import arclength, cubic, curvature_extrema, extrema, frenet

MAX_SAMPLES = 50_000_000


class Projection(NamedTuple):
    """The nearest point of a curve.

    Attributes:
        u: Its parameter.
        point: It [m], shape (d,).
        distance: How far it is [m].
    """

    u: float
    point: Floats
    distance: float


class Measured:
    """The metric half of ``PiecewiseCubic``, which brings the spans and their coefficients."""

    _spans: Floats
    _rows: Floats
    _closed: bool

    @cached_property
    def _table(self) -> tuple[Floats, Floats]:
        """Parameters and distances of the panels of the length integral."""
        at, along = arclength.length_table(self._rows)
        return at, along

    @property
    def packed_length(self) -> tuple[Floats, Floats, Floats]:
        """What kernels take that go along the curve: Taylor coefficients, and ``length_table``."""
        return self._rows, *self._table

    @property
    def length(self) -> float:
        """Length of the whole curve [m], to a relative 1e-9."""
        return float(self._table[1][-1])

    def distance(self, u: ArrayLike) -> Any:
        """Distance along the curve from its start [m].

        Args:
            u: Parameters in the domain; a number or an array of any shape.

        Returns:
            A number for a number, an array of the same shape for an array.

        Raises:
            GeometryError: When a parameter is outside the domain of an open curve.
        """
        values, shape = call(u)
        out = np.empty(values.size)
        bad = arclength.distances(self._rows, *self._table, values, self._closed, out)
        if bad >= 0:
            raise outside("u", values[bad], (0.0, float(len(self._spans))))
        return out.reshape(shape) if shape else float(out[0])

    def parameter(self, s: ArrayLike) -> Any:
        """Parameter at a distance along the curve: the inverse of ``distance``.

        Args:
            s: Distances from the start in [0, length] [m]; those of a closed curve wrap.

        Returns:
            A number for a number, an array of the same shape for an array.

        Raises:
            GeometryError: When a distance is not on an open curve.
        """
        values, shape = call(s)
        out = np.empty(values.size)
        bad = arclength.parameters(self._rows, *self._table, values, self._closed, out)
        if bad >= 0:
            raise outside("s", values[bad], (0.0, self.length))
        return out.reshape(shape) if shape else float(out[0])

    def at_distance(self, s: ArrayLike) -> Floats:
        """Points at distances along the curve.

        Args:
            s: Distances from the start in [0, length] [m]; those of a closed curve wrap.

        Returns:
            Shape (d,) for a number, (..., d) for an array.

        Raises:
            GeometryError: When a distance is not on an open curve.
        """
        u, shape = call(self.parameter(s))
        out = np.empty((u.size, self._spans.shape[2]))
        cubic.evaluate(self._rows, u, self._closed, out)
        return out.reshape((*shape, out.shape[1]))

    def sample(self, spacing: float) -> tuple[Floats, Floats, Floats]:
        """Points equally spaced along the curve, both ends among them.

        Args:
            spacing: Largest distance from point to point along the curve [m]; it is made so much
                smaller that it divides the length.

        Returns:
            (u (n,), s (n,) [m], points (n, d) [m]).

        Raises:
            GeometryError: When the spacing is not above 0, or so small that there would be more
                than 50 million points.
        """
        length, spacing = self.length, number_from("spacing", spacing)
        if not spacing > 0.0 or length / spacing > MAX_SAMPLES:
            raise GeometryError(f"spacing = {spacing} can't divide a curve of {length:.6g} m")
        steps = max(1, math.ceil(length / spacing - 1e-9))
        s = np.linspace(0.0, length, steps + 1)
        u = self.parameter(s)
        u[-1] = float(len(self._spans))
        out = np.empty((u.size, self._spans.shape[2]))
        cubic.evaluate(self._rows, u, self._closed, out)
        return u, s, out

    def project(
        self, point: ArrayLike, *, between: tuple[float, float] | None = None
    ) -> Projection:
        """The nearest point of the curve: of all of it, not a local one.

        Args:
            point: Where from [m], shape (d,).
            between: The first and the last parameter that count; the whole curve when not given.

        Returns:
            Parameter, point and distance; of several nearest points the first.

        Raises:
            GeometryError: When the point is not d finite numbers, or ``between`` is not in the
                domain.
        """
        end = float(len(self._spans))
        start, stop = (0.0, end) if between is None else map(float, between)
        if not 0.0 <= start <= stop <= end:
            raise GeometryError(f"between = {between} is not a part of [0.0, {end}]")
        place = as_point(point, self._spans.shape[2])
        u, distance = extrema.nearest_parameter(self._spans, place, start, stop)
        out = np.empty((1, place.size))
        cubic.evaluate(self._rows, np.array([u]), self._closed, out)
        return Projection(float(u), frozen(out[0]), float(distance))

    def max_curvature(self) -> tuple[float, float]:
        """The largest curvature without its sign, both sides of every joint included.

        Every stationary point of the curvature is found as the root of a polynomial; the largest
        value is exact to a millionth of it.

        Returns:
            (curvature [1/m], u); infinite at a cusp, where the curve stands still, to a billionth
            of its largest derivative there, and turns back, on a straight line as well.
        """
        value, span, w = curvature_extrema.sharpest(self._spans)
        return float(value), float(span + w)

    def curvature_jumps(self) -> Floats:
        """How far curvature jumps at the joints [1/m].

        Returns:
            Shape (m - 1,), joint 1 first; (m,), joint 0 first, for a closed curve. In the plane
            the difference of the signed curvatures, in space that of the curvature vectors.
        """
        joints = np.arange(0.0 if self._closed else 1.0, len(self._spans))
        sides = np.empty((2, joints.size))
        for side, left in zip(sides, (True, False), strict=True):
            frenet.curvature(self._spans, joints, self._closed, left, side)
        cusps = np.isinf(sides).any(axis=0)
        sides[:, cusps] = 0.0
        if self._spans.shape[2] < 3:
            jumps = np.abs(sides[1] - sides[0])
        else:
            before = self._spans[joints.astype(int) - 1, :0:-1]
            after = self._spans[joints.astype(int), :3]
            vectors = _across(after) * sides[1, :, None] - _across(before) * sides[0, :, None]
            jumps = np.linalg.norm(vectors, axis=1)
        jumps[cusps] = np.inf
        return np.asarray(jumps)


def _across(control: Floats) -> Floats:
    """Unit vectors of the curvature at the first of three control points each, (k, 3, d)."""
    first = control[:, 1] - control[:, 0]
    second = control[:, 2] - control[:, 1]
    squared = np.sum(first * first, axis=1, keepdims=True)
    part = np.sum(first * second, axis=1, keepdims=True) / np.where(squared > 0.0, squared, 1.0)
    across = second - part * first
    length = np.linalg.norm(across, axis=1, keepdims=True)
    return np.asarray(across / np.where(length > 0.0, length, 1.0))
