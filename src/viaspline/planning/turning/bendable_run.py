"""The runs of a path that may be bent each by itself: between what stays as it is.

Tested through ``planning/methods/test_bent_gently``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Flags, Floats, Ints

_Row = TypeVar("_Row", bound=np.generic)

JUMP_RAD = 1e-6  # of a heading between spans, that is one


@dataclass(frozen=True, eq=False)
class LaidRun:
    """A run of a path, as it is laid.

    Attributes:
        spans: Bézier control polygons [m], (m, 4, 2).
        joints: The span that begins at each via point, its start among them; m at its end, (n,).
        detours: The spans that begin at its detour via points, (k,).
    """

    spans: Floats
    joints: Ints
    detours: Ints


@dataclass(frozen=True, eq=False)
class BendableRun:
    """A run of a path, and what bounds it.

    Attributes:
        laid: It as it is.
        stands: Whether the robot stands still at each of its joints, (n,).
        ends: Directions in which it begins and ends, unit vectors where another run goes on there
            or a heading is given, nan where it is free, (2, 2).
        closed: Whether it is a round.
        stays: Whether it is to stay as it is.
    """

    laid: LaidRun
    stands: Flags
    ends: Floats
    closed: bool = False
    stays: bool = False

    @cached_property
    def length(self) -> float:
        """[m]."""
        return PiecewiseCubic(self.laid.spans).length


@dataclass(frozen=True, eq=False)
class RunsOfPath:
    """A path in runs.

    Attributes:
        runs: In order; those of a round from the first place on at which it may be parted.
        vias: The run and the joint of it at which each via point lies, (n, 2); the start of a round
            is its end as well.
        closed: Whether it is a round.
    """

    runs: tuple[BendableRun, ...]
    vias: Ints
    closed: bool

    @classmethod
    def of(
        cls, laid: LaidRun, stays: Flags, stands: Flags, given: tuple[bool, bool], closed: bool
    ) -> RunsOfPath:  # fmt: skip
        """The runs of a path, parted where its heading jumps and where what stays begins and ends.

        Args:
            laid: All of it.
            stays: Which spans stay as they are, (m,).
            stands: Whether the robot stands still at each via point, (n,).
            given: Whether there is a heading at its start and at its end that has to stay.
            closed: Whether it is a round, which goes on at its end without a bend.
        """
        count = len(laid.spans)
        parted = (stays != _from(stays, -1)) | _jumps(laid.spans)
        if closed and not parted.any():
            run = BendableRun(laid, stands, np.full((2, 2), np.nan), closed=True)
            at = np.arange(len(laid.joints) - 1)
            return cls((run,), np.column_stack((0 * at, at)), closed)
        first = int(np.flatnonzero(parted)[0]) if closed else 0
        begins = np.union1d(np.flatnonzero(_from(parted, first)), [0, count])
        spans = np.ascontiguousarray(_from(laid.spans, first))
        kept, detours = _from(stays, first), (laid.detours - first) % count
        wanted = (laid.joints[:-1] - first) % count if closed else laid.joints
        run_of = np.minimum(np.searchsorted(begins, wanted, side="right") - 1, len(begins) - 2)
        runs, where = [], np.column_stack((run_of, run_of))
        for k, (a, b) in enumerate(pairwise(begins.tolist())):
            joints = np.union1d([0, b - a], wanted[run_of == k] - a)
            where[run_of == k, 1] = np.searchsorted(joints, wanted[run_of == k] - a)
            halts: Flags = np.zeros(len(joints), np.bool_)
            halts[where[run_of == k, 1]] = stands[: len(wanted)][run_of == k]
            own = detours[(detours >= a) & (detours < b)] - a
            ends = _ends(spans[a:b])
            if not closed and a == 0 and not given[0]:
                ends[0] = np.nan
            if not closed and b == count and not given[1]:
                ends[1] = np.nan
            runs.append(
                BendableRun(LaidRun(spans[a:b], joints, own), halts, ends, stays=bool(kept[a]))
            )  # fmt: skip
        return cls(tuple(runs), where, closed)

    def joined(self, parts: Sequence[LaidRun]) -> LaidRun:
        """The path with its runs laid in another way."""
        spans = np.concatenate([part.spans for part in parts])
        begins = np.cumsum([0, *(len(part.spans) for part in parts)])
        joints = np.array([begins[run] + parts[run].joints[at] for run, at in self.vias.tolist()])
        detours = np.concatenate(
            [begin + part.detours for begin, part in zip(begins, parts, strict=False)]
        )
        if not self.closed:
            return LaidRun(spans, joints, detours)
        first, count = int(joints[0]), len(spans)
        around = np.append((joints - first) % count, count)
        return LaidRun(_from(spans, first), around, np.sort((detours - first) % count))


def _from(rows: NDArray[_Row], first: int) -> NDArray[_Row]:
    """Rows round from one of them on, (n, ...): ``np.roll`` takes ten times as long."""
    return rows if first == 0 else np.concatenate((rows[first:], rows[:first]))


def _ends(spans: Floats) -> Floats:
    """The directions in which spans begin and end, (2, 2)."""
    ways = np.stack((spans[0, 1] - spans[0, 0], spans[-1, 3] - spans[-1, 2]))
    found: Floats = ways / np.hypot(*ways.T)[:, None]
    return found


def _jumps(spans: Floats) -> Flags:
    """Where the heading jumps from the span before, that before the first the last, (m,)."""
    along, before = spans[:, 1] - spans[:, 0], _from(spans[:, 3] - spans[:, 2], -1)
    across = before[:, 0] * along[:, 1] - before[:, 1] * along[:, 0]
    found: Flags = np.abs(np.arctan2(across, (before * along).sum(axis=1))) > JUMP_RAD
    return found
