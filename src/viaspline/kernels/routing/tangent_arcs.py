"""A route of corners pulled taut: straight pieces and true arcs, and via points beside them.

Tested through ``kernels/routing/test_tangent_graph``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inlined, inner, kernel
from viaspline.kernels.world.corner_fans import (
    CENTER_X,
    CENTER_Y,
    CORNER_COLUMNS,
    NORMAL_X,
    NORMAL_Y,
    RADIUS,
    SLOPE,
    X,
    Y,
)

# columns of a bend: the arc's centre, radius and side (+1: it turns left), the headings with which
# the route comes to it and leaves it
MAX_TURN_RAD = 0.9  # turn at one via point [rad]
SURE_TURN_RAD = 1e-9  # a turn of a route that is more than rounding
BEND_X, BEND_Y, BEND_RADIUS, SIDE, HEADING_IN, TURN = range(6)
STEP, EASE = range(2)  # columns of an effort


@inner
def nearest_turn(angle: float, about: float) -> float:
    """The angle plus whole turns that is nearest to ``about``: a route may wrap far round."""
    return angle - 2 * math.pi * math.floor((angle - about + math.pi) / (2 * math.pi))


@inner
def _tangent(bends: Floats, i: int, j: int) -> float:
    """Heading of the line that leaves bend i and comes to bend j; NaN where there is none."""
    dx = bends[j, BEND_X] - bends[i, BEND_X]
    dy = bends[j, BEND_Y] - bends[i, BEND_Y]
    gap = math.hypot(dx, dy)
    offset = bends[j, SIDE] * bends[j, BEND_RADIUS] - bends[i, SIDE] * bends[i, BEND_RADIUS]
    if gap <= abs(offset) or gap == 0.0:
        return np.nan
    return math.atan2(dy, dx) - math.asin(offset / gap)


@inlined
def _side(route: Floats, k: int, turn: float) -> float:
    """Which way the route wraps round the corner of row k: +1 to the left, -1 to the right.

    The corner says so itself: it points away from what it is a corner of. The turn does only where
    there is one, and on a straight line of corners that is what rounding makes of it.
    """
    hx = route[k + 1, X] - route[k - 1, X]
    hy = route[k + 1, Y] - route[k - 1, Y]
    outwards = hx * route[k, NORMAL_Y] - hy * route[k, NORMAL_X]
    if abs(turn) > SURE_TURN_RAD or outwards == 0.0:
        return 1.0 if turn > 0.0 else -1.0
    return 1.0 if outwards < 0.0 else -1.0


@inner
def _merge(route: Floats) -> tuple[Floats, int]:
    """One row for every arc that the route wraps round; start and goal are arcs of radius 0."""
    bends = np.zeros((route.shape[0], 6))
    count = 0
    for k in range(route.shape[0]):
        side = 0.0
        turn = 0.0
        if 0 < k < route.shape[0] - 1:
            ux = route[k, X] - route[k - 1, X]
            uy = route[k, Y] - route[k - 1, Y]
            vx = route[k + 1, X] - route[k, X]
            vy = route[k + 1, Y] - route[k, Y]
            turn = math.atan2(ux * vy - uy * vx, ux * vx + uy * vy)
            side = _side(route, k, turn)
        if (
            0 < k < route.shape[0] - 1
            and bends[count - 1, BEND_X] == route[k, CENTER_X]
            and bends[count - 1, BEND_Y] == route[k, CENTER_Y]
            and bends[count - 1, SIDE] == side
        ):
            bends[count - 1, TURN] += side * turn
            continue
        bends[count, TURN] = side * turn
        bends[count, SIDE] = side
        bends[count, BEND_RADIUS] = 0.0 if side == 0.0 else route[k, RADIUS]
        bends[count, BEND_X] = route[k, X] if side == 0.0 else route[k, CENTER_X]
        bends[count, BEND_Y] = route[k, Y] if side == 0.0 else route[k, CENTER_Y]
        count += 1
    return bends, count


@kernel
def bends_of(route: Floats) -> Floats:
    """The arcs of a route of corners, with the headings of the tangents between them.

    Args:
        route: Corners from start to goal, (k, 8).

    Returns:
        Bends (m, 6), the first and last of radius 0 (start and goal). TURN is the angle that the
        route turns at a bend [rad], never negative. No rows where the arcs have no common
        tangents; the corners themselves are then the best that there is.
    """
    bends, count = _merge(route)
    while True:
        dropped = False
        for k in range(1, count):
            bends[k, HEADING_IN] = _tangent(bends, k - 1, k)
            if math.isnan(bends[k, HEADING_IN]):
                return bends[:0]
        for k in range(1, count - 1):
            turn = bends[k, SIDE] * (bends[k + 1, HEADING_IN] - bends[k, HEADING_IN])
            turn = nearest_turn(turn, bends[k, TURN])
            if turn < 0.0:
                for row in range(k, count - 1):
                    for column in range(6):
                        bends[row, column] = bends[row + 1, column]
                count -= 1
                dropped = True
                break
            bends[k, TURN] = turn
        if not dropped:
            return bends[:count]


@inner
def _touch(bends: Floats, k: int, heading: float) -> tuple[float, float]:
    """Where a tangent of this heading touches bend k."""
    reach = bends[k, SIDE] * bends[k, BEND_RADIUS]
    return (
        bends[k, BEND_X] + reach * math.sin(heading),
        bends[k, BEND_Y] - reach * math.cos(heading),
    )


@inner
def _append(points: Floats, of: Ints, count: int, bend: int, x: float, y: float) -> int:
    points[count, 0] = x
    points[count, 1] = y
    of[count] = bend
    return count + 1


@inner
def _helper_distance(bends: Floats, k: int, half: float, length: float, ease: float) -> float:
    """How far from bend k its helper stands on a straight piece of this length [m].

    A span of length h whose end turns by a is longer than its chord by about h a²/15 (two
    fifteenths of a parabola's slope squared, halved), so ease * length may be spent on roundness.
    """
    if bends[k, SIDE] == 0.0:
        return 0.0
    needed = bends[k, BEND_RADIUS] * math.tan(half)
    rounder = min(15.0 * ease * length / (half * half + 1e-12), 0.29 * length)
    return max(needed, rounder)


@inner
def _straight_length(bends: Floats, k: int) -> float:
    """Length of the straight piece from bend k to bend k + 1 [m]."""
    heading = bends[k + 1, HEADING_IN]
    ax, ay = _touch(bends, k, heading)
    bx, by = _touch(bends, k + 1, heading)
    return math.hypot(bx - ax, by - ay)


@inner
def _parts(bends: Floats, k: int, step: float, ease: float) -> int:
    """In how many turns a bend is taken: the fewer, the rounder and the longer.

    n circumscribed corners are longer than their arc by radius * turn³ / 12 n², for which the
    same part of the straight pieces' length may be spent.
    """
    turn = max(bends[k, TURN], 0.0)  # rounding may leave a bend that turns by less than nothing
    most = np.ceil(turn / step)
    spare = ease * (_straight_length(bends, k - 1) + _straight_length(bends, k))
    longer = bends[k, BEND_RADIUS] * turn**3 / 12.0
    if longer < spare * most * most:
        most = np.ceil(math.sqrt(longer / spare))
    return int(max(most, max(1.0, np.ceil(turn / MAX_TURN_RAD))))


@inner
def _straight(
    points: Floats, of: Ints, count: int, bends: Floats, k: int, halves: Floats, efforts: Floats
) -> int:
    """Helper via points near the ends of the straight piece from bend k to bend k + 1."""
    heading = bends[k + 1, HEADING_IN]
    ax, ay = _touch(bends, k, heading)
    bx, by = _touch(bends, k + 1, heading)
    length = math.hypot(bx - ax, by - ay)
    before = _helper_distance(bends, k, halves[k], length, efforts[k, EASE])
    after = _helper_distance(bends, k + 1, halves[k + 1], length, efforts[k + 1, EASE])
    need = before + after
    if length <= 0.0 or need <= 0.0:
        return count
    if need >= 0.6 * length:  # one helper serves both ends
        if before > 0.0 and after > 0.0 and length > 0.25 * need:
            w = before / need
            count = _append(points, of, count, k, ax + w * (bx - ax), ay + w * (by - ay))
        return count
    if before > 0.0:
        w = before / length
        count = _append(points, of, count, k, ax + w * (bx - ax), ay + w * (by - ay))
    if after > 0.0:
        w = 1.0 - after / length
        count = _append(points, of, count, k + 1, ax + w * (bx - ax), ay + w * (by - ay))
    return count


@kernel
def detour_points(bends: Floats, efforts: Floats) -> tuple[Floats, Ints]:
    """Via points along taut bends, through which a cardinal spline follows them closely.

    On each arc, equal turns, so far out that their chords clear it; a helper on the straight piece
    before and after each arc, without which the spline would swing out along the whole piece.

    Args:
        bends: (m, 6), from ``bends_of``.
        efforts: For each bend the largest turn from via point to via point [rad], and the part of a
            straight piece's length that may be spent on helpers that stand farther away than their
            step along the arc, which makes the turn rounder, (m, 2).

    Returns:
        (points (n, 2) [m] without start and goal, the bend that each is of (n,)).
    """
    count = bends.shape[0]
    halves = np.zeros(count)
    room = 2 * count
    for k in range(1, count - 1):
        parts = _parts(bends, k, efforts[k, STEP], efforts[k, EASE])
        halves[k] = 0.5 * bends[k, TURN] / parts
        room += parts
    points = np.empty((room, 2))
    of = np.empty(room, np.int64)
    size = 0
    for k in range(count - 1):
        size = _straight(points, of, size, bends, k, halves, efforts)
        bend = k + 1
        if bend == count - 1:
            break
        parts = _parts(bends, bend, efforts[bend, STEP], efforts[bend, EASE])
        half = halves[bend]
        reach = bends[bend, BEND_RADIUS] / math.cos(half)
        for part in range(parts):
            heading = bends[bend, HEADING_IN] + bends[bend, SIDE] * (2 * part + 1) * half
            size = _append(
                points, of, size, bend,
                bends[bend, BEND_X] + bends[bend, SIDE] * reach * math.sin(heading),
                bends[bend, BEND_Y] - bends[bend, SIDE] * reach * math.cos(heading),
            )  # fmt: skip
    return points[:size], of[:size]


@kernel
def taut_length(route: Floats, bends: Floats) -> float:
    """Length of the taut bends [m], or of the corners where there are no bends."""
    length = 0.0
    for k in range(bends.shape[0] - 1):
        heading = bends[k + 1, HEADING_IN]
        ax, ay = _touch(bends, k, heading)
        bx, by = _touch(bends, k + 1, heading)
        length += math.hypot(bx - ax, by - ay) + bends[k, TURN] * bends[k, BEND_RADIUS]
    if bends.shape[0] == 0:
        for k in range(route.shape[0] - 1):
            length += math.hypot(route[k + 1, X] - route[k, X], route[k + 1, Y] - route[k, Y])
    return length


@inner
def corners_round(bends: Floats, step: float) -> Floats:
    """The corners of taut bends: every arc in circumscribed turns of at most ``step``.

    Args:
        bends: (m, 6), start and goal among them.
        step: Largest turn at one corner [rad].

    Returns:
        Corners from start to goal, (k, 8), see ``corners``.
    """
    count = bends.shape[0]
    room = count
    for k in range(1, count - 1):
        room += int(np.ceil(bends[k, TURN] / step))
    corners = np.zeros((room, CORNER_COLUMNS))
    size = 0
    for k in range(count):
        if k == 0 or k == count - 1:
            corners[size, X] = bends[k, BEND_X]
            corners[size, Y] = bends[k, BEND_Y]
            size += 1
            continue
        parts = max(1, int(np.ceil(bends[k, TURN] / step)))
        half = 0.5 * bends[k, TURN] / parts
        for part in range(parts):
            heading = bends[k, HEADING_IN] + bends[k, SIDE] * (2 * part + 1) * half
            nx = bends[k, SIDE] * math.sin(heading)
            ny = -bends[k, SIDE] * math.cos(heading)
            corners[size, X] = bends[k, BEND_X] + bends[k, BEND_RADIUS] / math.cos(half) * nx
            corners[size, Y] = bends[k, BEND_Y] + bends[k, BEND_RADIUS] / math.cos(half) * ny
            corners[size, CENTER_X] = bends[k, BEND_X]
            corners[size, CENTER_Y] = bends[k, BEND_Y]
            corners[size, RADIUS] = bends[k, BEND_RADIUS]
            corners[size, NORMAL_X] = nx
            corners[size, NORMAL_Y] = ny
            corners[size, SLOPE] = math.tan(half)
            size += 1
    return corners[:size].copy()
