"""Crossings of which those of some robots are replaced by others, in one pass over all boxes.

Both hold their boxes in order, and no pair of robots is in both: they are merged, not sorted.

Tested through ``fleet/test_renewed_crossings``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints, Steps
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.growable import new_floats, new_steps
from viaspline.kernels.jit import inlined, inner, kernel


@kernel
def merged_pairs(
    kept: Ints, kept_span: Floats, fresh: Ints, fresh_span: Floats, is_changed: Flags
) -> tuple[Ints, Floats, Ints, Ints]:
    """The crossings of a fleet by their robots: those that stay, and those that are found anew.

    Args:
        kept: The robots of crossings from before, (c, 2).
        kept_span: Where these are [m], (c, 4).
        fresh: The robots of crossings of those that have changed, with whomever, (f, 2).
        fresh_span: Where these are [m], (f, 4).
        is_changed: These robots, (n,).

    Returns:
        The robots and the span of each crossing that there is now, and the number of each from
        before, -1 if it isn't there any more, and of each fresh one.
    """
    olds, news = kept.shape[0], fresh.shape[0]
    robots = np.empty((olds + news, 2), np.int64)
    span = np.empty((olds + news, 4))
    number, fresh_number = np.full(olds, -1), np.empty(news, np.int64)
    count, j = 0, 0
    for i in range(olds + 1):
        if i < olds and (is_changed[kept[i, 0]] or is_changed[kept[i, 1]]):
            continue
        while j < news and (i == olds or _is_before(fresh, j, kept, i)):
            _put_crossing(robots, span, count, fresh, fresh_span, j)
            fresh_number[j] = count
            count, j = count + 1, j + 1
        if i < olds:
            _put_crossing(robots, span, count, kept, kept_span, i)
            number[i] = count
            count += 1
    return robots[:count].copy(), span[:count].copy(), number, fresh_number


@inlined
def _is_before(one: Ints, i: int, other: Ints, j: int) -> bool:
    return one[i, 0] < other[j, 0] or (one[i, 0] == other[j, 0] and one[i, 1] < other[j, 1])


@inlined
def _put_crossing(
    robots: Ints, span: Floats, at: int, other_robots: Ints, other_span: Floats, i: int
) -> None:
    for side in range(2):
        robots[at, side] = other_robots[i, side]
    for k in range(4):
        span[at, k] = other_span[i, k]


@inlined
def _put_box(
    to: PackedCrossings, at: int, source: PackedCrossings, i: int, moved: int, number: Ints
) -> None:
    to.cell[at] = source.cell[i] + moved
    to.crossing[at] = number[source.crossing[i]]
    to.other[at] = source.other[i]
    to.low[at], to.high[at] = source.low[i], source.high[i]


@inner
def _loses_some(kept: PackedCrossings, number: Ints) -> Flags:
    """Which robots have boxes that aren't kept, (n,)."""
    loses = np.zeros(kept.box_first.size - 1, np.bool_)
    for k in range(number.size):
        if number[k] < 0:
            loses[kept.robots[k, 0]] = loses[kept.robots[k, 1]] = True
    return loses


@inner
def _box_counts(
    kept: PackedCrossings, fresh: PackedCrossings, number: Ints, loses: Flags
) -> Ints:  # fmt: skip
    """Where the boxes of each robot begin, (n + 1,)."""
    robots = kept.box_first.size - 1
    first = np.zeros(robots + 1, np.int64)
    for robot in range(robots):
        count = fresh.box_first[robot + 1] - fresh.box_first[robot]
        begin, end = kept.box_first[robot], kept.box_first[robot + 1]
        if not loses[robot]:
            count += end - begin
        else:
            for i in range(begin, end):
                if number[kept.crossing[i]] >= 0:
                    count += 1
        first[robot + 1] = first[robot] + count
    return first


@inner
def _put_all(
    to: PackedCrossings, at: int, source: PackedCrossings, begin: int, end: int, moved: int,
    number: Ints,
) -> None:  # fmt: skip
    """Copy boxes of a robot that keeps them all, an array after the other."""
    for i in range(begin, end):
        to.cell[at + i - begin] = source.cell[i] + moved
    for i in range(begin, end):
        to.crossing[at + i - begin] = number[source.crossing[i]]
    for i in range(begin, end):
        to.other[at + i - begin] = source.other[i]
    for i in range(begin, end):
        to.low[at + i - begin] = source.low[i]
    for i in range(begin, end):
        to.high[at + i - begin] = source.high[i]


@kernel
def renewed_boxes(
    kept: PackedCrossings, fresh: PackedCrossings, is_changed: Flags, moved: Ints
) -> tuple[Ints, Floats, Ints, Steps, Steps, Steps, Floats, Floats]:
    """The crossings of the fleet: those that stay, and those that are found anew.

    Args:
        kept: PackedCrossings, from before.
        fresh: PackedCrossings of the robots that have changed, with whomever.
        is_changed: These robots, (n,).
        moved: By how much the numbers of each robot's cells have changed since before, (n,).

    Returns:
        The fields of ``PackedCrossings``, in their order.
    """
    robots, span, number, fresh_number = merged_pairs(
        kept.robots, kept.span, fresh.robots, fresh.span, is_changed
    )
    loses = _loses_some(kept, number)
    first = _box_counts(kept, fresh, number, loses)
    boxes = first[first.size - 1]
    to = PackedCrossings(
        robots, span, first, new_steps(boxes, 1)[:, 0], new_steps(boxes, 1)[:, 0],
        new_steps(boxes, 1)[:, 0], new_floats(boxes, 1)[:, 0], new_floats(boxes, 1)[:, 0],
    )  # fmt: skip
    at = 0
    for robot in range(is_changed.size):
        j, news = fresh.box_first[robot], fresh.box_first[robot + 1]
        if j == news and not loses[robot]:
            begin, end = kept.box_first[robot], kept.box_first[robot + 1]
            _put_all(to, at, kept, begin, end, moved[robot], number)
            at += end - begin
            continue
        for i in range(kept.box_first[robot], kept.box_first[robot + 1]):
            if number[kept.crossing[i]] < 0:
                continue
            cell, other = kept.cell[i] + moved[robot], kept.other[i]
            while j < news and (
                fresh.cell[j] < cell or (fresh.cell[j] == cell and fresh.other[j] < other)
            ):
                _put_box(to, at, fresh, j, 0, fresh_number)
                at, j = at + 1, j + 1
            _put_box(to, at, kept, i, moved[robot], number)
            at += 1
        while j < news:
            _put_box(to, at, fresh, j, 0, fresh_number)
            at, j = at + 1, j + 1
    return robots, span, first, to.cell, to.crossing, to.other, to.low, to.high
