"""Search among configurations of all robots on a lattice (LaCAM).

Okumura: LaCAM: Search-based algorithm for quick multi-agent pathfinding, AAAI 2023. A depth-first
search among configurations. Each time that it comes back to one, the next one is made by PIBT under
another constraint (which robots go where), breadth first, from none to all robots: so every
successor comes up in the end, and a search that ends without a way has proven that there is none.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Steps
from viaspline.kernels.fleet.lattice_configurations import (
    FIRST,
    LAST,
    ROOM,
    add_configuration,
    grown,
    have_arrived,
    look_up,
    room_for,
    way_to,
    with_room,
)
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

BEFORE, WHO, WHERE, DEPTH, NEXT = 0, 1, 2, 3, 4
"""Of a constraint: that which it adds to, a robot, its cell, how many it has, the next in line."""


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
def _unconstrained(constraints: Steps, count: int) -> tuple[Steps, int]:
    """Add a constraint on no robot: the table, and how many there are."""
    if count == len(constraints):
        constraints = grown(constraints)
    constraints[count, DEPTH] = 0
    constraints[count, NEXT] = -1
    return constraints, count + 1


@inner
def _constrain_further(
    constraints: Steps, count: int, nodes: Steps, now: int, constraint: int, robot: int,
    cell: int, neighbours: Steps,
) -> tuple[Steps, int]:  # fmt: skip
    """Queue what adds one more robot to a constraint: the table, and how many there are."""
    width = neighbours.shape[1]
    while count + width + 1 > len(constraints):
        constraints = grown(constraints)
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
    none = np.empty((robots, 0), np.int32)
    for robot in range(robots):
        if distances[robot, starts[robot]] >= FAR:
            return NONE, none, 0
    choice = new_choice(neighbours, goals, distances, seed)
    found, constraints = room_for(robots), np.empty((ROOM, 5), np.int32)
    stack = np.zeros((ROOM, 1), np.int32)
    add_configuration(found, 0, -1, starts, goals, distances, starts, 0)
    constraints, queued = _unconstrained(constraints, 0)
    count, depth, used = 1, 1, 0
    while depth > 0 and used < work:
        now = stack[depth - 1, 0]
        if have_arrived(found.cells, now, goals):
            return FOUND, way_to(found.cells, found.nodes, now), used
        constraint = found.nodes[now, FIRST]
        if constraint < 0:
            depth -= 1
            continue
        found.nodes[now, FIRST] = constraints[constraint, NEXT]
        many = constraints[constraint, DEPTH]
        if many < robots:
            robot = found.order[now, many]
            constraints, queued = _constrain_further(
                constraints, queued, found.nodes, now, constraint, robot,
                found.cells[now, robot], neighbours,
            )  # fmt: skip
        _stand(choice, found.cells[now])
        is_possible = _successor(choice, found.order[now], constraints, constraint)
        used += robots
        _leave(choice)
        if not is_possible:
            continue
        _, other = look_up(found.table, found.cells, choice.to)
        if other < 0:
            other, found = count, with_room(found, count)
            add_configuration(found, count, now, choice.to, goals, distances, starts, queued)
            constraints, queued = _unconstrained(constraints, queued)
            count += 1
        if depth == len(stack):
            stack = grown(stack)
        stack[depth, 0] = other
        depth += 1
    return NONE if depth == 0 else GAVE_UP, none, used
