"""The states that a search through poses has found, and the table of their cells.

Tested through ``planning/turning/hybrid_astar/test_pose_search``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.heap import Heap, push
from viaspline.kernels.jit import inner
from viaspline.kernels.turning.collision_cache import AHEAD, LEFT, CollisionCache, about
from viaspline.kernels.turning.dubins import dubins_length, length_to_place
from viaspline.kernels.turning.hybrid_astar.primitives import LEVELS

NO_NODE = -1  # in place of a node
CELL_SHARE = 0.6  # side of a cell, as a share of a move
# columns of a node, and of its links; a start has the parent -1 less its number
X, Y, HEADING, COST, STILL = range(5)
LEVEL, PARENT, CLOSED, SLOT, SCALE = range(5)
# columns of the scales of a search
SIDE, AROUND, ROOM = range(3)
WITHIN, MORE = range(2)
# columns of an arrival
LENGTH, FIRST, SECOND = range(3)
# counters: nodes, expanded ones, moves that left the window, connections that were tried
NODES, EXPANDED, OUTSIDE, TRIED = range(4)


class PoseSearch(NamedTuple):
    """What has been searched.

    Attributes:
        window: Where the reference point may be: x_min, y_min, x_max, y_max [m], (4,).
        scales: Side of a cell [m], cells of heading in a whole turn, and the distance of the
            body's middle to the world from which on a scale is used [m], (k, 3).
        ends_at: Where all ways begin and end [m], (e, 2).
        care: How far from there it takes more room for longer moves, and how much more [m], (2,).
        nodes: x, y, heading, cost so far, length that is still to come at least, (n, 5).
        links: Level of curvature, node before, whether it is expanded, its place in the table,
            and its scale, (n, 5).
        keys: Cells of the nodes in a table with open addressing, 0 where it is empty.
        cells: The best node in each, the same shape.
        heap: Those not expanded.
        counts: See the counters above, (4,).
        goal: x, y of the goal [m], (2,).
        headings: Those that are allowed there [rad], NaN for whichever comes straight, (h,).
        arrivals: The best with each heading: whole length, sides of the two turns, (h, 3).
        ends: The node from which it was reached, (h,).
    """

    window: Floats
    scales: Floats
    ends_at: Floats
    care: Floats
    nodes: Floats
    links: Ints
    keys: Ints
    cells: Ints
    heap: Heap
    counts: Ints
    goal: Floats
    headings: Floats
    arrivals: Floats
    ends: Ints


class Ahead(NamedTuple):
    """What is known of the way that is still to come.

    Attributes:
        frame: x, y of the corner, side of a cell [m], how greedy the search is, (4,).
        lengths: From every cell to the goal [cells], (rows, columns).
    """

    frame: Floats
    lengths: Floats


@inner
def scale_at(cache: CollisionCache, search: PoseSearch, x: float, y: float, heading: float) -> int:
    """The scale on which there are moves from a pose: the longer, the more room there is."""
    c, s = math.cos(heading), math.sin(heading)
    disc = cache.discs[0]
    room = about(cache, x + c * disc[AHEAD] - s * disc[LEFT], y + s * disc[AHEAD] + c * disc[LEFT])
    for k in range(search.ends_at.shape[0]):
        if math.hypot(x - search.ends_at[k, X], y - search.ends_at[k, Y]) < search.care[WITHIN]:
            room -= search.care[MORE]
            break
    scale = search.scales.shape[0] - 1
    while scale > 0 and room < search.scales[scale, ROOM]:
        scale -= 1
    return scale


@inner
def key_of(search: PoseSearch, x: float, y: float, heading: float, level: int, scale: int) -> int:
    """The number of the cell of a state, 0 outside the window."""
    window = search.window
    if not (window[0] <= x < window[2] and window[1] <= y < window[3]):
        return 0
    side, around = search.scales[scale, SIDE], int(search.scales[scale, AROUND])
    column = math.floor((x - window[0]) / side)
    row = math.floor((y - window[1]) / side)
    columns = math.ceil((window[2] - window[0]) / side)
    turned = heading / (2.0 * math.pi)
    sector = min(int((turned - math.floor(turned)) * around), around - 1)
    key = ((row * columns + column) * around + sector) * LEVELS + level
    return key * search.scales.shape[0] + scale + 1


@inner
def slot_of(search: PoseSearch, key: int) -> int:
    """Where a cell is in the table, or would be."""
    mask = search.keys.size - 1
    slot = ((key * 0x9E3779B97F4A7C1) ^ (key >> 7)) & mask
    while search.keys[slot] != 0 and search.keys[slot] != key:
        slot = (slot + 1) & mask
    return slot


@inner
def to_come(
    search: PoseSearch, ahead: Ahead, rho: float, x: float, y: float, heading: float
) -> float:
    """Length that is still to come at least [m]; infinite where there is no way."""
    side = ahead.frame[2]
    row = math.floor((y - ahead.frame[1]) / side)
    column = math.floor((x - ahead.frame[0]) / side)
    round_ = 0.0
    if 0 <= row < ahead.lengths.shape[0] and 0 <= column < ahead.lengths.shape[1]:
        round_ = max(ahead.lengths[row, column] - 2.0, 0.0) * side
    if round_ == np.inf:
        return round_
    dx, dy = search.goal[0] - x, search.goal[1] - y
    if search.headings.size > 2 or math.isnan(search.headings[0]):
        return max(round_, length_to_place(dx, dy, heading, rho))
    open_ = np.inf
    for k in range(search.headings.size):
        open_ = min(open_, dubins_length(dx, dy, heading, search.headings[k], rho))
    return max(round_, open_)


@inner
def add(
    search: PoseSearch, ahead: Ahead, key: int, x: float, y: float, heading: float, level: int,
    scale: int, cost: float, still: float, parent: int,
) -> None:  # fmt: skip
    """Note a state as the best of its cell, and put it into the heap."""
    node = search.counts[NODES]
    search.counts[NODES] += 1
    slot = slot_of(search, key)
    search.keys[slot] = key
    row, link = search.nodes[node], search.links[node]
    row[X], row[Y], row[HEADING], row[COST], row[STILL] = x, y, heading, cost, still
    link[LEVEL], link[PARENT], link[CLOSED] = level, parent, 0
    link[SLOT], link[SCALE] = slot, scale
    search.cells[slot] = node + 1
    push(search.heap, cost + ahead.frame[3] * still, node)
