"""A path with swerves: spans that are led aside, and back again.

Tested through ``fleet/test_swerved_fleet``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.clearance.disc import conflicts
from viaspline.kernels.fleet.marked_joints import copy_path
from viaspline.kernels.fleet.moved_aside import moved_aside
from viaspline.kernels.fleet.span_geometry import nearest_on_span
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.world.packed import PackedWorld

CLEAR = -1
"""What a span comes too close to, where that is nothing."""
OFF_M = 1.0
"""How far the place of a swerve may be beside the path [m]: it was found on samples of it."""
SHORTEST = 0.5
"""Where there is less room than for this share of its half, there is no swerve."""
MORE_SPANS = 7
"""A swerve cuts a path into so many more spans, at most."""


@inner
def _place_on(spans: Floats, count: int, x: float, y: float) -> tuple[int, float]:
    """The span that is nearest to a place, and where on it; -1 where none is near."""
    best, at_k, at_w = OFF_M, -1, 0.0
    for k in range(count):
        apart, w = nearest_on_span(spans[k], x, y, best)
        if apart < best:
            best, at_k, at_w = apart, k, w
    return at_k, at_w


@kernel
def swerved_path(
    world: PackedWorld, spans: Floats, marks: Ints, swerves: Floats, required: float
) -> tuple[Floats, Ints, Flags]:
    """A path that swerves here and there.

    Args:
        world: What stands: a swerve that comes too near to it isn't made.
        spans: Bézier control polygons of a planar path [m], (m, 4, 2).
        marks: Of its joints, see ``step_aside``, (m + 1,).
        swerves: x, y of places on the path, how far it is to be aside there, to the left, and how
            long either half is [m]; each on the path with those before it, (k, 4).
        required: Distance that is to be kept from what stands [m].

    Returns:
        (spans, marks, which of the swerves are made (k,)).
    """
    room = spans.shape[0] + MORE_SPANS * swerves.shape[0]
    path, path_marks = np.empty((room, 4, 2)), np.zeros(room + 1, np.int64)
    trial, trial_marks = np.empty((room, 4, 2)), np.zeros(room + 1, np.int64)
    is_made = np.zeros(swerves.shape[0], np.bool_)
    count = spans.shape[0]
    copy_path(spans, marks, count, path, path_marks)
    for i in range(swerves.shape[0]):
        x, y, wide, half = swerves[i]
        k, w = _place_on(path, count, x, y)
        if k < 0:
            continue
        copy_path(path, path_marks, count, trial, trial_marks)
        now, first, last = moved_aside(
            trial, trial_marks, count, k, w, wide, SHORTEST * half, 12.0 * abs(wide) / half**2
        )
        if first == last:
            continue
        if (conflicts(world, trial[first:last], required)[0] != CLEAR).any():
            continue
        count, is_made[i] = now, True
        copy_path(trial, trial_marks, count, path, path_marks)
    return path[:count].copy(), path_marks[: count + 1].copy(), is_made
