"""Configurations of all robots on a lattice that a search has come to, each of them once.

Tested through ``kernels/fleet/test_lacam``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Steps
from viaspline.kernels.fleet.lattice_distances import FAR
from viaspline.kernels.jit import inner

PARENT, FIRST, LAST = 0, 1, 2
"""Of a configuration: the one before it, and the queue of its constraints."""

ROOM = 64
"""For so many there is room at first."""


class Configurations(NamedTuple):
    """All that have come up, a row each, in room for more.

    Attributes:
        cells: Where each robot is, (room, n).
        order: The robots by their priorities there, (room, n).
        waited: For so many steps each has been away from its goal, (room, n).
        nodes: The configuration before each, and the queue of its constraints, (room, 3).
        table: Their numbers by the hashes of their cells; -1 where there is none.
    """

    cells: Steps
    order: Steps
    waited: Steps
    nodes: Steps
    table: Steps


@inner
def grown(rows: Steps) -> Steps:
    """The rows in a table with twice the room."""
    other = np.empty((2 * rows.shape[0], rows.shape[1]), np.int32)
    for i in range(rows.shape[0]):
        for k in range(rows.shape[1]):
            other[i, k] = rows[i, k]
    return other


@inner
def look_up(table: Steps, cells: Steps, places: Steps) -> tuple[int, int]:
    """Where in a hash table a configuration belongs, and its number there, or -1."""
    key = 1469598103
    for robot in range(len(places)):
        key = (key * 1000003 + int(places[robot])) & 0xFFFFFFFFFF
    mask = len(table) - 1
    at = (key ^ (key >> 17)) & mask
    while table[at] >= 0:
        known, is_it = table[at], True
        for robot in range(len(places)):
            if cells[known, robot] != places[robot]:
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
def way_to(cells: Steps, nodes: Steps, last: int) -> Steps:
    """The cell of each robot at each step, (n, steps), up to a configuration."""
    steps, at = 1, last
    while nodes[at, PARENT] >= 0:
        at = nodes[at, PARENT]
        steps += 1
    robots = cells.shape[1]
    places = np.empty((robots, steps), np.int32)
    at = last
    for step in range(steps - 1, -1, -1):
        for robot in range(robots):
            places[robot, step] = cells[at, robot]
        at = nodes[at, PARENT]
    return places


@inner
def room_for(robots: int) -> Configurations:
    """Room for the first of them."""
    return Configurations(
        np.empty((ROOM, robots), np.int32), np.empty((ROOM, robots), np.int32),
        np.zeros((ROOM, robots), np.int32), np.empty((ROOM, 3), np.int32),
        np.full(4 * ROOM, -1, np.int32),
    )  # fmt: skip


@inner
def with_room(all_of: Configurations, count: int) -> Configurations:
    """They, if so many fill their room with twice as much."""
    if count < len(all_of.cells):
        return all_of
    cells = grown(all_of.cells)
    return Configurations(
        cells, grown(all_of.order), grown(all_of.waited), grown(all_of.nodes),
        _hashed(cells, count),
    )  # fmt: skip


@inner
def add_configuration(
    all_of: Configurations, new: int, before: int, places: Steps, goals: Steps, distances: Steps,
    starts: Steps, queued: int,
) -> None:  # fmt: skip
    """Write down another configuration.

    Args:
        all_of: With room for it.
        new: Its number.
        before: That of the one before it; -1 for the first.
        places: The cell of each robot, (n,).
        goals: As for ``lacam``, as are the next two.
        distances: As there.
        starts: As there.
        queued: The number of its first constraint.
    """
    for robot in range(len(places)):
        all_of.cells[new, robot] = places[robot]
        if before >= 0:
            is_there = places[robot] == goals[robot]
            all_of.waited[new, robot] = 0 if is_there else all_of.waited[before, robot] + 1
    at, _ = look_up(all_of.table, all_of.cells, places)
    all_of.table[at] = new
    _priorities(all_of.waited, new, distances, starts, all_of.order)
    all_of.nodes[new, PARENT] = before
    all_of.nodes[new, FIRST] = all_of.nodes[new, LAST] = queued


@inner
def have_arrived(cells: Steps, now: int, goals: Steps) -> bool:
    """Whether all robots are at their goals in a configuration."""
    return (cells[now] == goals).all()


@inner
def _hashed(cells: Steps, count: int) -> Steps:
    """A hash table of the first configurations, with room for four times as many as have a row."""
    size = 1
    while size < 4 * len(cells):
        size *= 2
    table = np.full(size, -1, np.int32)
    for known in range(count):
        at, _ = look_up(table, cells, cells[known])
        table[at] = known
    return table
