"""A search through poses for a robot with a turning circle that only drives forwards.

Hybrid A* (D. Dolgov, S. Thrun, M. Montemerlo, J. Diebel: "Path planning for autonomous vehicles in
unknown semi-structured environments", 2010) over place, heading and curvature. The curvature is on
one of five levels from one turning circle to the other, and a move keeps it or ramps it to the next
level, so that it is continuous (A. Scheuer, Th. Fraichard: "Continuous-curvature path planning for
car-like vehicles", 1997). From states without curvature turns with ramps and a line between them
are laid to the goal, which they hit exactly.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.connect import MOST, connection
from viaspline.kernels.dubins import dubins_length, length_to_place
from viaspline.kernels.ground import AHEAD, LEFT, Ground, about, is_clear, reach
from viaspline.kernels.heap import Heap, pop, push
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.moves import COUNT, LEVELS, PACE, STEP, WAYS, Moves
from viaspline.kernels.packed import Floats, Ints

NONE = -1  # in place of a node
CELL = 0.6  # side of a cell, as a share of a move
RUNNING, FULL, EMPTY, BEATEN = range(4)
# columns of a node, and of its links; a start has the parent -1 less its number
X, Y, HEADING, COST, STILL = range(5)
LEVEL, PARENT, CLOSED, SLOT, SCALE = range(5)
# columns of the scales of a search
SIDE, AROUND, ROOM = range(3)
WITHIN, MORE = range(2)
# columns of an arrival, and of its links
LENGTH, FIRST, SECOND, HERE, THERE = range(5)
# counters: nodes, expanded ones, moves that left the window
NODES, EXPANDED, OUTSIDE = range(3)
NEAR = 3  # places ahead at which another search is looked for
LESS = 1e-6  # an arrival has to be shorter by as much to replace another [m]


class Search(NamedTuple):
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
        counts: See the counters above, (3,).
        goal: x, y of the goal [m], (2,).
        headings: Those that are allowed there [rad], NaN for whichever comes straight, (h,).
        arrivals: The best with each heading: whole length, sides of the two turns, (h, 3).
        ends: The node from which it was reached, (h,).
        meeting: The best way to what another search has found: whole length, sides of the two
            turns between the two nodes, and these, (5,).
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
    meeting: Floats


class Ahead(NamedTuple):
    """What is known of the way that is still to come.

    Attributes:
        frame: x, y of the corner, side of a cell [m], how greedy the search is, (4,).
        lengths: From every cell to the goal [cells], (rows, columns).
    """

    frame: Floats
    lengths: Floats


@inner
def _scale(ground: Ground, search: Search, x: float, y: float, heading: float) -> int:
    """The scale on which there are moves from a pose: the longer, the more room there is."""
    c, s = math.cos(heading), math.sin(heading)
    disc = ground.discs[0]
    room = about(ground, x + c * disc[AHEAD] - s * disc[LEFT], y + s * disc[AHEAD] + c * disc[LEFT])
    for k in range(search.ends_at.shape[0]):
        if math.hypot(x - search.ends_at[k, X], y - search.ends_at[k, Y]) < search.care[WITHIN]:
            room -= search.care[MORE]
            break
    scale = search.scales.shape[0] - 1
    while scale > 0 and room < search.scales[scale, ROOM]:
        scale -= 1
    return scale


@inner
def _key(search: Search, x: float, y: float, heading: float, level: int, scale: int) -> int:
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
def _slot(search: Search, key: int) -> int:
    """Where a cell is in the table, or would be."""
    mask = search.keys.size - 1
    slot = ((key * 0x9E3779B97F4A7C1) ^ (key >> 7)) & mask
    while search.keys[slot] != 0 and search.keys[slot] != key:
        slot = (slot + 1) & mask
    return slot


@inner
def _to_come(search: Search, ahead: Ahead, rho: float, x: float, y: float, heading: float) -> float:
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
def _add(
    search: Search, ahead: Ahead, key: int, x: float, y: float, heading: float, level: int,
    scale: int, cost: float, still: float, parent: int,
) -> None:  # fmt: skip
    node = search.counts[NODES]
    search.counts[NODES] += 1
    slot = _slot(search, key)
    search.keys[slot] = key
    row, link = search.nodes[node], search.links[node]
    row[X], row[Y], row[HEADING], row[COST], row[STILL] = x, y, heading, cost, still
    link[LEVEL], link[PARENT], link[CLOSED] = level, parent, 0
    link[SLOT], link[SCALE] = slot, scale
    search.cells[slot] = node + 1
    push(search.heap, cost + ahead.frame[3] * still, node)


@kernel
def set_off(ground: Ground, search: Search, ahead: Ahead, rho: float, starts: Floats) -> None:
    """Begin a search.

    Args:
        ground: Ground.
        search: Search, empty.
        ahead: Ahead.
        rho: The least radius [m].
        starts: x, y, heading and cost so far of each, (n, 4).
    """
    for k in range(search.headings.size):
        search.arrivals[k, LENGTH] = np.inf
        search.ends[k] = NONE
    search.meeting[LENGTH] = np.inf
    for k in range(starts.shape[0]):
        x, y, heading = starts[k, 0], starts[k, 1], starts[k, 2]
        scale = _scale(ground, search, x, y, heading)
        key = _key(search, x, y, heading, LEVELS // 2, scale)
        still = _to_come(search, ahead, rho, x, y, heading)
        if key != 0 and still < np.inf:
            level = LEVELS // 2
            _add(search, ahead, key, x, y, heading, level, scale, starts[k, 3], still, -1 - k)


@inner
def _arrive(
    ground: Ground, moves: Moves, search: Search, node: int, bound: float, segments: Floats
) -> bool:
    """Try to reach the goal straight from a node; whether an arrival has become shorter."""
    rho, ramp = moves.sizes[0], moves.sizes[1]
    x, y, heading, cost, _ = search.nodes[node]
    dx, dy = search.goal[0] - x, search.goal[1] - y
    found = False
    for k in range(search.headings.size):
        goal = search.headings[k]
        best = min(search.arrivals[k, LENGTH], bound) - LESS - cost
        if best <= search.nodes[node, STILL]:
            continue
        for s1 in (1.0, -1.0):
            for s2 in (1.0, -1.0):
                if math.isnan(goal) and s2 < 0.0:
                    continue
                count, length = connection(dx, dy, heading, goal, s1, s2, rho, ramp, segments)
                if length < best and is_clear(ground, x, y, heading, segments, count):
                    best = length
                    arrival = search.arrivals[k]
                    arrival[LENGTH], arrival[FIRST], arrival[SECOND] = cost + length, s1, s2
                    search.ends[k] = node
                    found = True
    return found


@inner
def _meet(
    ground: Ground, moves: Moves, search: Search, other: Search, node: int, segments: Floats
) -> bool:
    """Try to reach what another search, which comes the other way, has found close ahead.

    Returns:
        Whether a way between the two has become shorter.
    """
    rho, ramp = moves.sizes[0], moves.sizes[1]
    x, y, heading, cost, _ = search.nodes[node]
    found = False
    for k in range(NEAR):
        gap = (k + 1) * max(0.5 * rho, 4.5 * ramp)
        to_x, to_y = x + gap * math.cos(heading), y + gap * math.sin(heading)
        scale = _scale(ground, other, to_x, to_y, heading)
        key = _key(other, to_x, to_y, heading + math.pi, LEVELS // 2, scale)
        if key == 0:
            continue
        there = other.cells[_slot(other, key)] - 1
        if there < 0:
            continue
        to_x, to_y, turned, rest, _ = other.nodes[there]
        dx, dy, goal = to_x - x, to_y - y, turned + math.pi
        for s1 in (1.0, -1.0):
            for s2 in (1.0, -1.0):
                count, length = connection(dx, dy, heading, goal, s1, s2, rho, ramp, segments)
                whole = cost + length + rest
                if whole < search.meeting[LENGTH] - LESS and is_clear(
                    ground, x, y, heading, segments, count
                ):
                    met = search.meeting
                    met[LENGTH], met[FIRST], met[SECOND] = whole, s1, s2
                    met[HERE], met[THERE] = node, there
                    found = True
    return found


@inner
def _is_free(
    ground: Ground, moves: Moves, row: int, x: float, y: float, c: float, s: float
) -> bool:
    """Whether the body surely gets along a move."""
    scale = row // (LEVELS * WAYS)
    half, pace = 0.5 * ground.frame[3], moves.scales[scale, PACE]
    last = int(moves.scales[scale, COUNT]) - 1
    k = 0
    while True:
        dx, dy, cosine, sine = moves.places[row, k]
        room = reach(
            ground, x + c * dx - s * dy, y + s * dx + c * dy, c * cosine - s * sine,
            s * cosine + c * sine,
        )  # fmt: skip
        if room < half:
            return False
        if k == last:
            return True
        k = min(last, k + max(1, int(min((room + half) / pace, 1e6))))


@inner
def _expand(ground: Ground, moves: Moves, search: Search, ahead: Ahead, node: int) -> None:
    """Do every move from a node."""
    x, y, heading, cost, _ = search.nodes[node]
    level, scale = search.links[node, LEVEL], search.links[node, SCALE]
    c, s = math.cos(heading), math.sin(heading)
    last = int(moves.scales[scale, COUNT]) - 1
    for way in range(WAYS):
        if not 0 <= level + way - 1 < LEVELS:
            continue
        row = (scale * LEVELS + level) * WAYS + way
        dx, dy = moves.places[row, last, 0], moves.places[row, last, 1]
        to_x, to_y, to = x + c * dx - s * dy, y + s * dx + c * dy, heading + moves.turns[row]
        to_scale = _scale(ground, search, to_x, to_y, to)
        key = _key(search, to_x, to_y, to, level + way - 1, to_scale)
        if key == 0:
            search.counts[OUTSIDE] += 1
            continue
        other, more = search.cells[_slot(search, key)] - 1, cost + moves.scales[scale, STEP]
        if other >= 0 and (search.links[other, CLOSED] != 0 or search.nodes[other, COST] <= more):
            continue
        still = _to_come(search, ahead, moves.sizes[0], to_x, to_y, to)
        if still < np.inf and _is_free(ground, moves, row, x, y, c, s):
            _add(search, ahead, key, to_x, to_y, to, level + way - 1, to_scale, more, still, node)


@kernel
def go_on(
    ground: Ground, moves: Moves, search: Search, other: Search, ahead: Ahead, quota: int,
    bound: float,
) -> int:  # fmt: skip
    """Expand some nodes.

    Args:
        ground: Ground.
        moves: Moves.
        search: Search, written in place.
        other: One that comes the other way.
        ahead: Ahead.
        quota: How many nodes at most; it also ends with an arrival or a meeting.
        bound: Arrivals as long as this don't count [m].

    Returns:
        RUNNING: there are more; FULL: there is no room for more; EMPTY: everything that can be
        reached has been; BEATEN: what is left is no better than the bound.
    """
    segments = np.empty((MOST, 3))
    for _ in range(quota):
        if search.heap.size[0] == 0:
            return EMPTY
        if search.counts[NODES] + WAYS > search.nodes.shape[0]:
            return FULL
        key = search.heap.keys[0]
        node = pop(search.heap)
        if search.links[node, CLOSED] != 0:
            continue
        if key >= bound:
            return BEATEN
        search.links[node, CLOSED] = 1
        row = search.nodes[node]
        if search.cells[search.links[node, SLOT]] - 1 != node:
            continue
        search.counts[EXPANDED] += 1
        _expand(ground, moves, search, ahead, node)
        if search.links[node, LEVEL] != LEVELS // 2:
            continue
        if _meet(ground, moves, search, other, node, segments):
            return RUNNING
        every = 1 + int(row[STILL] / moves.sizes[0])  # the farther, the less it is worth a try
        if search.counts[EXPANDED] % every > 1:
            continue
        if _arrive(ground, moves, search, node, bound, segments):
            return RUNNING
    return RUNNING


@kernel
def path_to(moves: Moves, search: Search, node: int) -> tuple[Floats, int]:
    """The way to a node.

    Returns:
        Segments (n, 3), see ``ground``, and the number of the start.
    """
    size, at = 0, node
    while search.links[at, PARENT] >= 0:
        at = search.links[at, PARENT]
        size += 1
    segments = np.zeros((2 * size, 3))
    start = -1 - search.links[at, PARENT]
    at = node
    for step in range(size - 1, -1, -1):
        parent = search.links[at, PARENT]
        level = search.links[parent, LEVEL]
        scale = search.links[parent, SCALE]
        row = (scale * LEVELS + level) * WAYS + search.links[at, LEVEL] - level + 1
        for i in range(2):
            for column in range(3):
                segments[2 * step + i, column] = moves.segments[row, i, column]
        at = parent
    return segments, start


@kernel
def connected(moves: Moves, dx: float, dy: float, start: float, goal: float, s1: float,
              s2: float) -> Floats:  # fmt: skip
    """The segments of a connection, see ``connect.connection``."""
    segments = np.empty((MOST, 3))
    count, _ = connection(dx, dy, start, goal, s1, s2, moves.sizes[0], moves.sizes[1], segments)
    return segments[:count].copy()


@kernel
def bridge(
    ground: Ground, moves: Moves, there: Search, back: Search, out: Ints, home: Ints
) -> tuple[float, int, int, float, float]:
    """Connect a search from the start with one that comes backwards from the goal.

    Args:
        ground: Ground.
        moves: Moves.
        there: The search from the start.
        back: The search from the goal, with all headings turned round.
        out: Nodes without curvature of the first, (n,).
        home: The same of the second, (m,).

    Returns:
        Length of the shortest way [m], infinite if there is none; the two nodes; the sides of the
        two turns between them.
    """
    segments = np.empty((MOST, 3))
    best, first, last, side1, side2 = np.inf, NONE, NONE, 0.0, 0.0
    for i in range(out.size):
        x, y, heading, cost, _ = there.nodes[out[i]]
        for j in range(home.size):
            to_x, to_y, turned, rest, _ = back.nodes[home[j]]
            dx, dy, goal = to_x - x, to_y - y, turned + math.pi
            if cost + rest + math.hypot(dx, dy) >= best:
                continue
            for s1 in (1.0, -1.0):
                for s2 in (1.0, -1.0):
                    count, length = connection(
                        dx, dy, heading, goal, s1, s2, moves.sizes[0], moves.sizes[1], segments
                    )
                    if cost + rest + length < best and is_clear(
                        ground, x, y, heading, segments, count
                    ):
                        best, first, last = cost + rest + length, out[i], home[j]
                        side1, side2 = s1, s2
    return best, first, last, side1, side2
