"""Cut paths into cells that are short, nearly straight, and inside of one span each.

In a cell of length h on which the curvature is at most κ, the curve is never farther than h² κ / 8
from the point of the chord in the same proportion, for its second derivative by the distance is
the curvature; and never farther than h / 2, for its first one is a unit vector, at a cusp as well.

Tested through ``fleet/test_courses``.
"""

from __future__ import annotations

import math
from typing import Final

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.curve.arclength import along_panel, panel_length, speed
from viaspline.kernels.fleet.packed_paths import PackedPaths
from viaspline.kernels.growable import new_floats, new_ints, sized_floats
from viaspline.kernels.jit import inlined, inner, kernel
from viaspline.kernels.motion.path_bends import sharpest

DISTANCE: Final = 0
X: Final = 1
Y: Final = 2
BOW: Final = 3
NODE_COLUMNS: Final = 4

LONGEST_CELL = 0.5  # [m]
WIDEST_BOW = 0.02  # of a cell that is longer than SHORTEST_HALVED [m]
SHORTEST_HALVED = 0.04  # a shorter cell isn't halved for its bow [m]
STRAIGHT_BOW = 0.002  # of a longest cell on a span whose parts needn't be looked at [m]
SAME_PLACE = 1e-9  # distances nearer to each other are one place [m]
TARGET_SHARE = 0.99  # of the longest cell that is aimed at


@inlined
def _bow(curvature: float, length: float) -> float:
    """How far a part of a curve is from its evenly driven chord, at most [m]."""
    return min(0.125 * length * length * curvature, 0.5 * length)


@inlined
def _panel_at(paths: PackedPaths, panel: int, w: float) -> int:
    """The panel of a span that holds a local parameter, from an earlier panel of it on."""
    k = math.floor(paths.at[panel])
    while paths.at[panel + 1] - k < w and paths.at[panel + 1] < k + 1:
        panel += 1
    return panel


@inlined
def _distance(paths: PackedPaths, row: int, panel: int, w: float) -> float:
    """Distance along the path of a local parameter in a panel [m]."""
    k = math.floor(paths.at[panel])
    start, end = paths.at[panel] - k, paths.at[panel + 1] - k
    if w >= end:
        return paths.along[panel + 1]
    return paths.along[panel] + panel_length(paths.rows, row, start, w)


@inlined
def _parameter(paths: PackedPaths, row: int, panel: int, distance: float) -> tuple[int, float]:
    """The panel and the local parameter of a distance in a span, from an earlier panel of it on."""
    k = math.floor(paths.at[panel])
    while paths.along[panel + 1] < distance and paths.at[panel + 1] < k + 1:
        panel += 1
    start, end = paths.at[panel] - k, paths.at[panel + 1] - k
    step, whole = distance - paths.along[panel], paths.along[panel + 1] - paths.along[panel]
    if step <= 0.0:
        return panel, start
    if step >= whole:
        return panel, end
    small = 1e-12 * (1.0 + paths.along[panel])
    return panel, along_panel(paths.rows, row, start, end, step, step / whole, small)


@inlined
def _set_node(
    paths: PackedPaths, nodes: Floats, i: int, distance: float, row: int, w: float
) -> None:
    """Write a node that lies at a local parameter of a row."""
    nodes[i, DISTANCE] = distance
    nodes[i, BOW] = 0.0
    for axis in range(2):
        c = paths.rows[row, 2, axis] + w * paths.rows[row, 3, axis]
        nodes[i, X + axis] = paths.rows[row, 0, axis] + w * (paths.rows[row, 1, axis] + w * c)


@inner
def _roomy(nodes: Floats, count: int) -> Floats:
    """The table of nodes with room for one more."""
    return nodes if count < nodes.shape[0] else sized_floats(nodes, count, 2 * count)


@inlined
def _cell_end(
    paths: PackedPaths, row: int, panel: int, w: float, s: float, last_w: float, last_s: float,
    curvature: float, longest: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Where a cell ends that begins at w and s, in a stretch that ends at last_w and last_s.

    Args:
        paths: PackedPaths.
        row: The row of the span.
        panel: The panel of w.
        w: Local parameter.
        s: Distance [m].
        last_w: The end of the stretch.
        last_s: [m].
        curvature: Bound on the whole stretch [1/m].
        longest: How long the cell may be [m].

    Returns:
        (local parameter, distance, bow).
    """
    end, there = last_w, last_s
    left = last_s - s
    if left > longest:
        aim = left / math.ceil(left / (TARGET_SHARE * longest))
        rate = speed(paths.rows, row, w)
        end = w + aim / rate if rate > 0.0 else last_w
        if end < last_w:
            rate = speed(paths.rows, row, 0.5 * (w + end))
            end = w + aim / rate if rate > 0.0 else last_w
        if not w < end < last_w:
            end = 0.5 * (w + last_w)
        there = _distance(paths, row, _panel_at(paths, panel, end), end)
    while True:
        length = there - s
        known = _bow(curvature, length)
        if length <= longest:
            if known > STRAIGHT_BOW:
                known = min(known, _bow(sharpest(paths.rows, row, w, end), length))
            if known <= WIDEST_BOW or length <= SHORTEST_HALVED:
                return end, max(there, s), known
        middle = 0.5 * (w + end)
        if not w < middle < end:
            return end, max(there, s), known
        end = middle
        there = _distance(paths, row, _panel_at(paths, panel, end), end)


@inlined
def _cut_stretch(
    paths: PackedPaths, row: int, panel: int, nodes: Floats, count: int, w: float, last_w: float,
    last_s: float, curvature: float, longest: float,
) -> tuple[int, float, float]:  # fmt: skip
    """Cut a stretch of a span that begins at the last node so far, while there is room for nodes.

    Args:
        paths: PackedPaths.
        row: The row of the span.
        panel: One of w, or before that.
        nodes: So far, (room, NODE_COLUMNS).
        count: How many these are.
        w: Local parameter of the last one.
        last_w: Where the stretch ends.
        last_s: The distance there [m].
        curvature: Bound on the span [1/m].
        longest: How long the next cell may be [m].

    Returns:
        (how many nodes there are, the parameter of the last one, how long the next cell may be).
    """
    while w < last_w and count < nodes.shape[0]:
        panel = _panel_at(paths, panel, w)
        s = nodes[count - 1, DISTANCE]
        w, there, bow = _cell_end(paths, row, panel, w, s, last_w, last_s, curvature, longest)
        longest = min(LONGEST_CELL, 2.0 * max(there - s, SHORTEST_HALVED))
        if w < last_w and there <= s:
            continue  # the curve stands still to rounding: the cell goes on
        nodes[count - 1, BOW] = bow
        _set_node(paths, nodes, count, there if w < last_w else last_s, row, w)
        count += 1
    return count, w, longest


@inner
def _cut_span(
    paths: PackedPaths, row: int, panel: int, nodes: Floats, count: int, knot: int, last_knot: int
) -> tuple[Floats, int, int, int]:
    """Cut a span that begins at the last node so far.

    Args:
        paths: PackedPaths.
        row: The row of the span.
        panel: Its first panel.
        nodes: So far, (room, NODE_COLUMNS).
        count: How many these are.
        knot: The first knot that is still to come.
        last_knot: Where the knots of the path end.

    Returns:
        (nodes, how many, the first panel of the next span, the first knot that is still to come).
    """
    k = math.floor(paths.at[panel])
    after = panel
    while paths.at[after] < k + 1:
        after += 1
    end = paths.along[after]
    curvature = sharpest(paths.rows, row, 0.0, 1.0)
    w = 0.0
    while True:
        has_knot = knot < last_knot and paths.knots[knot] <= end + SAME_PLACE
        if not has_knot and (w >= 1.0 or end <= nodes[count - 1, DISTANCE]):
            return nodes, count, after, knot
        there, to, held = end, 1.0, panel
        if has_knot:
            there = paths.knots[knot]
            knot += 1
            if there < end - SAME_PLACE:
                held, to = _parameter(paths, row, panel, there)
        if there <= nodes[count - 1, DISTANCE]:
            continue
        longest = LONGEST_CELL
        to = max(to, w)
        if to == w:
            nodes = _roomy(nodes, count)
            nodes[count - 1, BOW] = there - nodes[count - 1, DISTANCE]
            _set_node(paths, nodes, count, there, row, w)
            count += 1
        while w < to:
            nodes = _roomy(nodes, count)
            count, w, longest = _cut_stretch(
                paths, row, panel, nodes, count, w, to, there, curvature, longest
            )
        panel = held


@kernel
def cut_courses(paths: PackedPaths) -> tuple[Floats, Ints]:
    """Cut the paths of a fleet at their knots, at the ends of their spans, and in between.

    Returns:
        (nodes (k, NODE_COLUMNS), first (n + 1,)): the nodes of path r are first[r] to
        first[r + 1] - 1. A path that is a single place has two.
    """
    count = paths.row_first.shape[0] - 1
    first = new_ints(count + 1, 1)
    first[0, 0] = 0
    nodes = new_floats(1024, NODE_COLUMNS)
    size = 0
    for r in range(count):
        row = paths.row_first[r]
        panel = paths.panel_first[r]
        nodes = _roomy(nodes, size)
        _set_node(paths, nodes, size, 0.0, row, 0.0)
        size += 1
        knot = paths.knot_first[r]
        for k in range(row, paths.row_first[r + 1] - 1):
            nodes, size, panel, knot = _cut_span(
                paths, k, panel, nodes, size, knot, paths.knot_first[r + 1]
            )
        if size == first[r, 0] + 1:
            nodes = _roomy(nodes, size)
            _set_node(paths, nodes, size, 0.0, row, 0.0)
            size += 1
        first[r + 1, 0] = size
    return sized_floats(nodes, size, size), first[:, 0].copy()
