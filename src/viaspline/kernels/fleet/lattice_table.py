"""Who is in which cell of a lattice at which step.

A robot goes to a cell only if nobody is there any more when it sets out: not in the step in which
another one leaves it. So the order in which robots pass the cells has no circle, with a step to
spare, and a robot that is late delays those behind it and nobody else (compare Atzmon et al.:
Robust multi-agent path finding and executing, JAIR 2020).

Tested through ``kernels/fleet/test_prioritised_planning``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Flags, Steps
from viaspline.kernels.jit import inlined, inner, kernel


class LatticeTable(NamedTuple):
    """Paths of robots on a lattice, by robot and by place.

    Attributes:
        places: The cell of each robot at each step, (n, steps); -1 for a robot without a path.
        arrivals: The step at which each robot comes to its goal for good, (n,).
        robots: Who is in a cell at a step, the number of the robot plus 1, 0 for nobody,
            (steps, cells).
        departs: The step until which each robot stands at its start, (n,).
        leaves: Whether each leaves the lattice once it has arrived; its places go on all the same,
            (n,).
    """

    places: Steps
    arrivals: Steps
    robots: Steps
    departs: Steps
    leaves: Flags


@inner
def empty_table(cells: int, steps: int, departs: Steps, leaves: Flags) -> LatticeTable:
    """The table of a lattice on which nobody moves yet."""
    robots = len(departs)
    return LatticeTable(
        np.full((robots, steps), -1, np.int32),
        np.zeros(robots, np.int32),
        np.zeros((steps, cells), np.int32),
        departs,
        leaves,
    )


@inlined
def _steps_there(table: LatticeTable, robot: int) -> int:
    """For how many steps a robot is on the lattice."""
    return table.arrivals[robot] + 1 if table.leaves[robot] else table.places.shape[1]


@inner
def book(table: LatticeTable, robot: int) -> None:
    """Enter the path of a robot, which stands among the places, to who is where."""
    for step in range(_steps_there(table, robot)):
        table.robots[step, table.places[robot, step]] = robot + 1


@inner
def unbook(table: LatticeTable, robot: int) -> None:
    """Take a robot out of who is where; its places stay."""
    for step in range(table.places.shape[1]):
        if table.robots[step, table.places[robot, step]] == robot + 1:
            table.robots[step, table.places[robot, step]] = 0


@inlined
def may_move(table: LatticeTable, step: int, cell: int, to: int) -> bool:
    """Whether a robot may be in one cell at a step and in another, or there still, at the next."""
    if table.robots[step + 1, to] != 0:
        return False
    return cell == to or (table.robots[step, to] == 0 and table.robots[step + 1, cell] == 0)


@inlined
def free_from(table: LatticeTable, cell: int) -> int:
    """From which step on nobody comes to a cell any more; the number of steps if one stays."""
    for step in range(table.robots.shape[0] - 1, -1, -1):
        if table.robots[step, cell] != 0:
            return step + 1
    return 0


@kernel
def spaced_out(places: Steps, cells: int) -> tuple[Steps, int]:
    """Ways in the order that they have, but nobody goes to a cell before it has been left.

    Args:
        places: The cell of each robot at each step, without rings, (n, steps).
        cells: How many the lattice has.

    Returns:
        The cell of each robot at each step, (n, later steps), and how many steps there are.
    """
    robots, steps = places.shape
    turn = np.zeros((robots, steps), np.int32)  # how many were in the cell before the robot came
    visits = np.zeros(cells, np.int32)
    for step in range(steps):
        for robot in range(robots):
            if step == 0 or places[robot, step] != places[robot, step - 1]:
                turn[robot, step] = visits[places[robot, step]]
                visits[places[robot, step]] += 1
    left = np.zeros(cells, np.int32)
    at = np.zeros(robots, np.int64)
    found = np.empty((robots, robots * steps + 1), np.int32)
    count = 0
    moving = True
    while moving:
        for robot in range(robots):
            found[robot, count] = places[robot, at[robot]]
        count += 1
        moving = False
        was_left = left.copy()
        for robot in range(robots):
            here = places[robot, at[robot]]
            k = at[robot] + 1
            while k < steps and places[robot, k] == here:
                k += 1
            if k < steps and was_left[places[robot, k]] == turn[robot, k]:
                at[robot] = k
                left[here] += 1
                moving = True
    return found, count
