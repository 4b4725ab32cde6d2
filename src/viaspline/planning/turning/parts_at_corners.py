"""A path in parts, each from a corner to the next: laid each by itself, and put together again.

Tested through ``planning/methods/test_corners_at_stations``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.cleared_spline import ClearedSpline
from viaspline.planning.alternatives.homotopy_classes import TautRow
from viaspline.planning.problem.spline_path import (
    SAME_HEADING_RAD,
    SplinePath,
    heading_jumps,
)
from viaspline.planning.problem.via_sequence import lay
from viaspline.planning.turning.driven_problem import DrivenProblem


@dataclass(frozen=True)
class PartsAtCorners:
    """A path that is asked for, cut where it may have corners.

    Attributes:
        whole: The path.
        corners: Via points at which it is cut, in order; no ends of a path that is open.
    """

    whole: DrivenProblem
    corners: tuple[int, ...]

    @classmethod
    def of(cls, whole: DrivenProblem, laid: SplinePath) -> PartsAtCorners:
        """A path that was laid, cut where it has corners at via points.

        Args:
            whole: What was asked for.
            laid: The path.
        """
        vias = np.arange(0 if whole.sequence.closed else 1, len(laid.joints) - 1)
        turns = np.abs(laid.jumps_at(vias.tolist()))
        return cls(whole, tuple(vias[turns > SAME_HEADING_RAD].tolist()))

    @cached_property
    def ends(self) -> tuple[tuple[int, int], ...]:
        """The via points with which each part begins and ends, of a round counted on."""
        last = len(self.whole.sequence.vias) - 1
        if not self.whole.sequence.closed:
            return tuple(pairwise((0, *self.corners, last)))
        return tuple(pairwise((*self.corners, self.corners[0] + last + 1)))

    @cached_property
    def problems(self) -> tuple[DrivenProblem, ...]:
        """The problem of each part."""
        return tuple(self.problem(part) for part in range(len(self.ends)))

    def place(self, leg: int) -> tuple[int, int]:
        """The part in which a leg lies, and its place in that."""
        count = len(self.whole.sequence.legs)
        for part, (first, last) in enumerate(self.ends):
            if (leg - first) % count < last - first:
                return part, (leg - first) % count
        raise AssertionError("every leg lies in a part")

    def joined(self, laid: Sequence[SplinePath]) -> SplinePath:
        """The path whose parts were laid, (k,)."""
        sequence = self.whole.sequence
        begins = np.cumsum([0, *(len(part.spans) for part in laid)])
        joints = [begin + part.joints[:-1] for begin, part in zip(begins, laid, strict=False)]
        detours = [begin + _detours(part) for begin, part in zip(begins, laid, strict=False)]
        spans, count = np.concatenate([part.spans for part in laid]), int(begins[-1])
        at_vias, at_detours = np.concatenate(joints), np.concatenate(detours)
        if sequence.closed:  # it begins at the first corner
            seam = int(at_vias[-self.corners[0]]) if self.corners[0] else 0
            spans = np.roll(spans, -seam, axis=0)
            at_vias = np.sort((at_vias - seam) % count)
            at_detours = np.sort((at_detours - seam) % count)
        return SplinePath.through(
            sequence, spans, np.append(at_vias, count), at_detours.tolist()
        )  # fmt: skip

    def turns(self, laid: Sequence[SplinePath]) -> Floats:
        """By how much the parts that were laid turn at each corner [rad], (k,)."""
        before = [*laid[-1:], *laid[:-1]] if self.whole.sequence.closed else laid[:-1]
        after = laid if self.whole.sequence.closed else laid[1:]
        return heading_jumps(
            np.array([part.spans[-1] for part in before]),
            np.array([part.spans[0] for part in after]),
        )

    def problem(self, part: int) -> DrivenProblem:
        """The problem of one part."""
        first, last = self.ends[part]
        whole, count = self.whole, len(self.whole.sequence.legs)
        legs = [k % count for k in range(first, last)]
        row = whole.shortest_row
        found = DrivenProblem(
            whole.sequence.between(first, last),
            whole.world,
            whole.requirements,
            whole.router,
            tuple(whole.overlooked[k] for k in legs) if whole.overlooked else (),
            cleared=self._cleared(part),
        )
        paths = tuple(row.taut_paths[k] for k in legs)
        vars(found)["shortest_row"] = TautRow(paths, tuple(row.closed[k] for k in legs))
        return found

    def _cleared(self, part: int) -> ClearedSpline:
        """The clear spline of a part: its own, where that is clear, else that of the whole."""
        first, last = self.ends[part]
        cleared, count = self.whole.cleared, len(self.whole.sequence.legs)
        legs = [k % count for k in range(first, last)]
        passed = {k: cleared.passed[leg] for k, leg in enumerate(legs) if leg in cleared.passed}
        sides = tuple(cleared.sides[k] for k in legs)
        sequence = self.whole.sequence.between(first, last)
        if not passed:
            own = SplinePath.through(sequence, lay(sequence), sequence.first_spans(), ())
            off = (asked.crossed(own.leg(k)).any() for k, asked in enumerate(sides))
            if self.whole.is_clear(own.spans) and not any(off):
                return ClearedSpline(own, sides)
        return ClearedSpline(self.cut(cleared.spline_path, part), sides, passed)

    def cut(self, laid: SplinePath, part: int) -> SplinePath:
        """One part of a path that was laid."""
        first, last = self.ends[part]
        count, total = len(self.whole.sequence.legs), len(laid.spans)
        begin = int(laid.joints[first])
        ends = [int(laid.joints[k % count]) - begin for k in range(first, last)]
        joints = np.array([*(u % total for u in ends), 0])
        joints[-1] = joints[-2] + len(laid.leg((last - 1) % count))
        spans = np.roll(laid.spans, -begin, axis=0)[: joints[-1]]
        detours = (_detours(laid) - begin) % total
        sequence = self.whole.sequence.between(first, last)
        return SplinePath.through(
            sequence, spans, joints, np.sort(detours[detours < joints[-1]]).tolist()
        )  # fmt: skip


def _detours(laid: SplinePath) -> np.ndarray:
    """The spans of a path that begin at its detour via points, (k,)."""
    at_vias = set(laid.joints.tolist())
    return np.array([int(via.u) for via in laid.vias if via.u not in at_vias], np.int64)
