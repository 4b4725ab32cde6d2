"""The runs of a path that may be bent each by itself: between what stays as it is.

Tested through ``planning/methods/test_bent_gently``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Flags, Floats, Ints

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

    def part(self, begin: int, end: int, joints: Sequence[int]) -> LaidRun:
        """From one of its spans to before another, at these joints of all its spans."""
        is_within = (self.detours >= begin) & (self.detours < end)
        return LaidRun(
            self.spans[begin:end], np.array(joints) - begin, self.detours[is_within] - begin
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class BendableRun:
    """A run of a path, and what bounds it.

    Attributes:
        laid: It as it is.
        stands: Whether the robot stands still at each of its joints, (n,).
        ends: Directions in which it begins and ends, unit vectors where another run goes on there
            or a heading is given, nan where it is free, (2, 2).
        stays: Whether it is to stay as it is.
    """

    laid: LaidRun
    stands: Flags
    ends: Floats
    stays: bool = False

    @cached_property
    def length(self) -> float:
        """[m]."""
        return PiecewiseCubic(self.laid.spans).length


@dataclass(frozen=True, eq=False)
class RunsOfPath:
    """A path in runs.

    Attributes:
        runs: In order.
        vias: The run and the joint of it at which each via point lies.
    """

    runs: tuple[BendableRun, ...]
    vias: tuple[tuple[int, int], ...]

    @classmethod
    def of(
        cls, laid: LaidRun, stays: Flags, stands: Flags, given: tuple[bool, bool]
    ) -> RunsOfPath:  # fmt: skip
        """The runs of a path, parted where its heading jumps and where what stays begins and ends.

        Args:
            laid: All of it.
            stays: Which spans stay as they are, (m,).
            stands: Whether the robot stands still at each via point, (n,).
            given: Whether there is a heading at its start and at its end that has to stay.
        """
        parted = (stays[1:] != stays[:-1]) | _jumps(laid.spans)
        begins = [0, *(np.flatnonzero(parted) + 1).tolist(), len(laid.spans)]
        at_vias = dict(zip(laid.joints.tolist(), stands.tolist(), strict=True))
        runs, vias = [], []
        for k, (a, b) in enumerate(pairwise(begins)):
            is_last = b == begins[-1]
            joints = [a, *(joint for joint in at_vias if a < joint < b), b]
            mine = joints if is_last else joints[:-1]  # the next one begins at its end
            vias += [(k, i) for i, joint in enumerate(mine) if joint in at_vias]
            ends = _ends(laid.spans[a:b])
            if a == 0 and not given[0]:
                ends[0] = np.nan
            if is_last and not given[1]:
                ends[1] = np.nan
            halts = np.array([at_vias.get(joint, False) for joint in joints])
            runs.append(BendableRun(laid.part(a, b, joints), halts, ends, bool(stays[a])))
        return cls(tuple(runs), tuple(vias))

    def joined(self, parts: Sequence[LaidRun]) -> LaidRun:
        """The path with its runs laid in another way."""
        begins = np.cumsum([0, *(len(part.spans) for part in parts)])
        joints = np.array([begins[run] + parts[run].joints[at] for run, at in self.vias])
        detours = [begin + part.detours for begin, part in zip(begins, parts, strict=False)]
        return LaidRun(
            np.concatenate([part.spans for part in parts]), joints, np.concatenate(detours)
        )  # fmt: skip


def _ends(spans: Floats) -> Floats:
    """The directions in which spans begin and end, (2, 2)."""
    ways = np.stack((spans[0, 1] - spans[0, 0], spans[-1, 3] - spans[-1, 2]))
    found: Floats = ways / np.hypot(*ways.T)[:, None]
    return found


def _jumps(spans: Floats) -> Flags:
    """Where the heading jumps from the span before, for all but the first, (m - 1,)."""
    along, before = spans[1:, 1] - spans[1:, 0], spans[:-1, 3] - spans[:-1, 2]
    across = before[:, 0] * along[:, 1] - before[:, 1] * along[:, 0]
    found: Flags = np.abs(np.arctan2(across, (before * along).sum(axis=1))) > JUMP_RAD
    return found
