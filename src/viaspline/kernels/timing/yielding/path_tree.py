"""A path in short chords, and circles round runs of them: where along it something comes near.

A point of the path at a distance s lies within ``misses`` of the same share of its chord: with arc
h and chord c it is no farther than s from the one end and h - s from the other, so it lies in a
lens of half-width sqrt(h² - c²) / 2 and is off by h - c at most along it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel


class PathTree(NamedTuple):
    """A path in chords, and a tree of circles over them.

    Attributes:
        along: Distances of the ends of chords [m], (n + 1,).
        points: The ends [m], (n + 1, 2).
        misses: How far a point of the path may be from its chord's [m], (n,).
        circles: Of the nodes in depth-first order: x, y, radius [m], (t, 3).
        runs: First chord of a node and the one after its last, (t, 2).
        skip: The node that comes after a node and all below it, (t,).
    """

    along: Floats
    points: Floats
    misses: Floats
    circles: Floats
    runs: Ints
    skip: Ints


@kernel
def path_tree(along: Floats, points: Floats) -> PathTree:
    """The tree over points of a path.

    Args:
        along: Their distances along it [m], increasing, (n + 1,).
        points: (n + 1, 2) [m].
    """
    count = along.size - 1
    misses = np.empty(count)
    for i in range(count):
        arc = along[i + 1] - along[i]
        dx = points[i + 1, 0] - points[i, 0]
        dy = points[i + 1, 1] - points[i, 1]
        chord = min(math.sqrt(dx * dx + dy * dy), arc)
        misses[i] = math.sqrt(0.25 * (arc * arc - chord * chord) + (arc - chord) ** 2)
    size = 2 * count - 1
    circles = np.empty((size, 3))
    runs = np.empty((size, 2), np.int64)
    skip = np.empty(size, np.int64)
    stack = np.empty((64, 2), np.int64)
    stack[0, 0] = 0
    stack[0, 1] = count
    depth = 1
    node = 0
    while depth > 0:
        depth -= 1
        first = stack[depth, 0]
        last = stack[depth, 1]
        runs[node, 0] = first
        runs[node, 1] = last
        skip[node] = node + 2 * (last - first) - 1
        _bound(points, misses, first, last, circles, node)
        node += 1
        if last - first > 1:
            middle = (first + last) // 2
            stack[depth, 0] = middle
            stack[depth, 1] = last
            stack[depth + 1, 0] = first
            stack[depth + 1, 1] = middle
            depth += 2
    return PathTree(along, points, misses, circles, runs, skip)


@inner
def _bound(
    points: Floats, misses: Floats, first: int, last: int, circles: Floats, node: int
) -> None:
    """A circle round the chords first to last, and all that the path may be beside them."""
    low_x = high_x = points[first, 0]
    low_y = high_y = points[first, 1]
    for i in range(first + 1, last + 1):
        low_x = min(low_x, points[i, 0])
        high_x = max(high_x, points[i, 0])
        low_y = min(low_y, points[i, 1])
        high_y = max(high_y, points[i, 1])
    x = 0.5 * (low_x + high_x)
    y = 0.5 * (low_y + high_y)
    reach = 0.0
    for i in range(first, last + 1):
        reach = max(reach, math.hypot(points[i, 0] - x, points[i, 1] - y))
    beside = 0.0
    for i in range(first, last):
        beside = max(beside, misses[i])
    circles[node, 0] = x
    circles[node, 1] = y
    circles[node, 2] = reach + beside
