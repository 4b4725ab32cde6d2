"""Who is in which cell of a lattice at which step.

Two robots may follow each other closely: one may go to a cell in the step in which another leaves
it. But robots never go round in a ring, each to the cell of the next (two that change places are
the least ring): so the order in which robots pass the cells has no circle, and a robot that is
late delays those behind it and nobody else.

Tested through ``kernels/fleet/test_prioritised_planning``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Steps
from viaspline.kernels.jit import inlined, inner


class LatticeTable(NamedTuple):
    """Paths of robots on a lattice, by robot and by place.

    Attributes:
        places: The cell of each robot at each step, (n, steps); -1 for a robot without a path.
        arrivals: The step at which each robot comes to its goal for good, (n,).
        robots: Who is in a cell at a step, the number of the robot plus 1, 0 for nobody,
            (steps, cells).
    """

    places: Steps
    arrivals: Steps
    robots: Steps


@inner
def empty_table(robots: int, cells: int, steps: int) -> LatticeTable:
    """The table of a lattice on which nobody moves yet."""
    return LatticeTable(
        np.full((robots, steps), -1, np.int32),
        np.zeros(robots, np.int32),
        np.zeros((steps, cells), np.int32),
    )


@inner
def book(table: LatticeTable, robot: int) -> None:
    """Enter the path of a robot, which stands among the places, to who is where."""
    for step in range(table.places.shape[1]):
        table.robots[step, table.places[robot, step]] = robot + 1


@inner
def unbook(table: LatticeTable, robot: int) -> None:
    """Take a robot out of who is where; its places stay."""
    for step in range(table.places.shape[1]):
        table.robots[step, table.places[robot, step]] = 0


@inlined
def may_move(table: LatticeTable, step: int, cell: int, to: int) -> bool:
    """Whether a robot may be in one cell at a step and in another, or there still, at the next."""
    if table.robots[step + 1, to] != 0:
        return False
    if cell == to:
        return True
    ahead = table.robots[step, to]
    while ahead != 0:  # it goes on, as the cell is free then: to an empty one, or one is ahead
        further = table.places[ahead - 1, step + 1]
        if further == cell:
            return False
        ahead = table.robots[step, further]
    return True


@inlined
def free_from(table: LatticeTable, cell: int) -> int:
    """From which step on nobody comes to a cell any more; the number of steps if one stays."""
    for step in range(table.robots.shape[0] - 1, -1, -1):
        if table.robots[step, cell] != 0:
            return step + 1
    return 0
