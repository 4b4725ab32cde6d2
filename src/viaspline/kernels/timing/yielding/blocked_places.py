"""Which places of a path are blocked at which instants, by things that move.

A law is checked at instants a step apart. Between two of them the robot moves, as seen from an
obstacle, along a curve of at most L that lies within a sag of its chord; a chord at most L long
with both ends at least sqrt((D + sag)² + L²/4) from a set K stays D + sag from it (the point of K
that is nearest to it is farther than that from both ends). So places nearer than that are blocked.
What moves is blocked as if each piece of its motion began a step sooner and ended a step later:
then both ends of every step know all pieces in it, and jumps as well.

Tested through ``trajectory/yielding/test_law_among``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inlined, inner, kernel
from viaspline.kernels.motion.moving_distance import piece_at, piece_distance, uncertainty
from viaspline.kernels.motion.packed_motion import (
    BEGINS,
    HEADING,
    KNOWN,
    PRESENT,
    SPEED_X,
    SPEED_Y,
    TURNING,
    PackedMotion,
    X,
    Y,
)
from viaspline.kernels.timing.yielding.bit_rows import Words, add_places
from viaspline.kernels.timing.yielding.path_tree import PathTree

SPLITS = 40  # how often a chord is halved at most
MANY_EDGES = 64  # a look at a shape with so many counts twice, with twice as many thrice


class Driving(NamedTuple):
    """What every law keeps among things that move.

    Attributes:
        required: From the robot's centre to every shape [m].
        top: Largest speed [m/s].
        along: Largest acceleration along the path, either way [m/s²].
        across: Largest acceleration across it [m/s²].
        step: Between two instants at which a law is checked [s]; 0: what is blocked at each instant
            is asked for, and nothing between them.
    """

    required: float
    top: float
    along: float
    across: float
    step: float


class PlaceGrid(NamedTuple):
    """Instants, and the places of each that are looked at.

    Attributes:
        begin: The first instant [s].
        step: From one to the next [s].
        origin: Place 0, as a distance along the path [m].
        pitch: From one place to the next [m].
        widen: By so much more is blocked at each second instant, which lie in the middle of a step
            of the law, where it is between two places [m].
        bases: The place that is bit 0 at each instant, (r,).
    """

    begin: float
    step: float
    origin: float
    pitch: float
    widen: float
    bases: Ints


@inlined
def _keep_off(
    driving: Driving, radius: float, straight: float, turning: float, reach: float
) -> float:
    """How far both ends of a step have to be from the core of a shape with a radius [m]."""
    distance = driving.required + radius
    step = driving.step
    far = distance + reach + (driving.top + straight) * step
    pace = driving.top + straight + turning * far
    bent = driving.along + driving.across + turning * (2.0 * pace + turning * far)
    return math.hypot(distance + 0.125 * step * step * bent, 0.5 * pace * step)


@inlined
def _meeting(dx: float, dy: float, vx: float, vy: float, reach: float) -> tuple[float, float]:
    """From when to when a point at d + v t is within a reach of 0; from > to: never."""
    square = vx * vx + vy * vy
    gap = dx * dx + dy * dy - reach * reach
    if square == 0.0:
        return (-np.inf, np.inf) if gap < 0.0 else (np.inf, -np.inf)
    half = (dx * vx + dy * vy) / square
    root = half * half - gap / square
    if root < 0.0:
        return np.inf, -np.inf
    root = math.sqrt(root)
    return -half - root, -half + root


@inlined
def _instants(grid: PlaceGrid, begin: float, end: float) -> tuple[int, int]:
    """The first and the last instant from one time to another; first > last: there is none."""
    low = math.ceil((begin - grid.begin) / grid.step - 1e-9)
    high = math.floor((end - grid.begin) / grid.step + 1e-9)
    return int(max(low, 0)), int(min(high, grid.bases.size - 1))


@inlined
def _add_stretch(grid: PlaceGrid, row: int, low: float, high: float, rows: Words) -> None:
    """Block the places between two distances along the path, at an instant."""
    wide = 1e-9 + (grid.widen if row & 1 else 0.0)
    first = math.ceil((low - wide - grid.origin) / grid.pitch) - grid.bases[row]
    last = math.floor((high + wide - grid.origin) / grid.pitch) - grid.bases[row]
    add_places(rows, row, first, last)


@inlined
def _block_by_disc(
    tree: PathTree, leaf: int, x: float, y: float, reach: float, grid: PlaceGrid, row: int,
    rows: Words,
) -> None:  # fmt: skip
    """Block what is within a reach of (x, y) on a chord."""
    ax, ay = tree.points[leaf, 0], tree.points[leaf, 1]
    ex, ey = tree.points[leaf + 1, 0] - ax, tree.points[leaf + 1, 1] - ay
    chord = math.hypot(ex, ey)
    begin, end = tree.along[leaf], tree.along[leaf + 1]
    reach = max(reach + tree.misses[leaf], 0.0)
    if chord <= 1e-12:
        if math.hypot(x - ax, y - ay) < reach:
            _add_stretch(grid, row, begin, end, rows)
        return
    on = ((x - ax) * ex + (y - ay) * ey) / chord
    off = ((x - ax) * ey - (y - ay) * ex) / chord
    root = reach * reach - off * off
    if root <= 0.0:
        return
    root = math.sqrt(root)
    low, high = max(on - root, 0.0), min(on + root, chord)
    if low <= high:
        scale = (end - begin) / chord
        _add_stretch(grid, row, begin + low * scale, begin + high * scale, rows)


@inner
def _block_by_chord(
    motion: PackedMotion, i: int, piece: int, shift: float, instant: float, reach: float,
    tree: PathTree, leaf: int, grid: PlaceGrid, row: int, stack: Floats, rows: Words,
) -> int:  # fmt: skip
    """Block what is nearer than a reach to an obstacle on a chord, which is halved for that.

    Returns:
        At how many places it was looked how near the obstacle is.
    """
    begin, end = tree.along[leaf], tree.along[leaf + 1]
    ax, ay = tree.points[leaf, 0], tree.points[leaf, 1]
    ex, ey = tree.points[leaf + 1, 0] - ax, tree.points[leaf + 1, 1] - ay
    chord = math.hypot(ex, ey)
    stack[0, 0], stack[0, 1] = 0.0, 1.0
    depth, seen = 1, 0
    while depth > 0:
        depth -= 1
        seen += 1
        low, high = stack[depth, 0], stack[depth, 1]
        share, half = 0.5 * (low + high), 0.5 * (high - low)
        x, y = ax + share * ex, ay + share * ey
        gap = piece_distance(motion, i, piece, shift, instant, x, y, np.inf)
        gap -= tree.misses[leaf] + reach
        if gap >= half * chord:
            continue
        if gap <= -half * chord or half * (end - begin) <= 0.25 * grid.pitch or depth >= SPLITS:
            _add_stretch(grid, row, begin + low * (end - begin), begin + high * (end - begin), rows)
            continue
        stack[depth, 0], stack[depth, 1] = share, high
        stack[depth + 1, 0], stack[depth + 1, 1] = low, share
        depth += 2
    return seen


@inner
def _block_by_shape(
    motion: PackedMotion, i: int, piece: int, shift: float, instant: float, reach: float,
    tree: PathTree, top: int, first: float, last: float, grid: PlaceGrid, row: int,
    stack: Floats, rows: Words,
) -> int:  # fmt: skip
    """Block what is nearer than a reach to an obstacle at an instant, and between two places.

    A run of chords that is near it as a whole is blocked as one. Only what is below one node of the
    path's tree is looked at.

    Returns:
        How many nodes of the path's tree, and places of chords, were looked at.
    """
    node, seen = top, 0
    while node < tree.skip[top]:
        run, circle = tree.runs[node], tree.circles[node]
        begin, end = tree.along[run[0]], tree.along[run[1]]
        after = tree.skip[node]
        if end < first or begin > last:
            node = after
            continue
        seen += 1
        far = max(reach + circle[2], 0.0)
        gap = piece_distance(motion, i, piece, shift, instant, circle[0], circle[1], far)
        if gap < far:
            if gap <= reach - circle[2]:
                _add_stretch(grid, row, begin, end, rows)
            elif run[1] - run[0] > 1:
                after = node + 1
            else:
                seen += _block_by_chord(
                    motion, i, piece, shift, instant, reach, tree, run[0], grid, row, stack, rows
                )
        node = after
    return seen


@inner
def _shape_blocks(
    motion: PackedMotion, i: int, row: int, shift: float, begin: float, end: float,
    driving: Driving, tree: PathTree, first: float, last: float, grid: PlaceGrid, rows: Words,
) -> int:  # fmt: skip
    """``_piece_blocks`` for what isn't a disc that goes straight.

    Runs of the path that are longer than the shape are told by when it may meet their circles, and
    shorter ones by where it is.
    """
    piece = motion.pieces[row]
    head = motion.shapes.heads[motion.shapes.slot[i]]
    known = shift + piece[KNOWN]
    turning, reach = abs(piece[TURNING]), motion.reaches[i]
    straight = math.hypot(piece[SPEED_X], piece[SPEED_Y])
    off = _keep_off(driving, reach + uncertainty(motion, i, end), straight, turning, reach)
    stack = np.empty((SPLITS + 2, 2))
    node, seen = 0, 1
    while node < tree.skip.size:
        run, circle = tree.runs[node], tree.circles[node]
        if tree.along[run[1]] < first or tree.along[run[0]] > last:
            node = tree.skip[node]
            continue
        since, until = _meeting(
            piece[X] - circle[0], piece[Y] - circle[1], piece[SPEED_X], piece[SPEED_Y],
            circle[2] + off,
        )  # fmt: skip
        low, high = _instants(grid, max(since + known, begin), min(until + known, end))
        is_small = circle[2] <= reach or run[1] - run[0] == 1
        if low <= high and not is_small:
            node += 1
            continue
        for k in range(low, high + 1):
            instant = grid.begin + k * grid.step
            unsure = uncertainty(motion, i, instant + driving.step)
            near = _keep_off(driving, head[2] + unsure, straight, turning, reach)
            near -= head[2] + uncertainty(motion, i, instant)
            seen += _block_by_shape(
                motion, i, row, shift, instant, near, tree, node, first, last, grid, k, stack, rows
            )
        node = tree.skip[node]
    rings = motion.shapes.ring_edges
    slot = motion.shapes.slot[i]
    return seen * (1 + (rings[slot + 1] - rings[slot]) // MANY_EDGES)


@inner
def _disc_blocks(
    motion: PackedMotion, i: int, row: int, shift: float, begin: float, end: float,
    driving: Driving, tree: PathTree, first: float, last: float, grid: PlaceGrid, rows: Words,
) -> int:  # fmt: skip
    """``_piece_blocks`` for a disc that goes straight."""
    piece = motion.pieces[row]
    head = motion.shapes.heads[motion.shapes.slot[i]]
    vx, vy = piece[SPEED_X], piece[SPEED_Y]
    c, s = math.cos(piece[HEADING]), math.sin(piece[HEADING])
    x = piece[X] + c * head[0] - s * head[1]
    y = piece[Y] + s * head[0] + c * head[1]
    straight = math.hypot(vx, vy)
    off = _keep_off(driving, head[2] + uncertainty(motion, i, end), straight, 0.0, 0.0)
    known = shift + piece[KNOWN]
    node, seen = 0, 1
    while node < tree.skip.size:
        seen += 1
        run = tree.runs[node]
        if tree.along[run[1]] < first or tree.along[run[0]] > last:
            node = tree.skip[node]
            continue
        circle = tree.circles[node]
        since, until = _meeting(x - circle[0], y - circle[1], vx, vy, circle[2] + off)
        low, high = _instants(grid, max(since + known, begin), min(until + known, end))
        if low > high:
            node = tree.skip[node]
            continue
        if run[1] - run[0] > 1:
            node += 1
            continue
        for k in range(low, high + 1):
            instant = grid.begin + k * grid.step
            unsure = uncertainty(motion, i, instant + driving.step)
            near = _keep_off(driving, head[2] + unsure, straight, 0.0, 0.0)
            late = instant - known
            seen += 1
            _block_by_disc(tree, run[0], x + vx * late, y + vy * late, near, grid, k, rows)
        node += 1
    return seen


@inner
def _piece_blocks(
    motion: PackedMotion, i: int, row: int, shift: float, begin: float, end: float,
    driving: Driving, tree: PathTree, first: float, last: float, grid: PlaceGrid, rows: Words,
) -> int:  # fmt: skip
    """Block what a piece of motion blocks from one time to another, and between two places.

    Returns:
        How many chords, nodes of the path's tree and places of chords were looked at; of a shape
        with many edges a multiple of that.
    """
    head = motion.shapes.heads[motion.shapes.slot[i]]
    is_centred = head[0] == 0.0 and head[1] == 0.0
    if head[3] == 1.0 and (motion.pieces[row, TURNING] == 0.0 or is_centred):
        return _disc_blocks(
            motion, i, row, shift, begin, end, driving, tree, first, last, grid, rows
        )
    return _shape_blocks(motion, i, row, shift, begin, end, driving, tree, first, last, grid, rows)


@kernel
def block_places(
    motion: PackedMotion, driving: Driving, tree: PathTree, first: float, last: float,
    grid: PlaceGrid, rows: Words,
) -> int:  # fmt: skip
    """Block the places of a path at instants.

    Args:
        motion: What moves.
        driving: What the law keeps.
        tree: The path.
        first: Only places from this distance along the path on matter [m].
        last: And up to this one [m].
        grid: Which instants and places.
        rows: Where blocked places are added, (r, w).

    Returns:
        How many pieces of motion, chords and places of chords were looked at.
    """
    start = grid.begin - driving.step
    stop = grid.begin + grid.bases.size * grid.step
    seen = 0
    for i in range(motion.first_piece.size - 1):
        row, shift, until = piece_at(motion, i, start)
        begin = -np.inf
        while begin <= stop:
            if motion.pieces[row, PRESENT] != 0.0:
                seen += _piece_blocks(
                    motion, i, row, shift, max(begin, start) - driving.step,
                    min(until, stop) + driving.step, driving, tree, first, last, grid, rows,
                )  # fmt: skip
            seen += 1
            begin = until
            row += 1
            if row == motion.first_piece[i + 1]:
                row = motion.first_piece[i]
                shift += motion.rounds[i, 1]
            if row + 1 < motion.first_piece[i + 1]:
                until = motion.pieces[row + 1, BEGINS] + shift
            else:
                until = motion.rounds[i, 0] + motion.rounds[i, 1] + shift
                if motion.rounds[i, 1] == 0.0:
                    until = np.inf
    return seen
