"""Cubic B-splines on equal knots, closed or clamped, as sparse matrices and as Bézier spans."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline
from scipy.sparse import csr_array

from viaspline.kernels.arrays import Floats

CLAMPED = np.r_[0.0, 0.0, 0.0]


@dataclass(frozen=True)
class Knots:
    """The knots 0, 1, ..., ``count`` of a cubic spline with two continuous derivatives.

    Attributes:
        count: Spans; at least 4 if it is closed.
        closed: Whether the spline is periodic; else its ends are its first and last control points.

    >>> Knots(5, closed=True).controls, Knots(5, closed=False).controls
    (5, 8)
    """

    count: int
    closed: bool

    @property
    def controls(self) -> int:
        """Number of control points."""
        return self.count if self.closed else self.count + 3

    @cached_property
    def _line(self) -> Floats:
        if self.closed:
            return np.arange(-3.0, self.count + 4.0)
        inner = np.arange(0.0, self.count + 1.0)
        return np.concatenate((CLAMPED, inner, CLAMPED + self.count))

    @cached_property
    def _fold(self) -> csr_array:
        """From control points to those of the spline on the line, (count + 3, controls)."""
        rows = np.arange(self.count + 3)
        columns = (rows - 1) % self.count if self.closed else rows
        return csr_array((np.ones(rows.size), (rows, columns)), (rows.size, self.controls))

    def matrix(self, at: Floats, derivative: int = 0) -> csr_array:
        """What takes control points to values or derivatives of the spline.

        Args:
            at: Parameters in [0, count], shape (k,); those of a closed spline wrap.
            derivative: 0, 1 or 2.

        Returns:
            Shape (k, controls).
        """
        line, fold = self._line, self._fold
        for order in range(derivative):
            degree = 3 - order
            spacing = line[degree + 1 : -1] - line[1 : -degree - 1]
            size = spacing.size
            rows = np.repeat(np.arange(size), 2)
            columns = rows + np.tile([0, 1], size)
            weights = np.outer(degree / spacing, [-1.0, 1.0]).ravel()
            fold = csr_array(csr_array((weights, (rows, columns)), (size, size + 1)) @ fold)
            line = line[1:-1]
        wrapped = at % self.count if self.closed else at
        return csr_array(BSpline.design_matrix(wrapped, line, 3 - derivative) @ fold)

    @cached_property
    def _joints(self) -> tuple[csr_array, csr_array]:
        at = np.arange(self.count + (not self.closed), dtype=np.float64)
        return self.matrix(at), self.matrix(at, 1)

    def spans(self, controls: Floats) -> Floats:
        """The spline's Bézier control polygons [m], shape (count, 4, d)."""
        places, slopes = (joint @ controls for joint in self._joints)
        if self.closed:
            places, slopes = (np.concatenate((row, row[:1])) for row in (places, slopes))
        before, after = places[:-1], places[1:]
        return np.stack((before, before + slopes[:-1] / 3, after - slopes[1:] / 3, after), axis=1)

    def through(self, points: Floats) -> Floats:
        """Control points of the spline through points at the knots.

        Args:
            points: [m], (count, d) if it is closed, else (count + 1, d); the ends of an open
                spline have no second derivative.
        """
        from scipy.sparse.linalg import splu

        system = self._joints[0]
        rows = points
        if not self.closed:
            from scipy.sparse import vstack

            ends = np.array([0.0, float(self.count)])
            system = csr_array(vstack((system, self.matrix(ends, 2))))
            rows = np.vstack((points, np.zeros((2, points.shape[1]))))
        solved: Floats = splu(system.tocsc()).solve(rows)
        return solved
