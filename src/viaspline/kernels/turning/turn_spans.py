"""The spans of lines and turns that were laid round a row of bends, and their length.

Tested through ``kernels/turning/test_turn_sequence``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel, uncounted
from viaspline.kernels.turning.clothoid import (
    MAX_SPAN_TURN_RAD,
    MIN_TURN_RAD,
    arc_and_ramp,
    spans_between,
    turn_length,
    turn_nodes,
)
from viaspline.kernels.turning.settled_lines import X, Y, turn_radius

MAX_TURN_NODES = 64  # of one turn, at most
MIN_STRAIGHT_M = 1e-3  # straight piece that is laid by itself [m]
MIN_TO_POINT_M = 1e-6  # the same, from a turn to a point that stays where it is [m]


@uncounted
def _heading_at(bends: Floats, closed: bool, lines: Floats, turns: Floats, k: int) -> float:
    """Heading at the apex of a bend [rad]."""
    count = bends.shape[0]
    if not closed and k == count - 1:
        return lines[k - 1] + 0.5 * turns[k]
    return lines[k] - 0.5 * turns[k]


@uncounted
def _nodes_of(
    bends: Floats, closed: bool, lines: Floats, turns: Floats, apexes: Floats, ramps: Floats,
    k: int, nodes: Floats,
) -> int:  # fmt: skip
    """Fill in the nodes of one bend, the apex in the middle; returns their number."""
    heading = _heading_at(bends, closed, lines, turns, k)
    if abs(turns[k]) < MIN_TURN_RAD:
        nodes[0, 0], nodes[0, 1] = bends[k, X], bends[k, Y]
        nodes[0, 2], nodes[0, 3] = heading, 0.0
        return 1
    radius = turn_radius(bends[k])
    return turn_nodes(apexes[k, 0], apexes[k, 1], heading, turns[k], radius, ramps[k], nodes)


@inner
def fill_ends(
    bends: Floats, closed: bool, ramps: Floats, lines: Floats, turns: Floats, apexes: Floats,
    ends: Floats,
) -> None:  # fmt: skip
    """Where the turn of each bend begins and ends: x, y and x, y [m], (n, 4)."""
    nodes = np.empty((MAX_TURN_NODES, 4))
    for k in range(bends.shape[0]):
        size = _nodes_of(bends, closed, lines, turns, apexes, ramps, k, nodes)
        for i in range(2):
            ends[k, i], ends[k, 2 + i] = nodes[0, i], nodes[size - 1, i]


@uncounted
def _straight(nodes: Floats, a: int, b: int, polygons: Floats) -> None:
    for axis in range(2):
        start, end = nodes[a, axis], nodes[b, axis]
        for i in range(4):
            polygons[i, axis] = start + (end - start) * i / 3.0


@kernel
def turn_sequence_spans(
    bends: Floats, closed: bool, lines: Floats, turns: Floats, apexes: Floats, ramps: Floats
) -> tuple[Floats, Ints]:  # fmt: skip
    """The spans of a swing.

    Args:
        bends: (n, 6).
        closed: As in ``turn_sequence``.
        lines: What ``turn_sequence`` found.
        turns: The same.
        apexes: The same.
        ramps: The same.

    Returns:
        Bézier control polygons (m, 4, 2) [m], and for every bend the span that begins at its
        apex, (n,), or (n + 1,) when closed: the last one is the end of the curve.
    """
    count = bends.shape[0]
    total = count + 1 if closed else count
    polygons = np.empty((3 * MAX_TURN_NODES * total, 4, 2))
    begins = np.zeros(total, np.int64)
    nodes, lengths = np.empty((MAX_TURN_NODES + 1, 4)), np.empty(MAX_TURN_NODES)
    size = 0
    was_point = False
    for row in range(total):
        k = row % count
        number = _nodes_of(bends, closed, lines, turns, apexes, ramps, k, nodes[1:])
        if number > 1:
            _lengths(abs(turns[k]), turn_radius(bends[k]), ramps[k], number, lengths)
        first, end, middle = 1, number, 1 + number // 2
        if closed and row == 0:
            first = middle
        elif closed and row == count:
            end = middle
        elif not closed and row == 0:
            middle = first
        elif not closed and row == count - 1:
            middle = end
        if row > 0:
            gap = math.hypot(nodes[first, 0] - nodes[0, 0], nodes[first, 1] - nodes[0, 1])
            to_point = number == 1 and gap > (0.0 if was_point else MIN_TO_POINT_M)
            if gap > MIN_STRAIGHT_M or to_point:
                _straight(nodes, 0, first, polygons[size])
                size += 1
            elif number == 1 and size > 0:  # a point is where it was asked for
                for axis in range(2):
                    polygons[size - 1, 3, axis] = nodes[first, axis]
            else:
                for axis in range(2):
                    nodes[first, axis] = nodes[0, axis]
        was_point = number == 1
        begins[row] = size + 3 * (middle - first)
        if end > first:
            spans_between(
                nodes[first : end + 1], end - first + 1, lengths[first - 1 :],
                polygons[size : size + 3 * (end - first)],
            )  # fmt: skip
            size += 3 * (end - first)
        for column in range(4):
            nodes[0, column] = nodes[end, column]
    return polygons[:size].copy(), begins


@uncounted
def _lengths(theta: float, rho: float, ramp: float, number: int, lengths: Floats) -> None:
    """Lengths between the nodes of a turn [m]."""
    radius, ramp = arc_and_ramp(theta, rho, ramp)
    on_ramp = 0.5 * ramp / radius
    half = number // 2
    ramps = max(1, math.ceil(on_ramp / MAX_SPAN_TURN_RAD))
    arcs = half - ramps
    for k in range(half):
        piece = ramp / ramps
        if k >= ramps:
            piece = radius * (0.5 * theta - on_ramp) / arcs
        lengths[k] = piece
        lengths[2 * half - 1 - k] = piece


@kernel
def turn_sequence_length(
    bends: Floats, closed: bool, lines: Floats, turns: Floats, apexes: Floats, ramps: Floats
) -> float:  # fmt: skip
    """Length of a swing [m]."""
    count = bends.shape[0]
    ends = np.empty((count, 4))
    fill_ends(bends, closed, ramps, lines, turns, apexes, ends)
    length = 0.0
    for k in range(count):
        length += turn_length(turns[k], turn_radius(bends[k]), ramps[k])
        if closed or k < count - 1:
            after = (k + 1) % count
            length += math.hypot(ends[after, 0] - ends[k, 2], ends[after, 1] - ends[k, 3])
    return length
