"""From cells to motions in the plane: a place at every step, made as straight as the others allow.

Tested through ``fleet/lattice_order/test_lattice_paths``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.fleet.lattice_order.cell_lattice import CellLattice
from viaspline.fleet.lattice_order.solve_lattice import LatticePlan
from viaspline.kernels.arrays import Floats, Ints, Steps
from viaspline.kernels.fleet.straightened_motions import (
    along_its_line,
    straightened_motions,
)
from viaspline.world.world import World

ROOM_SHARE = 0.5
"""Of the room between two robots in neighbouring cells, kept between those that drive past."""
LATER = 8
"""Steps after the last arrival, for robots on lines of their own."""
SAME_M = 1e-9
"""Places and speeds that differ by less are the same."""


@dataclass(frozen=True, eq=False)
class LatticeMotions:
    """Where robots are step by step; in between each drives straight and evenly.

    Attributes:
        places: [m], (n, steps, 2).
        arrives: The step at which each comes to its goal for good, (n,).
        sets_out: The step at which each sets out on its own line, which it drives along by one cell
            in a step; -1 where it drives from cell to cell, (n,).
    """

    places: Floats
    arrives: Ints
    sets_out: Ints

    def vertices(self, robot: int) -> tuple[Floats, Floats]:
        """Where the motion of a robot bends, changes its speed or stands.

        Args:
            robot: Its number.

        Returns:
            Places [m], (k, 2), and the steps at which it is there, (k,). One at which it stands is
            there twice.
        """
        places = self.places[robot, : int(self.arrives[robot]) + 1]
        moves = np.diff(places, axis=0)
        changes = np.abs(np.diff(moves, axis=0)).max(axis=1, initial=0.0) > SAME_M
        at = np.concatenate([[0], np.flatnonzero(changes) + 1, [len(places) - 1]])
        at = np.unique(at)
        return places[at], at.astype(float)


def lattice_motions(
    plan: LatticePlan, lattice: CellLattice, world: World, lines: Sequence[Floats], reach: Floats,
    kept: Floats, soonest: Steps, rounds: int,
) -> LatticeMotions:  # fmt: skip
    """Motions of robots from start to goal, in the order of a lattice plan.

    A robot drives along its own line wherever that leads past nobody, else straight from cell to
    cell as far as it can.

    Args:
        plan: Their cells.
        lattice: Of these.
        world: What stands.
        lines: As each would drive if it were alone, from its real start to its real goal [m],
            (n) of (k, 2).
        reach: How far each keeps others away on its part [m], (n,).
        kept: What the centre of each keeps of the world [m], (n,).
        soonest: The step at which each may set out, (n,).
        rounds: In which motions are made straighter.
    """
    cells = np.hstack([plan.places, np.repeat(plan.places[:, -1:], LATER, axis=1)])
    places = lattice.places[cells]
    moved = cells != cells[:, :1]
    departs = np.where(moved.any(axis=1), moved.argmax(axis=1) - 1, 0).astype(np.int64)
    arrives = plan.arrivals.copy()
    for robot, line in enumerate(lines):
        places[robot, : departs[robot] + 1] = line[0]
        places[robot, arrives[robot] :] = line[-1]
    margin = ROOM_SHARE * max(lattice.cell - 2.0 * reach.max(initial=0.0), 0.0)
    sets_out = np.full(len(lines), -1, np.int64)
    for _ in range(2):
        for robot in np.argsort(arrives - plan.shortest, kind="stable").tolist():
            if sets_out[robot] >= 0:
                continue
            line = lines[robot]
            along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
            takes = along[-1] / lattice.cell
            latest = max(int(arrives[robot] - takes), 0) + LATER // 2
            start = along_its_line(
                places, reach, margin, robot, line, along, lattice.cell, int(soonest[robot]), latest
            )
            if start >= 0:
                sets_out[robot] = departs[robot] = start
                arrives[robot] = math.ceil(start + takes)
        others = np.where(sets_out < 0, arrives, departs)  # nothing to do for those on their lines
        straightened_motions(world.packed, kept, places, reach, margin, departs, others, rounds)
    return LatticeMotions(places, arrives, sets_out)
