"""The certificate's kernels: bounds of the distance between a cubic and a world.

A piece of a curve lies in the hull of its Bézier control points. So with p the curve's middle and
rho the farthest control point from it, no point of the piece is nearer to the world than
``distance(p) - rho`` (the distance is 1-Lipschitz). With c the chord and delta the larger distance
of the two inner control points from it, no point is nearer than ``distance(c) - 3/4 delta``,
because the inner control points weigh at most 3/4 together. The first bound walks in great steps
through open space, the second in long ones beside an obstacle, where the first would crawl; what
neither settles is halved.

Of a world that moves, both are taken at the piece's middle instant, less what its pace allows until
its first and its last.

Tested through ``curve/test_certificate``.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.clearance.world_protocol import chord_distance, dimension, distance_at, pace
from viaspline.kernels.curve.halving import halve_piece, load_span
from viaspline.kernels.jit import inlined, kernel

STILL: Floats = np.empty(0)
"""The instants of a drive in a world that stands still."""

MAX_DEPTH = 64  # halvings of a span
MAX_PIECES = 2_000_000  # that a bound may take


@inlined
def _set_middle(piece: Floats, d: int, middle: Floats) -> None:
    for axis in range(d):
        inner_ones = piece[d + axis] + piece[2 * d + axis]
        middle[axis] = (piece[axis] + 3.0 * inner_ones + piece[3 * d + axis]) / 8.0


@inlined
def _reach(piece: Floats, d: int, middle: Floats) -> float:
    """Distance from the middle to the farthest control point."""
    squared = 0.0
    for k in range(4):
        apart = 0.0
        for axis in range(d):
            gap = piece[k * d + axis] - middle[axis]
            apart += gap * gap
        squared = max(squared, apart)
    return math.sqrt(squared)


@inlined
def _sag(piece: Floats, d: int) -> float:
    """Bound of the distance between a piece and its chord."""
    squared = 0.0
    for axis in range(d):
        chord = piece[3 * d + axis] - piece[axis]
        squared += chord * chord
    farthest = 0.0
    for k in range(1, 3):
        along = 0.0
        for axis in range(d):
            chord = piece[3 * d + axis] - piece[axis]
            along += (piece[k * d + axis] - piece[axis]) * chord
        w = min(1.0, max(0.0, along / squared)) if squared > 0.0 else 0.0
        apart = 0.0
        for axis in range(d):
            gap = piece[k * d + axis] - piece[axis] - w * (piece[3 * d + axis] - piece[axis])
            apart += gap * gap
        farthest = max(farthest, apart)
    return 0.75 * math.sqrt(farthest)


@kernel
def tightest(
    world: Any, spans: Floats, instants: Floats, tolerance: float
) -> tuple[float, float, int, float, int]:
    """The smallest distance between what moves along a curve and a world, from both sides.

    Args:
        world: A packed world; see ``world_protocol``.
        spans: Bézier control polygons, (m, 4, e), of at least as many coordinates as the world.
        instants: When each span begins, and the last one ends [s], (m + 1,); within a span time
            goes evenly with the parameter: cut spans where it doesn't. In a world that stands
            still none, (0,): see ``STILL``.
        tolerance: How far apart the two bounds may be [m].

    Returns:
        (lower, upper, span, w, index): the bounds [m], where the upper one is reached, and what is
        nearest there. Both are infinite in an empty world. The lower one is minus infinity where
        so small a tolerance takes too many pieces: kilometres deep inside of something.
    """
    d = dimension(world)
    moves = pace(world)
    timed = instants.size > 0
    upper = np.inf
    lower = np.inf
    span_at = 0
    w_at = 0.0
    index_at = -1
    for joint in range(spans.shape[0] + 1):
        span = min(joint, spans.shape[0] - 1)
        end = 3 * (joint - span)  # the last joint is the last control point, the others first ones
        instant = instants[joint] if timed else 0.0
        distance, index = distance_at(world, spans[span, end], instant, upper)
        if distance < upper:
            upper, span_at, w_at, index_at = distance, span, float(joint - span), index
    if upper == np.inf and moves == 0.0:
        return lower, upper, span_at, w_at, index_at
    stack = np.empty((MAX_DEPTH, 4 * d + 2))
    middle = np.empty(d)
    pieces = 0
    for span in range(spans.shape[0]):
        begin = instants[span] if timed else 0.0
        lasts = instants[span + 1] - begin if timed else 0.0
        load_span(stack, spans, span, d)
        top = 0
        while top >= 0:
            pieces += 1
            if pieces > MAX_PIECES:
                return -np.inf, upper, span_at, w_at, index_at
            piece = stack[top]
            _set_middle(piece, d, middle)
            w = 0.5 * (piece[4 * d] + piece[4 * d + 1])
            instant = begin + w * lasts
            drift = moves * 0.5 * (piece[4 * d + 1] - piece[4 * d]) * lasts
            reach = _reach(piece, d, middle)
            distance, index = distance_at(world, middle, instant, upper + reach + drift)
            if distance < upper:
                upper, span_at, index_at = distance, span, index
                w_at = w
            bound = distance - reach - drift
            if bound < upper - tolerance:
                sag = _sag(piece, d) + drift
                if sag <= tolerance + distance - upper and upper > 0.0:
                    chord, _ = chord_distance(
                        world, piece[:d], piece[3 * d : 4 * d], instant, upper + sag
                    )
                    if chord > 0.0:  # a chord that touches something says nothing about depth
                        bound = max(bound, chord - sag)
            is_small = reach + drift < 1e-9
            if bound >= upper - tolerance or top + 2 > MAX_DEPTH or is_small:
                lower = min(lower, bound)
                top -= 1
            else:
                halve_piece(stack, top, d)
                top += 1
    return min(lower, upper), upper, span_at, w_at, index_at


@kernel
def conflicts(world: Any, spans: Floats, required: float) -> tuple[Ints, Floats]:
    """What each span comes too close to, in a world that stands still.

    Args:
        world: A packed world; see ``world_protocol``.
        spans: Bézier control polygons, (m, 4, e).
        required: Distance that is to be kept [m].

    Returns:
        (index (m,), w (m,)): -1 where a span is proven clear; elsewhere the index of what it is
        too close to (see ``distance_at``) and where on the span it was found.
    """
    d = dimension(world)
    count = spans.shape[0]
    found = np.full(count, -1, np.int64)
    where = np.zeros(count)
    stack = np.empty((MAX_DEPTH, 4 * d + 2))
    middle = np.empty(d)
    for span in range(count):
        load_span(stack, spans, span, d)
        top = 0
        while top >= 0:
            piece = stack[top]
            _set_middle(piece, d, middle)
            reach = _reach(piece, d, middle)
            distance, index = distance_at(world, middle, 0.0, required + reach)
            if distance >= required + reach:
                top -= 1
                continue
            sag = _sag(piece, d)
            if distance >= required and sag <= 0.1 * required + (distance - required):
                chord, _ = chord_distance(
                    world, piece[:d], piece[3 * d : 4 * d], 0.0, required + sag
                )
                if chord >= required + sag:
                    top -= 1
                    continue
            if distance < required or reach < 1e-7 or top + 2 > MAX_DEPTH:
                found[span] = index
                where[span] = 0.5 * (piece[4 * d] + piece[4 * d + 1])
                break
            halve_piece(stack, top, d)
            top += 1
    return found, where
