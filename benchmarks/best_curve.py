"""The best curve of a kind, by a slow optimiser that shares nothing with the planner.

Free space is a row of half-planes at each node, one for each convex obstacle near it, square to
its nearest point: all that lies in them is free. Ipopt solves that, the half-planes are laid anew
at what it finds, and so on: nothing gets worse, until nothing gets better. The homotopy class is
that of the curve it begins with. Half-planes stand at the nodes and half-way between them; what a
chord of that length cuts off a corner may be missing, so that it is rather too good than not good
enough.
"""

from __future__ import annotations

import math

import numpy as np
import shapely
from collocation import Aim, solved
from curve_nodes import Nodes, Task, start_nodes, timed

MAX_ROUNDS = 25
TIME_GIVEN = 2e-3  # of the least time, for a gentler curve
CHORD_SHARE = 1.1  # of what a chord cuts off, that may be missing
ROOM_SHARE = 1e-3  # of what is required, that may be missing


def fastest(task: Task) -> Nodes:
    """The curve that is driven in the least time."""
    first = start_nodes(task)
    return _improved(task, first, Aim(cost=lambda drive: drive.time / first.time))


def shortest(task: Task) -> Nodes:
    """The shortest curve, in which the speed has no part but to be told."""
    first = start_nodes(task)
    return _improved(task, first, Aim(cost=lambda drive: drive.length / first.length))


def gentlest(task: Task, fast: Nodes) -> Nodes:
    """The curve that bends least of those that take hardly longer than the fastest."""
    most = (1.0 + TIME_GIVEN) * fast.time
    bending = max(fast.bending, 1e-6)
    aim = Aim(cost=lambda drive: drive.bending / bending, most_time=most, least_gain=1e-2)
    return _improved(task, fast, aim)


class UnsolvedError(Exception):
    """Nothing was found in the free space about the curve that was begun with."""


def _improved(task: Task, first: Nodes, aim: Aim) -> Nodes:
    found, cost = None, math.inf
    for _ in range(MAX_ROUNDS):
        better, reached = solved(task, found or first, aim)
        if better is None:
            break
        found = better
        if cost - reached < aim.least_gain * reached:
            break
        cost = reached
    if found is None or least_room(task, found) < -room_missed(task, found):
        raise UnsolvedError
    return timed(task, found)


def least_room(task: Task, nodes: Nodes) -> float:
    """By how much more than required the polyline through nodes and middles is clear [m]."""
    pieces = np.stack((nodes.line[:-1], nodes.line[1:]), axis=1)
    return float(task.space.room(shapely.linestrings(pieces)).min())


def room_missed(task: Task, nodes: Nodes) -> float:
    """How much may be missing between the places at which it is looked at [m]."""
    required, chord = task.space.required, 0.5 * float(nodes.steps.max())
    return CHORD_SHARE * chord * chord / (8.0 * required) + ROOM_SHARE * required
