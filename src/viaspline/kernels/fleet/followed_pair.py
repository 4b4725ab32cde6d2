"""The least distance of two robots of a fleet for a while, from stage to stage of their drives.

Within a stage of either, both go along chords with constant acceleration. So the difference p of
their places bows out from the straight line between two instants h apart by h²/8 |p''|, and that
line's distance from 0 is exact. What may be least is halved. Where a law is off constant
acceleration a robot is still between its nodes: there it is told as well what part of its chord it
may be on.

Tested through ``fleet/test_fleet_certificate``.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple, TypeAlias

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.fleet_motion import (
    DriveStage,
    error_in,
    parts_in,
    place_in,
    stage_end,
    stage_of,
)
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.jit import inlined, inner

LOWER: Final = 0  # proven: nowhere is anything less [m]
UPPER: Final = 1  # the least that was met [m]
WHEN: Final = 2  # when that was [s]
FIRST_X: Final = 3  # where the two were [m]
FIRST_Y: Final = 4
SECOND_X: Final = 5
SECOND_Y: Final = 6
BEST_COLUMNS: Final = 7

HALF_SLACK = 5e-7  # half of PROOF_SLACK_M [m]
DEEPEST: Final = 40
SWINGS_M = 1e-9
"""Laws that are less off constant acceleration aren't looked at for that."""

Place: TypeAlias = tuple[float, float]


class PairSearch(NamedTuple):
    """Room for what is halved.

    Attributes:
        halves: Instants in which either robot has one stage, (DEEPEST + 2, 7).
        at: The places of both, (1, 4).
    """

    halves: Floats
    at: Floats


@inlined
def _least(x0: float, y0: float, x1: float, y1: float) -> float:
    """The distance of a segment from the origin."""
    dx, dy = x1 - x0, y1 - y0
    squared = dx * dx + dy * dy
    part = 0.0
    if squared > 0.0:
        part = min(max(-(x0 * dx + y0 * dy) / squared, 0.0), 1.0)
    x, y = x0 + part * dx, y0 + part * dy
    return math.sqrt(x * x + y * y)


@inlined
def _is_settled(lower: float, best: Floats, tolerance: float) -> bool:
    """Whether a bound needs no halving: near the least, on the same side of what is required."""
    least = best[0, UPPER]
    if lower >= least:
        return True
    return lower >= least - tolerance and (lower >= -HALF_SLACK or least < -2.0 * HALF_SLACK)


@inlined
def _meet(best: Floats, pair: Ints, value: float, when: float, at: Floats, i: int, j: int) -> None:
    """Note a distance if it is the least so far; ``at`` has the places of both."""
    if value < best[0, UPPER]:
        best[0, UPPER], best[0, WHEN] = value, when
        for column in range(4):
            best[0, FIRST_X + column] = at[0, column]
        pair[0, 0], pair[0, 1] = i, j


@inlined
def _side(a: Place, b: Place, c: Place) -> float:
    """On which side of the line from a to b a place is: positive on its left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


@inlined
def _from_segment(a: Place, b: Place, c: Place) -> float:
    """The distance of a place from the segment from a to b."""
    return _least(a[0] - c[0], a[1] - c[1], b[0] - c[0], b[1] - c[1])


@inlined
def _segments_apart(a: Place, b: Place, c: Place, d: Place) -> float:
    """The distance of the segment from a to b from that from c to d."""
    if _side(a, b, c) * _side(a, b, d) < 0.0 and _side(c, d, a) * _side(c, d, b) < 0.0:
        return 0.0
    from_one = min(_from_segment(a, b, c), _from_segment(a, b, d))
    return min(from_one, min(_from_segment(c, d, a), _from_segment(c, d, b)))


@inlined
def _on_chord(stage: DriveStage, part: float) -> Place:
    return stage.x + part * stage.across, stage.y + part * stage.up


@inner
def _may_be_apart(one: DriveStage, other: DriveStage, begin: float, end: float) -> float:
    """How far apart two robots are at least between two instants, wherever on their chords [m].

    Only of laws that are off constant acceleration; minus infinity of others.
    """
    if one.swing + other.swing < SWINGS_M:
        return -math.inf
    low, high = parts_in(one, begin, end)
    first, last = parts_in(other, begin, end)
    apart = _segments_apart(
        _on_chord(one, low), _on_chord(one, high), _on_chord(other, first), _on_chord(other, last)
    )
    return apart - one.bow - other.bow


@inlined
def _bend(one: DriveStage, other: DriveStage) -> float:
    """By how much the difference of places bows out in a second, at most [m/s²]."""
    across = one.rise * one.across - other.rise * other.across
    up = one.rise * one.up - other.rise * other.up
    return 0.25 * math.sqrt(across * across + up * up)


@inner
def _apart_at(one: DriveStage, other: DriveStage, x: float, y: float, instant: float) -> float:
    """How far apart two robots are at least at an instant [m].

    Args:
        one: The stage of a robot,
        other: and that of another one.
        x: From the point of the one on its chord to that of the other [m].
        y: The same.
        instant: In both stages [s].
    """
    apart = math.sqrt(x * x + y * y)
    apart -= error_in(one, instant, instant) + error_in(other, instant, instant)
    return max(apart, _may_be_apart(one, other, instant, instant))


@inner
def _halve(
    one: DriveStage, other: DriveStage, begin: float, end: float, reach: float, tolerance: float,
    robots: tuple[int, int], search: PairSearch, best: Floats, pair: Ints,
) -> None:  # fmt: skip
    """The least distance between two instants in which either robot has one stage.

    Args:
        one: The stage of a robot.
        other: That of another one.
        begin: The earlier instant [s].
        end: The later one [s].
        reach: What is taken off the distance of both [m].
        tolerance: How near the least has to be known [m].
        robots: Their numbers.
        search: Room.
        best: What is known so far, (1, BEST_COLUMNS).
        pair: Whose that is, (1, 2).
    """
    stack, at = search.halves, search.at
    bend = _bend(one, other)
    stack[0, 0], stack[0, 1], stack[0, 6] = begin, end, 0.0
    for side in range(2):
        instant = stack[0, side]
        at[0, 0], at[0, 1] = place_in(one, instant)
        at[0, 2], at[0, 3] = place_in(other, instant)
        x, y = at[0, 0] - at[0, 2], at[0, 1] - at[0, 3]
        stack[0, 2 + 2 * side], stack[0, 3 + 2 * side] = x, y
        value = _apart_at(one, other, x, y, instant) - reach
        _meet(best, pair, value, instant, at, robots[0], robots[1])
    top = 0
    while top >= 0:
        t0, t1, depth = stack[top, 0], stack[top, 1], stack[top, 6]
        x0, y0, x1, y1 = stack[top, 2], stack[top, 3], stack[top, 4], stack[top, 5]
        top -= 1
        off = reach + error_in(one, t0, t1) + error_in(other, t0, t1)
        lower = _least(x0, y0, x1, y1) - bend * (t1 - t0) ** 2 - off
        if not _is_settled(lower, best, tolerance):
            lower = max(lower, _may_be_apart(one, other, t0, t1) - reach)
        middle = 0.5 * (t0 + t1)
        is_done = depth >= DEEPEST or not t0 < middle < t1
        if is_done or _is_settled(lower, best, tolerance):
            best[0, LOWER] = min(best[0, LOWER], lower)
            continue
        at[0, 0], at[0, 1] = place_in(one, middle)
        at[0, 2], at[0, 3] = place_in(other, middle)
        x, y = at[0, 0] - at[0, 2], at[0, 1] - at[0, 3]
        value = _apart_at(one, other, x, y, middle) - reach
        _meet(best, pair, value, middle, at, robots[0], robots[1])
        for half in range(2):
            top += 1
            stack[top, 0], stack[top, 1] = (middle, t1) if half == 0 else (t0, middle)
            stack[top, 2], stack[top, 3] = (x, y) if half == 0 else (x0, y0)
            stack[top, 4], stack[top, 5] = (x1, y1) if half == 0 else (x, y)
            stack[top, 6] = depth + 1.0


@inlined
def _next_stage(laws: PackedLaws, stage: int, last: int, instant: float) -> int:
    """The stage at an instant, from an earlier one on; its last one where that has ended."""
    while stage < last and stage_end(laws, stage) <= instant:
        stage += 1
    return stage


@inner
def follow_pair(
    courses: PackedCourses, laws: PackedLaws, i: int, j: int, node_i: int, node_j: int,
    begin: float, end: float, tolerance: float, search: PairSearch, best: Floats, pair: Ints,
) -> None:  # fmt: skip
    """The least distance of two robots in a window, from stage to stage; see ``_halve``."""
    last_i, last_j = 2 * (courses.first[i + 1] - 1), 2 * (courses.first[j + 1] - 1)
    reach = courses.reach[i] + courses.reach[j]
    stage_i = _next_stage(laws, 2 * node_i, last_i, begin)
    stage_j = _next_stage(laws, 2 * node_j, last_j, begin)
    one, other = stage_of(courses, laws, stage_i), stage_of(courses, laws, stage_j)
    x0, y0 = place_in(one, begin)
    x2, y2 = place_in(other, begin)
    t = begin
    while True:
        until = max(min(end, min(one.end, other.end)), t)
        off = reach + error_in(one, t, until) + error_in(other, t, until)
        x1, y1 = place_in(one, until)
        x3, y3 = place_in(other, until)
        lower = _least(x0 - x2, y0 - y2, x1 - x3, y1 - y3) - off
        lower -= (until - t) ** 2 * _bend(one, other)
        if _is_settled(lower, best, tolerance):
            best[0, LOWER] = min(best[0, LOWER], lower)
        else:
            _halve(one, other, t, until, reach, tolerance, (i, j), search, best, pair)
        if until >= end:
            return
        t, x0, y0, x2, y2 = until, x1, y1, x3, y3
        if one.end <= t:
            if stage_i == last_i:
                return  # it leaves
            stage_i = _next_stage(laws, stage_i, last_i, t)
            one = stage_of(courses, laws, stage_i)
            x0, y0 = one.x, one.y
        if other.end <= t:
            if stage_j == last_j:
                return
            stage_j = _next_stage(laws, stage_j, last_j, t)
            other = stage_of(courses, laws, stage_j)
            x2, y2 = other.x, other.y
