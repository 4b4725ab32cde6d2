"""A round that is looked at from elsewhere: what is its seam is a joint like any other then.

Where a path ends its direction has to stay, for a round goes on there as it begins. So there is
less room to step aside beside its start than beside its via points, though it is one of these.

Tested through ``fleet/laying/test_step_aside``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.curve.bending import SMOOTH_JUMP_RAD
from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.marked_joints import FIXED, FREE, KEPT


@dataclass(frozen=True, eq=False)
class TurnedRound:
    """A round that begins at another of its joints.

    Attributes:
        spans: Bézier control polygons, (m, 4, 2).
        marks: Of its joints, (m + 1,): it is to go on where it begins as it did.
        mark: Of the joint at which it begins now, as it was.
        before_seam: How many via points it passes before its own start, which is the next one.
    """

    spans: Floats
    marks: Ints
    mark: int
    before_seam: int

    @classmethod
    def of(cls, path: Path, marks: Ints, discs: Floats) -> TurnedRound | None:
        """A round that begins as far from all discs as it can; None where it has no such joint.

        Args:
            path: It may have a corner where it begins.
            marks: Of its joints: see ``kernels.fleet.sidestep.step_aside``.
            discs: x, y of each, and the distance to keep from there [m], (n, 3).
        """
        first, last = path.spans[0], path.spans[-1]
        ahead, before = first[1] - first[0], last[3] - last[2]
        turned = math.atan2(ahead[1] * before[0] - ahead[0] * before[1], ahead @ before)
        if len(marks) < 3 or not ahead.any() or abs(turned) > SMOOTH_JUMP_RAD:
            return None
        joints = path.spans[1:, 0]
        away = np.hypot(*(joints[:, None] - discs[:, :2]).T).T - discs[:, 2]
        room = np.where(marks[1:-1] == FREE, away.min(axis=1), -np.inf)
        cut = int(room.argmax()) + 1
        if room[cut - 1] <= 0.0:
            return None
        own = np.concatenate((marks[cut:-1], [KEPT], marks[1 : cut + 1]))
        own[0] = own[-1] = FIXED
        kept = int(_is_kept(own[1 : len(marks) - 1 - cut]).sum())
        return cls(np.roll(path.spans, -cut, axis=0), own, int(marks[cut]), kept)

    def back(self, spans: Floats, marks: Ints) -> tuple[Floats, Ints]:
        """What became of it, from its own start on.

        Args:
            spans: Its spans, (k, 4, 2).
            marks: Of its joints, those that it had among them, (k + 1,).
        """
        seam = 1 + int(np.flatnonzero(_is_kept(marks[1:]))[self.before_seam])
        own = np.concatenate(([FIXED], marks[seam + 1 : -1], [self.mark], marks[1:seam], [FIXED]))
        return np.roll(spans, -seam, axis=0), own


def _is_kept(marks: Ints) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """Whether a path has to run through each of some joints."""
    return np.asarray((marks == KEPT) | (marks == FIXED))
