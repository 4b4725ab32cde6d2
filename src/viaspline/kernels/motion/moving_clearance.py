"""The certificate in space-time: the least distance between a drive and all that moves.

The drive is cut into strides, every obstacle's motion is walked beside them, and each pair of a
stride and a piece of motion is bounded from both sides at once (``moving_gap``). Pairs that can't
hold the least distance are dropped; of the others the one with the least bound is halved in time
until it is known well enough. What has been proven is true whenever that ends.

A body is an outline about the reference point, a disc that of one point, (0, 0): its radius comes
off at the end. A polygonal body is bounded by the disc round it until its pairs are halved, and
from then on by itself (``moving_body``).

Tested through ``trajectory/test_moving_certificate``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.clearance.footprint_pose import outer_radius
from viaspline.kernels.growable import sized_floats
from viaspline.kernels.heap import Heap, pop, push
from viaspline.kernels.jit import inlined, inner, kernel
from viaspline.kernels.motion.body_turns import mark_cusps
from viaspline.kernels.motion.motion_pairs import (
    FACING,
    LOWER,
    OBSTACLE,
    PIECE,
    REACHED,
    SHIFT,
    SPARE_ROWS,
    UPPER,
    bound_pair,
    copy_pair,
    halve_pair,
    is_rough,
    pairs_of,
    place_ends,
)
from viaspline.kernels.motion.moving_body import body_bounds
from viaspline.kernels.motion.moving_distance import piece_distance, uncertainty
from viaspline.kernels.motion.moving_gap import is_circle, nearest_share
from viaspline.kernels.motion.packed_motion import PackedMotion
from viaspline.kernels.motion.path_bends import bends_of
from viaspline.kernels.motion.strides import (
    BEGIN,
    END,
    SAG,
    SHORTEST_S,
    X0,
    X1,
    Y0,
    Y1,
    strides_of,
)
from viaspline.kernels.motion.timed_path import (
    DISTANCE,
    TIME,
    TimedPath,
    law_piece,
    law_state,
    place_at,
    place_of,
)

MAX_PAIRS = 1_000_000  # that are halved for a bound
FIRST_SAG_SHARE = 0.01  # of the length of a path: the sag of the strides to start with
PLACING_STEPS = 50  # halvings in which the tightest instant is looked for
TOLD_M = 1e-7  # to which it is told whether what is required is kept


@inner
def _settled(lower: float, upper: float, tolerance: float, required: float) -> bool:
    """Whether a pair is known well enough: to the tolerance, and to tell what is required."""
    if not math.isinf(tolerance) and lower < upper - tolerance:
        return False
    return lower >= required or upper < required or lower >= upper - TOLD_M


@inner
def _bound(
    path: TimedPath, motion: PackedMotion, bends: Floats, body: Floats, held: float, pair: Floats,
    enough: float,
) -> None:  # fmt: skip
    """Fill in the bounds of a pair that has been halved."""
    if body.shape[0] == 1:
        bound_pair(motion, pair, enough)
        return
    outer = outer_radius(body)
    bound_pair(motion, pair, enough + outer)
    i = int(pair[OBSTACLE])  # overlaps count as 0
    pair[LOWER] = max(pair[LOWER] - outer, -uncertainty(motion, i, pair[END]))
    pair[UPPER] = max(pair[UPPER], -uncertainty(motion, i, pair[BEGIN]))
    if pair[LOWER] < enough:
        lower, pair[UPPER], pair[FACING], pair[REACHED] = body_bounds(
            path, motion, bends, body, held, pair, enough
        )
        pair[LOWER] = max(pair[LOWER], lower)


@inner
def _with_room(heap: Heap, room: int) -> Heap:
    """A heap with the same items and room for more."""
    larger = Heap(np.empty(room), np.empty(room, np.int64), heap.size)
    for k in range(heap.size[0]):
        larger.keys[k], larger.items[k] = heap.keys[k], heap.items[k]
    return larger


@inlined
def _is_instant(pair: Floats) -> bool:
    return float(pair[END] - pair[BEGIN]) <= SHORTEST_S


@inner
def _sharpened(path: TimedPath, bends: Floats, pairs: Floats, k: int, size: int) -> int:
    """Put the ends of a rough pair where they are, or halve it into row ``size``; the new size.

    An instant stays as it is: of a body only the disc round it may have been looked at so far.
    """
    if is_rough(pairs[k]):
        place_ends(path, bends, pairs[k])
        return size
    if _is_instant(pairs[k]):
        return size
    halve_pair(path, bends, pairs, k, size)
    return size + 1


@inner
def _refined(
    path: TimedPath, motion: PackedMotion, bends: Floats, body: Floats, held: float,
    pairs: Floats, size: int, best: int, tolerance: float, required: float,
) -> tuple[float, float, Floats]:  # fmt: skip
    """Halve pairs until their least distance is known.

    Returns:
        (lower, upper, pairs): the bounds [m], and a table in whose row 0 stands the pair in which
        the upper one is reached.
    """
    lower = np.inf
    upper = pairs[best, UPPER]
    most = required if math.isinf(tolerance) else np.inf
    copy_pair(pairs, best, 0)
    room = pairs.shape[0]
    heap = Heap(np.empty(room), np.empty(room, np.int64), np.zeros(1, np.int64))
    for k in range(SPARE_ROWS, size):
        push(heap, pairs[k, LOWER], k)
    for _ in range(MAX_PAIRS):
        if heap.size[0] == 0:
            return lower, upper, pairs
        least = heap.keys[0]
        if _settled(least, upper, tolerance, required):
            return min(lower, least), upper, pairs
        k = pop(heap)
        looked_at = body.shape[0] == 1 or not math.isnan(pairs[k, FACING])
        if looked_at and _is_instant(pairs[k]) and not is_rough(pairs[k]):
            lower = min(lower, least)
            continue
        if size == room:
            room *= 2
            pairs = sized_floats(pairs, size, room)
            heap = _with_room(heap, room)
        grown = _sharpened(path, bends, pairs, k, size)
        for n in range(grown - size + 1):
            j = k if n == 0 else size
            _bound(path, motion, bends, body, held, pairs[j], min(upper, most))
            if pairs[j, UPPER] < upper:
                upper = pairs[j, UPPER]
                copy_pair(pairs, j, 0)
            if pairs[j, LOWER] < min(upper, most):
                push(heap, pairs[j, LOWER], j)
            else:
                lower = min(lower, pairs[j, LOWER])
        size = grown
    return min(lower, heap.keys[0]), upper, pairs


@inner
def _distance_then(path: TimedPath, motion: PackedMotion, pair: Floats, instant: float) -> float:
    """Of the reference point from the obstacle of a pair at an instant [m]."""
    _, x, y = place_at(path, instant)
    i, row = int(pair[OBSTACLE]), int(pair[PIECE])
    return piece_distance(motion, i, row, pair[SHIFT], instant, x, y, np.inf)


@inner
def _tightest_instant(path: TimedPath, motion: PackedMotion, pairs: Floats) -> float:
    """When the reference point is nearest in the pair of row 0 [s]; row 1 is overwritten."""
    pair = pairs[0]
    pair[SAG] = 0.0
    if is_circle(motion, int(pair[OBSTACLE])):
        share = nearest_share(
            motion, int(pair[PIECE]), pair[SHIFT], pair[BEGIN], pair[END],
            pair[X0], pair[Y0], pair[X1], pair[Y1],
        )  # fmt: skip
        return float(pair[BEGIN] + share * (pair[END] - pair[BEGIN]))
    least = np.inf
    at = pair[BEGIN]
    for _ in range(PLACING_STEPS):
        middle = 0.5 * (pair[BEGIN] + pair[END])
        if not pair[BEGIN] < middle < pair[END]:
            break
        distance = _distance_then(path, motion, pair, middle)
        if distance < least:
            least, at = distance, middle
        x, y = 0.5 * (pair[X0] + pair[X1]), 0.5 * (pair[Y0] + pair[Y1])
        copy_pair(pairs, 0, 1)
        late = pairs[1]
        late[BEGIN], late[X0], late[Y0] = middle, x, y
        pair[END], pair[X1], pair[Y1] = middle, x, y
        bound_pair(motion, pair, np.inf)
        bound_pair(motion, late, np.inf)
        if late[LOWER] < pair[LOWER]:
            copy_pair(pairs, 1, 0)
    return float(at)


@kernel
def moving_tightest(
    path: TimedPath, motion: PackedMotion, body: Floats, held: float, hold: float,
    tolerance: float, required: float,
) -> tuple[float, float, float, float, float, float, float, int]:  # fmt: skip
    """The least distance between a robot and all that moves, from both sides.

    Args:
        path: TimedPath.
        motion: PackedMotion.
        body: The outline (k, 2) [m], with the reference point inside; (1, 2), a disc: the reference
            point alone counts.
        held: The heading that the body keeps [rad]; nan: it looks the way it goes.
        hold: How long the robot stands at its end [s].
        tolerance: How far apart the two bounds may be [m]; infinite: they tell no more than whether
            what is required is kept.
        required: Distance of which the bounds have to tell whether it is kept [m].

    Returns:
        (lower, upper, instant, distance, x, y, heading, index): the bounds [m], when [s] and where
        along the curve [m] and in the plane [m] the upper one is reached, with which heading of a
        polygonal body [rad], and the obstacle that is nearest then. Both bounds are infinite and
        the index is -1 where nothing is there all the time. They are farther apart than the
        tolerance only where that takes too many pairs.
    """
    bends = bends_of(path)
    most = FIRST_SAG_SHARE * path.along[path.along.size - 1]
    if body.shape[0] > 1 and math.isnan(held):
        mark_cusps(path.rows, bends)
    strides, count = strides_of(path, bends, hold, most)
    outer = outer_radius(body)
    pairs, size, others, best = pairs_of(motion, strides, count, outer, -np.inf)
    if best == -1:
        start = path.law[0]
        _, x, y = place_of(path, start[DISTANCE])
        return np.inf, np.inf, start[TIME], start[DISTANCE], x, y, np.nan, -1
    if body.shape[0] > 1:  # known to the disc round the body only
        for k in range(SPARE_ROWS, size):
            pairs[k, LOWER], pairs[k, UPPER] = pairs[k, LOWER] - outer, np.inf
    lower, upper, pairs = _refined(
        path, motion, bends, body, held, pairs, size, best, tolerance, required
    )  # fmt: skip
    lower = min(lower, others - outer, upper)
    if body.shape[0] == 1:
        instant = _tightest_instant(path, motion, pairs)
    else:
        instant = pairs[0, REACHED]
    distance, _, _ = law_state(path.law, law_piece(path.law, instant), instant)
    _, x, y = place_of(path, distance)
    return lower, upper, instant, distance, x, y, pairs[0, FACING], int(pairs[0, OBSTACLE])
