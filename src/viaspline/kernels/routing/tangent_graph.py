"""The exact shortest route among inflated obstacles, activated only when they are hit.

A* in the tangent visibility graph of the active obstacles alone; the route that it finds is held
against the whole world; what it hits becomes active; again, until nothing new is hit. A route that
is shortest among fewer obstacles and hits no other is the shortest among all.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.jit import inner, kernel, uncounted
from viaspline.kernels.world.corner_fans import (
    CORNER_COLUMNS,
    X,
    Y,
    fence_corners,
    supports,
)
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.ring_distance import rings_gap
from viaspline.kernels.world.segment import inner_segment, mark_near_segment
from viaspline.kernels.world.shape import obstacle_corners, obstacle_segment

MAX_CORNERS = 8_000
"""Beyond so many the search, which looks at every pair, is given up."""


@uncounted
def _crosses_barrier(barriers: Floats, ax: float, ay: float, bx: float, by: float) -> bool:
    for k in range(barriers.shape[0]):
        cx = barriers[k, 0]
        cy = barriers[k, 1]
        dx = barriers[k, 2]
        dy = barriers[k, 3]
        side_a = (dx - cx) * (ay - cy) - (dy - cy) * (ax - cx)
        side_b = (dx - cx) * (by - cy) - (dy - cy) * (bx - cx)
        if (side_a > 0.0) == (side_b > 0.0):
            continue
        side_c = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        side_d = (bx - ax) * (dy - ay) - (by - ay) * (dx - ax)
        if (side_c > 0.0) != (side_d > 0.0):
            return True
    return False


@uncounted
def _bring_forward(members: Floats, k: int) -> None:
    """Move a member half way to the front: what blocked one segment blocks others near it."""
    forward = k // 2
    for column in range(members.shape[1]):
        members[k, column], members[forward, column] = members[forward, column], members[k, column]


@uncounted
def is_clear(
    world: PackedWorld,
    members: Floats,
    barriers: Floats,
    ax: float,
    ay: float,
    bx: float,
    by: float,
    floor: float,
) -> bool:
    """Whether the segment a-b keeps ``floor`` from the given obstacles and crosses no barrier."""
    if barriers.shape[0] > 0 and _crosses_barrier(barriers, ax, ay, bx, by):
        return False
    if inner_segment(world, ax, ay, bx, by, floor)[0] < floor:
        return False
    x0 = min(ax, bx) - floor
    x1 = max(ax, bx) + floor
    y0 = min(ay, by) - floor
    y1 = max(ay, by) + floor
    for k in range(members.shape[0]):
        if members[k, 1] > x1 or members[k, 3] < x0 or members[k, 2] > y1 or members[k, 4] < y0:
            continue
        if obstacle_segment(world, int(members[k, 0]), ax, ay, bx, by, floor) < floor:
            _bring_forward(members, k)
            return False
    return True


@inner
def _members(world: PackedWorld, active: Flags) -> Floats:
    """Index and box of every active obstacle, (k, 5)."""
    count = 0
    for i in range(active.size):
        if active[i]:
            count += 1
    rows = np.empty((count, 5))
    count = 0
    for node in range(world.leaf.size):
        i = world.leaf[node]
        if i >= 0 and active[i]:
            rows[count, 0] = i
            for side in range(4):
                rows[count, 1 + side] = world.boxes[node, side]
            count += 1
    return rows


@inner
def _corners(
    world: PackedWorld, members: Floats, start: Floats, goal: Floats, rho: float, step: float
) -> Floats:
    """Start, goal, then the corners of all fences and members, (n, 8)."""
    room = 64
    while True:
        corners = np.zeros((room, CORNER_COLUMNS))
        corners[0, X] = start[0]
        corners[0, Y] = start[1]
        corners[1, X] = goal[0]
        corners[1, Y] = goal[1]
        count = fence_corners(world, rho, step, corners, 2)
        for k in range(members.shape[0]):
            count = obstacle_corners(world, int(members[k, 0]), rho, step, corners, count)
        if count <= room:
            return corners[:count]
        room = count


@inner
def _search(
    world: PackedWorld, members: Floats, corners: Floats, barriers: Floats, floor: float
) -> Ints:
    """A* from corner 0 to corner 1; returns each corner's predecessor, -1 where there is none."""
    count = corners.shape[0]
    cost = np.full(count, np.inf)
    rank = np.full(count, np.inf)
    before = np.full(count, -1, np.int64)
    closed = np.zeros(count, np.bool_)
    gx = corners[1, X]
    gy = corners[1, Y]
    cost[0] = 0.0
    rank[0] = 0.0
    while True:
        here = -1
        best = np.inf
        for k in range(count):
            if rank[k] < best and not closed[k]:
                best = rank[k]
                here = k
        if here < 0 or here == 1:
            return before
        closed[here] = True
        x = corners[here, X]
        y = corners[here, Y]
        for k in range(1, count):
            if closed[k]:
                continue
            dx = corners[k, X] - x
            dy = corners[k, Y] - y
            price = cost[here] + math.sqrt(dx * dx + dy * dy)
            if price >= cost[k]:
                continue
            if here > 1 and not supports(corners, here, dx, dy):
                continue
            if k > 1 and not supports(corners, k, dx, dy):
                continue
            ahead = price + math.hypot(gx - corners[k, X], gy - corners[k, Y])
            if k > 1 and ahead >= cost[1]:
                continue  # the goal comes before it
            if not is_clear(world, members, barriers, x, y, x + dx, y + dy, floor):
                continue
            cost[k] = price
            before[k] = here
            rank[k] = ahead


@kernel
def shortest_route(
    world: PackedWorld,
    start: Floats,
    goal: Floats,
    rho: float,
    floor: float,
    step: float,
    barriers: Floats,
    active: Flags,
    most: int,
) -> Floats:
    """The shortest route from start to goal as a list of corners.

    Args:
        world: PackedWorld.
        start: (2,) [m].
        goal: (2,) [m].
        rho: Distance from obstacles at which the route turns [m], more than ``floor``.
        floor: Distance that every segment keeps [m].
        step: Largest turn at one corner [rad]: how closely arcs are wrapped.
        barriers: Segments x0, y0, x1, y1 that the route must not cross, (b, 4).
        active: (n,) of bool: obstacles to begin with; those met are added in place.
        most: Active obstacles beyond which the search is given up.

    Returns:
        Corners from start to goal, (k, 8); no rows when there is no route, or when more than
        ``most`` obstacles are active, or they have more than ``MAX_CORNERS`` corners.
    """
    mark_near_segment(world, start[0], start[1], goal[0], goal[1], floor, active)
    while True:
        members = _members(world, active)
        if members.shape[0] > most:
            return np.empty((0, CORNER_COLUMNS))
        corners = _corners(world, members, start, goal, rho, step)
        if corners.shape[0] > MAX_CORNERS:
            return np.empty((0, CORNER_COLUMNS))
        before = _search(world, members, corners, barriers, floor)
        if before[1] < 0:
            return corners[:0]
        length = 1
        k = 1
        while k != 0:
            k = before[k]
            length += 1
        route = np.empty((length, corners.shape[1]))
        k = 1
        new = 0
        for row in range(length - 1, -1, -1):
            for column in range(corners.shape[1]):
                route[row, column] = corners[k, column]
            if row < length - 1:
                new += mark_near_segment(
                    world, route[row, X], route[row, Y], route[row + 1, X], route[row + 1, Y],
                    floor, active,
                )  # fmt: skip
            k = before[k]
        if new == 0:
            return route


@kernel
def has_narrow_gap(world: PackedWorld, active: Flags, low: float, high: float) -> bool:
    """Whether two active obstacles, or one and the bounds, stand between low and high apart [m].

    Circumscribed corners may close such a gap although a robot fits through.
    """
    members = _members(world, active)
    for k in range(members.shape[0]):
        i = int(members[k, 0])
        if world.bounds.shape[0] > 0:
            gap = min(members[k, 1] - world.bounds[0, 0], members[k, 2] - world.bounds[0, 1])
            gap = min(gap, world.bounds[0, 2] - members[k, 3])
            gap = min(gap, world.bounds[0, 3] - members[k, 4])
            if low <= gap <= high:
                return True
        for other in range(k):
            x0 = members[k, 1] - members[other, 3]
            y0 = members[k, 2] - members[other, 4]
            x1 = members[other, 1] - members[k, 3]
            y1 = members[other, 2] - members[k, 4]
            if max(max(x0, x1), max(y0, y1)) > high:
                continue
            gap = rings_gap(world, world.slot[i], world.slot[int(members[other, 0])], high)
            if low <= gap < high:
                return True
    return False


@kernel
def barrier_crossings(route: Floats, barrier: Floats) -> tuple[int, int]:
    """How often a route of corners crosses a barrier, and after which corner it does so first."""
    count = 0
    first = -1
    for k in range(route.shape[0] - 1):
        if _crosses_barrier(barrier, route[k, X], route[k, Y], route[k + 1, X], route[k + 1, Y]):
            count += 1
            if first < 0:
                first = k
    return count, first
