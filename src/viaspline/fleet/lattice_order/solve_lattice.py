"""Who is in which cell of a lattice at which step, on ways that are short in the sum."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.fleet.lattice_order.no_lattice_order import NoLatticeOrder
from viaspline.kernels.arrays import Flags, Ints, Steps
from viaspline.kernels.fleet.lacam import FOUND, NONE, lacam
from viaspline.kernels.fleet.lattice_distances import FAR, lattice_distances
from viaspline.kernels.fleet.lattice_table import LatticeTable, spaced_out
from viaspline.kernels.fleet.neighbourhood_search import neighbourhood_search
from viaspline.kernels.fleet.prioritised_planning import prioritised_planning, table_of

TRIES = 20
"""Orders of priorities."""
SLACK = 64
"""Steps beyond the longest way, and a third of that."""
NEIGHBOURHOOD = 8
"""Robots that are planned anew at a time."""
MOST_ENTRIES = 400_000_000
"""Robots times cells, and steps times cells: 4 bytes each."""
WORK = 5_000_000
"""States and choices of each search: some seconds."""


@dataclass(frozen=True, eq=False)
class LatticePlan:
    """The cells of robots, step by step: nobody goes to one in the step in which another leaves it.

    Attributes:
        places: The cell of each robot at each step, (n, steps).
        arrivals: The step at which each comes to its goal for good, (n,).
        shortest: The step at which it would arrive if it were alone, (n,).
    """

    places: Steps
    arrivals: Ints
    shortest: Ints


def solve_lattice(
    neighbours: Steps,
    starts: Steps,
    goals: Steps,
    *,
    departs: Steps | None = None,
    leaves: Flags | None = None,
    work: int = WORK,
    improve: int | None = None,
) -> LatticePlan | NoLatticeOrder:
    """Bring robots from cell to cell, one step at a time, without meeting.

    Robots are planned by priority, each past those before it. Where that leads to nothing, all are
    searched for together, which finds a way if there is one. Then a few at a time are planned anew.

    Args:
        neighbours: The cells next to each cell, -1 where there is none, (cells, k).
        starts: Different cells, (n,).
        goals: Different cells, (n,).
        departs: The step until which each stands at its start, (n,); none if it isn't given.
        leaves: Whether it leaves the lattice when it has arrived, (n,); none does if it isn't
            given.
        work: Of each search, in states or choices.
        improve: The same for making the result better; ``work`` if it isn't given.

    Returns:
        Their ways; or proven that there is none, or that work or room for tables ran out.

    Example:
        >>> row = np.array([[1, -1], [2, 0], [-1, 1]], np.int32)
        >>> solve_lattice(row, np.int32([0, 1]), np.int32([1, 2])).places.tolist()
        [[0, 0, 1], [1, 2, 2]]
    """
    robots = len(starts)
    if robots == 0:
        none = np.zeros(0, np.int64)
        return LatticePlan(np.zeros((0, 1), np.int32), none, none)
    if robots * len(neighbours) > MOST_ENTRIES:
        return _gave_up("its tables would be too large")
    distances = lattice_distances(neighbours, goals)
    shortest = distances[np.arange(robots), starts].astype(np.int64)
    if (shortest >= FAR).any():
        return _no_way()
    waiting = np.zeros(robots, np.int32) if departs is None else departs
    leaving = np.zeros(robots, np.bool_) if leaves is None else leaves
    table = _first(neighbours, starts, goals, distances, shortest, waiting, leaving, work)
    if isinstance(table, NoLatticeOrder):
        return table
    better = work if improve is None else improve
    neighbourhood_search(neighbours, starts, goals, distances, table, NEIGHBOURHOOD, better, 1)
    steps = max(int(table.arrivals.max()), 1) + 1
    alone = np.where(shortest > 0, shortest + table.departs, 0)
    return LatticePlan(table.places[:, :steps].copy(), table.arrivals.astype(np.int64), alone)


def _first(
    neighbours: Steps, starts: Steps, goals: Steps, distances: Steps, shortest: Ints,
    departs: Steps, leaves: Flags, work: int,
) -> LatticeTable | NoLatticeOrder:  # fmt: skip
    """Ways of all robots, however long.

    Where all are searched for together, none departs later and none leaves: that is an order, too.
    """
    longest = int((shortest + departs).max())
    steps = min(longest + longest // 3 + SLACK, MOST_ENTRIES // len(neighbours))
    order = np.argsort(-shortest, kind="stable").astype(np.int32)
    found, table, _ = prioritised_planning(
        neighbours, starts, goals, distances, departs, leaves, order, steps, TRIES, work
    )
    if found:
        return table
    state, places, _ = lacam(neighbours, starts, goals, distances, work, 1)
    if state == NONE:
        return _no_way()
    if state != FOUND:
        return _gave_up("the search for an order ran out of its budget")
    places, count = spaced_out(places, len(neighbours))
    if (count + SLACK) * len(neighbours) > MOST_ENTRIES:
        return _gave_up("its ways are too long for the tables")
    wide = np.empty((len(places), max(steps, count + SLACK)), np.int32)
    wide[:, :count], wide[:, count:] = places[:, :count], places[:, count - 1 : count]
    return table_of(wide, len(neighbours), departs, leaves)


def _no_way() -> NoLatticeOrder:
    return NoLatticeOrder(
        "refused", "robots can't get past each other on the lattice", "give them more room"
    )


def _gave_up(reason: str) -> NoLatticeOrder:
    return NoLatticeOrder("gave up", reason, "take robots out, or give them more room")
