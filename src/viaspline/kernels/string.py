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

from viaspline.kernels.distance import nearest
from viaspline.kernels.features import (
    FEATURE_RADIUS,
    FEATURE_X,
    FEATURE_Y,
    OUT_X,
    OUT_Y,
    features_near,
)
from viaspline.kernels.jit import inner, kernel, part, within
from viaspline.kernels.packed import Floats, PackedWorld
from viaspline.kernels.rows import new_floats, sized_floats
from viaspline.kernels.segment import nearest_to_segment
from viaspline.kernels.taut import (
    BEND_RADIUS,
    BEND_X,
    BEND_Y,
    HEADING_IN,
    SIDE,
    TURN,
    corners_round,
)

# a string's row is a bend and where its feature lies along the guide
PLACE = 6
COLUMNS = 7
ROOM = 256  # features that are looked at near one place
OFTEN = 2  # times that a feature may be put in anew on one side
SMALL = 1e-9


@inner
def _insert(rows: Floats, count: int, at: int) -> Floats:
    """Make room for one more row at ``at``."""
    if count == rows.shape[0]:
        rows = sized_floats(rows, count, 2 * count)
    for i in range(count, at, -1):
        for k in range(COLUMNS):
            rows[i, k] = rows[i - 1, k]
    return rows


@within
def _remove(rows: Floats, count: int, at: int) -> int:
    for i in range(at, count - 1):
        for k in range(COLUMNS):
            rows[i, k] = rows[i + 1, k]
    return count - 1


@within
def _write_end(rows: Floats, k: int, guide: Floats, corner: int) -> None:
    """Write an end of the guide to row k."""
    for column in range(COLUMNS):
        rows[k, column] = 0.0
    rows[k, BEND_X] = guide[corner, 0]
    rows[k, BEND_Y] = guide[corner, 1]
    rows[k, PLACE] = corner


@within
def _write(
    rows: Floats, k: int, found: Floats, j: int, rho: float, side: float, place: float
) -> None:
    """Write feature j to row k."""
    rows[k, BEND_X] = found[j, FEATURE_X]
    rows[k, BEND_Y] = found[j, FEATURE_Y]
    rows[k, BEND_RADIUS] = found[j, FEATURE_RADIUS] + rho
    rows[k, SIDE] = side
    rows[k, HEADING_IN] = 0.0
    rows[k, TURN] = 0.0
    rows[k, PLACE] = place


@within
def _is_row(rows: Floats, k: int, found: Floats, j: int, side: float) -> bool:
    """Whether row k goes round feature j on this side."""
    return (
        rows[k, BEND_X] == found[j, FEATURE_X]
        and rows[k, BEND_Y] == found[j, FEATURE_Y]
        and rows[k, SIDE] == side
    )


@within
def _left_of(guide: Floats, k: int, x: float, y: float) -> float:
    """Twice the area of (x, y) and piece k of the guide; above 0 to the left of it."""
    dx = guide[k + 1, 0] - guide[k, 0]
    dy = guide[k + 1, 1] - guide[k, 1]
    return dx * (y - guide[k, 1]) - dy * (x - guide[k, 0])


@within
def _foot(guide: Floats, first: int, last: int, x: float, y: float) -> float:
    """Where on the pieces first:last of the guide the nearest place to (x, y) is."""
    best = np.inf
    place = float(first)
    for k in range(first, last):
        dx = guide[k + 1, 0] - guide[k, 0]
        dy = guide[k + 1, 1] - guide[k, 1]
        squared = dx * dx + dy * dy
        w = 0.0
        if squared > 0.0:
            w = min(max(((x - guide[k, 0]) * dx + (y - guide[k, 1]) * dy) / squared, 0.0), 1.0)
        gx = guide[k, 0] + w * dx - x
        gy = guide[k, 1] + w * dy - y
        if gx * gx + gy * gy < best:
            best = gx * gx + gy * gy
            place = k + w
    return place


@within
def _side_of(guide: Floats, place: float, found: Floats, j: int) -> float:
    """On which side of the guide feature j lies: +1 to the left, -1 to the right."""
    x = found[j, FEATURE_X]
    y = found[j, FEATURE_Y]
    pieces = guide.shape[0] - 1
    k = min(int(place), pieces - 1)
    w = place - k
    size = math.hypot(guide[k + 1, 0] - guide[k, 0], guide[k + 1, 1] - guide[k, 1])
    area = _left_of(guide, k, x, y)
    other = k
    if w <= SMALL and k > 0:
        other = k - 1
    elif w >= 1.0 - SMALL and k + 1 < pieces:
        other = k + 1
    if other != k:
        first = min(k, other)
        turn = _left_of(guide, first, guide[first + 2, 0], guide[first + 2, 1])
        second = _left_of(guide, other, x, y)
        area = min(area, second) if turn > 0.0 else max(area, second)
    if abs(area) <= 1e-7 * size * (1.0 + size) and found[j, FEATURE_RADIUS] == 0.0:
        # on the guide itself: what is blocked lies against its corner's direction
        dx = guide[k + 1, 0] - guide[k, 0]
        dy = guide[k + 1, 1] - guide[k, 1]
        area = dy * found[j, OUT_X] - dx * found[j, OUT_Y]
    return 1.0 if area > 0.0 else -1.0


@within
def _turn_at(guide: Floats, k: int) -> tuple[float, float, float]:
    """How far the guide turns at a corner [rad], 0 where it goes straight on, and to where.

    Returns:
        (turn, x, y): above 0 to the left, and the unit vector to the inside of the turn.
    """
    ux = guide[k, 0] - guide[k - 1, 0]
    uy = guide[k, 1] - guide[k - 1, 1]
    vx = guide[k + 1, 0] - guide[k, 0]
    vy = guide[k + 1, 1] - guide[k, 1]
    long_u = math.hypot(ux, uy)
    long_v = math.hypot(vx, vy)
    area = ux * vy - uy * vx
    if abs(area) <= SMALL * long_u * long_v:
        return 0.0, 0.0, 0.0
    turn = math.atan2(area, ux * vx + uy * vy)
    half = math.atan2(uy, ux) + 0.5 * turn + math.copysign(0.5 * math.pi, turn)
    return turn, math.cos(half), math.sin(half)


@part
def _inside(
    world: PackedWorld, guide: Floats, k: int, nx: float, ny: float, rho: float, side: float,
    found: Floats,
) -> int:  # fmt: skip
    """The feature that the guide goes round at a corner: what is most in its way.

    Args:
        world: PackedWorld.
        guide: (k, 2) [m].
        k: The corner.
        nx: To the inside of the turn.
        ny: The same.
        rho: Distance at which the string turns [m].
        side: How far the corner may be from the feature [m].
        found: Room for features.

    Returns:
        Its row in ``found``, -1 where there is none.
    """
    x = guide[k, 0] + 0.7 * side * nx
    y = guide[k, 1] + 0.7 * side * ny
    distance, _ = nearest(world, x, y, rho + 3.0 * side)
    near = features_near(world, x, y, max(distance, 0.0) + 0.75 * side, found)
    best = -np.inf
    chosen = -1
    for j in range(near):
        inwards = (found[j, FEATURE_X] - x) * nx + (found[j, FEATURE_Y] - y) * ny
        reach = found[j, FEATURE_RADIUS] - inwards
        if reach > best:
            best = reach
            chosen = j
    return chosen


@part
def _begin(
    world: PackedWorld, guide: Floats, rho: float, side: float, found: Floats
) -> tuple[Floats, int]:
    """One row for every feature that a corner of the guide goes round, and the two ends."""
    corners = guide.shape[0]
    rows = new_floats(max(16, 2 * corners), COLUMNS)
    _write_end(rows, 0, guide, 0)
    count = 1
    for k in range(1, corners - 1):
        turn, nx, ny = _turn_at(guide, k)
        if turn == 0.0:
            continue
        chosen = _inside(world, guide, k, nx, ny, rho, side, found)
        if chosen < 0:
            continue
        lean = math.copysign(1.0, turn)
        if not _is_row(rows, count - 1, found, chosen, lean):
            _write(rows, count, found, chosen, rho, lean, float(k))
            count += 1
        rows[count - 1, TURN] += abs(turn)
    _write_end(rows, count, guide, corners - 1)
    return rows, count + 1


@within
def _missing_tangent(rows: Floats, count: int) -> int:
    """Write the headings of the tangents; the first row from which none leads on, or -1."""
    for k in range(count - 1):
        dx = rows[k + 1, BEND_X] - rows[k, BEND_X]
        dy = rows[k + 1, BEND_Y] - rows[k, BEND_Y]
        gap = math.hypot(dx, dy)
        offset = rows[k + 1, SIDE] * rows[k + 1, BEND_RADIUS]
        offset -= rows[k, SIDE] * rows[k, BEND_RADIUS]
        if count > 2 and gap <= abs(offset):
            return k
        rows[k + 1, HEADING_IN] = math.atan2(dy, dx)
        if offset != 0.0:
            rows[k + 1, HEADING_IN] -= math.asin(offset / gap)
    return -1


@within
def _slack(rows: Floats, count: int) -> int:
    """Write the turns; the first row that the string does not bend round, or -1."""
    for k in range(1, count - 1):
        turn = rows[k, SIDE] * (rows[k + 1, HEADING_IN] - rows[k, HEADING_IN])
        turn -= math.tau * math.floor((turn - rows[k, TURN] + math.pi) / math.tau)
        if turn < -1e-12:
            return k
        rows[k, TURN] = turn
    return -1


@within
def _slacken(rows: Floats, count: int) -> tuple[int, int]:
    """Leave out rows that the string does not bend round, until all that are left are needed.

    Returns:
        (count, gap): -1, or the row from which no tangent leads to the next because they have to
        be passed on different sides and stand too close together.
    """
    while True:
        dropped = _missing_tangent(rows, count)
        if dropped >= 0:
            if rows[dropped, SIDE] * rows[dropped + 1, SIDE] < 0.0:
                return count, dropped
            if rows[dropped, BEND_RADIUS] >= rows[dropped + 1, BEND_RADIUS]:
                dropped += 1  # the one that lies within the other
            dropped = min(max(dropped, 1), count - 2)
        else:
            dropped = _slack(rows, count)
            if dropped < 0:
                return count, -1
        count = _remove(rows, count, dropped)


@within
def _most_in_the_way(
    rows: Floats,
    k: int,
    at: int,
    guide: Floats,
    found: Floats,
    near: int,
    rho: float,
    heading: float,
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

    Returns:
        (row in ``found``, side, place along the guide); -1 where there is none.
    """
    dx = math.cos(heading)
    dy = math.sin(heading)
    reach = rows[k, SIDE] * rows[k, BEND_RADIUS]
    ax = rows[k, BEND_X] + reach * dy
    ay = rows[k, BEND_Y] - reach * dx
    first = int(rows[at, PLACE])
    last = max(first + 1, min(math.ceil(rows[k + 1, PLACE]), guide.shape[0] - 1))
    best = 1e-9 * (1.0 + rho)
    chosen = -1
    side = 0.0
    place = 0.0
    for j in range(near):
        there = _foot(guide, first, last, found[j, FEATURE_X], found[j, FEATURE_Y])
        here = _side_of(guide, there, found, j)
        left = dx * (found[j, FEATURE_Y] - ay) - dy * (found[j, FEATURE_X] - ax)
        violation = found[j, FEATURE_RADIUS] + rho - here * left
        if violation <= best:
            continue
        is_there = False
        for row in range(at, k + 2):
            is_there = is_there or _is_row(rows, row, found, j, here)
        if not is_there:
            best = violation
            chosen = j
            side = here
            place = there
    return chosen, side, place


@part
def _closest_on(
    world: PackedWorld, ax: float, ay: float, bx: float, by: float, floor: float
) -> tuple[float, float]:
    """A place on a segment near which it comes closer than ``floor`` to the world."""
    size = math.hypot(bx - ax, by - ay)
    while size > 0.25 * floor + SMALL:
        mx = 0.5 * (ax + bx)
        my = 0.5 * (ay + by)
        distance, _ = nearest_to_segment(world, ax, ay, mx, my, floor)
        if distance < floor:
            bx = mx
            by = my
        else:
            ax = mx
            ay = my
        size *= 0.5
    return 0.5 * (ax + bx), 0.5 * (ay + by)


@part
def _arc_conflict(
    world: PackedWorld, rows: Floats, k: int, floor: float
) -> tuple[float, float, float]:
    """Where along the turn of row k the arc comes too close to something: place and turn so far.

    The turn is below 0 where it is clear.
    """
    turn = 0.0
    radius = rows[k, BEND_RADIUS]
    while turn < rows[k, TURN]:
        heading = rows[k, HEADING_IN] + rows[k, SIDE] * turn
        x = rows[k, BEND_X] + rows[k, SIDE] * radius * math.sin(heading)
        y = rows[k, BEND_Y] - rows[k, SIDE] * radius * math.cos(heading)
        distance, _ = nearest(world, x, y, floor + radius)
        if distance < floor:
            return x, y, turn
        turn += max(0.02, (distance - floor) / radius)
    return 0.0, 0.0, -1.0


@part
def _conflict(
    world: PackedWorld, rows: Floats, k: int, floor: float
) -> tuple[int, float, float, float]:
    """Where the tangent after row k, or the arc of row k, comes closer than ``floor``.

    Returns:
        (row after which something is missing, heading there, x, y); -1 where both are clear.
    """
    heading = rows[k + 1, HEADING_IN]
    reach = rows[k, SIDE] * rows[k, BEND_RADIUS]
    ax = rows[k, BEND_X] + reach * math.sin(heading)
    ay = rows[k, BEND_Y] - reach * math.cos(heading)
    reach = rows[k + 1, SIDE] * rows[k + 1, BEND_RADIUS]
    bx = rows[k + 1, BEND_X] + reach * math.sin(heading)
    by = rows[k + 1, BEND_Y] - reach * math.cos(heading)
    distance, _ = nearest_to_segment(world, ax, ay, bx, by, floor)
    if distance < floor:
        x, y = _closest_on(world, ax, ay, bx, by, floor)
        return k, heading, x, y
    x, y, turned = _arc_conflict(world, rows, k, floor)
    if turned < 0.0:
        return -1, heading, x, y
    at = k if turned >= 0.5 * rows[k, TURN] else k - 1
    return at, rows[k, HEADING_IN] + rows[k, SIDE] * turned, x, y


@part
def _next_conflict(
    world: PackedWorld, rows: Floats, count: int, k: int, floor: float
) -> tuple[int, int, float, float, float]:
    """The first conflict of a string from row k on, and round to it again.

    Returns:
        (row, and what ``_conflict`` says of it).
    """
    for i in range(count - 1):
        row = (k + i) % (count - 1)
        at, heading, x, y = _conflict(world, rows, row, floor)
        if at >= 0:
            return row, at, heading, x, y
    return 0, -1, 0.0, 0.0, 0.0


@within
def _remember(history: Floats, count: int, found: Floats, j: int, side: float) -> int:
    """Note in row ``count`` that a feature is put in; how often it has been on this side."""
    history[count, BEND_X] = found[j, FEATURE_X]
    history[count, BEND_Y] = found[j, FEATURE_Y]
    history[count, SIDE] = side
    times = 0
    for i in range(count):
        if _is_row(history, i, found, j, side):
            times += 1
    return times


@part
def _pulled(
    world: PackedWorld, guide: Floats, rho: float, floor: float, side: float, stuck: Floats
) -> tuple[Floats, int]:
    """The rows of a taut string; none where it gets stuck, and ``stuck`` says where."""
    found = new_floats(ROOM, 5)
    rows, count = _begin(world, guide, rho, side, found)
    history = new_floats(64, COLUMNS)
    insertions = 0
    k = 0
    while True:
        before = count
        count, narrow = _slacken(rows, count)
        if narrow >= 0:
            for end in range(2):
                stuck[0, 2 * end] = rows[narrow + end, BEND_X]
                stuck[0, 2 * end + 1] = rows[narrow + end, BEND_Y]
            stuck[0, 4] = -1.0
            return rows, 0
        k = max(0, k - 2 - before + count)
        k, at, heading, x, y = _next_conflict(world, rows, count, k, floor)
        if at < 0:
            return rows, count
        chosen = -1
        lean = 0.0
        place = 0.0
        wide = 1.26 * floor + SMALL
        while chosen < 0 and wide < 40.0 * floor + 4.0 * side:
            near = features_near(world, x, y, wide, found)
            chosen, lean, place = _most_in_the_way(rows, k, at, guide, found, near, rho, heading)
            wide *= 2.0
        if chosen < 0:
            stuck[0, 4] = _foot(guide, int(rows[k, PLACE]), guide.shape[0] - 1, x, y)
            return rows, 0
        if insertions == history.shape[0]:
            history = sized_floats(history, insertions, 2 * insertions)
        if _remember(history, insertions, found, chosen, lean) > OFTEN:
            stuck[0, 4] = place
            return rows, 0
        insertions += 1
        rows = _insert(rows, count, at + 1)
        _write(rows, at + 1, found, chosen, rho, lean, place)
        count += 1


@part
def _is_clear(world: PackedWorld, corners: Floats, floor: float) -> bool:
    """Whether every piece of a row of corners keeps ``floor``."""
    for k in range(corners.shape[0] - 1):
        distance, _ = nearest_to_segment(
            world, corners[k, 0], corners[k, 1], corners[k + 1, 0], corners[k + 1, 1], floor
        )
        if distance < floor:
            return False
    return True


@kernel
def pulled_taut(
    world: PackedWorld, guide: Floats, rhos: Floats, floor: float, side: float, steps: Floats
) -> tuple[Floats, Floats, Floats]:
    """The taut string of a guide.

    Args:
        world: PackedWorld.
        guide: Places from start to goal that pass everything on the right sides, (k, 2) [m].
        rhos: Distances from features at which the string may turn [m], the best first, (r,).
        floor: Distance that the string keeps [m].
        side: How far the guide's corners may be from the features that they go round [m].
        steps: Largest turns at one corner that may be taken [rad], the coarsest first, (s,).

    Returns:
        (bends (n, 6) as in ``taut``, corners round them (m, 8) as in ``corners``, in so fine
        steps as keep the floor, stuck (1, 5)). Where the guide goes through a gap that is too
        narrow there are no bends, and ``stuck`` has the two obstacles x0, y0, x1, y1 [m] between
        which it is and -1; or only, in its last column, where along the guide the string got
        stuck: the number of the piece, and the part of it that lies before.
    """
    stuck = new_floats(1, 5)
    for r in range(rhos.size):
        rows, count = _pulled(world, guide, rhos[r], floor, side, stuck)
        if count == 0:
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
