"""Paths that step aside for discs: bent by just so much, where they come too near.

A step aside has two halves, before and behind the place that is farthest aside: see
``shape_aside``.

Tested through ``fleet/laying/test_step_aside``.
"""

from __future__ import annotations

import math

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
MAX_WIDENINGS = 8
"""How often a step aside is made wider that isn't wide enough."""
WIDENED = 1.5
"""By how much of what it lacks it is made wider: it is narrower beside its widest place."""
ONE_MORE_M = 100.0
"""What it costs to come too near to another disc, beside being so far aside [m]."""


@inner
def _first_met(spans: Floats, count: int, discs: Floats) -> tuple[int, int, float, float]:
    """The first disc that a path comes too near to, and where it is nearest to that.

    Returns:
        (disc, span, its parameter, distance [m]); the disc is -1 if there is none.
    """
    for k in range(count):
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
            return which, at_k, at_w, best
    return -1, 0, 0.0, 0.0


@inner
def _least_apart(spans: Floats, first: int, last: int, disc: Floats) -> float:
    """The least distance of a disc's middle from some spans; infinite where all are far [m]."""
    least = math.inf
    for k in range(first, last):
        least = min(least, nearest_on_span(spans[k], disc[0], disc[1], disc[2])[0])
    return least


@kernel
def step_aside(
    world: PackedWorld, spans: Floats, marks: Ints, discs: Floats, required: float, bend: float
) -> tuple[Floats, Ints, int]:
    """A path that steps aside for every disc that it comes too near to, one after the other.

    It goes to the side on which it comes near to no other disc, else to the nearer one.

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
    path, path_marks = np.empty((room, 4, 2)), np.zeros(room + 1, np.int64)
    trial, trial_marks = np.empty((room, 4, 2)), np.zeros(room + 1, np.int64)
    best, best_marks = np.empty((room, 4, 2)), np.zeros(room + 1, np.int64)
    count = spans.shape[0]
    copy_path(spans, marks, count, path, path_marks)
    which = -1
    for _ in range(most + 1):
        which, k, w, apart = _first_met(path, count, discs)
        if which < 0:
            break
        x, y, needed = discs[which]
        left = left_of_span(path[k], w, x, y)
        sign = 1.0 if left >= 0.0 else -1.0
        best_count, least = 0, math.inf
        for side in range(2):
            # first away from the disc, then across it
            wide = -sign * (needed - apart) if side == 0 else sign * (needed + apart)
            for _ in range(MAX_WIDENINGS):
                copy_path(path, path_marks, count, trial, trial_marks)
                shortest = math.sqrt(12.0 * abs(wide) * needed)
                now, first, last = moved_aside(
                    trial, trial_marks, count, k, w, wide, shortest, bend
                )
                if first == last:
                    break
                kept = _least_apart(trial, first, last, discs[which])
                if kept >= needed:
                    break
                wide += math.copysign(WIDENED * (needed - kept) + TOUCH_M, wide)
            if first == last or _least_apart(trial, first, last, discs[which]) < needed:
                continue
            if (conflicts(world, trial[first:last], required)[0] != CLEAR).any():
                continue
            price = abs(wide)
            for i in range(discs.shape[0]):
                if _least_apart(trial, first, last, discs[i]) < discs[i, 2]:
                    price += ONE_MORE_M
            if price < least:
                least, best_count = price, now
                copy_path(trial, trial_marks, now, best, best_marks)
        if best_count == 0:
            break
        count = best_count
        copy_path(best, best_marks, count, path, path_marks)
    return path[:count].copy(), path_marks[: count + 1].copy(), which
