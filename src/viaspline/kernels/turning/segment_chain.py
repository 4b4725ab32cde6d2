"""Chains of segments of evenly changing curvature: made simpler, shortened, laid as spans.

Tested through ``planning/turning/hybrid_astar/test_pose_search``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.turning.clothoid import MAX_SPAN_TURN_RAD, spans_between
from viaspline.kernels.turning.collision_cache import (
    FROM,
    LENGTH,
    TO,
    CollisionCache,
    is_clear,
    looked_at,
)
from viaspline.kernels.turning.connect import MAX_SEGMENTS, connection
from viaspline.kernels.turning.curvature_ramp import along_bend

CURVATURE_TOLERANCE = 1e-9  # relative to the curvature, or its change, of the turning circle
MIN_LINE_M = 1e-3  # line that is laid by itself [m]
MIN_SHORTCUT_M = 1e-4  # by which a shortcut has to be shorter [m]
TO_STATE, FROM_STATE = range(2)  # of a pair of states


class Shortcuts(NamedTuple):
    """The best shortcuts between states along a chain, as far as they were looked for.

    Attributes:
        costs: Length of the best way to each state [m], (k,).
        before: The state that it comes from, (k,).
        sides: To which sides its two turns go; 0 where it is the chain itself, (k, 2).
        cursor: The pair of states that comes next, (2,): see ``TO_STATE``.
    """

    costs: Floats
    before: Ints
    sides: Floats
    cursor: Ints


@kernel
def merged(segments: Floats, rho: float) -> Floats:
    """A chain with as few segments as it has.

    Args:
        segments: See ``cache``, (n, 3).
        rho: The least radius [m].
    """
    found = np.zeros((segments.shape[0], 3))
    size = 0
    for k in range(segments.shape[0]):
        first, last, length = segments[k]
        if length <= 1e-12 * rho:
            continue
        if size > 0:
            before = found[size - 1]
            slope = (before[TO] - before[FROM]) / before[LENGTH]
            other = (last - first) / length
            if (
                abs(slope - other) <= CURVATURE_TOLERANCE / rho**2
                and abs(before[TO] - first) <= CURVATURE_TOLERANCE / rho
            ):
                before[TO] = last
                before[LENGTH] += length
                continue
        found[size, FROM], found[size, TO], found[size, LENGTH] = first, last, length
        size += 1
    return found[:size].copy()


@inner
def _divided(segments: Floats, spacing: float) -> Floats:
    """A chain with every line in equal parts of at most ``spacing`` [m]."""
    count = 0
    for k in range(segments.shape[0]):
        flat = segments[k, FROM] == 0.0 and segments[k, TO] == 0.0
        count += max(1, math.ceil(segments[k, LENGTH] / spacing)) if flat else 1
    parts = np.zeros((count, 3))
    size = 0
    for k in range(segments.shape[0]):
        first, last, length = segments[k]
        flat = first == 0.0 and last == 0.0
        pieces = max(1, math.ceil(length / spacing)) if flat else 1
        for _ in range(pieces):
            parts[size, FROM], parts[size, TO], parts[size, LENGTH] = first, last, length / pieces
            size += 1
    return parts


@inner
def _stations(start: Floats, goal: Floats, parts: Floats, poses: Floats, begins: Ints) -> int:
    """Poses without curvature along a chain, with the length up to them; returns how many."""
    x, y, heading = start[0], start[1], start[2]
    so_far = 0.0
    size = 0
    for k in range(parts.shape[0] + 1):
        flat = k in (0, parts.shape[0]) or (parts[k - 1, TO] == 0.0 and parts[k, FROM] == 0.0)
        if flat:
            poses[size, 0], poses[size, 1], poses[size, 2], poses[size, 3] = x, y, heading, so_far
            begins[size] = k
            size += 1
        if k < parts.shape[0]:
            first, last, length = parts[k]
            dx, dy, turn = along_bend(first, last, length, length)
            c, s = math.cos(heading), math.sin(heading)
            x, y, heading = x + c * dx - s * dy, y + s * dx + c * dy, heading + turn
            so_far += length
    poses[size - 1, 0], poses[size - 1, 1] = goal[0], goal[1]
    if not math.isnan(goal[2]):
        poses[size - 1, 2] = goal[2]
    return size


@kernel
def shortcut_states(
    start: Floats, goal: Floats, segments: Floats, spacing: float
) -> tuple[Floats, Floats, Ints]:
    """States without curvature along a chain, between which shortcuts are tried.

    Args:
        start: x, y, heading, (3,).
        goal: The same; a heading of NaN is free, (3,).
        segments: See ``collision_cache``, (n, 3).
        spacing: Between the states on a line, at most [m].

    Returns:
        (the chain in parts, (m, 3); x, y, heading and the length so far of each state, (k, 4); the
        part with which each begins, (k,)).
    """
    parts = _divided(segments, spacing)
    poses, begins = np.empty((parts.shape[0] + 1, 4)), np.empty(parts.shape[0] + 1, np.int64)
    count = _stations(start, goal, parts, poses, begins)
    return parts, poses[:count].copy(), begins[:count].copy()


@kernel
def look_for_shortcuts(
    cache: CollisionCache, goal: Floats, poses: Floats, found: Shortcuts, rho: float, ramp: float,
    effort: int,
) -> None:  # fmt: skip
    """Replace parts of a chain by turn, line, turn where that is shorter and clear, as far as goes.

    The best row of such shortcuts between states without curvature: dynamic programming.

    Args:
        cache: Ground.
        goal: See ``shortcut_states``.
        poses: The states.
        found: What is found, written in place; it is over when ``cursor[TO_STATE]`` is past the
            last state.
        rho: The least radius [m].
        ramp: Length of the ramps [m].
        effort: How many distances are reckoned and connections tried, about: it ends with the pair
            of states in which that becomes more.
    """
    costs, count = found.costs, poses.shape[0]
    trial = np.empty((MAX_SEGMENTS, 3))
    last, tried = looked_at(cache) + effort, 0
    j, i = found.cursor[TO_STATE], found.cursor[FROM_STATE]
    while j < count:
        if i == 0:
            costs[j] = costs[j - 1] + poses[j, 3] - poses[j - 1, 3]
            found.before[j] = j - 1
        heading = goal[2] if j == count - 1 else poses[j, 2]
        while i < j and looked_at(cache) + tried < last:
            dx, dy = poses[j, 0] - poses[i, 0], poses[j, 1] - poses[i, 1]
            if costs[i] + math.hypot(dx, dy) >= costs[j] - MIN_SHORTCUT_M:
                i += 1
                continue
            for s1 in (1.0, -1.0):
                for s2 in (1.0, -1.0):
                    if math.isnan(heading) and s2 < 0.0:
                        continue
                    tried += 1
                    size, length = connection(
                        dx, dy, poses[i, 2], heading, s1, s2, rho, ramp, trial
                    )
                    if costs[i] + length < costs[j] - MIN_SHORTCUT_M and is_clear(
                        cache, poses[i, 0], poses[i, 1], poses[i, 2], trial, size
                    ):
                        costs[j], found.before[j] = costs[i] + length, i
                        found.sides[j, 0], found.sides[j, 1] = s1, s2
            i += 1
        if i < j:
            break
        j, i = j + 1, 0
    found.cursor[TO_STATE], found.cursor[FROM_STATE] = j, i


@kernel
def with_shortcuts(
    goal: Floats, parts: Floats, poses: Floats, begins: Ints, found: Shortcuts, rho: float,
    ramp: float,
) -> Floats:  # fmt: skip
    """The segments of the best row of shortcuts, (k, 3); see ``look_for_shortcuts``."""
    return _rebuilt(goal, parts, poses, begins, found.before, found.sides, rho, ramp)


@inner
def _rebuilt(
    goal: Floats, parts: Floats, poses: Floats, begins: Ints, before: Ints, sides: Floats,
    rho: float, ramp: float,
) -> Floats:  # fmt: skip
    """The segments of the best row of shortcuts."""
    last = before.size - 1
    follows = np.zeros(last + 1, np.int64)
    j = last
    while j > 0:
        follows[before[j]] = j
        j = before[j]
    found = np.zeros((parts.shape[0] + MAX_SEGMENTS * (last + 1), 3))
    size, i = 0, 0
    while i < last:
        j = follows[i]
        if sides[j, 0] != 0.0:
            heading = goal[2] if j == last else poses[j, 2]
            more, _ = connection(
                poses[j, 0] - poses[i, 0], poses[j, 1] - poses[i, 1], poses[i, 2], heading,
                sides[j, 0], sides[j, 1], rho, ramp, found[size:],
            )  # fmt: skip
            size += more
        else:
            for k in range(begins[i], begins[j]):
                for column in range(3):
                    found[size, column] = parts[k, column]
                size += 1
        i = j
    return found[:size].copy()


@inner
def _nodes(start: Floats, segments: Floats, nodes: Floats, lengths: Floats) -> int:
    """Places along a chain between which spans are laid, with the lengths between them."""
    x, y, heading = start[0], start[1], start[2]
    nodes[0, 0], nodes[0, 1], nodes[0, 2], nodes[0, 3] = x, y, heading, 0.0
    size = 1
    over = 0.0
    for k in range(segments.shape[0]):
        first, last, length = segments[k]
        flat = first == 0.0 and last == 0.0
        is_sliver = flat and length < MIN_LINE_M and segments.shape[0] > 1
        _, _, turn = along_bend(first, last, length, length)
        pieces = 1 if flat else max(1, math.ceil(abs(turn) / MAX_SPAN_TURN_RAD - 1e-9))
        c, s = math.cos(heading), math.sin(heading)
        for i in range(1, pieces + 1):
            at = length * i / pieces
            dx, dy, turned = along_bend(first, last, length, at)
            to = nodes[size]
            if is_sliver and size > 1 and k == segments.shape[0] - 1:
                to = nodes[size - 1]
                lengths[size - 2] += length
            to[0], to[1] = x + c * dx - s * dy, y + s * dx + c * dy
            to[2], to[3] = heading + turned, first + (last - first) * at / length
            if is_sliver:
                over += length
            else:
                lengths[size - 1] = length / pieces + over
                over = 0.0
                size += 1
        _, _, turn = along_bend(first, last, length, length)
        dx, dy, _ = along_bend(first, last, length, length)
        x, y, heading = x + c * dx - s * dy, y + s * dx + c * dy, heading + turn
    return size


@kernel
def chain_spans(start: Floats, goal: Floats, segments: Floats) -> Floats:
    """Lay a chain as spans, lines as one cubic each and bends as three for every 0.4 rad.

    Args:
        start: x, y, heading, (3,).
        goal: Where the chain ends but for rounding; a heading of NaN is free, (3,).
        segments: See ``cache``, (n, 3).

    Returns:
        Bézier control polygons (m, 4, 2) [m].
    """
    room, total = 2, 0.0
    for k in range(segments.shape[0]):
        bend = max(abs(segments[k, FROM]), abs(segments[k, TO]))
        room += 1 + math.ceil(bend * segments[k, LENGTH] / MAX_SPAN_TURN_RAD)
        total += segments[k, LENGTH]
    nodes, lengths = np.empty((room, 4)), np.empty(room)
    count = _nodes(start, segments, nodes, lengths)
    off_x, off_y = goal[0] - nodes[count - 1, 0], goal[1] - nodes[count - 1, 1]
    if not math.isnan(goal[2]):
        nodes[count - 1, 2] = goal[2]
    so_far = 0.0
    for k in range(1, count):
        so_far += lengths[k - 1]
        nodes[k, 0] += off_x * so_far / total
        nodes[k, 1] += off_y * so_far / total
    nodes[count - 1, 0], nodes[count - 1, 1] = goal[0], goal[1]
    polygons = np.empty((3 * count, 4, 2))
    size = 0
    for k in range(count - 1):
        gap = abs(math.sin(nodes[k + 1, 2] - nodes[k, 2]))
        if nodes[k, 3] == 0.0 and nodes[k + 1, 3] == 0.0 and gap < 1e-7:
            for i in range(4):
                for axis in range(2):
                    a, b = nodes[k, axis], nodes[k + 1, axis]
                    polygons[size, i, axis] = a + (b - a) * i / 3.0
            size += 1
        else:
            spans_between(nodes[k : k + 2], 2, lengths[k : k + 1], polygons[size : size + 3])
            size += 3
    return polygons[:size].copy()
