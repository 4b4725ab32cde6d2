"""What the tension of each span does to the spline itself, before anything is led round.

Tested through ``test_advice``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.certificate import PROOF_SLACK_M
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.clearance.disc import STILL, tightest
from viaspline.kernels.curve.measure import length_and_curvature
from viaspline.planning.checking.driving_time import driving_time
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import Leg, ViaSequence, lay
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.world.world import World

CLEARANCE_TOLERANCE_M = 1e-3  # of a clearance [m]
WINDOW_SPANS = 3  # a span and its neighbours, whose time hangs on its tension
SWEEPS = 2  # along the spans, each beside its neighbours as they are by then


@dataclass(frozen=True, eq=False)
class SpanTensions(ComparedByValue):
    """The spline with every span at every tension.

    A span's tension changes that span alone: the curve and its tangents' directions elsewhere
    stay. Only the time depends on its neighbours.

    Attributes:
        sequence: The via points.
        requirements: What a path has to keep.
        tensions: Eq. (7)'s t, shape (n,).
        spans: Bézier control polygons [m], shape (n, m, pieces, 4, d).
        lengths: [m], shape (m, n).
        clearances: Proven distance between the disc in the body and everything known [m], shape
            (m, n); infinite when there is nothing.
        curvatures: Proven peak [1/m], shape (m, n).
        allowed: Where the span keeps its clearance, and is no sharper than the turning circle or
            else the body's own; shape (m, n).
    """

    sequence: ViaSequence
    requirements: Requirements
    tensions: Floats
    spans: Floats
    lengths: Floats
    clearances: Floats
    curvatures: Floats
    allowed: Flags

    @classmethod
    def of(
        cls,
        sequence: ViaSequence,
        world: World,
        requirements: Requirements,
        least_radius: float,
        tensions: Floats,
    ) -> SpanTensions:
        """Lay the spline with each tension, and measure its spans.

        Args:
            sequence: The via points.
            world: What is on the map.
            requirements: What a path has to keep.
            least_radius: That is round enough for the robot [m].
            tensions: Eq. (7)'s t, shape (n,).
        """
        curves = np.array([_laid(sequence, t) for t in tensions.tolist()])
        spans = curves.reshape(
            len(tensions), len(sequence.legs), sequence.pieces, *curves.shape[2:]
        )
        table = np.array([[_measured(span, world, requirements) for span in row] for row in spans])
        lengths, clearances, curvatures = table.transpose(2, 1, 0)
        is_clear = clearances >= requirements.kept - PROOF_SLACK_M
        return cls(
            sequence, requirements, tensions, spans, lengths, clearances, curvatures,
            allowed=is_clear & (curvatures * least_radius <= 1.0),
        )  # fmt: skip

    def nearest(self, tension: Floats | float) -> Ints:
        """The place in ``tensions`` of the one next to each of some."""
        apart = np.abs(self.tensions - np.asarray(tension)[..., None])
        return np.asarray(apart.argmin(axis=-1))

    def fits(self, tension: Floats | float) -> bool:
        """Whether all spans can be driven with a tension, or each with its own, shape (m,)."""
        taken = np.broadcast_to(self.nearest(tension), (len(self.allowed),))
        return bool(self.allowed[np.arange(len(taken)), taken].all())

    def fits_any(self, tension: float) -> bool:
        """Whether any span can be driven with a tension."""
        return bool(self.allowed[:, int(self.nearest(tension))].any())

    def times(self, taken: Ints, span: int) -> Floats:
        """The time over a span and its neighbours, with each tension of that span [s], shape (n,).

        Args:
            taken: Which tension every span has, shape (m,).
            span: Which one is changed.
        """
        count = len(taken)
        near = [span - 1, span, span + 1]
        if self.sequence.closed and count > 2:
            near = [k % count for k in near]
        near = [k for k in near if 0 <= k < count]
        pieces = self.sequence.pieces
        rests = np.zeros(len(near) * pieces + 1, np.bool_)
        for i, k in enumerate(near):
            rests[i * pieces] |= self.sequence.stands(k)
            rests[(i + 1) * pieces] |= self.sequence.stands(k + 1)
        curve = self.spans[taken[near], near]
        times = []
        for one in self.spans[:, span]:
            curve[near.index(span)] = one
            cubics = curve.reshape(-1, *curve.shape[2:])
            times.append(driving_time(cubics, self.requirements.objective.pace, rests))
        return np.array(times)

    def lost(self, taken: Ints) -> Floats:
        """What each tension of a span costs over its fastest [s], the others as taken, (m, n)."""
        times = np.array([self.times(taken, k) for k in range(len(taken))])
        return np.asarray(times - times.min(axis=1, keepdims=True))

    def gentle(self, common: int, spare: float, changed: Flags) -> Ints:
        """Which tension each span has, the gentlest of those that are nearly the fastest, (m,).

        Args:
            common: The tension that all spans begin with.
            spare: Part of a span's time that may be spent on a gentler one.
            changed: Which spans get another, of those that are allowed, shape (m,).
        """
        taken = np.full(len(self.allowed), common)
        for _ in range(SWEEPS):
            for k in np.flatnonzero(changed).tolist():
                times = np.where(self.allowed[k], self.times(taken, k), np.inf)
                fast = times <= (1.0 + spare / WINDOW_SPANS) * times.min()
                peaks = np.where(fast, np.round(self.curvatures[k], 9), np.inf)
                taken[k] = np.lexsort((times, peaks))[0]
        return taken


def _laid(sequence: ViaSequence, tension: float) -> Floats:
    slack = (1.0 - tension) / 2.0
    legs = tuple(Leg(leg.points, np.full_like(leg.slack, slack)) for leg in sequence.legs)
    return lay(replace(sequence, legs=legs))


def _measured(span: Floats, world: World, requirements: Requirements) -> tuple[float, float, float]:
    """Length, proven clearance of the body and peak curvature of a span's cubics."""
    span = np.ascontiguousarray(span)
    lower, upper = tightest(world.packed, span, STILL, CLEARANCE_TOLERANCE_M)[:2]
    length, peak = length_and_curvature(span)
    gap = lower if np.isfinite(lower) else upper
    return float(length), float(gap) - requirements.radius, float(peak)
