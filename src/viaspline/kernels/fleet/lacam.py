"""Search among configurations of all robots on a lattice (LaCAM).

Okumura: LaCAM: Search-based algorithm for quick multi-agent pathfinding, AAAI 2023. A depth-first
search among configurations. Each time that it comes back to one, the next one is made by PIBT under
another constraint (which robots go where), breadth first, from none to all robots: so every
successor comes up in the end, and a search that ends without a way has proven that there is none.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Steps
from viaspline.kernels.fleet.lattice_distances import FAR
from viaspline.kernels.fleet.pibt import (
    StepChoice,
    may_step,
    new_choice,
    step_by_priority,
    step_to,
)
from viaspline.kernels.jit import inner, kernel

FOUND, NONE, GAVE_UP = 0, 1, 2
"""A way; proven that there is none; the budget ran out."""

PARENT, FIRST, LAST = 0, 1, 2
"""Of a configuration: the one before it, and the queue of its constraints."""

BEFORE, WHO, WHERE, DEPTH, NEXT = 0, 1, 2, 3, 4
"""Of a constraint: that which it adds to, a robot, its cell, how many it has, the next in line."""


@inner
def _grown(rows: Steps) -> Steps:
    """The rows in a table with twice the room."""
    other = np.empty((2 * rows.shape[0], rows.shape[1]), np.int32)
    for i in range(rows.shape[0]):
        for k in range(rows.shape[1]):
            other[i, k] = rows[i, k]
    return other


@inner
def _stand(choice: StepChoice, configuration: Steps) -> None:
    """Put the robots where they stand in a configuration; nothing of the next step is known."""
    for robot in range(len(choice.at)):
        choice.at[robot] = configuration[robot]
        choice.to[robot] = -1
        choice.here[configuration[robot]] = robot + 1


@inner
def _leave(choice: StepChoice) -> None:
    """Take all robots off the lattice."""
    for robot in range(len(choice.at)):
        choice.here[choice.at[robot]] = 0
        if choice.to[robot] >= 0:
            choice.there[choice.to[robot]] = 0


@inner
def _successor(choice: StepChoice, order: Steps, constraints: Steps, constraint: int) -> bool:
    """Choose everyone's next cell under a constraint; whether that is possible."""
    while constraints[constraint, DEPTH] > 0:
        robot, cell = constraints[constraint, WHO], constraints[constraint, WHERE]
        if not may_step(choice, robot, cell):
            return False
        step_to(choice, robot, cell)
        constraint = constraints[constraint, BEFORE]
    for k in range(len(order)):
        if choice.to[order[k]] < 0 and not step_by_priority(choice, order[k]):
            return False
    return True


@inner
def _look_up(table: Steps, configurations: Steps, places: Steps) -> tuple[int, int]:
    """Where in a hash table a configuration belongs, and its number there, or -1."""
    key = 1469598103
    for robot in range(len(places)):
        key = (key * 1000003 + int(places[robot])) & 0xFFFFFFFFFF
    mask = len(table) - 1
    at = (key ^ (key >> 17)) & mask
    while table[at] >= 0:
        known, is_it = table[at], True
        for robot in range(len(places)):
            if configurations[known, robot] != places[robot]:
                is_it = False
                break
        if is_it:
            return at, known
        at = (at + 1) & mask
    return at, -1


@inner
def _priorities(waited: Steps, now: int, distances: Steps, starts: Steps, order: Steps) -> None:
    """Sort robots by how long they have been away from their goals, then by how far they began."""
    robots = len(starts)
    keys = np.empty(robots, np.int64)
    for robot in range(robots):
        far = min(distances[robot, starts[robot]], FAR - 1)
        keys[robot] = -(np.int64(waited[now, robot]) * FAR + far) * robots + robot
    keys.sort()
    for k in range(robots):
        order[now, k] = keys[k] % robots


@inner
def _constrain_further(
    constraints: Steps, count: int, nodes: Steps, now: int, constraint: int, robot: int,
    cell: int, neighbours: Steps,
) -> tuple[Steps, int]:  # fmt: skip
    """Queue what adds one more robot to a constraint: the table, and how many there are."""
    width = neighbours.shape[1]
    while count + width + 1 > len(constraints):
        constraints = _grown(constraints)
    for k in range(width + 1):
        to = cell if k == width else neighbours[cell, k]
        if to < 0:
            continue
        constraints[count, BEFORE] = constraint
        constraints[count, WHO] = robot
        constraints[count, WHERE] = to
        constraints[count, DEPTH] = constraints[constraint, DEPTH] + 1
        constraints[count, NEXT] = -1
        if nodes[now, FIRST] < 0:
            nodes[now, FIRST] = count
        else:
            constraints[nodes[now, LAST], NEXT] = count
        nodes[now, LAST] = count
        count += 1
    return constraints, count


@inner
def _way_to(configurations: Steps, nodes: Steps, last: int) -> Steps:
    """The cell of each robot at each step, (n, steps), up to a configuration."""
    steps, at = 1, last
    while nodes[at, PARENT] >= 0:
        at = nodes[at, PARENT]
        steps += 1
    robots = configurations.shape[1]
    places = np.empty((robots, steps), np.int32)
    at = last
    for step in range(steps - 1, -1, -1):
        for robot in range(robots):
            places[robot, step] = configurations[at, robot]
        at = nodes[at, PARENT]
    return places


@kernel
def lacam(
    neighbours: Steps, starts: Steps, goals: Steps, distances: Steps, work: int, seed: int
) -> tuple[int, Steps, int]:
    """Find a way for all robots from their starts to their goals, without rings.

    Args:
        neighbours: The cells next to each cell, -1 where there is none, (cells, k).
        starts: Different cells, (n,).
        goals: Different cells, (n,).
        distances: Steps from every cell to each goal, (n, cells).
        work: How many choices of robots to make, at most.
        seed: Of the choices among equals.

    Returns:
        ``FOUND``, ``NONE`` or ``GAVE_UP``; the cell of each robot at each step, (n, steps), without
        columns if there is no way; and how many choices were made.
    """
    robots = len(starts)
    choice = new_choice(neighbours, goals, distances, seed)
    room = 64
    configurations = np.empty((room, robots), np.int32)
    order = np.empty((room, robots), np.int32)
    waited = np.zeros((room, robots), np.int32)
    nodes = np.empty((room, 3), np.int32)
    constraints = np.empty((room, 5), np.int32)
    table = np.full(256, -1, np.int32)
    stack = np.empty((room, 1), np.int32)
    for robot in range(robots):
        configurations[0, robot] = starts[robot]
        if distances[robot, starts[robot]] >= FAR:
            return NONE, np.empty((robots, 0), np.int32), 0
    _priorities(waited, 0, distances, starts, order)
    nodes[0, PARENT] = -1
    nodes[0, FIRST] = nodes[0, LAST] = 0
    constraints[0, DEPTH] = 0
    constraints[0, NEXT] = -1
    at, _ = _look_up(table, configurations, configurations[0])
    table[at] = 0
    stack[0, 0] = 0
    count, queued, depth, used = 1, 1, 1, 0
    while depth > 0 and used < work:
        now = stack[depth - 1, 0]
        if _arrived(configurations, now, goals):
            return FOUND, _way_to(configurations, nodes, now), used
        constraint = nodes[now, FIRST]
        if constraint < 0:
            depth -= 1
            continue
        nodes[now, FIRST] = constraints[constraint, NEXT]
        many = constraints[constraint, DEPTH]
        if many < robots:
            robot = order[now, many]
            constraints, queued = _constrain_further(
                constraints, queued, nodes, now, constraint, robot,
                configurations[now, robot], neighbours,
            )  # fmt: skip
        _stand(choice, configurations[now])
        is_possible = _successor(choice, order[now], constraints, constraint)
        used += robots
        _leave(choice)
        if not is_possible:
            continue
        at, known = _look_up(table, configurations, choice.to)
        if depth == len(stack):
            stack = _grown(stack)
        if known >= 0:
            stack[depth, 0] = known
            depth += 1
            continue
        if count == len(configurations):
            configurations, order = _grown(configurations), _grown(order)
            waited, nodes = _grown(waited), _grown(nodes)
            table = _hashed(configurations, count)
            at, _ = _look_up(table, configurations, choice.to)
        table[at] = count
        for robot in range(robots):
            configurations[count, robot] = choice.to[robot]
            is_there = choice.to[robot] == goals[robot]
            waited[count, robot] = 0 if is_there else waited[now, robot] + 1
        _priorities(waited, count, distances, starts, order)
        nodes[count, PARENT] = now
        nodes[count, FIRST] = nodes[count, LAST] = queued
        while queued >= len(constraints):
            constraints = _grown(constraints)
        constraints[queued, DEPTH] = 0
        constraints[queued, NEXT] = -1
        queued += 1
        stack[depth, 0] = count
        depth += 1
        count += 1
    state = NONE if depth == 0 else GAVE_UP
    return state, np.empty((robots, 0), np.int32), used


@inner
def _arrived(configurations: Steps, now: int, goals: Steps) -> bool:
    return (configurations[now] == goals).all()


@inner
def _hashed(configurations: Steps, count: int) -> Steps:
    """A hash table of the first configurations, with room for four times as many as have a row."""
    size = 1
    while size < 4 * len(configurations):
        size *= 2
    table = np.full(size, -1, np.int32)
    for known in range(count):
        at, _ = _look_up(table, configurations, configurations[known])
        table[at] = known
    return table
