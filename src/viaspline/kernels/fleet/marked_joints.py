"""Paths whose joints are marked by what has to stay there; they are walked along and cut.

Tested through ``fleet/laying/test_step_aside``.
"""

from __future__ import annotations

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.span_geometry import EDGE, keep_from, span_length, span_part
from viaspline.kernels.jit import inner

FREE, KEPT, FIXED, ASIDE = 0, 1, 2, 3
"""Marks of joints: where a path runs through the place, where it does so in this direction."""


@inner
def walk_path(
    spans: Floats, count: int, marks: Ints, k: int, w: float, far: float, ahead: bool
) -> tuple[int, float, float]:
    """Go along a path from a place on it, up to a joint that is kept: where that is, how far."""
    gone = 0.0
    while True:
        rest = span_length(spans[k], w, 1.0) if ahead else span_length(spans[k], 0.0, w)
        if gone + rest >= far:
            share = (far - gone) / rest if rest > 0.0 else 0.0
            w = w + share * (1.0 - w) if ahead else w - share * w
            return k, w, far
        gone += rest
        joint = k + 1 if ahead else k
        if marks[joint] == KEPT or marks[joint] == FIXED:
            return k, 1.0 if ahead else 0.0, gone
        k, w = (k + 1, 0.0) if ahead else (k - 1, 1.0)


@inner
def split_span(spans: Floats, marks: Ints, count: int, k: int, w: float) -> tuple[int, int]:
    """Cut a span in two, unless that is at one of its ends already.

    Args:
        spans: Of a path; those behind make room.
        marks: Of its joints; see ``step_aside``.
        count: So many spans there are.
        k: The span,
        w: and where on it.

    Returns:
        (the joint there, how many spans there are now).
    """
    if w < EDGE:
        return k, count
    if w > 1.0 - EDGE:
        return k + 1, count
    for i in range(count, k, -1):
        marks[i + 1] = marks[i]
        for j in range(4):
            for axis in range(2):
                spans[i, j, axis] = spans[i - 1, j, axis]
    marks[k + 1] = FREE
    span_part(spans[k + 1], 0.0, w, spans[k])
    keep_from(spans[k + 1], w)
    return k + 1, count + 1


@inner
def copy_path(spans: Floats, marks: Ints, count: int, to_spans: Floats, to_marks: Ints) -> None:
    """Copy a path with its marks to where there is room for more."""
    for i in range(count):
        for j in range(4):
            for axis in range(2):
                to_spans[i, j, axis] = spans[i, j, axis]
    for i in range(count + 1):
        to_marks[i] = marks[i]
