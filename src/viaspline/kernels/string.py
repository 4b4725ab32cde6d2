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
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.packed import Floats, PackedWorld
from viaspline.kernels.segment import nearest_to_segment
from viaspline.kernels.taut import BEND_RADIUS, BEND_X, BEND_Y, HEADING_IN, SIDE, TURN

# a string's row is a bend and where its feature lies along the guide
PLACE = 6
COLUMNS = 7
ROOM = 256  # features that are looked at near one place
TAUT, TOO_NARROW = 0, 1
SMALL = 1e-9


@inner
def _grown(rows: Floats) -> Floats:
    larger = np.empty((2 * rows.shape[0], rows.shape[1]))
    for i in range(rows.shape[0]):
        for k in range(rows.shape[1]):
            larger[i, k] = rows[i, k]
    return larger


@inner
def _insert(rows: Floats, count: int, at: int) -> Floats:
    """Make room for one more row at ``at``."""
    if count == rows.shape[0]:
        rows = _grown(rows)
    for i in range(count, at, -1):
        for k in range(COLUMNS):
            rows[i, k] = rows[i - 1, k]
    return rows


@inner
def _remove(rows: Floats, count: int, at: int) -> int:
    for i in range(at, count - 1):
        for k in range(COLUMNS):
            rows[i, k] = rows[i + 1, k]
    return count - 1


@inner
def _write(
    rows: Floats, k: int, x: float, y: float, radius: float, side: float, place: float
) -> None:
    rows[k, BEND_X] = x
    rows[k, BEND_Y] = y
    rows[k, BEND_RADIUS] = radius
    rows[k, SIDE] = side
    rows[k, HEADING_IN] = 0.0
    rows[k, TURN] = 0.0
    rows[k, PLACE] = place


@inner
def _left_of(guide: Floats, k: int, x: float, y: float) -> float:
    """Twice the area of (x, y) and piece k of the guide; above 0 to the left of it."""
    dx = guide[k + 1, 0] - guide[k, 0]
    dy = guide[k + 1, 1] - guide[k, 1]
    return dx * (y - guide[k, 1]) - dy * (x - guide[k, 0])


@inner
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


@inner
def _side_of(guide: Floats, place: float, feature: Floats) -> float:
    """On which side of the guide a feature lies: +1 to the left, -1 to the right."""
    x = feature[FEATURE_X]
    y = feature[FEATURE_Y]
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
    if abs(area) <= 1e-7 * size * (1.0 + size) and feature[FEATURE_RADIUS] == 0.0:
        # on the guide itself: what is blocked lies against its corner's direction
        dx = guide[k + 1, 0] - guide[k, 0]
        dy = guide[k + 1, 1] - guide[k, 1]
        area = dy * feature[OUT_X] - dx * feature[OUT_Y]
    return 1.0 if area > 0.0 else -1.0


@inner
def _begin(
    world: PackedWorld, guide: Floats, rho: float, side: float, found: Floats
) -> tuple[Floats, int]:
    """One row for every feature that a corner of the guide goes round, and the two ends."""
    corners = guide.shape[0]
    rows = np.empty((max(16, 2 * corners), COLUMNS))
    _write(rows, 0, guide[0, 0], guide[0, 1], 0.0, 0.0, 0.0)
    count = 1
    for k in range(1, corners - 1):
        ux = guide[k, 0] - guide[k - 1, 0]
        uy = guide[k, 1] - guide[k - 1, 1]
        vx = guide[k + 1, 0] - guide[k, 0]
        vy = guide[k + 1, 1] - guide[k, 1]
        long_u = math.hypot(ux, uy)
        long_v = math.hypot(vx, vy)
        area = ux * vy - uy * vx
        if abs(area) <= SMALL * long_u * long_v:
            continue  # straight on
        turn = 1.0 if area > 0.0 else -1.0
        # towards the inside of the turn
        nx = -turn * (uy / long_u + vy / long_v)
        ny = turn * (ux / long_u + vx / long_v)
        size = math.hypot(nx, ny)
        if size < SMALL:
            nx = vx
            ny = vy
            size = long_v
        nx /= size
        ny /= size
        x = guide[k, 0] + 0.7 * side * nx
        y = guide[k, 1] + 0.7 * side * ny
        distance, _ = nearest(world, x, y, rho + 3.0 * side)
        near = features_near(world, x, y, max(distance, 0.0) + 0.75 * side, found)
        best = -np.inf
        chosen = -1
        for j in range(near):
            reach = found[j, FEATURE_RADIUS] - (
                (found[j, FEATURE_X] - x) * nx + (found[j, FEATURE_Y] - y) * ny
            )
            if reach > best:
                best = reach
                chosen = j
        if chosen < 0:
            continue
        feature = found[chosen]
        if (
            rows[count - 1, BEND_X] == feature[FEATURE_X]
            and rows[count - 1, BEND_Y] == feature[FEATURE_Y]
            and rows[count - 1, SIDE] == turn
        ):
            rows[count - 1, TURN] += abs(math.atan2(ux * vy - uy * vx, ux * vx + uy * vy))
            continue
        if count + 1 >= rows.shape[0]:
            rows = _grown(rows)
        _write(
            rows, count, feature[FEATURE_X], feature[FEATURE_Y], feature[FEATURE_RADIUS] + rho,
            turn, float(k),
        )  # fmt: skip
        rows[count, TURN] = abs(math.atan2(ux * vy - uy * vx, ux * vx + uy * vy))
        count += 1
    _write(rows, count, guide[corners - 1, 0], guide[corners - 1, 1], 0.0, 0.0, corners - 1.0)
    return rows, count + 1


@inner
def _heading(rows: Floats, k: int) -> float:
    """Heading of the tangent from row k to row k + 1; NaN where they have none."""
    dx = rows[k + 1, BEND_X] - rows[k, BEND_X]
    dy = rows[k + 1, BEND_Y] - rows[k, BEND_Y]
    gap = math.hypot(dx, dy)
    offset = rows[k + 1, SIDE] * rows[k + 1, BEND_RADIUS] - rows[k, SIDE] * rows[k, BEND_RADIUS]
    if gap <= abs(offset) or gap == 0.0:
        return np.nan
    return math.atan2(dy, dx) - math.asin(offset / gap)


@inner
def _slacken(rows: Floats, count: int) -> tuple[int, int]:
    """Leave out rows that the string does not bend round, until all that are left are needed.

    Returns:
        (count, gap): -1, or the row from which no tangent leads to the next because they have to
        be passed on different sides and stand too close together.
    """
    while True:
        dropped = -1
        for k in range(count - 1):
            heading = _heading(rows, k)
            rows[k + 1, HEADING_IN] = heading
            if not math.isnan(heading):
                continue
            here = rows[k, BEND_RADIUS]
            after = rows[k + 1, BEND_RADIUS]
            if rows[k, SIDE] * rows[k + 1, SIDE] < 0.0:
                return count, k
            dropped = k if here < after else k + 1  # the one that lies within the other
            if dropped == 0:
                dropped = 1
            if dropped == count - 1:
                dropped = count - 2
            break
        if dropped < 0:
            for k in range(1, count - 1):
                turn = rows[k, SIDE] * (rows[k + 1, HEADING_IN] - rows[k, HEADING_IN])
                turn -= math.tau * math.floor((turn - rows[k, TURN] + math.pi) / math.tau)
                if turn < -1e-12:
                    dropped = k
                    break
                rows[k, TURN] = max(turn, 0.0)
        if dropped < 0:
            return count, -1
        if dropped <= 0 or dropped >= count - 1:
            return count, min(max(dropped - 1, 0), count - 2)
        count = _remove(rows, count, dropped)


@inner
def _closest_on(
    world: PackedWorld, ax: float, ay: float, bx: float, by: float, floor: float
) -> tuple[float, float]:
    """A place on a segment near which it comes closer than ``floor`` to the world."""
    size = math.hypot(bx - ax, by - ay)
    while size > 0.25 * floor + SMALL:
        mx = 0.5 * (ax + bx)
        my = 0.5 * (ay + by)
        first, _ = nearest_to_segment(world, ax, ay, mx, my, floor)
        second, _ = nearest_to_segment(world, mx, my, bx, by, floor)
        if first <= second:
            bx = mx
            by = my
        else:
            ax = mx
            ay = my
        size *= 0.5
    return 0.5 * (ax + bx), 0.5 * (ay + by)


@inner
def _most_in_the_way(
    rows: Floats, k: int, guide: Floats, found: Floats, near: int, rho: float, heading: float
) -> tuple[int, float, float]:
    """The feature that a line after row k has to be bent round most, its side, and its place.

    The line goes from the touching point of row k along ``heading``.
    """
    dx = math.cos(heading)
    dy = math.sin(heading)
    reach = rows[k, SIDE] * rows[k, BEND_RADIUS]
    ax = rows[k, BEND_X] + reach * dy
    ay = rows[k, BEND_Y] - reach * dx
    first = int(rows[k, PLACE])
    last = min(math.ceil(rows[k + 1, PLACE]), guide.shape[0] - 1)
    best = 1e-9 * (1.0 + rho)
    chosen = -1
    side = 0.0
    place = 0.0
    for j in range(near):
        feature = found[j]
        at = _foot(guide, first, max(last, first + 1), feature[FEATURE_X], feature[FEATURE_Y])
        here = _side_of(guide, at, feature)
        left = dx * (feature[FEATURE_Y] - ay) - dy * (feature[FEATURE_X] - ax)
        violation = feature[FEATURE_RADIUS] + rho - here * left
        if violation > best and not (
            _is_row(rows, k, feature, here) or _is_row(rows, k + 1, feature, here)
        ):
            best = violation
            chosen = j
            side = here
            place = at
    return chosen, side, place


@inner
def _is_row(rows: Floats, k: int, feature: Floats, side: float) -> bool:
    return (
        rows[k, BEND_X] == feature[FEATURE_X]
        and rows[k, BEND_Y] == feature[FEATURE_Y]
        and rows[k, SIDE] == side
    )


@inner
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


@inner
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
    if k == 0:
        return -1, heading, ax, ay
    x, y, turned = _arc_conflict(world, rows, k, floor)
    if turned < 0.0:
        return -1, heading, x, y
    at = k if turned >= 0.5 * rows[k, TURN] else k - 1
    return at, rows[k, HEADING_IN] + rows[k, SIDE] * turned, x, y


@inner
def _chord(
    world: PackedWorld, x: float, y: float, reach: float
) -> tuple[float, float, float, float]:
    """From (x, y) to the nearest obstacle and straight back to what is opposite [m]."""
    distance, _ = nearest(world, x, y, np.inf)
    step = 1e-3 * reach + SMALL
    east, _ = nearest(world, x + step, y, np.inf)
    north, _ = nearest(world, x, y + step, np.inf)
    dx = east - distance
    dy = north - distance
    size = math.hypot(dx, dy)
    if size == 0.0:
        return x, y, x, y
    dx /= size
    dy /= size
    ahead = 0.0
    here = max(distance, 0.0)
    while here > 1e-3 * reach and ahead < 4.0 * reach:
        ahead += here
        here, _ = nearest(world, x + ahead * dx, y + ahead * dy, np.inf)
    ahead += here  # at least as far as what is opposite
    return x - distance * dx, y - distance * dy, x + ahead * dx, y + ahead * dy


@inner
def _narrowest(world: PackedWorld, guide: Floats, place: float, rho: float, gap: Floats) -> None:
    """Write the shortest segment across the guide near a place on it to ``gap``, (1, 4)."""
    best = np.inf
    for sense in range(2):
        k = min(int(place), guide.shape[0] - 2)
        w = place - k
        travelled = 0.0
        while travelled <= 3.0 * rho and 0 <= k < guide.shape[0] - 1:
            dx = guide[k + 1, 0] - guide[k, 0]
            dy = guide[k + 1, 1] - guide[k, 1]
            size = math.hypot(dx, dy)
            if 0.0 <= w <= 1.0 and size > 0.0:
                ax, ay, bx, by = _chord(world, guide[k, 0] + w * dx, guide[k, 1] + w * dy, rho)
                width = math.hypot(bx - ax, by - ay)
                if width < best:
                    best = width
                    gap[0, 0] = ax
                    gap[0, 1] = ay
                    gap[0, 2] = bx
                    gap[0, 3] = by
            travelled += 0.1 * rho
            move = 0.1 * rho / max(size, SMALL)
            w = w + move if sense == 1 else w - move
            if w > 1.0:
                k += 1
                w = 0.0
            elif w < 0.0:
                k -= 1
                w = 1.0


@inner
def _times(history: Floats, count: int, feature: Floats, side: float) -> int:
    """How often a feature has been put in on this side."""
    times = 0
    for i in range(count):
        if (
            history[i, 0] == feature[FEATURE_X]
            and history[i, 1] == feature[FEATURE_Y]
            and history[i, 2] == side
        ):
            times += 1
    return times


@kernel
def pulled_taut(
    world: PackedWorld, guide: Floats, rho: float, floor: float, side: float
) -> tuple[int, Floats, Floats]:
    """The taut string of a guide.

    Args:
        world: PackedWorld.
        guide: Places from start to goal that pass everything on the right sides, (k, 2) [m].
        rho: Distance from features at which the string turns [m], more than ``floor``.
        floor: Distance that the string keeps [m].
        side: How far the guide's corners may be from the features that they go round [m].

    Returns:
        (status, bends (n, 6) as in ``taut``, gap (1, 4)): TAUT with the bends, or TOO_NARROW with
        the segment x0, y0, x1, y1 across the gap that the guide goes through.
    """
    found = np.empty((ROOM, 5))
    gap = np.zeros((1, 4))
    rows, count = _begin(world, guide, rho, side, found)
    history = np.empty((64, 3))
    insertions = 0
    k = 0
    touched = True
    while True:
        before = count
        count, narrow = _slacken(rows, count)
        if narrow >= 0:
            gap[0, 0] = rows[narrow, BEND_X]
            gap[0, 1] = rows[narrow, BEND_Y]
            gap[0, 2] = rows[narrow + 1, BEND_X]
            gap[0, 3] = rows[narrow + 1, BEND_Y]
            return TOO_NARROW, rows[:0, :6].copy(), gap
        k = max(0, k - 2 - before + count)
        at = -1
        while k < count - 1:
            at, heading, x, y = _conflict(world, rows, k, floor)
            if at >= 0:
                break
            k += 1
        if at < 0:
            if not touched:
                break
            touched = False
            k = 0
            continue
        touched = True
        chosen = -1
        lean = 0.0
        place = 0.0
        wide = 1.26 * floor + SMALL
        while chosen < 0 and wide < 40.0 * floor + 4.0 * side:
            near = features_near(world, x, y, wide, found)
            chosen, lean, place = _most_in_the_way(rows, k, guide, found, near, rho, heading)
            wide *= 2.0
        if chosen < 0 or _times(history, insertions, found[chosen], lean) > 2:
            if chosen < 0:
                first = int(rows[k, PLACE])
                place = _foot(guide, first, guide.shape[0] - 1, x, y)
            _narrowest(world, guide, place, rho, gap)
            return TOO_NARROW, rows[:0, :6].copy(), gap
        if insertions == history.shape[0]:
            history = _grown(history)
        history[insertions, 0] = found[chosen, FEATURE_X]
        history[insertions, 1] = found[chosen, FEATURE_Y]
        history[insertions, 2] = lean
        insertions += 1
        rows = _insert(rows, count, at + 1)
        _write(
            rows, at + 1, found[chosen, FEATURE_X], found[chosen, FEATURE_Y],
            found[chosen, FEATURE_RADIUS] + rho, lean, place,
        )  # fmt: skip
        count += 1
    bends = np.empty((count, 6))
    for i in range(count):
        for j in range(6):
            bends[i, j] = rows[i, j]
    bends[0, TURN] = 0.0
    bends[count - 1, TURN] = 0.0
    return TAUT, bends, gap


@kernel
def narrow_places(world: PackedWorld, guide: Floats, rho: float) -> Floats:
    """Segments across a guide where it goes between two things less than 2 rho apart.

    No path that keeps ``rho`` crosses such a segment: every place on it is nearer to one of its
    two ends.

    Args:
        world: PackedWorld.
        guide: (k, 2) [m].
        rho: Distance to keep [m].

    Returns:
        Segments x0, y0, x1, y1 [m], (n, 4).
    """
    rows = np.empty((16, 4))
    count = 0
    for k in range(guide.shape[0] - 1):
        dx = guide[k + 1, 0] - guide[k, 0]
        dy = guide[k + 1, 1] - guide[k, 1]
        size = math.hypot(dx, dy)
        travelled = 0.0
        while travelled < size:
            x = guide[k, 0] + travelled / size * dx
            y = guide[k, 1] + travelled / size * dy
            distance, _ = nearest(world, x, y, 4.0 * rho)
            travelled += 0.25 * rho + max(distance - rho, 0.0)
            if distance >= rho:
                continue
            ax, ay, bx, by = _chord(world, x, y, rho)
            if math.hypot(bx - ax, by - ay) >= 2.0 * rho * (1.0 - 1e-6):
                continue
            if count == rows.shape[0]:
                rows = _grown(rows)
            rows[count, 0] = ax
            rows[count, 1] = ay
            rows[count, 2] = bx
            rows[count, 3] = by
            count += 1
            travelled += 0.75 * rho
    return rows[:count].copy()


@kernel
def is_clear_polyline(world: PackedWorld, corners: Floats, floor: float) -> bool:
    """Whether every piece of a polyline, its first two columns x and y, keeps ``floor`` [m]."""
    for k in range(corners.shape[0] - 1):
        distance, _ = nearest_to_segment(
            world, corners[k, 0], corners[k, 1], corners[k + 1, 0], corners[k + 1, 1], floor
        )
        if distance < floor:
            return False
    return True
