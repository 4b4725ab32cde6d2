"""The fastest v² along a path with a limit of the jerk, from rest to rest.

Jerk is the change of the acceleration along the path with time. On a grid w = v² is a quadratic
spline: the acceleration a = w'/2 is continuous and linear in the distance on every stretch, and the
jerk is a'v. The unknowns are the middle Bernstein coefficients of w on the stretches; at both ends
and in between every limit but the jerk is linear in them, and a polynomial lies below its largest
coefficient, so the limits hold between the points as well. Beside a rest the jerk is constant:
v1² = 3/2 a1 h there, which is linear again.

The time is convex. Jerk bounds a' by J / v, which is not, so what is found is a local optimum: a
barrier keeps every limit strictly from a crawl on, and Newton's method with a banded matrix takes
it as near to the limits as ``GAP``.

Source: the same problem as in L. Consolini, M. Locatelli and A. Minari, "A sequential algorithm
for jerk limited speed planning", IEEE T-ASE 2022.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

GAP = 2e-4
"""What the barrier keeps of the time, at most, as a part of it."""

STEEPER = 12.0
ROUNDS = 200

_GAUSS = (0.21132486540518713, 0.7886751345948129)


class Motion(NamedTuple):
    """A motion from rest to rest in pieces.

    Attributes:
        speeds: At the ends of the pieces [m/s], shape (n + 1,).
        accelerations: At the beginning of each [m/s²], shape (n,).
        changes: Of the acceleration with the distance [1/s²], shape (n,).
        jerks: With time, in the first and the last one [m/s³], shape (n,).
    """

    speeds: Floats
    accelerations: Floats
    changes: Floats
    jerks: Floats


@dataclass(frozen=True)
class Rows:
    """Limits p · (a0, a1, w0, m, w1) <= g of each stretch: its ends and its middle coefficient.

    Attributes:
        weights: Shape (n, k, 5).
        limits: Shape (n, k), above 0.
    """

    weights: Floats
    limits: Floats


def smoothest(widths: Floats, rows: Rows, jerk: float) -> Motion:
    """The fastest motion over stretches, at rest before the first and after the last.

    Args:
        widths: Of the stretches [m], shape (n,), n >= 4.
        rows: Their limits; those of the first and last stretch are asked of the a and w of the end
            that moves alone.
        jerk: [m/s³].
    """
    problem = _Problem.of(widths, rows, jerk)
    m = problem.crawl()
    sharpness = problem.limits.size / problem.time(m)
    while True:
        m = problem.centred(m, sharpness)
        if problem.limits.size < GAP * sharpness * problem.time(m):
            return problem.motion(m)
        sharpness *= STEEPER


@dataclass(frozen=True)
class _Problem:
    """All in terms of the coefficients of a stretch, the one before and the one after it.

    Attributes:
        widths: Of all stretches [m], shape (n + 2,); the unknowns are those of the inner n.
        jerk: [m/s³].
        ends: a0, a1, w0, m, w1 of the inner stretches, shape (n, 5, 3).
        rows: Linear limits, shape (n, k, 3).
        limits: Their right-hand sides, shape (n, k); inf where a row is empty.
        change: da/ds, shape (n, 3).
        gauss: w at two places of every stretch, shape (n, 2, 3).
    """

    widths: Floats
    jerk: float
    ends: Floats
    rows: Floats
    limits: Floats
    change: Floats
    gauss: Floats

    @classmethod
    def of(cls, widths: Floats, rows: Rows, jerk: float) -> _Problem:
        h = widths[1:-1]
        n = h.size
        ends = np.zeros((n, 5, 3))
        ends[:, 3, 1] = 1.0
        both = h[:-1] + h[1:]
        ends[1:, 0, 0], ends[1:, 0, 1] = -1.0 / both, 1.0 / both
        ends[1:, 2, 0], ends[1:, 2, 1] = h[1:] / both, h[:-1] / both
        ends[:-1, 1, 1:], ends[:-1, 4, 1:] = ends[1:, 0, :2], ends[1:, 2, :2]
        for inner, outer, at, sign in ((0, 0, 0, 1.0), (-1, -1, 1, -1.0)):
            rest = 1.5 * widths[outer]
            ends[inner, at, 1] = sign / (rest + h[inner])
            ends[inner, 2 if at == 0 else 4, 1] = rest / (rest + h[inner])
        inside = np.einsum("nkz,nzc->nkc", rows.weights[1:-1], ends)
        more = np.zeros((n, 2 + 2 * rows.limits.shape[1], 3))
        bound = np.full(more.shape[:2], np.inf)
        more[:, 0, 1], bound[:, 0] = -1.0, 0.0
        for inner, outer, at in ((0, 0, 0), (-1, -1, 1)):
            k = slice(2 + at * rows.limits.shape[1], 2 + (at + 1) * rows.limits.shape[1])
            moving = np.zeros((5, 3))
            moving[1 - at], moving[2 if at else 4] = ends[inner, at], ends[inner, 4 if at else 2]
            more[inner, k], bound[inner, k] = rows.weights[outer] @ moving, rows.limits[outer]
            more[inner, 1] = ends[inner, 4 if at else 2]
            bound[inner, 1] = (4.5 * widths[outer] ** 2 * jerk) ** (2.0 / 3.0)
        gauss = np.stack(
            [
                (1 - x) ** 2 * ends[:, 2] + 2 * x * (1 - x) * ends[:, 3] + x * x * ends[:, 4]
                for x in _GAUSS
            ],
            axis=1,
        )
        change = (ends[:, 1] - ends[:, 0]) / h[:, None]
        return cls(
            widths, jerk, ends, np.concatenate((inside, more), axis=1),
            np.concatenate((rows.limits[1:-1], bound), axis=1), change, gauss,
        )  # fmt: skip

    def _near(self, m: Floats) -> Floats:
        """The coefficients before, of and after each stretch, shape (n, 3)."""
        return np.stack((np.append(0.0, m[:-1]), m, np.append(m[1:], 0.0)), axis=1)

    def slacks(self, m: Floats) -> tuple[Floats, Floats, Floats]:
        """What is left of the linear limits and of the jerk, and the w that the jerk goes with."""
        near = self._near(m)
        linear = self.limits - np.einsum("nkc,nc->nk", self.rows, near)
        w = np.einsum("nkc,nc->nk", self.ends[:, 2:], near)
        k = np.einsum("nc,nc->n", self.change, near)
        with np.errstate(invalid="ignore"):
            used = k[:, None] * np.sqrt(w)
        return linear, np.concatenate((self.jerk - used, self.jerk + used), axis=1), w

    def time(self, m: Floats) -> float:
        """How long it takes [s]."""
        w = np.einsum("nkc,nc->nk", self.gauss, self._near(m))
        first, last = self.ends[0, 2, 1] * m[0], self.ends[-1, 4, 1] * m[-1]
        beside = 3.0 * (self.widths[0] / np.sqrt(first) + self.widths[-1] / np.sqrt(last))
        return float(0.5 * (self.widths[1:-1, None] / np.sqrt(w)).sum() + beside)

    def crawl(self) -> Floats:
        """So slow that every limit is kept strictly."""
        m = np.full(self.widths.size - 2, 1.0)
        while not self.value(m, 1.0) < np.inf:
            m *= 0.25
        return 0.25 * m

    def value(self, m: Floats, sharpness: float) -> float:
        """What the barrier makes least."""
        if not np.all(m > 0.0):
            return np.inf
        linear, jerk, _ = self.slacks(m)
        if not (np.all(linear > 0.0) and np.all(jerk > 0.0)):
            return np.inf
        finite = linear[np.isfinite(linear)]
        return float(sharpness * self.time(m) - np.log(finite).sum() - np.log(jerk).sum())

    def centred(self, m: Floats, sharpness: float) -> Floats:
        """The least of the barrier function from m on, by Newton's method."""
        from scipy.linalg import solveh_banded  # 0.2 s to import, and few plans ask for the jerk

        value = self.value(m, sharpness)
        for _ in range(ROUNDS):
            gradient, matrix = self._newton(m, sharpness)
            step = -solveh_banded(matrix, gradient, lower=True)
            drop = float(gradient @ step)
            if drop > -1e-6 * (1.0 + abs(value)) * 1e-2:
                break
            part = 1.0
            while part > 1e-8:
                new = self.value(m + part * step, sharpness)
                if new <= value + 0.1 * part * drop:
                    break
                part *= 0.5
            else:
                break
            m, value = m + part * step, new
        return m

    def _newton(self, m: Floats, sharpness: float) -> tuple[Floats, Floats]:
        """Gradient (n,) and lower bands of a positive definite matrix (3, n)."""
        linear, jerk, w = self.slacks(m)
        near = self._near(m)
        k = np.einsum("nc,nc->n", self.change, near)
        root = np.sqrt(w)
        tilt = root[:, :, None] * self.change[:, None] + (
            0.5 * k[:, None, None] / root[:, :, None] * self.ends[:, 2:]
        )
        at = np.einsum("nkc,nc->nk", self.gauss, near)
        h = self.widths[1:-1, None]
        rows = np.concatenate((self.rows, tilt, -tilt, self.gauss), axis=1)
        push = sharpness * 0.25 * h * at**-1.5
        first = np.concatenate((1.0 / linear, 1.0 / jerk, -push), axis=1)
        second = np.concatenate((linear**-2.0, jerk**-2.0, 1.5 * push / at), axis=1)
        slope = np.einsum("nkc,nk->nc", rows, first)
        local = np.einsum("nkc,nk,nkd->ncd", rows, second, rows, optimize=True)
        for inner, at_end, outer in ((0, 2, 0), (-1, 4, -1)):
            share = self.ends[inner, at_end, 1]
            rest = 3.0 * sharpness * self.widths[outer] / np.sqrt(share)
            slope[inner, 1] -= 0.5 * rest * m[inner] ** -1.5
            local[inner, 1, 1] += 0.75 * rest * m[inner] ** -2.5
        gradient = slope[:, 1].copy()
        gradient[:-1] += slope[1:, 0]
        gradient[1:] += slope[:-1, 2]
        bands = np.zeros((3, m.size))
        bands[0] = local[:, 1, 1]
        bands[0, :-1] += local[1:, 0, 0]
        bands[0, 1:] += local[:-1, 2, 2]
        bands[1, :-1] = local[1:, 0, 1] + local[:-1, 1, 2]
        bands[2, :-2] = local[1:-1, 0, 2]
        bands[0] += 1e-14 * bands[0].max()
        return gradient, bands

    def motion(self, m: Floats) -> Motion:
        """The motion with these coefficients."""
        near = self._near(m)
        values = np.einsum("nzc,nc->nz", self.ends, near)
        squares = np.concatenate(([0.0], values[:, 2], values[-1:, 4], [0.0]))
        speeds = np.sqrt(squares)
        changes = np.concatenate(([0.0], np.einsum("nc,nc->n", self.change, near), [0.0]))
        last = -values[-1, 4] / (1.5 * self.widths[-1])
        accelerations = np.concatenate(([0.0], values[:, 0], [last]))
        jerks = np.zeros(changes.size)
        for k, speed in ((0, speeds[1]), (-1, speeds[-2])):
            jerks[k] = 2.0 * speed**3 / (9.0 * self.widths[k] ** 2)
        return Motion(speeds, accelerations, changes, jerks)
