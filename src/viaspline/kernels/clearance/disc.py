"""The certificate's kernels: bounds of the distance between a cubic and a packed world.

A piece of a curve lies in the hull of its Bézier control points. So with p the curve's middle and
rho the farthest control point from it, no point of the piece is nearer to the world than
``distance(p) - rho`` (the distance is 1-Lipschitz). With c the chord and delta the larger distance
of the two inner control points from it, no point is nearer than ``distance(c) - 3/4 delta``,
because the inner control points weigh at most 3/4 together. The first bound walks in great steps
through open space, the second in long ones beside an obstacle, where the first would crawl; what
neither settles is halved.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.plane import point_segment
from viaspline.kernels.world.segment import nearest_to_segment

DEPTH = 64
MOST = 2_000_000  # pieces that a bound may take


@inner
def _halve(stack: Floats, top: int) -> None:
    """Replace the piece at ``top`` of the stack by its right half, its left half above it."""
    for axis in range(2):
        p0 = stack[top, axis]
        p1 = stack[top, 2 + axis]
        p2 = stack[top, 4 + axis]
        p3 = stack[top, 6 + axis]
        q0 = 0.5 * (p0 + p1)
        q1 = 0.5 * (p1 + p2)
        q2 = 0.5 * (p2 + p3)
        r0 = 0.5 * (q0 + q1)
        r1 = 0.5 * (q1 + q2)
        middle = 0.5 * (r0 + r1)
        stack[top + 1, axis] = p0
        stack[top + 1, 2 + axis] = q0
        stack[top + 1, 4 + axis] = r0
        stack[top + 1, 6 + axis] = middle
        stack[top, axis] = middle
        stack[top, 2 + axis] = r1
        stack[top, 4 + axis] = q2
        stack[top, 6 + axis] = p3
    middle = 0.5 * (stack[top, 8] + stack[top, 9])
    stack[top + 1, 8] = stack[top, 8]
    stack[top + 1, 9] = middle
    stack[top, 8] = middle


@inner
def _load(stack: Floats, spans: Floats, span: int) -> None:
    for k in range(4):
        stack[0, 2 * k] = spans[span, k, 0]
        stack[0, 2 * k + 1] = spans[span, k, 1]
    stack[0, 8] = 0.0
    stack[0, 9] = 1.0


@inner
def _middle(piece: Floats) -> tuple[float, float]:
    x = (piece[0] + 3.0 * (piece[2] + piece[4]) + piece[6]) / 8.0
    y = (piece[1] + 3.0 * (piece[3] + piece[5]) + piece[7]) / 8.0
    return x, y


@inner
def _reach(piece: Floats, x: float, y: float) -> float:
    """Distance from (x, y) to the farthest control point."""
    squared = 0.0
    for k in range(4):
        dx = piece[2 * k] - x
        dy = piece[2 * k + 1] - y
        squared = max(squared, dx * dx + dy * dy)
    return math.sqrt(squared)


@inner
def _sag(piece: Floats) -> float:
    """Bound of the distance between a piece and its chord."""
    first = point_segment(piece[2], piece[3], piece[0], piece[1], piece[6], piece[7])
    second = point_segment(piece[4], piece[5], piece[0], piece[1], piece[6], piece[7])
    return 0.75 * max(first, second)


@kernel
def tightest(
    world: PackedWorld, spans: Floats, tolerance: float
) -> tuple[float, float, int, float, int]:
    """The smallest distance between a curve and a world, from both sides.

    Args:
        world: PackedWorld.
        spans: Bézier control polygons, (m, 4, d); the first two coordinates count.
        tolerance: How far apart the two bounds may be [m].

    Returns:
        (lower, upper, span, w, index): the bounds [m], where the upper one is reached, and what is
        nearest there. Both are infinite in an empty world. The lower one is minus infinity where
        so small a tolerance takes too many pieces: kilometres deep inside of something.
    """
    upper = np.inf
    lower = np.inf
    span_at = 0
    w_at = 0.0
    index_at = -1
    for joint in range(spans.shape[0] + 1):
        span = min(joint, spans.shape[0] - 1)
        end = 3 * (joint - span)  # the last joint is the last control point, the others first ones
        distance, index = nearest(world, spans[span, end, 0], spans[span, end, 1], upper)
        if distance < upper:
            upper, span_at, w_at, index_at = distance, span, float(joint - span), index
    if upper == np.inf:
        return lower, upper, span_at, w_at, index_at
    stack = np.empty((DEPTH, 10))
    pieces = 0
    for span in range(spans.shape[0]):
        _load(stack, spans, span)
        top = 0
        while top >= 0:
            pieces += 1
            if pieces > MOST:
                return -np.inf, upper, span_at, w_at, index_at
            piece = stack[top]
            x, y = _middle(piece)
            reach = _reach(piece, x, y)
            distance, index = nearest(world, x, y, upper + reach)
            if distance < upper:
                upper, span_at, index_at = distance, span, index
                w_at = 0.5 * (piece[8] + piece[9])
            bound = distance - reach
            if bound < upper - tolerance:
                sag = _sag(piece)
                if sag <= tolerance + distance - upper and upper > 0.0:
                    chord, _ = nearest_to_segment(
                        world, piece[0], piece[1], piece[6], piece[7], upper + sag
                    )
                    if chord > 0.0:  # a chord that touches something says nothing about depth
                        bound = max(bound, chord - sag)
            if bound >= upper - tolerance or top + 2 > DEPTH or reach < 1e-9:
                lower = min(lower, bound)
                top -= 1
            else:
                _halve(stack, top)
                top += 1
    return min(lower, upper), upper, span_at, w_at, index_at


@kernel
def conflicts(world: PackedWorld, spans: Floats, required: float) -> tuple[Ints, Floats]:
    """What each span comes too close to.

    Args:
        world: PackedWorld.
        spans: Bézier control polygons, (m, 4, d).
        required: Distance that is to be kept [m].

    Returns:
        (index (m,), w (m,)): -1 where a span is proven clear; elsewhere the index of what it is
        too close to (see ``nearest``) and where on the span it was found.
    """
    count = spans.shape[0]
    found = np.full(count, -1, np.int64)
    where = np.zeros(count)
    stack = np.empty((DEPTH, 10))
    for span in range(count):
        _load(stack, spans, span)
        top = 0
        while top >= 0:
            piece = stack[top]
            x, y = _middle(piece)
            reach = _reach(piece, x, y)
            distance, index = nearest(world, x, y, required + reach)
            if distance >= required + reach:
                top -= 1
                continue
            sag = _sag(piece)
            if distance >= required and sag <= 0.1 * required + (distance - required):
                chord, _ = nearest_to_segment(
                    world, piece[0], piece[1], piece[6], piece[7], required + sag
                )
                if chord >= required + sag:
                    top -= 1
                    continue
            if distance < required or reach < 1e-7 or top + 2 > DEPTH:
                found[span] = index
                where[span] = 0.5 * (piece[8] + piece[9])
                break
            _halve(stack, top)
            top += 1
    return found, where
