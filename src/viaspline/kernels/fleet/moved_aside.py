"""One step aside of a path, at one of its places.

Tested through ``fleet/laying/test_step_aside``.
"""

from __future__ import annotations

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.marked_joints import ASIDE, FIXED, KEPT, split_span, walk_path
from viaspline.kernels.fleet.shape_aside import half_aside, joint_bend, share_aside, shifted_piece
from viaspline.kernels.fleet.span_geometry import span_length
from viaspline.kernels.jit import inner


@inner
def cut_half(
    spans: Floats, marks: Ints, count: int, apex: int, ahead: bool, half: float, beyond: float
) -> tuple[int, int]:
    """Cut a path where one half of a step aside has its knots.

    Returns:
        (the joint where the half ends, how many spans there are now). Behind a cut joints count on.
    """
    had = count
    k, w = (apex, 0.0) if ahead else (apex - 1, 1.0)
    at_k, at_w, _ = walk_path(spans, count, marks, k, w, half, ahead)
    joint, count = split_span(spans, marks, count, at_k, at_w)
    if beyond > 0.0:
        k, w = (joint, 0.0) if ahead else (joint - 1, 1.0)
        at_k, at_w, _ = walk_path(spans, count, marks, k, w, beyond, ahead)
        joint, count = split_span(spans, marks, count, at_k, at_w)
    k, w = (apex, 0.0) if ahead else (apex + count - had - 1, 1.0)
    before = count
    at_k, at_w, _ = walk_path(spans, count, marks, k, w, 0.5 * half, ahead)
    _, count = split_span(spans, marks, count, at_k, at_w)
    return joint + count - before if ahead else joint, count


@inner
def _welded(spans: Floats, first: int, last: int) -> None:
    """Let spans begin where those before them end, to the last bit: both were moved there."""
    for k in range(first, last):
        for axis in range(2):
            spans[k, 0, axis] = spans[k - 1, 3, axis]


@inner
def moved_aside(
    spans: Floats, marks: Ints, count: int, k: int, w: float, wide: float, shortest: float,
    bend: float,
) -> tuple[int, int, int]:  # fmt: skip
    """Step aside at a place of a path.

    Args:
        spans: The path; it is changed,
        marks: and so are the marks of its joints.
        count: So many spans there are.
        k: The span on which the path is to be farthest aside,
        w: and where on it.
        wide: How far, to the left [m].
        shortest: A half that bends no more than the disc [m].
        bend: The curvature that a step aside has where there is room [1/m].

    Returns:
        (how many spans there are now, the first that is moved, the first behind that isn't);
        nothing is moved where there is no room or the path bends too sharply.
    """
    apex, count = split_span(spans, marks, count, k, w)
    if marks[apex] == KEPT or marks[apex] == FIXED:
        return count, 0, 0
    after, swing_after = half_aside(spans, marks, count, apex, True, wide, shortest, bend)
    before, swing_before = half_aside(spans, marks, count, apex, False, wide, shortest, bend)
    if min(before, after) <= 0.0:
        return count, 0, 0
    last, count = cut_half(spans, marks, count, apex, True, after, swing_after)
    had = count
    first, count = cut_half(spans, marks, count, apex, False, before, swing_before)
    apex, last = apex + count - had, last + count - had
    farthest = bend0 = joint_bend(spans, count, apex)
    x = 0.0
    for i in range(apex, last):
        bend1 = joint_bend(spans, count, i + 1)
        out0, slope0 = share_aside(x, after, swing_after)
        x += span_length(spans[i], 0.0, 1.0)
        out1, slope1 = share_aside(x, after, swing_after)
        if i + 1 == last and swing_after != 0.0:
            out1, slope1 = 0.0, 0.0
        out0 = 0.0 if marks[i] == KEPT else out0
        out1 = 0.0 if marks[i + 1] == KEPT else out1
        if not shifted_piece(
            spans[i], wide * out0, wide * slope0, bend0, wide * out1, wide * slope1, bend1
        ):
            return count, 0, 0
        bend0 = bend1
    bend1, x = farthest, 0.0
    for i in range(apex - 1, first - 1, -1):
        bend0 = joint_bend(spans, count, i)
        out1, slope1 = share_aside(x, before, swing_before)
        x += span_length(spans[i], 0.0, 1.0)
        out0, slope0 = share_aside(x, before, swing_before)
        if i == first and swing_before != 0.0:
            out0, slope0 = 0.0, 0.0
        out0 = 0.0 if marks[i] == KEPT else out0
        out1 = 0.0 if marks[i + 1] == KEPT else out1
        if not shifted_piece(
            spans[i], wide * out0, -wide * slope0, bend0, wide * out1, -wide * slope1, bend1
        ):
            return count, 0, 0
        bend1 = bend0
    marks[apex] = ASIDE
    _welded(spans, max(first, 1), min(last + 1, count))
    return count, first, last
