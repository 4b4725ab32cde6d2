"""A taut string whose end is drawn along a guide: it wraps round what it meets, and unwraps.

While the end moves, the last tangent turns about the feature at which it begins. Where it meets
another feature the string bends round that, on the side from which it came; where it has turned
back to the heading with which it comes to its feature, the string leaves that. So the string is
taut at every moment and can be bent into the guide, without any look at which side of the guide
a feature lies on. All that it takes is that the guide itself keeps the distance.

Tested through ``kernels/routing/string_pulling/test_pull``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.growable import new_floats
from viaspline.kernels.jit import fused, inlined, uncounted
from viaspline.kernels.routing.string_pulling.features import features_near
from viaspline.kernels.routing.string_pulling.string_conflicts import (
    SAME_DISTANCE_M,
    arc_conflict,
    closest_on,
)
from viaspline.kernels.routing.string_pulling.string_rows import (
    PLACE,
    ROW_COLUMNS,
    insert,
    write,
    write_end,
)
from viaspline.kernels.routing.tangent_arcs import (
    BEND_RADIUS,
    BEND_X,
    BEND_Y,
    HEADING_IN,
    SIDE,
    TURN,
    nearest_turn,
)
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.ring_features import FEATURE_RADIUS, FEATURE_X, FEATURE_Y
from viaspline.kernels.world.segment import nearest_to_segment

MAX_EVENTS = 1000  # of one step of the end
MOST_BACK_RAD = 0.5  # of a tangent, to what it is a little too near to already
LEAST_SHARE = 1e-3  # of a step of the end
MAX_EARLIER = 100  # features that are met before the one that was found first
MAX_FEATURES_MET = 1024  # features that are looked at near one place


@inlined
def _heading_to(
    rows: Floats, k: int, x: float, y: float, reach: float, about: float
) -> float:  # fmt: skip
    """Heading of the line that leaves row k and passes (x, y) at ``reach`` to its right [rad]."""
    dx = x - rows[k, BEND_X]
    dy = y - rows[k, BEND_Y]
    gap = math.hypot(dx, dy)
    if gap == 0.0:
        return about
    sine = (reach - rows[k, SIDE] * rows[k, BEND_RADIUS]) / gap
    return nearest_turn(math.atan2(dy, dx) - math.asin(min(max(sine, -1.0), 1.0)), about)


@inlined
def _touched(rows: Floats, k: int, heading: float) -> tuple[float, float]:
    """Where a line of this heading leaves row k."""
    reach = rows[k, SIDE] * rows[k, BEND_RADIUS]
    return rows[k, BEND_X] + reach * math.sin(heading), rows[k, BEND_Y] - reach * math.cos(heading)


@inlined
def _on_step(
    ax: float, ay: float, heading: float, x: float, y: float, tx: float, ty: float
) -> float:
    """Which part of the step from (x, y) to (tx, ty) lies before a line from (ax, ay)."""
    dx = math.cos(heading)
    dy = math.sin(heading)
    before = dx * (y - ay) - dy * (x - ax)
    after = dx * (ty - ay) - dy * (tx - ax)
    if before == after:
        return 1.0
    return min(max(before / (before - after), 0.0), 1.0)


@inlined
def _first_met(
    rows: Floats, k: int, found: Floats, near: int, rho: float, x: float, y: float, tx: float,
    ty: float, old: float, heading: float, length: float, sense: float,
) -> tuple[int, float]:  # fmt: skip
    """The feature that the last tangent meets first when it turns from a heading to another.

    Args:
        rows: The string.
        k: Its last row.
        found: Features.
        near: How many.
        rho: Distance at which the string turns [m].
        x: Where its end is [m].
        y: The same.
        tx: Where its end is moved to [m].
        ty: The same.
        old: The heading of the tangent, which is clear [rad].
        heading: The one to which it turns [rad].
        length: Of the tangent, at most [m].
        sense: +1 where it turns to the left, else -1.

    Returns:
        (row in ``found``, heading of the tangent to it [rad]); -1 where it meets none.
    """
    ax, ay = _touched(rows, k, old)
    bx, by = _touched(rows, k, heading)
    behind = rows[k, BEND_RADIUS]
    chosen = -1
    best = heading
    for j in range(near):
        radius = found[j, FEATURE_RADIUS] + rho
        was = math.cos(old) * (found[j, FEATURE_Y] - ay) - math.sin(old) * (
            found[j, FEATURE_X] - ax
        )
        if sense * was <= 0.5 * radius - SAME_DISTANCE_M:
            continue
        dx = found[j, FEATURE_X] - bx
        dy = found[j, FEATURE_Y] - by
        left = math.cos(heading) * dy - math.sin(heading) * dx
        along = math.cos(heading) * dx + math.sin(heading) * dy
        if (
            sense * left >= radius - SAME_DISTANCE_M
            or not -2.0 * behind - radius < along < length + radius
        ):
            continue
        there = _heading_to(rows, k, found[j, FEATURE_X], found[j, FEATURE_Y], sense * radius, old)
        if sense * (there - best) >= 0.0 or sense * (there - old) < -MOST_BACK_RAD:
            continue
        cx, cy = _touched(rows, k, there)
        w = _on_step(cx, cy, there, x, y, tx, ty)
        reach = math.hypot(x + w * (tx - x) - cx, y + w * (ty - y) - cy)
        dx = found[j, FEATURE_X] - cx
        dy = found[j, FEATURE_Y] - cy
        if math.cos(there) * dx + math.sin(there) * dy < reach + SAME_DISTANCE_M:
            best = there
            chosen = j
    return chosen, best


@uncounted
def _meets(
    world: PackedWorld, rows: Floats, k: int, old: float, heading: float, x: float, y: float,
    floor: float,
) -> tuple[bool, float, float]:  # fmt: skip
    """Whether the arc of row k or the tangent from it to (x, y) is too close, and where."""
    if k > 0 and rows[k, SIDE] * (heading - old) > 0.0:
        begun = rows[k, SIDE] * (old - rows[k, HEADING_IN])
        turn = rows[k, SIDE] * (heading - rows[k, HEADING_IN])
        cx, cy, at = arc_conflict(world, rows, k, max(begun, 0.0), turn, floor)
        if at >= 0.0:
            return True, cx, cy
    ax, ay = _touched(rows, k, heading)
    distance, _ = nearest_to_segment(world, ax, ay, x, y, floor)
    if distance >= floor:
        return False, 0.0, 0.0
    cx, cy = closest_on(world, ax, ay, x, y, floor, 0.25 * floor)
    return True, cx, cy


@fused
def _step(
    world: PackedWorld, rows: Floats, count: int, place: float, x: float, y: float, tx: float,
    ty: float, old: float, rho: float, floor: float, found: Floats,
) -> tuple[Floats, int, float, float, float, bool]:  # fmt: skip
    """One event of the end's way from (x, y) to (tx, ty): the string, where its end is, heading.

    Returns:
        (rows, count, x, y, heading, whether something stops the string that is no feature).
    """
    k = count - 1
    heading = _heading_to(rows, k, tx, ty, 0.0, old)
    px = tx
    py = ty
    leaves = False
    if k > 0 and rows[k, SIDE] * (heading - rows[k, HEADING_IN]) < 0.0:
        leaves = True
        heading = rows[k, HEADING_IN]
        ax, ay = _touched(rows, k, heading)
        w = _on_step(ax, ay, heading, x, y, tx, ty)
        px = x + w * (tx - x)
        py = y + w * (ty - y)
    sense = math.copysign(1.0, heading - old)
    met = False
    for _ in range(MAX_EARLIER):
        is_close, cx, cy = _meets(world, rows, k, old, heading, px, py, floor)
        if not is_close:
            break
        chosen = -1
        there = heading
        ax, ay = _touched(rows, k, heading)
        length = math.hypot(px - ax, py - ay)
        wide = 1.26 * floor + SAME_DISTANCE_M
        while chosen < 0 and wide < 2.0 * length + 8.0 * floor:
            near = features_near(world, cx, cy, wide, found[1:])
            chosen, there = _first_met(
                rows, k, found[1:], near, rho, x, y, tx, ty, old, heading, length, sense
            )
            wide *= 2.0
        if chosen < 0:
            return rows, count, x, y, old, True
        for column in range(found.shape[1]):
            found[0, column] = found[1 + chosen, column]
        met = True
        leaves = False
        heading = there
        ax, ay = _touched(rows, k, heading)
        w = _on_step(ax, ay, heading, x, y, tx, ty) if sense * (heading - old) > 0.0 else 0.0
        px = x + w * (tx - x)
        py = y + w * (ty - y)
        if w == 0.0:
            break
    if met:
        rows = insert(rows, count, count)
        write(rows, count, found, 0, rho, sense, place)
        rows[count, HEADING_IN] = heading
        rows[k, TURN] = rows[k, SIDE] * (heading - rows[k, HEADING_IN])
        count += 1
    elif leaves:
        count -= 1
    return rows, count, px, py, heading, False


@fused
def drawn(
    world: PackedWorld, guide: Floats, rho: float, floor: float, step: float
) -> tuple[Floats, int, float]:
    """The taut string of a guide that keeps the distance itself.

    Args:
        world: PackedWorld.
        guide: (k, 2) [m].
        rho: Distance from features at which the string turns [m].
        floor: Distance that it keeps [m], a little less.
        step: By how much the end is moved at a time [m]: what is wider is met on the way.

    Returns:
        (rows, how many, where along the guide it got stuck); none where it did.
    """
    found = new_floats(MAX_FEATURES_MET, 5)
    rows = new_floats(64, ROW_COLUMNS)
    write_end(rows, 0, guide, 0)
    count = 1
    x = guide[0, 0]
    y = guide[0, 1]
    heading = math.atan2(guide[1, 1] - y, guide[1, 0] - x)
    for k in range(guide.shape[0] - 1):
        size = math.hypot(guide[k + 1, 0] - guide[k, 0], guide[k + 1, 1] - guide[k, 1])
        parts = max(1, math.ceil(size / step))
        for part in range(parts):
            w = (part + 1) / parts
            tx = guide[k, 0] + w * (guide[k + 1, 0] - guide[k, 0])
            ty = guide[k, 1] + w * (guide[k + 1, 1] - guide[k, 1])
            place = k + (part + 0.5) / parts
            share = 1.0  # of the way to there that is tried at once
            events = 0
            while x != tx or y != ty:
                nx = x + share * (tx - x) if share < 1.0 else tx
                ny = y + share * (ty - y) if share < 1.0 else ty
                rows, count, x, y, heading, is_stuck = _step(
                    world, rows, count, place, x, y, nx, ny, heading, rho, floor, found
                )
                events += 1
                if events > MAX_EVENTS or (is_stuck and share < LEAST_SHARE):
                    return rows, 0, place
                share = 0.5 * share if is_stuck else min(1.0, 4.0 * share)
    rows = insert(rows, count, count)
    write_end(rows, count, guide, guide.shape[0] - 1)
    rows[count, HEADING_IN] = heading
    rows[count, PLACE] = guide.shape[0] - 1
    k = count - 1
    rows[k, TURN] = rows[k, SIDE] * (heading - rows[k, HEADING_IN])
    return rows, count + 1, -1.0
