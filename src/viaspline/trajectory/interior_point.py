"""The problem of the fastest v² with a limit of the jerk, as Newton's method takes it.

All is in terms of the middle Bernstein coefficients of w = v² on the stretches: a stretch knows its
own, the one before it and the one after it.

Tested through ``trajectory/test_jerk``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.timing.speed_barrier import (
    BarrierTerms,
    barrier_least,
    barrier_limit,
    barrier_value,
    motion_time,
)

DUALITY_GAP = 1e-4
"""What the barrier keeps of the time, at most, as a part of it."""

FIRST_SHARPNESS, BARRIER_GROWTH = 2.0, 12.0
MAX_NEWTON_STEPS = 60

LOOSER, NEARER = 40, 8
"""Rounds in which a motion that keeps every limit is sought, and Newton's steps in each."""

INTERIOR_SHARE = 0.998
"""Part of the limits that is planned with."""

_GAUSS = (0.21132486540518713, 0.7886751345948129)


class Rest(NamedTuple):
    """The motion begins or ends at rest, with a stretch of constant jerk beside it."""


class Moving(NamedTuple):
    """The motion begins at a speed.

    Attributes:
        square: v² [m²/s²], above 0.
        accel: [m/s²].
    """

    square: float
    accel: float


class Even(NamedTuple):
    """The motion ends at any speed, without acceleration."""


class Seam(NamedTuple):
    """The motion goes on at its start where it ends."""


@dataclass(frozen=True)
class Rows:
    """Limits p · (a0, a1, w0, m, w1) <= g of each stretch: its ends and its middle coefficient.

    Attributes:
        weights: Shape (n, k, 5).
        limits: Shape (n, k), above 0.
    """

    weights: Floats
    limits: Floats

    def spared(self) -> Rows:
        """The rows with a little less, so that a robot that is re-planned under way has room."""
        return Rows(self.weights, self.limits * INTERIOR_SHARE)


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
        ends = _joined_ends(widths, h, start, end)
        near = np.stack((np.arange(-1, n - 1), np.arange(n), np.arange(1, n + 1)), axis=1)
        near[0, 0], near[-1, 2] = (n - 1, 0) if isinstance(start, Seam) else (n, n + 1)
        linear, limits, first = _joined_rows(widths, rows, jerk, ends, start, end, inner)
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
        places, bands = _places(near, order)
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

        Limits that are not kept are widened so that they are; from the middle of what that allows
        they are narrowed again, as far as they are kept there.

        Returns:
            The problem, with limits that are widened where they have to be, and m.
        """
        scale = _sizes(self.limits)
        wide, best, least, lost = self, (self, m), np.inf, 0
        for k in range(LOOSER):
            off = self.lacks(m)
            if off == 0.0 and self.value(m, 1.0) < np.inf:
                return self, m
            wide = wide.narrowed(self, m, scale, *((0.3, 1e-6) if k else (0.0, 0.05)))
            lost = 0 if off < 0.9 * least else lost + 1
            if off < least:
                best, least = (wide, m), off
            if lost > 8:
                break
            m = wide.centred(m, 2e-3 * self.asked / self.time(m), NEARER)
        return best

    def lacks(self, m: Floats) -> float:
        """By what parts of them limits are not kept, in all."""
        linear, jerk, _ = self.slacks(m)
        off = float(np.maximum(-linear / _sizes(self.limits), 0.0).sum())
        return off + 0.01 * float(np.maximum(-jerk / self.jerk[:, None], 0.0).sum())

    def narrowed(
        self, true: SpeedProblem, m: Floats, scale: Floats, share: float, least: float
    ) -> SpeedProblem:
        """The problem with limits nearer to the true ones, that are still kept."""
        linear, jerk, _ = self.slacks(m)
        used, spent = self.limits - linear, self.jerk - jerk.min(axis=1)
        room = np.maximum(share * linear, least * scale)
        rate = np.maximum(share * (self.jerk - spent), least * true.jerk)
        return replace(
            self,
            limits=np.maximum(true.limits, used + room),
            jerk=np.maximum(true.jerk, spent + rate),
        )

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

    @property
    def asked(self) -> int:
        """How many limits there are: two of the jerk at three places of each stretch, and rows."""
        return 6 * self.widths.size + self.limits.size

    def value(self, m: Floats, sharpness: float) -> float:
        """What the barrier makes least; inf where a limit isn't kept strictly."""
        return float(barrier_value(self.terms, m, sharpness))

    def centred(self, m: Floats, sharpness: float, rounds: int) -> Floats:
        """The least of the barrier function from m on, by Newton's method."""
        return np.asarray(barrier_least(self.terms, m, sharpness, rounds))

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


def _joined_ends(
    widths: Floats, h: Floats, start: Rest | Moving | Seam, end: Rest | Even | Seam
) -> Floats:
    """a0, a1, w0, m, w1 of stretches by the coefficients they know, shape (n, 5, 3)."""
    ends = np.zeros((h.size, 5, 3))
    ends[:, 3, 1] = 1.0
    both = h[:-1] + h[1:]
    ends[1:, 0, 0], ends[1:, 0, 1] = -1.0 / both, 1.0 / both
    ends[1:, 2, 0], ends[1:, 2, 1] = h[1:] / both, h[:-1] / both
    ends[:-1, 1, 1:], ends[:-1, 4, 1:] = ends[1:, 0, :2], ends[1:, 2, :2]
    if isinstance(start, Rest):
        rest = 1.5 * widths[0]
        ends[0, 0, 1], ends[0, 2, 1] = 1.0 / (rest + h[0]), rest / (rest + h[0])
    else:
        before = widths[0] if isinstance(start, Moving) else h[-1]
        whole = before + h[0]
        ends[0, 0, :2] = -1.0 / whole, 1.0 / whole
        ends[0, 2, :2] = h[0] / whole, before / whole
    if isinstance(end, Rest):
        rest = 1.5 * widths[-1]
        ends[-1, 1, 1], ends[-1, 4, 1] = -1.0 / (rest + h[-1]), rest / (rest + h[-1])
    elif isinstance(end, Even):
        ends[-1, 4, 1] = 1.0
    else:
        ends[-1, 1, 1:], ends[-1, 4, 1:] = ends[0, 0, :2], ends[0, 2, :2]
    return ends


def _joined_rows(
    widths: Floats, rows: Rows, jerk: float, ends: Floats, start: Rest | Moving | Seam,
    end: Rest | Even | Seam, inner: slice,
) -> tuple[Floats, Floats, Ints]:  # fmt: skip
    """All rows that ask for something, with right-hand sides, and where each stretch's begin."""
    inside = np.einsum("nkz,nzc->nkc", rows.weights[inner], ends)
    more, bound = _outer_rows(widths, rows, jerk, ends, start, end)
    limits = np.concatenate((rows.limits[inner], bound), axis=1)
    asks = limits < np.inf
    first = np.concatenate(([0], np.cumsum(asks.sum(axis=1))))
    return np.concatenate((inside, more), axis=1)[asks], limits[asks], first


def _outer_rows(
    widths: Floats, rows: Rows, jerk: float, ends: Floats, start: Rest | Moving | Seam,
    end: Rest | Even | Seam,
) -> tuple[Floats, Floats]:  # fmt: skip
    """What the stretches beside the ends ask of their neighbours, with right-hand sides."""
    n, many = ends.shape[0], rows.limits.shape[1]
    more = np.zeros((n, 3 + 2 * many, 3))
    bound = np.full(more.shape[:2], np.inf)
    more[:, 0, 1], bound[:, 0] = -1.0, 0.0
    beside = [(0, 0, 0)] if isinstance(start, Rest) else []
    beside += [(-1, -1, 1)] if isinstance(end, Rest) else []
    for inner, outer, at in beside:
        k = slice(3 + at * many, 3 + (at + 1) * many)
        moving = np.zeros((5, 3))
        moving[1 - at], moving[2 if at else 4] = ends[inner, at], ends[inner, 4 if at else 2]
        more[inner, k], bound[inner, k] = rows.weights[outer] @ moving, rows.limits[outer]
        more[inner, 1] = ends[inner, 4 if at else 2]
        bound[inner, 1] = (4.5 * widths[outer] ** 2 * jerk) ** (2.0 / 3.0)
    if isinstance(start, Moving):
        k, first = slice(3, 3 + many), widths[0]
        moving = np.zeros((5, 3))
        moving[1], moving[4] = ends[0, 0], ends[0, 2]
        middle = start.square + start.accel * first
        given = rows.weights[0] @ np.array([start.accel, 0.0, start.square, middle, 0.0])
        free = np.any(rows.weights[0][:, [1, 4]] != 0.0, axis=1)
        more[0, k] = rows.weights[0] @ moving
        bound[0, k] = np.where(free, rows.limits[0] - given, np.inf)
        rise = start.accel + 1.5 * jerk * first / np.sqrt(start.square)  # no stretch reaches it
        room = jerk * first / np.sqrt(max(start.square, middle, middle + rise * first))
        more[0, 1], bound[0, 1] = ends[0, 0], room + start.accel
        more[0, 2], bound[0, 2] = -ends[0, 0], room - start.accel
    return more, bound


def _places(near: Ints, order: Ints) -> tuple[Ints, int]:
    """Where the products of two coefficients go in the lower bands; the last place is for none."""
    n = order.size
    place = np.append(order, (-1, -1))[near]
    row, column = place[:, :, None], place[:, None, :]
    apart = row - column
    valid = (row >= 0) & (column >= 0) & (apart >= 0)
    bands = int(apart[valid].max()) + 1
    return np.where(valid, apart * n + column, bands * n), bands
