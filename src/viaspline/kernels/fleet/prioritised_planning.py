"""Robots planned one after the other on a lattice, each past those before it."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Steps
from viaspline.kernels.fleet.cell_path import CellSearch, cell_path, new_search
from viaspline.kernels.fleet.lattice_table import LatticeTable, book, empty_table, unbook
from viaspline.kernels.jit import inner, kernel

ROOM = 1 << 18
"""States of one search for a path."""


@inner
def plan_in_order(
    search: CellSearch, table: LatticeTable, order: Steps, starts: Steps, goals: Steps,
    distances: Steps, most: int,
) -> tuple[int, int, int]:  # fmt: skip
    """Plan robots one after the other, until one finds no path or their times become too much.

    Args:
        search: Room.
        table: The others' paths; those of these robots are booked as they are found.
        order: The robots, (m,).
        starts: Cells of all, (n,).
        goals: Cells of all, (n,).
        distances: Steps to every goal, (n, cells).
        most: The sum of arrivals that is allowed.

    Returns:
        How many of them are booked, the sum of their arrivals, and how many states were looked at.
    """
    left = 0  # the least sum of those that are still to come
    for k in range(len(order)):
        left += int(distances[order[k], starts[order[k]]])
    total = work = 0
    for k in range(len(order)):
        robot = order[k]
        start, goal = starts[robot], goals[robot]
        left -= int(distances[robot, start])
        found = cell_path(search, table, robot, start, goal, distances, most - total - left)
        work += abs(found)
        if found < 0:
            return k, total, work
        total += int(table.arrivals[robot])
        book(table, robot)
    return len(order), total, work


@kernel
def prioritised_planning(
    neighbours: Steps, starts: Steps, goals: Steps, distances: Steps, departs: Steps,
    leaves: Flags, order: Steps, steps: int, tries: int, work: int,
) -> tuple[bool, LatticeTable, int]:  # fmt: skip
    """Plan all robots by priority; one that finds no path goes to the front, and all is new.

    Args:
        neighbours: The lattice, (cells, k).
        starts: Different cells, (n,).
        goals: Different cells, (n,).
        distances: Steps to every goal, (n, cells).
        departs: The step until which each stands at its start, (n,).
        leaves: Whether it leaves the lattice when it has arrived, (n,).
        order: The robots, the one that is planned first in front, (n,); rearranged.
        steps: How many steps there are, with that at the start.
        tries: How often to begin.
        work: How many states to look at, about.

    Returns:
        Whether all have a path; these; and how many states were looked at.
    """
    table = empty_table(len(neighbours), steps, departs, leaves)
    search = new_search(neighbours, steps, ROOM, 1)
    used = 0
    for _ in range(tries):
        done, _total, looked = plan_in_order(
            search, table, order, starts, goals, distances, 1 << 60
        )
        used += looked
        if done == len(order):
            return True, table, used
        if used > work:
            break
        for k in range(done):
            unbook(table, order[k])
        failed = order[done]
        for k in range(done, 0, -1):
            order[k] = order[k - 1]
        order[0] = failed
    return False, table, used


@kernel
def table_of(places: Steps, cells: int, departs: Steps, leaves: Flags) -> LatticeTable:
    """The table of paths that are known.

    Args:
        places: The cell of each robot at each step, (n, steps); at the last one all are at goals.
        cells: How many the lattice has.
        departs: See ``LatticeTable``, (n,).
        leaves: See ``LatticeTable``, (n,).
    """
    robots, steps = places.shape
    table = empty_table(cells, steps, departs, leaves)
    for robot in range(robots):
        for step in range(steps):
            table.places[robot, step] = places[robot, step]
        arrival = steps - 1
        while arrival > 0 and places[robot, arrival - 1] == places[robot, steps - 1]:
            arrival -= 1
        table.arrivals[robot] = np.int32(arrival)
        book(table, robot)
    return table
