"""A via sequence as it was laid in the end: its curve and where its via points lie on it.

Tested through ``planning/problem/test_ledger_as_laid``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.path import PathVia, ViaKind
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Flags, Floats
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.presentable.told_in_lines import told_in_lines

SAME_HEADING_RAD = 1e-6
"""A heading that jumps by more has a corner."""


@told_in_lines
@dataclass(frozen=True)
class SplinePath:
    """The curve of a via sequence.

    Attributes:
        spans: Bézier control polygons [m], shape (m, 4, d).
        joints: The span that begins at each via point of the sequence; m at its end, shape (n,), or
            (n + 1,) when it is closed.
        vias: The via points of the sequence and its detours, in order.
    """

    spans: Floats
    joints: NDArray[np.int64]
    vias: tuple[PathVia, ...]

    @classmethod
    def through(
        cls, sequence: ViaSequence, spans: Floats, joints: NDArray[np.int64], detours: Sequence[int]
    ) -> SplinePath:
        """The curve of a sequence with a detour via point where each of some spans begins."""
        vias = [_user_via(sequence, k, int(u)) for k, u in enumerate(joints)]
        taken = set(joints.tolist())
        free = [k for k in detours if k not in taken]
        vias += [
            PathVia("detour", tuple(at), "detour", float(k))
            for k, at in zip(free, spans[free, 0].tolist(), strict=True)
        ]
        return cls(spans, joints, tuple(sorted(vias, key=lambda via: via.u)))

    @property
    def length(self) -> float:
        """[m]."""
        return PiecewiseCubic(self.spans).length

    def leg(self, k: int) -> Floats:
        """The spans of one leg [m], shape (l, 4, d)."""
        return self.spans[self.joints[k] : self.joints[k + 1]]

    def detours(self, k: int) -> Floats:
        """The detour via points of one leg [m], shape (j, d)."""
        first, last = self.joints[k], self.joints[k + 1]
        found = [via.at for via in self.vias if first < via.u < last]
        return np.array(found).reshape(-1, self.spans.shape[2])

    def jumps_at(self, vias: Sequence[int]) -> Floats:
        """By how much the heading jumps at some via points [rad], (k,).

        Args:
            vias: Not the ends of a path that is open.
        """
        begins = self.joints[list(vias)]
        return heading_jumps(self.spans[begins - 1], self.spans[begins])

    def rests(self, sequence: ViaSequence) -> Flags:
        """Where a robot that drives it stands still, of the joints of its spans, (m + 1,)."""
        return sequence.rests(self.joints, len(self.spans))

    def vias_from(self, first: int) -> tuple[PathVia, ...]:
        """The via points if the curve begins with span ``first`` of another one."""
        return tuple(replace(via, u=via.u + first) for via in self.vias)


def heading_jumps(before: Floats, after: Floats) -> Floats:
    """By how much the heading jumps from spans to those behind them [rad], left is positive, (n,).

    Args:
        before: Bézier control polygons [m], (n, 4, d).
        after: The same.
    """
    there, away = before[:, 3] - before[:, 2], after[:, 1] - after[:, 0]
    across = there[:, 0] * away[:, 1] - there[:, 1] * away[:, 0]
    found: Floats = np.arctan2(across, (there * away)[:, :2].sum(axis=1))
    return found


def _user_via(sequence: ViaSequence, k: int, u: int) -> PathVia:
    via = sequence.vias[k % len(sequence.vias)]
    kind: ViaKind = "detour" if via.index is None else "user"
    index = len(sequence.vias) if k == len(sequence.vias) else via.index
    return PathVia(via.name, tuple(via.at.tolist()), kind, float(u), via.dwell, index)
