"""The path on a lattice that arrives first, past robots whose paths are known.

A* among cells and steps. As every edge takes a step, the key of a state is known when it is first
met, and open states stand in a stack for each key: the one met last goes on.

Tested through ``kernels/fleet/test_prioritised_planning``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Ints, Steps
from viaspline.kernels.fleet.lattice_distances import FAR
from viaspline.kernels.fleet.lattice_table import LatticeTable, free_from, may_move
from viaspline.kernels.fleet.random_numbers import random_below
from viaspline.kernels.jit import inlined, inner


class CellSearch(NamedTuple):
    """Room for a search, used again by the next one.

    Attributes:
        cells: Of each state, (room,).
        steps: Of each state, (room,).
        parents: The state before each state, (room,).
        below: The open state under each state in its stack, (room,).
        tops: The top of the stack of each key, (steps + 1,).
        seen: A hash table of states, (a power of 2,).
        searches: The search in which an entry of that table was made, of its size; and at the end
            the number of searches so far.
        random: The state of the random numbers, (1,).
        neighbours: The lattice, (cells, k).
    """

    cells: Steps
    steps: Steps
    parents: Steps
    below: Steps
    tops: Steps
    seen: Steps
    searches: Steps
    random: Ints
    neighbours: Steps


@inner
def new_search(neighbours: Steps, steps: int, room: int, seed: int) -> CellSearch:
    """Room for ``room`` states, with the random numbers of a seed."""
    size = 1
    while size < 2 * room:
        size *= 2
    return CellSearch(
        np.empty(room, np.int32),
        np.empty(room, np.int32),
        np.empty(room, np.int32),
        np.empty(room, np.int32),
        np.empty(steps + 1, np.int32),
        np.empty(size, np.int32),
        np.zeros(size + 1, np.int32),
        np.full(1, seed % 2147483646 + 1, np.int64),
        neighbours,
    )


@inlined
def _is_new(search: CellSearch, cell: int, step: int, state: int) -> bool:
    """Whether a state wasn't met in this search yet; it then is entered."""
    mask = len(search.seen) - 1
    now = search.searches[mask + 1]
    at = (int(cell) * 73856093 + int(step) * 19349663) & mask
    while search.searches[at] == now:
        other = search.seen[at]
        if search.cells[other] == cell and search.steps[other] == step:
            return False
        at = (at + 1) & mask
    search.searches[at] = now
    search.seen[at] = state
    return True


@inlined
def _open(search: CellSearch, state: int, cell: int, step: int, parent: int, key: int) -> None:
    search.cells[state] = cell
    search.steps[state] = step
    search.parents[state] = parent
    search.below[state] = search.tops[key]
    search.tops[key] = state


@inner
def cell_path(
    search: CellSearch, table: LatticeTable, robot: int, start: int, goal: int, distances: Steps,
    latest: int,
) -> int:  # fmt: skip
    """Find the first arrival of a robot at its goal, from where it isn't driven away any more.

    Its path is written to the table's places and arrivals; it isn't booked.

    Args:
        search: Room.
        table: The others' paths.
        robot: The number of the robot.
        start: Its cell.
        goal: Its goal.
        distances: Steps to every goal, (n, cells).
        latest: Arrivals after this step are of no use.

    Returns:
        How many states were looked at; negative where no path was found.
    """
    last = min(table.places.shape[1] - 1, latest)
    free = 0 if table.leaves[robot] else free_from(table, goal)
    departs = int(table.departs[robot])
    free = max(free, departs) if start == goal else free
    key = max(int(distances[robot, start]) + departs, free)
    if key > last or table.robots[0, start] != 0:
        return -1
    for k in range(last + 2):
        search.tops[k] = -1
    search.searches[len(search.seen)] += 1
    _is_new(search, start, 0, 0)
    _open(search, 0, start, 0, -1, key)
    count, work = 1, 0
    width = search.neighbours.shape[1]
    while key <= last:
        state = search.tops[key]
        if state < 0:
            key += 1
            continue
        search.tops[key] = search.below[state]
        work += 1
        cell, step = search.cells[state], search.steps[state]
        if cell == goal and step >= free:
            _trace(search, table, robot, state)
            return work
        turn = random_below(search.random, width)
        for k in range(width + 1):
            to = cell if k == 0 else search.neighbours[cell, (k + turn) % width]
            if to < 0 or distances[robot, to] >= FAR or (to != cell and step < departs):
                continue
            reached = max(max(step + 1, departs) + int(distances[robot, to]), free)
            if reached > last or not may_move(table, step, cell, to):
                continue
            if count == len(search.cells):
                return -work
            if _is_new(search, to, step + 1, count):
                _open(search, count, to, step + 1, state, reached)
                count += 1
    return -max(work, 1)


@inlined
def _trace(search: CellSearch, table: LatticeTable, robot: int, state: int) -> None:
    """Write the path that leads to a state, with the stay after it."""
    cell, arrival = search.cells[state], search.steps[state]
    for step in range(arrival, table.places.shape[1]):
        table.places[robot, step] = cell
    table.arrivals[robot] = arrival
    while state >= 0:
        table.places[robot, search.steps[state]] = search.cells[state]
        state = search.parents[state]
    while arrival > 0 and table.places[robot, arrival - 1] == cell:
        arrival -= 1  # waiting at the goal is no driving
    table.arrivals[robot] = arrival
