"""Paths that step aside for discs: bent by just so much, where they come too near.

A step aside has two halves, before and behind the place that is farthest aside: see
``shape_aside``.

Tested through ``fleet/laying/test_step_aside``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.clearance.disc import conflicts
from viaspline.kernels.fleet.marked_joints import copy_path
from viaspline.kernels.fleet.moved_aside import moved_aside
from viaspline.kernels.fleet.shape_aside import TOUCH_M
from viaspline.kernels.fleet.span_geometry import left_of_span, nearest_on_span
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.world.packed import PackedWorld

CLEAR = -1
"""What a span comes too close to, where that is nothing."""
MAX_STEPS_EACH = 3
"""Steps aside for each disc, on average, after which it is given up."""
MAX_WIDENINGS = 24
"""How often a step aside is made wider that isn't wide enough: close to a via point it gains little
by that."""
WIDENED = 1.5
"""By how much of what it lacks it is made wider: it is narrower beside its widest place."""
BESIDE, PAST_OTHERS = 2, 4
"""How many ways a path tries: to either side, and then to either side past others."""
WIDEST = 2.5
"""So far aside a path goes past several discs, at most, in the distance that it has to keep."""
ONE_MORE_M = 100.0
"""What it costs to come too near to another disc, beside being so far aside [m]."""


class MarkedPath(NamedTuple):
    """A path that is changed, in room for more spans.

    Attributes:
        spans: Bézier control polygons [m], (n, 4, 2).
        marks: Of its joints, (n + 1,).
    """

    spans: Floats
    marks: Ints


@inner
def _first_met(
    spans: Floats, begin: int, count: int, discs: Floats
) -> tuple[int, int, float, float, int]:  # fmt: skip
    """The first disc that a path comes too near to, and where it is nearest to that.

    Args:
        spans: Of the path,
        begin: which is clear before this one.
        count: So many there are.
        discs: x, y of each and the distance to keep [m], (n, 3).

    Returns:
        (disc, span, its parameter, distance [m], the first span that comes too near to it); the
        disc is -1 if there is none.
    """
    for k in range(begin, count):
        which, deepest = -1, -TOUCH_M / 2.0
        for i in range(discs.shape[0]):
            apart, _ = nearest_on_span(spans[k], discs[i, 0], discs[i, 1], discs[i, 2])
            if apart - discs[i, 2] < deepest:
                which, deepest = i, apart - discs[i, 2]
        if which >= 0:
            x, y, needed = discs[which]
            best, at_k, at_w = math.inf, k, 0.0
            for j in range(k, count):
                apart, w = nearest_on_span(spans[j], x, y, needed)
                if apart >= needed:
                    break
                if apart < best:
                    best, at_k, at_w = apart, j, w
            return which, at_k, at_w, best, k
    return -1, 0, 0.0, 0.0, count


@inner
def _least_apart(spans: Floats, first: int, last: int, disc: Floats) -> float:
    """The least distance of a disc's middle from some spans; infinite where all are far [m]."""
    least = math.inf
    for k in range(first, last):
        least = min(least, nearest_on_span(spans[k], disc[0], disc[1], disc[2])[0])
    return least


@inner
def _room_for(spans: int) -> MarkedPath:
    """A path of so many spans at most, to be filled."""
    return MarkedPath(np.empty((spans, 4, 2)), np.zeros(spans + 1, np.int64))


@inner
def _count_met(spans: Floats, first: int, last: int, discs: Floats) -> int:
    """How many discs some spans come too near to."""
    met = 0
    for i in range(discs.shape[0]):
        if _least_apart(spans, first, last, discs[i]) < discs[i, 2]:
            met += 1
    return met


@inner
def _tried(
    path: MarkedPath, count: int, k: int, w: float, wide: float, needed: float, bend: float,
    trial: MarkedPath,
) -> tuple[int, int, int]:  # fmt: skip
    """Move a copy of a path aside as far as is said, for a disc that needs so much [m]."""
    copy_path(path.spans, path.marks, count, trial.spans, trial.marks)
    shortest = math.sqrt(12.0 * abs(wide) * needed)
    return moved_aside(trial.spans, trial.marks, count, k, w, wide, shortest, bend)


@inner
def _wide_enough(
    path: MarkedPath, count: int, k: int, w: float, wide: float, disc: Floats, bend: float,
    trial: MarkedPath,
) -> tuple[int, int, int, float]:  # fmt: skip
    """Step aside for one disc, ever wider until it is far enough.

    Args:
        path: As it is,
        count: and so many spans it has.
        k: The span that is nearest to the disc,
        w: and where on it.
        wide: How far aside at first, to the left [m].
        disc: x, y and the distance to keep [m].
        bend: See ``step_aside``.
        trial: What comes of it.

    Returns:
        (how many spans there are, the first that is moved, the first behind that isn't, how wide);
        nothing is moved where there is no room.
    """
    for _ in range(MAX_WIDENINGS):
        now, first, last = _tried(path, count, k, w, wide, disc[2], bend, trial)
        if first == last:
            break
        kept = _least_apart(trial.spans, first, last, disc)
        if kept >= disc[2]:
            return now, first, last, wide
        wide += math.copysign(WIDENED * (disc[2] - kept) + TOUCH_M, wide)
    return count, 0, 0, wide


@inner
def _deepest_met(
    spans: Floats, first: int, last: int, discs: Floats
) -> tuple[int, int, float, float]:  # fmt: skip
    """The disc that some spans come farthest into, and where: see ``_first_met``."""
    which, at_k, at_w, met, deepest = -1, 0, 0.0, 0.0, -TOUCH_M / 2.0
    for i in range(discs.shape[0]):
        for k in range(first, last):
            apart, w = nearest_on_span(spans[k], discs[i, 0], discs[i, 1], discs[i, 2])
            if apart - discs[i, 2] < deepest:
                which, at_k, at_w, met, deepest = i, k, w, apart, apart - discs[i, 2]
    return which, at_k, at_w, met


@inner
def _past_all(
    path: MarkedPath, count: int, k: int, w: float, wide: float, discs: Floats, which: int,
    bend: float, trial: MarkedPath,
) -> tuple[int, int, int, float]:  # fmt: skip
    """Step aside for one disc and past all others that are met then, on their far side.

    Args:
        path: As it is,
        count: and so many spans it has.
        k: The span that is nearest to the disc,
        w: and where on it.
        wide: How far aside at first, to the left [m].
        discs: x, y of each and the distance to keep [m], (n, 3).
        which: The first of them that is stepped aside for.
        bend: See ``step_aside``.
        trial: What comes of it.

    Returns:
        As ``_wide_enough``.
    """
    outward = math.copysign(1.0, wide)
    for _ in range(MAX_WIDENINGS):
        now, first, last = _tried(path, count, k, w, wide, discs[which, 2], bend, trial)
        if first == last:
            break
        other, at_k, at_w, apart = _deepest_met(trial.spans, first, last, discs)
        if other < 0:
            return now, first, last, wide
        x, y, needed = discs[other]
        is_beyond = outward * left_of_span(trial.spans[at_k], at_w, x, y) > 0.0
        wide += outward * ((needed + apart) if is_beyond else WIDENED * (needed - apart) + TOUCH_M)
        if abs(wide) > WIDEST * discs[which, 2]:
            break
    return count, 0, 0, wide


@inner
def _one_step(
    world: PackedWorld, path: MarkedPath, count: int, discs: Floats,
    met: tuple[int, int, float, float, int], required: float, bend: float, attempts: int,
    trial: MarkedPath, best: MarkedPath,
) -> tuple[int, int]:  # fmt: skip
    """Step aside for a disc that is met, in the way that comes near to the fewest others.

    Args:
        world: What stands.
        path: As it is,
        count: and so many spans it has.
        discs: x, y of each and the distance to keep [m], (n, 3).
        met: The disc and where: see ``_first_met``.
        required: Distance to keep from what stands [m].
        bend: See ``step_aside``.
        attempts: ``BESIDE`` or ``PAST_OTHERS``.
        trial: Room for what is tried.
        best: What comes of it.

    Returns:
        (how many spans there are then, the first that is moved); no spans where there is no room.
    """
    which, k, w, apart, _ = met
    x, y, needed = discs[which]
    sign = 1.0 if left_of_span(path.spans[k], w, x, y) >= 0.0 else -1.0
    best_count, best_first, least = 0, 0, math.inf
    for attempt in range(attempts):
        if attempt == BESIDE and least < ONE_MORE_M:
            break
        # first away from the disc, then across it
        wide = -sign * (needed - apart) if attempt % 2 == 0 else sign * (needed + apart)
        if attempt < BESIDE:
            now, first, last, wide = _wide_enough(
                path, count, k, w, wide, discs[which], bend, trial
            )  # fmt: skip
        else:
            now, first, last, wide = _past_all(path, count, k, w, wide, discs, which, bend, trial)
        if first == last:
            continue
        if (conflicts(world, trial.spans[first:last], required)[0] != CLEAR).any():
            continue
        price = abs(wide) + ONE_MORE_M * _count_met(trial.spans, first, last, discs)
        if price < least:
            least, best_count, best_first = price, now, first
            copy_path(trial.spans, trial.marks, now, best.spans, best.marks)
    return best_count, best_first


@kernel
def step_aside(
    world: PackedWorld, spans: Floats, marks: Ints, discs: Floats, required: float, bend: float
) -> tuple[Floats, Ints, int]:
    """A path that steps aside for every disc that it comes too near to, one after the other.

    It goes to the side on which it comes near to no other disc, else to the nearer one. Where that
    leads nowhere all is begun anew, and it goes past others as well where they are on both sides.

    Args:
        world: What stands: nowhere does it step nearer than is required to that.
        spans: Bézier control polygons of a planar path [m], (m, 4, 2).
        marks: Of its joints, (m + 1,): ``KEPT`` where it has to run through, ``FIXED`` where in
            this direction as well; at both ends one of these; else ``FREE`` or ``ASIDE``.
        discs: x, y of each, and the distance that the path has to keep from there [m], (n, 3).
        required: Distance that it has to keep from what stands [m].
        bend: The curvature that a step aside has where it can be so long [1/m].

    Returns:
        (spans, marks, the disc for which there is no room to step aside): the last is -1 where the
        path is clear of all discs, as closely as it was looked. Marks of joints where the path is
        farthest aside are ``ASIDE``.
    """
    most = MAX_STEPS_EACH * discs.shape[0] + 1
    room = spans.shape[0] + 7 * most + 14
    path, trial, best = _room_for(room), _room_for(room), _room_for(room)
    count, which = spans.shape[0], -1
    for attempts in (BESIDE, PAST_OTHERS):
        count, begin = spans.shape[0], 0
        copy_path(spans, marks, count, path.spans, path.marks)
        for _ in range(most + 1):
            met = _first_met(path.spans, begin, count, discs)
            which = met[0]
            if which < 0:
                break
            now, moved = _one_step(
                world, path, count, discs, met, required, bend, attempts, trial, best
            )  # fmt: skip
            if now == 0:
                break
            count, begin = now, min(moved, met[4])
            copy_path(best.spans, best.marks, count, path.spans, path.marks)
        if which < 0:
            break
    return path.spans[:count].copy(), path.marks[: count + 1].copy(), which
