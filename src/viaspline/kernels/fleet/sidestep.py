"""Paths that step aside for discs: bent by just so much, where they come too near.

A step aside has two halves, before and behind the place that is farthest aside. Where there is room
each is half of a cubic B-spline's basis function, scaled, across the path: it begins without an
offset, a slope or a bend. Where a via point is too near for that, the path swings through it: it
runs through the via point in another direction, and swings out a little on its far side.

Tested through ``fleet/laying/test_step_aside``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.clearance.disc import conflicts
from viaspline.kernels.jit import inlined, inner, kernel
from viaspline.kernels.world.packed import PackedWorld

FREE, KEPT, FIXED, ASIDE = 0, 1, 2, 3
"""Marks of joints: where a path runs through the place, where it does so in this direction."""
CLEAR = -1
"""What a span comes too close to, where that is nothing."""
MAX_STEPS_EACH = 3
"""Steps aside for each disc, on average, after which it is given up."""
MAX_WIDENINGS = 8
"""How often a step aside is made wider that isn't wide enough."""
WIDENED = 1.5
"""By how much of what it lacks it is made wider: it is narrower beside its widest place."""
TOUCH_M = 1e-4
"""By which a step aside is too wide, so that the next look finds it wide enough."""
LOOKS_APART_M = 2.0
"""Between places on a span that are looked at for the nearest one; then it is closed in on."""
MOST_LOOKS = 64
EDGE = 1e-6
"""Nearer to its end a span isn't cut."""
LEAST_KEPT = 0.2
"""A path bends no more sharply than that its inner side is shortened to this."""
ONE_MORE_M = 100.0
"""What it costs to come too near to another disc, beside being so far aside [m]."""
SHORTEST = 0.6
"""The shortest half of a step aside, of the one that bends no more than the disc,"""
SHORTEST_SWING = 0.3
"""and that of one that swings through a via point."""
GENTLE = 0.7
"""Of the half that is wanted, from which on a path doesn't swing through a via point for more."""
STEEPEST = 1.8
"""The greatest slope with which a path swings through a via point, to the path as it was."""


@inlined
def _bezier(span: Floats, w: float, axis: int) -> float:
    v = 1.0 - w
    return (
        v * v * v * span[0, axis]
        + 3.0 * v * v * w * span[1, axis]
        + 3.0 * v * w * w * span[2, axis]
        + w * w * w * span[3, axis]
    )


@inner
def _apart(span: Floats, w: float, x: float, y: float) -> float:
    return math.hypot(_bezier(span, w, 0) - x, _bezier(span, w, 1) - y)


@inner
def _nearest_on(span: Floats, x: float, y: float, limit: float) -> tuple[float, float]:
    """Distance of a place from a span and where on it; infinite where it is beyond a limit."""
    low_x = min(min(span[0, 0], span[1, 0]), min(span[2, 0], span[3, 0]))
    high_x = max(max(span[0, 0], span[1, 0]), max(span[2, 0], span[3, 0]))
    low_y = min(min(span[0, 1], span[1, 1]), min(span[2, 1], span[3, 1]))
    high_y = max(max(span[0, 1], span[1, 1]), max(span[2, 1], span[3, 1]))
    if x < low_x - limit or x > high_x + limit or y < low_y - limit or y > high_y + limit:
        return math.inf, 0.0
    rough = high_x - low_x + high_y - low_y
    looks = min(max(int(rough / LOOKS_APART_M) + 1, 4), MOST_LOOKS)
    best, at = math.inf, 0.0
    for k in range(looks + 1):
        apart = _apart(span, k / looks, x, y)
        if apart < best:
            best, at = apart, k / looks
    low, high = max(at - 1.0 / looks, 0.0), min(at + 1.0 / looks, 1.0)
    for _ in range(24):
        third = (high - low) / 3.0
        if _apart(span, low + third, x, y) <= _apart(span, high - third, x, y):
            high = high - third
        else:
            low = low + third
    w = 0.5 * (low + high)
    apart = _apart(span, w, x, y)
    return (apart, w) if apart < best else (best, at)


@inner
def _part(span: Floats, begin: float, end: float, out: Floats) -> None:
    """The part of a span between two of its parameters, as a span."""
    width = end - begin
    for axis in range(2):
        p0, p1, p2, p3 = span[0, axis], span[1, axis], span[2, axis], span[3, axis]
        d0, d1, d2 = p1 - p0, p2 - p1, p3 - p2
        v = 1.0 - begin
        slope0 = v * v * d0 + 2.0 * v * begin * d1 + begin * begin * d2
        v = 1.0 - end
        slope1 = v * v * d0 + 2.0 * v * end * d1 + end * end * d2
        out[0, axis] = _bezier(span, begin, axis)
        out[3, axis] = _bezier(span, end, axis)
        out[1, axis] = out[0, axis] + width * slope0
        out[2, axis] = out[3, axis] - width * slope1


@inner
def _length(span: Floats, begin: float, end: float) -> float:
    """About how long a span is between two of its parameters [m]."""
    steps = 8
    total = 0.0
    x, y = _bezier(span, begin, 0), _bezier(span, begin, 1)
    for k in range(1, steps + 1):
        w = begin + (end - begin) * k / steps
        to_x, to_y = _bezier(span, w, 0), _bezier(span, w, 1)
        total += math.hypot(to_x - x, to_y - y)
        x, y = to_x, to_y
    return total


@inner
def _walk(
    spans: Floats, count: int, marks: Ints, k: int, w: float, far: float, ahead: bool
) -> tuple[int, float, float]:
    """Go along a path from a place on it, up to a joint that is kept: where that is, how far."""
    gone = 0.0
    while True:
        rest = _length(spans[k], w, 1.0) if ahead else _length(spans[k], 0.0, w)
        if gone + rest >= far:
            share = (far - gone) / rest if rest > 0.0 else 0.0
            w = w + share * (1.0 - w) if ahead else w - share * w
            return k, w, far
        gone += rest
        joint = k + 1 if ahead else k
        if marks[joint] == KEPT or marks[joint] == FIXED:
            return k, 1.0 if ahead else 0.0, gone
        k, w = (k + 1, 0.0) if ahead else (k - 1, 1.0)


@inlined
def _aside(x: float, half: float, beyond: float) -> tuple[float, float]:
    """How far aside a path is, as a share of the most, and its slope away from there [1/m].

    Args:
        x: How far from the place that is farthest aside [m], at least 0.
        half: How long this half is, to the via point if it swings through that [m].
        beyond: How far it swings out behind that [m]; negative if it doesn't swing at all.
    """
    t = x / half
    if beyond >= 0.0:
        if t < 1.0:
            return 1.0 - 1.5 * t * t + 0.5 * t * t * t, (-3.0 * t + 1.5 * t * t) / half
        z = min((x - half) / beyond, 1.0) if beyond > 0.0 else 0.0
        steep = -1.5 / half
        return steep * beyond * z * (1.0 - z) ** 2, steep * (1.0 - z) * (1.0 - 3.0 * z)
    if t >= 1.0:
        return 0.0, 0.0
    if t >= 0.5:
        return 2.0 * (1.0 - t) ** 3, -6.0 * (1.0 - t) ** 2 / half
    return 1.0 - 6.0 * t * t + 6.0 * t * t * t, (-12.0 * t + 18.0 * t * t) / half


@inner
def _shift(piece: Floats, out0: float, slope0: float, out1: float, slope1: float) -> bool:
    """Move a piece of a path to the left: its ends by offsets [m], its tangents by slopes.

    Returns:
        Whether it goes on in its direction: it doesn't where the path bends too sharply that way.
    """
    d01x, d01y = piece[1, 0] - piece[0, 0], piece[1, 1] - piece[0, 1]
    d12x, d12y = piece[2, 0] - piece[1, 0], piece[2, 1] - piece[1, 1]
    d23x, d23y = piece[3, 0] - piece[2, 0], piece[3, 1] - piece[2, 1]
    first, last = math.hypot(d01x, d01y), math.hypot(d23x, d23y)
    if first < 1e-12 or last < 1e-12:
        return False
    bend0 = 2.0 / 3.0 * (d01x * d12y - d01y * d12x) / first**3
    bend1 = 2.0 / 3.0 * (d12x * d23y - d12y * d23x) / last**3
    keep0, keep1 = 1.0 - bend0 * out0, 1.0 - bend1 * out1
    if keep0 < LEAST_KEPT or keep1 < LEAST_KEPT:
        return False
    nx0, ny0 = -d01y / first, d01x / first
    nx1, ny1 = -d23y / last, d23x / last
    # Directions are those of the path and of the offset alone: with its bend, which may jump at a
    # joint, they would differ on either side of that.
    piece[0, 0] += out0 * nx0
    piece[0, 1] += out0 * ny0
    piece[3, 0] += out1 * nx1
    piece[3, 1] += out1 * ny1
    piece[1, 0] = piece[0, 0] + keep0 * (d01x + slope0 * first * nx0)
    piece[1, 1] = piece[0, 1] + keep0 * (d01y + slope0 * first * ny0)
    piece[2, 0] = piece[3, 0] - keep1 * (d23x + slope1 * last * nx1)
    piece[2, 1] = piece[3, 1] - keep1 * (d23y + slope1 * last * ny1)
    return True


@inner
def _split(spans: Floats, marks: Ints, count: int, k: int, w: float) -> tuple[int, int]:
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
    _part(spans[k + 1], 0.0, w, spans[k])
    _part_from(spans[k + 1], w)
    return k + 1, count + 1


@inner
def _part_from(span: Floats, w: float) -> None:
    """Keep the part of a span from one of its parameters on."""
    for axis in range(2):
        p0, p1, p2, p3 = span[0, axis], span[1, axis], span[2, axis], span[3, axis]
        a, b, c = p0 + w * (p1 - p0), p1 + w * (p2 - p1), p2 + w * (p3 - p2)
        d, e = a + w * (b - a), b + w * (c - b)
        span[0, axis] = d + w * (e - d)
        span[1, axis] = e
        span[2, axis] = c


@inner
def _copy(spans: Floats, marks: Ints, count: int, to_spans: Floats, to_marks: Ints) -> None:
    for i in range(count):
        for j in range(4):
            for axis in range(2):
                to_spans[i, j, axis] = spans[i, j, axis]
    for i in range(count + 1):
        to_marks[i] = marks[i]


@inner
def _half(
    spans: Floats, marks: Ints, count: int, apex: int, ahead: bool, wide: float, shortest: float,
    bend: float,
) -> tuple[float, float]:  # fmt: skip
    """How one half of a step aside is: how long, and how far it swings out beyond [m].

    Args:
        spans: The path,
        marks: its joints,
        count: and how many spans it has.
        apex: The joint that is to be farthest aside.
        ahead: Which half.
        wide: How far aside [m].
        shortest: A half that bends no more than the disc [m].
        bend: The curvature that a step aside has where there is room [1/m].

    Returns:
        See ``_aside``; a length of 0 where there is no room.
    """
    wanted = max(shortest, math.sqrt(12.0 * abs(wide) / bend))
    k, w = (apex, 0.0) if ahead else (apex - 1, 1.0)
    k, _, room = _walk(spans, count, marks, k, w, wanted, ahead)
    if room >= GENTLE * wanted:
        return room, -1.0
    joint = k + 1 if ahead else k
    is_end = joint == 0 or joint == count
    steep = 1.5 * abs(wide) / max(room, TOUCH_M)
    if marks[joint] == FIXED or steep > STEEPEST or room < SHORTEST_SWING * shortest:
        return room if room >= SHORTEST * shortest else 0.0, -1.0
    if is_end:
        return room, 0.0
    k, w = (joint, 0.0) if ahead else (joint - 1, 1.0)
    _, _, beyond = _walk(spans, count, marks, k, w, 4.0 * steep / bend, ahead)
    if beyond < room:
        return room if room >= SHORTEST * shortest else 0.0, -1.0
    return room, beyond


@inner
def _cut_half(
    spans: Floats, marks: Ints, count: int, apex: int, ahead: bool, half: float, beyond: float
) -> tuple[int, int]:
    """Cut a path where one half of a step aside has its knots.

    Returns:
        (the joint where the half ends, how many spans there are now). Behind a cut joints count on.
    """
    had = count
    k, w = (apex, 0.0) if ahead else (apex - 1, 1.0)
    at_k, at_w, _ = _walk(spans, count, marks, k, w, half, ahead)
    joint, count = _split(spans, marks, count, at_k, at_w)
    if beyond > 0.0:
        k, w = (joint, 0.0) if ahead else (joint - 1, 1.0)
        at_k, at_w, _ = _walk(spans, count, marks, k, w, beyond, ahead)
        joint, count = _split(spans, marks, count, at_k, at_w)
    k, w = (apex, 0.0) if ahead else (apex + count - had - 1, 1.0)
    before = count
    at_k, at_w, _ = _walk(spans, count, marks, k, w, 0.5 * half, ahead)
    _, count = _split(spans, marks, count, at_k, at_w)
    return joint + count - before if ahead else joint, count


@inner
def _moved(
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
    apex, count = _split(spans, marks, count, k, w)
    if marks[apex] == KEPT or marks[apex] == FIXED:
        return count, 0, 0
    after, swing_after = _half(spans, marks, count, apex, True, wide, shortest, bend)
    before, swing_before = _half(spans, marks, count, apex, False, wide, shortest, bend)
    if min(before, after) <= 0.0:
        return count, 0, 0
    last, count = _cut_half(spans, marks, count, apex, True, after, swing_after)
    had = count
    first, count = _cut_half(spans, marks, count, apex, False, before, swing_before)
    apex, last = apex + count - had, last + count - had
    x = 0.0
    for i in range(apex, last):
        out0, slope0 = _aside(x, after, swing_after)
        x += _length(spans[i], 0.0, 1.0)
        out1, slope1 = _aside(x, after, swing_after)
        if i + 1 == last and swing_after != 0.0:
            out1, slope1 = 0.0, 0.0
        out0 = 0.0 if marks[i] == KEPT else out0
        out1 = 0.0 if marks[i + 1] == KEPT else out1
        if not _shift(spans[i], wide * out0, wide * slope0, wide * out1, wide * slope1):
            return count, 0, 0
    x = 0.0
    for i in range(apex - 1, first - 1, -1):
        out1, slope1 = _aside(x, before, swing_before)
        x += _length(spans[i], 0.0, 1.0)
        out0, slope0 = _aside(x, before, swing_before)
        if i == first and swing_before != 0.0:
            out0, slope0 = 0.0, 0.0
        out0 = 0.0 if marks[i] == KEPT else out0
        out1 = 0.0 if marks[i + 1] == KEPT else out1
        if not _shift(spans[i], wide * out0, -wide * slope0, wide * out1, -wide * slope1):
            return count, 0, 0
    marks[apex] = ASIDE
    return count, first, last


@inner
def _first_met(spans: Floats, count: int, discs: Floats) -> tuple[int, int, float, float]:
    """The first disc that a path comes too near to, and where it is nearest to that.

    Returns:
        (disc, span, its parameter, distance [m]); the disc is -1 if there is none.
    """
    for k in range(count):
        which, deepest = -1, -TOUCH_M / 2.0
        for i in range(discs.shape[0]):
            apart, _ = _nearest_on(spans[k], discs[i, 0], discs[i, 1], discs[i, 2])
            if apart - discs[i, 2] < deepest:
                which, deepest = i, apart - discs[i, 2]
        if which >= 0:
            x, y, needed = discs[which]
            best, at_k, at_w = math.inf, k, 0.0
            for j in range(k, count):
                apart, w = _nearest_on(spans[j], x, y, needed)
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
        least = min(least, _nearest_on(spans[k], disc[0], disc[1], disc[2])[0])
    return least


@inner
def _left_of(span: Floats, w: float, x: float, y: float) -> float:
    """How far left of a span's tangent a place is [m]."""
    part = np.empty((4, 2))
    _part(span, 0.0, w if w > EDGE else EDGE, part)
    dx, dy = part[3, 0] - part[2, 0], part[3, 1] - part[2, 1]
    long = max(math.hypot(dx, dy), 1e-12)
    return (dx * (y - part[3, 1]) - dy * (x - part[3, 0])) / long


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
    _copy(spans, marks, count, path, path_marks)
    which = -1
    for _ in range(most + 1):
        which, k, w, apart = _first_met(path, count, discs)
        if which < 0:
            break
        x, y, needed = discs[which]
        left = _left_of(path[k], w, x, y)
        sign = 1.0 if left >= 0.0 else -1.0
        best_count, least = 0, math.inf
        for side in range(2):
            # first away from the disc, then across it
            wide = -sign * (needed - apart) if side == 0 else sign * (needed + apart)
            for _ in range(MAX_WIDENINGS):
                _copy(path, path_marks, count, trial, trial_marks)
                shortest = math.sqrt(12.0 * abs(wide) * needed)
                now, first, last = _moved(trial, trial_marks, count, k, w, wide, shortest, bend)
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
                _copy(trial, trial_marks, now, best, best_marks)
        if best_count == 0:
            break
        count = best_count
        _copy(best, best_marks, count, path, path_marks)
    return path[:count].copy(), path_marks[: count + 1].copy(), which
