"""From cells to motions in the plane: a place at every step, made as straight as the others allow.

Tested through ``fleet/lattice_order/test_lattice_paths``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.fleet.lattice_order.cell_lattice import CellLattice
from viaspline.fleet.lattice_order.solve_lattice import LatticePlan
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.straightened_motions import straightened_motions
from viaspline.world.world import World

ROUNDS = 3
"""In which motions are made straighter."""
ROOM_SHARE = 0.5
"""Of the room between two robots that pass each other round a corner, kept on straight drives."""
SAME_M = 1e-9
"""Places and speeds that differ by less are the same."""


@dataclass(frozen=True, eq=False)
class LatticeMotions:
    """Where robots are step by step; in between each drives straight and evenly.

    Attributes:
        places: [m], (n, steps, 2).
        arrives: The step at which each comes to its goal for good, (n,).
    """

    places: Floats
    arrives: Ints

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
    plan: LatticePlan, lattice: CellLattice, world: World, starts: Floats, goals: Floats,
    reach: Floats, kept: Floats,
) -> LatticeMotions:  # fmt: skip
    """Motions of robots from start to goal, in the order of a lattice plan.

    Args:
        plan: Their cells.
        lattice: Of these.
        world: What stands.
        starts: Where they really start [m], (n, 2).
        goals: Their real goals [m], (n, 2).
        reach: How far each keeps others away on its part [m], (n,).
        kept: What the centre of each keeps of the world [m], (n,).
    """
    places = lattice.places[plan.places]
    moved = plan.places != plan.places[:, :1]
    departs = np.where(moved.any(axis=1), moved.argmax(axis=1) - 1, 0)
    for robot in range(len(places)):
        places[robot, : departs[robot] + 1] = starts[robot]
        places[robot, plan.arrivals[robot] :] = goals[robot]
    room = lattice.cell / np.sqrt(2.0) - 2.0 * reach.max(initial=0.0)
    margin = max(ROOM_SHARE * room, 0.0)
    straightened_motions(
        world.packed, kept, places, reach, margin, departs.astype(np.int64), plan.arrivals, ROUNDS
    )
    return LatticeMotions(places, plan.arrivals)
