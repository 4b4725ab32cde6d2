"""The problem of the fastest v² with a limit of the jerk, as Newton's method takes it.

All is in terms of the middle Bernstein coefficients of w = v² on the stretches: a stretch knows its
own, the one before it and the one after it.

Tested through ``trajectory/test_jerk``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.timing.barrier_newton import barrier_limit
from viaspline.kernels.timing.barrier_settling import barrier_lack, barrier_settled
from viaspline.kernels.timing.speed_barrier import BarrierTerms, barrier_value, motion_time
from viaspline.trajectory.joined_rows import joined_ends, joined_rows, places_in_bands
from viaspline.trajectory.motion_ends import Even, Moving, Rest, Rows, Seam

DUALITY_GAP = 1e-4
"""What the barrier keeps of the time, at most, as a part of it."""

FIRST_SHARPNESS, BARRIER_GROWTH = 2.0, 12.0
MAX_NEWTON_STEPS = 60

LOOSER, NEARER = 40, 8
"""Rounds in which a motion that keeps every limit is sought, and Newton's steps in each."""

_GAUSS = (0.21132486540518713, 0.7886751345948129)


@dataclass(frozen=True)
class SpeedProblem:
    """All in terms of the coefficients of a stretch, the one before and the one after it.

    Attributes:
        widths: Of the stretches whose coefficients are sought [m], shape (n,).
        near: Which coefficients a stretch knows, shape (n, 3): n is ``before``, n + 1 none.
        before: The coefficient of the stretch before all of these [m²/s²].
        jerk: On each [m/s³], shape (n,).
        ends: a0, a1, w0, m, w1 of the stretches, shape (n, 5, 3).
        rows: Linear limits, those of each stretch behind each other, shape (r, 3).
        limits: Their right-hand sides, shape (r,).
        first: The first row of every stretch, and how many there are, shape (n + 1,).
        change: da/ds, shape (n, 3).
        gauss: w at two places of every stretch, shape (n, 2, 3).
        rests: Stretches beside a rest: the one that moves next to it, and the weight of its
            coefficient in the time, shape (r, 2).
        order: Place of every coefficient in the banded matrix, shape (n,).
        places: Where the products of what a stretch knows go in its bands, shape (n, 3, 3).
        bands: How many there are.
    """

    widths: Floats
    near: Ints
    before: float
    jerk: Floats
    ends: Floats
    rows: Floats
    limits: Floats
    first: Ints
    change: Floats
    gauss: Floats
    rests: Floats
    order: Ints
    places: Ints
    bands: int

    @classmethod
    def of(
        cls, widths: Floats, rows: Rows, jerk: float, start: Rest | Moving | Seam,
        end: Rest | Even | Seam,
    ) -> SpeedProblem:  # fmt: skip
        """The problem of a motion with this start and this end."""
        inner = slice(
            0 if isinstance(start, Seam) else 1, widths.size - (1 if isinstance(end, Rest) else 0)
        )
        h, n = widths[inner], widths[inner].size
        ends = joined_ends(widths, h, start, end)
        near = np.stack((np.arange(-1, n - 1), np.arange(n), np.arange(1, n + 1)), axis=1)
        near[0, 0], near[-1, 2] = (n - 1, 0) if isinstance(start, Seam) else (n, n + 1)
        linear, limits, first = joined_rows(widths, rows, jerk, ends, start, end, inner)
        x = np.array(_GAUSS)[:, None, None]
        at = (1 - x) ** 2 * ends[:, 2] + 2 * x * (1 - x) * ends[:, 3] + x * x * ends[:, 4]
        rests = []
        if isinstance(start, Rest):
            rests.append((0.0, 3.0 * widths[0] / np.sqrt(ends[0, 2, 1])))
        if isinstance(end, Rest):
            rests.append((n - 1.0, 3.0 * widths[-1] / np.sqrt(ends[-1, 4, 1])))
        order = np.arange(n)
        if isinstance(start, Seam):  # both ends of the line beside each other, and so on
            order = np.where(2 * order < n, 2 * order, 2 * (n - 1 - order) + 1)
        places, bands = places_in_bands(near, order)
        before = start.square + start.accel * widths[0] if isinstance(start, Moving) else 0.0
        return cls(
            h, near, float(before), np.full(n, jerk), ends, linear, limits, first,
            (ends[:, 1] - ends[:, 0]) / h[:, None], np.ascontiguousarray(np.moveaxis(at, 0, 1)),
            np.array(rests).reshape(-1, 2), order, places, bands,
        )  # fmt: skip

    def known(self, m: Floats) -> Floats:
        """The coefficients before, of and after each stretch, shape (n, 3)."""
        return np.asarray(np.append(m, (self.before, 0.0))[self.near])

    def slacks(self, m: Floats) -> tuple[Floats, Floats, Floats]:
        """What is left of the linear limits and of the jerk, and the w that the jerk goes with."""
        known = self.known(m)
        each = known.repeat(np.diff(self.first), axis=0)
        linear = self.limits - np.einsum("rc,rc->r", self.rows, each)
        w = np.einsum("nkc,nc->nk", self.ends[:, 2:], known)
        k = np.einsum("nc,nc->n", self.change, known)
        with np.errstate(invalid="ignore"):
            used = k[:, None] * np.sqrt(w)
        jerk = self.jerk[:, None]
        return linear, np.concatenate((jerk - used, jerk + used), axis=1), w

    def time(self, m: Floats) -> float:
        """How long it takes [s], but for what lies before a start at a speed."""
        return float(motion_time(self.terms, m))

    def crawl(self) -> Floats:
        """So slow that every limit is kept strictly; for motions that don't begin at a speed."""
        m = np.full(self.widths.size, 1.0)
        while not self.value(m, 1.0) < np.inf:
            m *= 0.25
        return 0.25 * m

    def settled(self, m: Floats) -> tuple[SpeedProblem, Floats]:
        """From any m above 0 one that keeps every limit strictly, or as nearly as is found.

        Returns:
            The problem, with limits that are widened where they have to be, and m.
        """
        limits, jerk, found = barrier_settled(self.terms, m, LOOSER, NEARER)
        return replace(self, limits=np.asarray(limits), jerk=np.asarray(jerk)), np.asarray(found)

    def lacks(self, m: Floats) -> float:
        """By what parts of them limits are not kept, in all."""
        return float(barrier_lack(self.terms, m))

    def excess(self, m: Floats, true: SpeedProblem) -> tuple[Floats, Floats]:
        """By what parts linear limits and the jerk of every stretch are beyond true ones, (n,)."""
        linear, jerk, _ = true.slacks(m)
        beyond = np.maximum.reduceat(-linear / _sizes(true.limits), self.first[:-1])
        return beyond, -jerk.min(axis=1) / true.jerk

    def fastest(self, m: Floats) -> Floats:
        """The fastest from one that keeps every limit strictly."""
        return np.asarray(
            barrier_limit(
                self.terms, m, FIRST_SHARPNESS, BARRIER_GROWTH, DUALITY_GAP, MAX_NEWTON_STEPS
            )
        )

    def value(self, m: Floats, sharpness: float) -> float:
        """What the barrier makes least; inf where a limit isn't kept strictly."""
        return float(barrier_value(self.terms, m, sharpness))

    @property
    def terms(self) -> BarrierTerms:
        """As the kernels take it."""
        return BarrierTerms(
            self.widths, self.near, self.before, self.jerk, np.ascontiguousarray(self.ends[:, 2:]),
            self.change, self.rows, self.limits, self.first, self.gauss, self.rests,
            self.places, self.order, self.bands,
        )  # fmt: skip


def _sizes(limits: Floats) -> Floats:
    """What limits are compared with."""
    return np.asarray(np.maximum(np.abs(limits), 1e-6))
