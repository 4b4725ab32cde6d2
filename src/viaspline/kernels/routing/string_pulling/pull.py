"""Pulling a guide taut: the shortest path among inflated obstacles that can be bent into it.

A string is a row of arcs round features and the common tangents between them. Where a tangent or
an arc comes too close to a feature that is not in the row, the feature is put in, on the side on
which the guide passes it; where the string bends away from a feature, the feature is left out.
What remains is taut. Two features that have to be passed between and stand too close together are
a gap that is too narrow: the guide itself is no way.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.growable import new_floats, sized_floats
from viaspline.kernels.jit import fused, inlined, inner, kernel
from viaspline.kernels.routing.string_pulling.drawn import drawn
from viaspline.kernels.routing.string_pulling.features import features_near
from viaspline.kernels.routing.string_pulling.guide import foot, side_of
from viaspline.kernels.routing.string_pulling.string_conflicts import SAME_DISTANCE_M, next_conflict
from viaspline.kernels.routing.string_pulling.string_rows import (
    PLACE,
    ROW_COLUMNS,
    insert,
    is_row,
    write,
)
from viaspline.kernels.routing.string_pulling.tighten import slacken
from viaspline.kernels.routing.tangent_arcs import (
    BEND_RADIUS,
    BEND_X,
    BEND_Y,
    HEADING_IN,
    SIDE,
    TURN,
    corners_round,
)
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.ring_features import FEATURE_RADIUS, FEATURE_X, FEATURE_Y
from viaspline.kernels.world.segment import nearest_to_segment

MAX_FEATURES_NEAR = 256  # features that are looked at near one place
MAX_INSERTIONS = 2  # times that a feature may be put in anew on one side
GUIDE_TURN_RAD = np.pi / 16  # at one corner of a string that is the guide of a wider one
GRADIENT_STEP = 1e-6  # as a share of the distance
MAX_PLACES_ACROSS_GAP = 200  # at which it is looked at whether a gap has the room
MAX_GROWTH = 0.1  # of the distance at a time, as a share of the whole


@inlined
def _most_in_the_way(
    rows: Floats,
    k: int,
    at: int,
    guide: Floats,
    found: Floats,
    near: int,
    rho: float,
    heading: float,
    spare: float,
) -> tuple[int, float, float]:
    """The feature that the string has to be bent round most.

    Args:
        rows: The string.
        k: The line begins where it touches row k.
        at: The row after which the feature is missing: k, or k - 1 where the arc conflicts.
        guide: It says on which side to pass.
        found: Features near the conflict.
        near: How many.
        rho: Distance at which the string turns [m].
        heading: Of the line [rad].
        spare: How far beyond the line's ends a feature may be too near to it [m].

    Returns:
        (row in ``found``, side, place along the guide); -1 where there is none.
    """
    dx = math.cos(heading)
    dy = math.sin(heading)
    reach = rows[k, SIDE] * rows[k, BEND_RADIUS]
    ax = rows[k, BEND_X] + reach * dy
    ay = rows[k, BEND_Y] - reach * dx
    reach = rows[k + 1, SIDE] * rows[k + 1, BEND_RADIUS]
    bx = rows[k + 1, BEND_X] + reach * dy
    by = rows[k + 1, BEND_Y] - reach * dx
    length = math.hypot(bx - ax, by - ay)
    is_on_line = heading == rows[k + 1, HEADING_IN]  # else it is on the arc before
    first = int(rows[at, PLACE])
    last = max(first + 1, min(math.ceil(rows[k + 1, PLACE]), guide.shape[0] - 1))
    best = 1e-9 * (1.0 + rho)
    chosen = -1
    side = 0.0
    place = 0.0
    for j in range(near):
        there = foot(guide, first, last, found[j, FEATURE_X], found[j, FEATURE_Y])
        here = side_of(guide, there, found, j)
        left = dx * (found[j, FEATURE_Y] - ay) - dy * (found[j, FEATURE_X] - ax)
        radius = found[j, FEATURE_RADIUS] + rho
        along = dx * (found[j, FEATURE_X] - ax) + dy * (found[j, FEATURE_Y] - ay)
        violation = radius - here * left
        beyond = max(-along, along - length, 0.0) if is_on_line else 0.0
        if violation <= best or (beyond > spare and math.hypot(beyond, left) >= radius):
            continue
        is_there = False
        for row in range(at, k + 2):
            is_there = is_there or is_row(rows, row, found, j, here)
        if not is_there:
            best = violation
            chosen = j
            side = here
            place = there
    return chosen, side, place


@inlined
def _remember(history: Floats, count: int, found: Floats, j: int, side: float) -> int:
    """Note in row ``count`` that a feature is put in; how often it has been on this side."""
    history[count, BEND_X] = found[j, FEATURE_X]
    history[count, BEND_Y] = found[j, FEATURE_Y]
    history[count, SIDE] = side
    times = 0
    for i in range(count):
        if is_row(history, i, found, j, side):
            times += 1
    return times


@inner
def _write_narrower(
    world: PackedWorld, rows: Floats, k: int, x: float, y: float, stuck: Floats
) -> None:  # fmt: skip
    """Write the gap between the feature of row k and what is nearest to (x, y), if it is less."""
    here, _ = nearest(world, x, y, np.inf)
    step = GRADIENT_STEP * max(here, 1e-3)
    beside, _ = nearest(world, x + step, y, np.inf)
    above, _ = nearest(world, x, y + step, np.inf)
    size = math.hypot(beside - here, above - here)
    if size == 0.0:
        return
    qx = x - here * (beside - here) / size
    qy = y - here * (above - here) / size
    if (rows[k, BEND_X] - x) * (qx - x) + (rows[k, BEND_Y] - y) * (qy - y) >= 0.0:
        return  # not opposite
    width = math.hypot(qx - rows[k, BEND_X], qy - rows[k, BEND_Y])
    if width < math.hypot(stuck[0, 2] - stuck[0, 0], stuck[0, 3] - stuck[0, 1]):
        stuck[0, 0] = rows[k, BEND_X]
        stuck[0, 1] = rows[k, BEND_Y]
        stuck[0, 2] = qx
        stuck[0, 3] = qy
        stuck[0, 4] = -1.0


@fused
def _write_gap(
    world: PackedWorld, rows: Floats, k: int, heading: float, x: float, y: float, stuck: Floats
) -> None:  # fmt: skip
    """Write the narrowest gap between the features of rows k and k + 1 and what is opposite."""
    for column in range(5):
        stuck[0, column] = np.inf if column == 0 else 0.0
    for end in range(2):
        if rows[k + end, BEND_RADIUS] > 0.0:
            reach = rows[k + end, SIDE] * rows[k + end, BEND_RADIUS]
            px = rows[k + end, BEND_X] + reach * math.sin(heading)
            py = rows[k + end, BEND_Y] - reach * math.cos(heading)
            _write_narrower(world, rows, k + end, px, py, stuck)
            _write_narrower(world, rows, k + end, x, y, stuck)


@fused
def _settled(
    world: PackedWorld, rows: Floats, count: int, guide: Floats, rho: float, floor: float,
    side: float, stuck: Floats,
) -> tuple[Floats, int]:  # fmt: skip
    """A string's rows, put in and left out until it is clear; none where it gets stuck."""
    found = new_floats(MAX_FEATURES_NEAR, 5)
    history = new_floats(64, ROW_COLUMNS)
    insertions = 0
    k = 0
    while True:
        before = count
        count, narrow = slacken(rows, count)
        if narrow >= 0:
            for end in range(2):
                stuck[0, 2 * end] = rows[narrow + end, BEND_X]
                stuck[0, 2 * end + 1] = rows[narrow + end, BEND_Y]
            stuck[0, 4] = -1.0
            return rows, 0
        k = max(0, k - 2 - before + count)
        k, at, heading, x, y = next_conflict(world, rows, count, k, floor)
        if at < 0:
            return rows, count
        chosen = -1
        lean = 0.0
        place = 0.0
        gap = math.hypot(
            rows[k + 1, BEND_X] - rows[k, BEND_X], rows[k + 1, BEND_Y] - rows[k, BEND_Y]
        )
        for attempt in range(2):  # what is too near to the line, then what a wall leads on to
            spare = 0.0 if attempt == 0 else np.inf
            wide = 1.02 * floor + SAME_DISTANCE_M
            while chosen < 0 and wide < 40.0 * floor + 4.0 * side + 2.0 * gap:
                near = features_near(world, x, y, wide, found)
                chosen, lean, place = _most_in_the_way(
                    rows, k, at, guide, found, near, rho, heading, spare
                )
                wide *= 2.0
        if insertions == history.shape[0]:
            history = sized_floats(history, insertions, 2 * insertions)
        if chosen < 0 or _remember(history, insertions, found, chosen, lean) > MAX_INSERTIONS:
            _write_gap(world, rows, k, heading, x, y, stuck)
            return rows, 0
        insertions += 1
        row = at + 1
        if row < count - 1 and rows[row, SIDE] == lean and rows[row, PLACE] < place:
            row += 1  # the guide comes past it later: before the other it would bend back
        rows = insert(rows, count, row)
        write(rows, row, found, chosen, rho, lean, place)
        count += 1


@fused
def _as_guide(rows: Floats, count: int) -> Floats:
    """The string as a guide for one that keeps a little more; its rows get their places on it."""
    corners = corners_round(rows[:count], GUIDE_TURN_RAD)
    guide = new_floats(corners.shape[0], 2)
    for k in range(corners.shape[0]):
        guide[k, 0] = corners[k, 0]
        guide[k, 1] = corners[k, 1]
    at = 0.0
    for k in range(1, count):
        parts = max(1.0, np.ceil(rows[k, TURN] / GUIDE_TURN_RAD)) if k < count - 1 else 1.0
        rows[k, PLACE] = at + 0.5 * (parts + 1.0)
        at += parts
    return guide


@fused
def _pulled(
    world: PackedWorld, guide: Floats, kept: float, rho: float, floor: float, side: float,
    stuck: Floats,
) -> tuple[Floats, int]:  # fmt: skip
    """The rows of a taut string; none where it gets stuck, and ``stuck`` says where."""
    spare = rho - floor
    now = min(rho, kept)
    rows, count, place = drawn(world, guide, now, now - spare, side)
    if count == 0:
        stuck[0, 4] = place
        return rows, 0
    while True:
        rows, count = _settled(world, rows, count, guide, now, now - spare, side, stuck)
        if count == 0 or now == rho:
            return rows, count
        guide = _as_guide(rows, count)
        wider = min(rho, now + MAX_GROWTH * rho)
        for k in range(1, count - 1):
            rows[k, BEND_RADIUS] += wider - now
        now = wider


@fused
def _is_clear(world: PackedWorld, corners: Floats, floor: float) -> bool:
    """Whether every piece of a row of corners keeps ``floor``."""
    for k in range(corners.shape[0] - 1):
        distance, _ = nearest_to_segment(
            world, corners[k, 0], corners[k, 1], corners[k + 1, 0], corners[k + 1, 1], floor
        )
        if distance < floor:
            return False
    return True


@fused
def _is_shut(world: PackedWorld, stuck: Floats, floor: float) -> bool:
    """Whether nothing on the segment across a gap keeps ``floor``: no margin opens it then.

    So far as the distance lacks there, so far on it lacks some as well.
    """
    dx = stuck[0, 2] - stuck[0, 0]
    dy = stuck[0, 3] - stuck[0, 1]
    size = math.hypot(dx, dy)
    along = 0.0
    for _ in range(MAX_PLACES_ACROSS_GAP):
        if along >= size:
            return True
        distance, _ = nearest(
            world, stuck[0, 0] + along / size * dx, stuck[0, 1] + along / size * dy, floor
        )
        if distance >= floor - SAME_DISTANCE_M:
            return False
        along += floor - distance
    return False


@kernel
def pulled_taut(
    world: PackedWorld, guide: Floats, kept: float, rhos: Floats, floor: float, side: float,
    steps: Floats,
) -> tuple[Floats, Floats, Floats]:  # fmt: skip
    """The taut string of a guide.

    Args:
        world: PackedWorld.
        guide: Places from start to goal that pass everything on the right sides, (k, 2) [m].
        kept: Distance that the guide keeps [m]; the string is drawn at that, and then widened.
        rhos: Distances from features at which the string may turn [m], the best first, (r,).
        floor: Distance that the string keeps [m].
        side: How far the string's end is drawn at a time [m].
        steps: Largest turns at one corner that may be taken [rad], the coarsest first, (s,).

    Returns:
        (bends (n, 6) as in ``taut``, corners round them (m, 8) as in ``corners``, in so fine
        steps as keep the floor, stuck (1, 5)). Where the guide goes through a gap that is too
        narrow there are no bends, and ``stuck`` has the two obstacles x0, y0, x1, y1 [m] between
        which it is and -1; or only, in its last column, where along the guide the string got
        stuck: the number of the piece, and the part of it that lies before.
    """
    stuck = new_floats(1, 5)
    stuck[0, 4] = 0.0
    for r in range(rhos.size):
        rows, count = _pulled(world, guide, kept, rhos[r], floor, side, stuck)
        if count == 0:
            if stuck[0, 4] < 0.0 and _is_shut(world, stuck, floor):
                break
            continue
        bends = new_floats(count, PLACE)
        for i in range(count):
            for column in range(PLACE):
                bends[i, column] = rows[i, column]
        corners = corners_round(bends, steps[0])
        for s in range(1, steps.size):
            if _is_clear(world, corners, floor):
                break
            corners = corners_round(bends, steps[s])
        return bends, corners, stuck
    return new_floats(0, PLACE), new_floats(0, 8), stuck
