"""Shortest paths through a mesh of rectangles: Polyanya.

Michael Cui, Daniel Harabor, Alban Grastien: "Compromise-free Pathfinding on a Navigation Mesh",
IJCAI 2017. A* over intervals: a node is the part [a, b] of a portal that is seen from its root, the
last place where the path turned. The path that it finds is the shortest of all in the mesh.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.mesh import Mesh, rectangle_at
from viaspline.kernels.packed import Floats, Ints

TINY = 1e-9
# columns of a node
A, B, ROOT_X, ROOT_Y, COST = range(5)
PORTAL, UP, ROOT, PARENT = range(4)
START = -1  # the root before the first turn
GOAL = -2  # in place of the portal: the path has arrived


@inner
def _push(keys: Floats, items: Ints, size: int, key: float, item: int) -> int:
    k = size
    while k > 0:
        parent = (k - 1) >> 1
        if keys[parent] <= key:
            break
        keys[k] = keys[parent]
        items[k] = items[parent]
        k = parent
    keys[k] = key
    items[k] = item
    return size + 1


@inner
def _pop(keys: Floats, items: Ints, size: int) -> int:
    """Take the first item away; it stands at ``items[size - 1]`` then."""
    first = items[0]
    size -= 1
    key = keys[size]
    item = items[size]
    k = 0
    while True:
        child = 2 * k + 1
        if child >= size:
            break
        if child + 1 < size and keys[child + 1] < keys[child]:
            child += 1
        if keys[child] >= key:
            break
        keys[k] = keys[child]
        items[k] = items[child]
        k = child
    keys[k] = key
    items[k] = item
    items[size] = first
    return size


@inner
def _crossing(
    rx: float, ry: float, a: float, b: float, y: float, gx: float, gy: float
) -> tuple[float, float]:
    """Where the shortest way from a root through [a, b] at y to the goal crosses, and its length.

    A goal on the root's side is mirrored: a path that has to go through the interval and come
    back is as long as one to its image.
    """
    if (gy < y) == (ry < y) and gy != y and ry != y:
        gy = 2.0 * y - gy
    elif ry == y and gy == y:
        x = min(max(rx, a), b)
        return x, abs(x - rx) + abs(gx - x)
    x = rx + (gx - rx) * (y - ry) / (gy - ry) if gy != ry else rx
    x = min(max(x, a), b)
    return x, math.hypot(x - rx, y - ry) + math.hypot(gx - x, gy - y)


@inner
def _grown_floats(rows: Floats) -> Floats:
    larger = np.empty((2 * rows.shape[0], rows.shape[1]))
    for i in range(rows.shape[0]):
        for k in range(rows.shape[1]):
            larger[i, k] = rows[i, k]
    return larger


@inner
def _grown_ints(rows: Ints) -> Ints:
    larger = np.empty((2 * rows.shape[0], rows.shape[1]), np.int64)
    for i in range(rows.shape[0]):
        for k in range(rows.shape[1]):
            larger[i, k] = rows[i, k]
    return larger


@inner
def _range(mesh: Mesh, first: int, last: int, low: float, high: float) -> tuple[int, int]:
    """Those of the portals first:last, which stand from left to right, that meet [low, high]."""
    portals = mesh.portals
    if last - first > 8:
        left = first
        right = last
        while left < right:
            middle = (left + right) >> 1
            if portals[middle, 1] <= low + TINY:
                left = middle + 1
            else:
                right = middle
        first = left
    else:
        while first < last and portals[first, 1] <= low + TINY:
            first += 1
    end = first
    while end < last and portals[end, 0] < high - TINY:
        end += 1
    return first, end


@kernel
def shortest_path(mesh: Mesh, start: Floats, goal: Floats) -> Floats:
    """The shortest path between two places of a mesh.

    Args:
        mesh: Mesh.
        start: (2,) [cells].
        goal: (2,) [cells].

    Returns:
        Start, the corners where it turns, goal, (k, 2) [cells]; no rows where there is no path.
    """
    sx = start[0]
    sy = start[1]
    gx = goal[0]
    gy = goal[1]
    first_room = rectangle_at(mesh, sx, sy)
    last_room = rectangle_at(mesh, gx, gy)
    path = np.empty((2, 2))
    if first_room < 0 or last_room < 0:
        return path[:0]
    if first_room == last_room:
        path[0, 0] = sx
        path[0, 1] = sy
        path[1, 0] = gx
        path[1, 1] = gy
        return path
    cheapest = np.full(2 * mesh.portals.shape[0], np.inf)
    places = np.empty((1024, 5))
    links = np.empty((1024, 4), np.int64)
    keys = np.empty(1024)
    items = np.empty(1024, np.int64)
    count = 0
    size = 0
    # what is to be made of the node that is being expanded: a queue of (portal, up, a, b, root)
    here = -1
    while True:
        if here < 0:
            room = first_room
            a = b = rx = 0.0
            ry = sy
            rx = sx
            cost = 0.0
            root = START
            up = 1
            stages = 2  # at the start: what is above, then what is below
        else:
            portal = links[here, PORTAL]
            up = links[here, UP]
            room = mesh.portals[portal, 4] if up == 1 else mesh.portals[portal, 3]
            a = places[here, A]
            b = places[here, B]
            rx = places[here, ROOT_X]
            ry = places[here, ROOT_Y]
            cost = places[here, COST]
            root = links[here, ROOT]
            stages = 5
        left = float(mesh.rectangles[room, 0])
        right = float(mesh.rectangles[room, 1])
        bottom = float(mesh.rectangles[room, 2])
        top = float(mesh.rectangles[room, 3])
        near = bottom if up == 1 else top
        far = top if up == 1 else bottom
        if here >= 0 and room == last_room:
            x, rest = _crossing(rx, ry, a, b, near, gx, gy)
            if count + 1 >= places.shape[0]:
                places = _grown_floats(places)
                links = _grown_ints(links)
            places[count, A] = x
            places[count, B] = x
            places[count, ROOT_X] = rx
            places[count, ROOT_Y] = ry
            places[count, COST] = cost + rest
            links[count, PORTAL] = GOAL
            links[count, UP] = up
            links[count, ROOT] = root
            links[count, PARENT] = here
            if size + 1 >= keys.size:
                keys, items = _roomier(keys, items)
            size = _push(keys, items, size, cost + rest, count)
            count += 1
        # the far side as the root sees it through the interval
        low = left
        high = right
        if here >= 0 and ry != near:
            scale = (far - ry) / (near - ry)
            low = rx + (a - rx) * scale
            high = rx + (b - rx) * scale
        left_turn = False
        right_turn = False
        if here >= 0:
            left_turn = a == mesh.portals[portal, 0] and mesh.turns[portal, 0] == 1
            right_turn = b == mesh.portals[portal, 1] and mesh.turns[portal, 1] == 1
        left_cost = np.inf
        right_cost = np.inf
        if left_turn:
            left_cost = cost + math.hypot(a - rx, near - ry)
            if left_cost > cheapest[2 * portal] + TINY:
                left_turn = False
            else:
                cheapest[2 * portal] = left_cost
        if right_turn:
            right_cost = cost + math.hypot(b - rx, near - ry)
            if right_cost > cheapest[2 * portal + 1] + TINY:
                right_turn = False
            else:
                cheapest[2 * portal + 1] = right_cost
        for stage in range(stages):
            # 0: seen on the far side; 1, 2: the far side round either end; 3, 4: back through the
            # near side, round either end. At the start 1 is what lies below.
            go_up = up
            from_x = rx
            from_y = ry
            price = cost
            origin = root
            back = False
            if stage == 0:
                window_low = max(low, left)
                window_high = min(high, right)
            elif here < 0:
                go_up = 0
                window_low = left
                window_high = right
            elif stage == 1 or stage == 3:
                if not left_turn:
                    continue
                from_x = a
                from_y = near
                price = left_cost
                origin = 2 * portal
                window_low = left
                window_high = min(low, right) if stage == 1 else a
                back = stage == 3
            else:
                if not right_turn:
                    continue
                from_x = b
                from_y = near
                price = right_cost
                origin = 2 * portal + 1
                window_low = max(high, left) if stage == 2 else b
                window_high = right
                back = stage == 4
            if back:
                go_up = 1 - up
            if window_high - window_low <= TINY:
                continue
            doors = mesh.above if go_up == 1 else mesh.below
            first, last = _range(mesh, doors[room, 0], doors[room, 1], window_low, window_high)
            for door in range(first, last):
                if door == (portal if here >= 0 else -1):
                    continue
                new_a = float(mesh.portals[door, 0])
                new_b = float(mesh.portals[door, 1])
                if window_low > new_a + TINY:  # else it is the end itself, where paths turn
                    new_a = window_low
                if window_high < new_b - TINY:
                    new_b = window_high
                y = float(mesh.portals[door, 2])
                root_x = from_x
                new_root = origin
                new_price = price
                if from_y == y and (from_x < new_a or from_x > new_b):
                    # along the wall to the nearer end of the portal, and round it
                    end = 0 if from_x < new_a else 1
                    root_x = new_a if end == 0 else new_b
                    new_price = price + abs(root_x - from_x)
                    new_root = 2 * door + end
                    if new_price > cheapest[new_root] + TINY:
                        continue
                    cheapest[new_root] = new_price
                if count + 2 >= places.shape[0]:
                    places = _grown_floats(places)
                    links = _grown_ints(links)
                parent = here
                if new_root != origin:  # two turns at once: the first gets a node of its own
                    places[count, ROOT_X] = from_x
                    places[count, ROOT_Y] = from_y
                    places[count, COST] = price
                    links[count, ROOT] = origin
                    links[count, PARENT] = here
                    parent = count
                    count += 1
                places[count, A] = new_a
                places[count, B] = new_b
                places[count, ROOT_X] = root_x
                places[count, ROOT_Y] = from_y
                places[count, COST] = new_price
                links[count, PORTAL] = door
                links[count, UP] = go_up
                links[count, ROOT] = new_root
                links[count, PARENT] = parent
                _, rest = _crossing(root_x, from_y, new_a, new_b, y, gx, gy)
                if size + 1 >= keys.size:
                    keys, items = _roomier(keys, items)
                size = _push(keys, items, size, new_price + rest, count)
                count += 1
        # the next node that is still worth it
        while True:
            if size == 0:
                return path[:0]
            size = _pop(keys, items, size)
            here = items[size]
            root = links[here, ROOT]
            if links[here, PORTAL] == GOAL:
                return _path_to(places, links, here, start, goal, mesh)
            if root == START or places[here, COST] <= cheapest[root] + TINY:
                break


@inner
def _roomier(keys: Floats, items: Ints) -> tuple[Floats, Ints]:
    more_keys = np.empty(2 * keys.size)
    more_items = np.empty(2 * items.size, np.int64)
    for k in range(keys.size):
        more_keys[k] = keys[k]
        more_items[k] = items[k]
    return more_keys, more_items


@inner
def _path_to(
    places: Floats, links: Ints, last: int, start: Floats, goal: Floats, mesh: Mesh
) -> Floats:
    """Start, roots and goal on the way to the last node, (k, 2)."""
    count = 2
    for writing in range(2):
        if writing == 1:
            path = np.empty((count, 2))
            path[0, 0] = start[0]
            path[0, 1] = start[1]
            path[count - 1, 0] = goal[0]
            path[count - 1, 1] = goal[1]
        row = count - 2
        x = goal[0]
        y = goal[1]
        size = 2
        # the last turn may be at an end of the last interval
        near = float(mesh.portals[links[links[last, PARENT], PORTAL], 2])
        node = last
        px = places[last, A]
        py = near
        straight = abs(
            (px - places[last, ROOT_X]) * (y - py) - (py - places[last, ROOT_Y]) * (x - px)
        )
        if straight > 1e-7 * (abs(x - px) + abs(y - py) + 1.0):
            if writing == 1:
                path[row, 0] = px
                path[row, 1] = py
                row -= 1
            size += 1
            x = px
            y = py
        while node >= 0:
            px = places[node, ROOT_X]
            py = places[node, ROOT_Y]
            if links[node, ROOT] != START and (px != x or py != y):
                if writing == 1:
                    path[row, 0] = px
                    path[row, 1] = py
                    row -= 1
                size += 1
                x = px
                y = py
            node = links[node, PARENT]
        count = size
    return path
