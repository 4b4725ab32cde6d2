"""Large-neighbourhood search on a lattice: a few robots planned again and again.

Li, Chen, Harabor, Stuckey and Koenig: Anytime multi-agent path finding via large neighborhood
search, IJCAI 2021. Each set of paths is valid; a new one is kept if its sum of arrivals isn't
larger.

Tested through ``kernels/fleet/test_prioritised_planning``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Ints, Steps
from viaspline.kernels.fleet.cell_path import CellSearch, new_search
from viaspline.kernels.fleet.lattice_table import LatticeTable, book, unbook
from viaspline.kernels.fleet.prioritised_planning import ROOM, plan_in_order
from viaspline.kernels.fleet.random_numbers import random_below
from viaspline.kernels.jit import inner, kernel

WALKS = 12
"""Random walks that look for robots in the way of a late one."""


@inner
def _lateness(table: LatticeTable, starts: Steps, distances: Steps, robot: int) -> int:
    """How many steps later than if it were alone a robot arrives."""
    soonest = distances[robot, starts[robot]]
    if soonest > 0:
        soonest += table.departs[robot]
    return max(int(table.arrivals[robot]) - int(soonest), 0)


@inner
def _delayed(table: LatticeTable, starts: Steps, distances: Steps, random: Ints) -> int:
    """A robot that arrives late, drawn by how late it is; -1 where none is."""
    late = 0
    for robot in range(len(starts)):
        late += _lateness(table, starts, distances, robot)
    if late == 0:
        return -1
    drawn = random_below(random, late)
    for robot in range(len(starts)):
        drawn -= _lateness(table, starts, distances, robot)
        if drawn < 0:
            return robot
    return -1


@inner
def _in_its_way(
    search: CellSearch, table: LatticeTable, distances: Steps, robot: int, chosen: Steps,
    count: int, is_chosen: Steps,
) -> int:  # fmt: skip
    """Add robots that a late one meets on ways that would be sooner; gives how many there are.

    Walks begin somewhere on its path and go where it could still be sooner than it is.
    """
    width = search.neighbours.shape[1]
    arrival = table.arrivals[robot]
    for _ in range(WALKS):
        step = random_below(search.random, max(arrival, 1))
        cell = table.places[robot, step]
        while count < len(chosen) and step + 1 < table.places.shape[1]:
            turn = random_below(search.random, width + 1)
            to = -1
            for k in range(width + 1):
                at = (k + turn) % (width + 1)
                other = cell if at == width else search.neighbours[cell, at]
                if other >= 0 and step + 1 + distances[robot, other] < arrival:
                    to = other
                    break
            if to < 0:
                break
            for k in (0, 1):
                met = table.robots[step + k, to] - 1
                if met >= 0 and is_chosen[met] == 0 and count < len(chosen):
                    chosen[count] = met
                    is_chosen[met] = 1
                    count += 1
            cell = to
            step += 1
    return count


@inner
def _choose(
    search: CellSearch, table: LatticeTable, starts: Steps, distances: Steps, chosen: Steps,
    is_chosen: Steps,
) -> int:  # fmt: skip
    """A late robot and some in its way, or round a place; gives how many there are."""
    late = _delayed(table, starts, distances, search.random)
    if late < 0:
        return 0
    chosen[0] = late
    is_chosen[late] = 1
    count = 1
    if random_below(search.random, 4) > 0:
        count = _in_its_way(search, table, distances, late, chosen, count, is_chosen)
    least = min(len(chosen), 2)
    for _ in range(8 * len(chosen)):
        if count >= len(chosen) or (count > least and random_below(search.random, 3) == 0):
            break
        met = random_below(search.random, len(starts))
        if is_chosen[met] == 0:
            chosen[count] = met
            is_chosen[met] = 1
            count += 1
    return count


@inner
def _restore(table: LatticeTable, chosen: Steps, booked: int, kept: Steps, count: int) -> None:
    """Take the new paths of the chosen out, and put the old ones in."""
    for k in range(booked):
        unbook(table, chosen[k])
    for k in range(count):
        robot = chosen[k]
        for step in range(table.places.shape[1]):
            table.places[robot, step] = kept[robot, step]
        book(table, robot)


@kernel
def neighbourhood_search(
    neighbours: Steps, starts: Steps, goals: Steps, distances: Steps, table: LatticeTable,
    size: int, work: int, seed: int,
) -> int:  # fmt: skip
    """Plan a few robots anew, whose delays hang together, for as long as work is left.

    Args:
        neighbours: The lattice, (cells, k).
        starts: Cells, (n,).
        goals: Cells, (n,).
        distances: Steps to every goal, (n, cells).
        table: Paths of all robots; better ones take their places.
        size: How many robots are planned anew at a time, at most.
        work: How many states to look at, about.
        seed: Of the choices.

    Returns:
        The sum of arrivals.
    """
    robots = len(starts)
    search = new_search(neighbours, table.places.shape[1], ROOM, seed)
    chosen = np.zeros(min(size, robots), np.int32)
    is_chosen = np.zeros(robots, np.int32)
    kept = table.places.copy()
    arrivals = table.arrivals.copy()
    used = 0
    while used < work:
        count = _choose(search, table, starts, distances, chosen, is_chosen)
        if count == 0:
            break
        total = 0
        for k in range(count):
            is_chosen[chosen[k]] = 0
            total += table.arrivals[chosen[k]]
            unbook(table, chosen[k])
        for k in range(count - 1, 0, -1):
            other = random_below(search.random, k + 1)
            chosen[k], chosen[other] = chosen[other], chosen[k]
        order = chosen[:count]
        done, _total, looked = plan_in_order(search, table, order, starts, goals, distances, total)
        used += looked + count
        if done < count:
            for k in range(count):
                table.arrivals[chosen[k]] = arrivals[chosen[k]]
            _restore(table, chosen, done, kept, count)
        else:
            for k in range(count):
                robot = chosen[k]
                arrivals[robot] = table.arrivals[robot]
                for step in range(table.places.shape[1]):
                    kept[robot, step] = table.places[robot, step]
    result = 0
    for robot in range(robots):
        result += table.arrivals[robot]
    return result
