"""One search through poses, in one direction, as it grows.

Tested through ``planning/turning/hybrid_astar/test_pose_search``.
"""

from __future__ import annotations

import math
from copy import copy
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.kernels.heap import Heap
from viaspline.kernels.turning.collision_cache import CollisionCache
from viaspline.kernels.turning.hybrid_astar import expand_poses as kernels
from viaspline.kernels.turning.hybrid_astar.goal_arrival import connected
from viaspline.kernels.turning.hybrid_astar.pose_nodes import (
    CELL_SHARE,
    EXPANDED,
    NODES,
    Ahead,
    PoseSearch,
)
from viaspline.kernels.turning.hybrid_astar.primitives import STEP, MotionPrimitives
from viaspline.planning.turning.hybrid_astar.search_window import SearchWindow

FIRST_SLICE, SLICE = 1000, 2500  # efforts between which a search can be stopped
MOST_STATES = 1 << 40  # more than any search has
LEAST_STATES_BEFORE = 800  # that count as those before the first arrival

Number = TypeVar("Number", np.float64, np.int64)


@dataclass(frozen=True)
class Arrival:
    """A way that a search has found.

    Attributes:
        start: Number of the start.
        heading: At the goal; NaN if it comes straight [rad].
        cost: With what it cost up to the start [m].
        segments: See ``kernels.turning.collision_cache``, (n, 3).
    """

    start: int
    heading: float
    cost: float
    segments: Floats


class SearchTree:
    """A search that is stopped and goes on.

    Attributes:
        cache: Where the body may be.
        moves: What the robot can do.
        ahead: How far it is to the goal.
        search: What it has found.
        state: Whether there is more to be done; see ``expand_poses``.
        effort: What it does next, at most; see ``expand_poses.go_on``.
    """

    def __init__(
        self, search_window: SearchWindow, cache: CollisionCache, moves: MotionPrimitives,
        ahead: Ahead, starts: Floats, goal: Floats, headings: Floats, room: int, after: float,
    ) -> None:  # fmt: skip
        """Begin.

        Args:
            search_window: Where.
            cache: Its collision cache, for one direction of driving.
            moves: What the robot can do.
            ahead: How far it is to the goal.
            starts: x, y, heading, cost so far, (n, 4).
            goal: x, y [m], (2,).
            headings: Those that are allowed there [rad], NaN for whichever comes straight, (h,).
            room: States that are kept, at most.
            after: How many states are looked at after the first arrival, as a share of those
                before it and of ``LEAST_STATES_BEFORE``.
        """
        self.cache, self.moves = cache, moves
        self.ahead = ahead
        self.search = _empty(search_window, moves, starts, goal, headings, room)
        self.state = kernels.RUNNING
        self.effort = FIRST_SLICE
        self._until = math.inf
        self._after = after
        kernels.set_off(cache, self.search, self.ahead, float(moves.sizes[0]), starts)

    def copy(self) -> SearchTree:
        """As far as it came: it and this one go on each by itself; one that is over is the same."""
        if self.is_over:
            return self
        tree = copy(self)
        tree.cache = self.cache.copied()
        search, count = self.search, int(self.search.counts[NODES])
        keys, nodes, size = search.heap
        waiting = int(size[0])
        heap = Heap(_begun(keys, waiting), _begun(nodes, waiting), size.copy())
        fields = search._asdict() | {"heap": heap}
        fields |= {name: _begun(fields[name], count) for name in ("nodes", "links")}
        whole = ("keys", "cells", "counts", "arrivals", "ends")
        fields |= {name: fields[name].copy() for name in whole}
        tree.search = PoseSearch(**fields)
        return tree

    @property
    def expanded(self) -> int:
        """How many states were looked at."""
        return int(self.search.counts[EXPANDED])

    @property
    def is_over(self) -> bool:
        """Whether there is nothing more to be done."""
        return self.state != kernels.RUNNING or self.expanded >= self._until

    @property
    def has_arrived(self) -> bool:
        """Whether it has come to the goal."""
        return bool((self.search.ends >= 0).any())

    def go_on(self) -> None:
        """Look at some more states."""
        effort, quota = self.effort, int(min(self._until, MOST_STATES)) - self.expanded
        self.effort = min(2 * effort, SLICE)
        had = self.has_arrived
        self.state = kernels.go_on(self.cache, self.moves, self.search, self.ahead, quota, effort)
        if self.has_arrived and not had:
            self._until = self.expanded + math.ceil(
                self._after * (self.expanded + LEAST_STATES_BEFORE)
            )

    def arrivals(self) -> list[Arrival]:
        """The best with each heading, the shortest first."""
        search = self.search
        found = []
        for k in np.flatnonzero(search.ends >= 0).tolist():
            segments, start = kernels.path_to(self.moves, search, int(search.ends[k]))
            x, y, heading = search.nodes[search.ends[k], :3].tolist()
            cost, s1, s2 = search.arrivals[k].tolist()
            goal = float(search.headings[k])
            last = connected(
                self.moves, search.goal[0] - x, search.goal[1] - y, heading, goal, s1, s2
            )
            found.append(Arrival(int(start), goal, cost, np.concatenate((segments, last))))
        return sorted(found, key=lambda arrival: arrival.cost)


def _begun(rows: NDArray[Number], count: int) -> NDArray[Number]:
    """A copy of rows of which the first ``count`` are in use; the memory of others is left alone.

    Args:
        rows: (n, ...).
        count: No more than n.
    """
    copied = np.empty(rows.shape, rows.dtype)
    copied[:count] = rows[:count]
    return copied


def _empty(
    search_window: SearchWindow,
    moves: MotionPrimitives,
    starts: Floats,
    goal: Floats,
    headings: Floats,
    room: int,
) -> PoseSearch:
    steps = moves.scales[:, STEP]
    around = np.ceil(4.0 * math.pi * moves.sizes[0] / steps)
    nodes = room
    table = 1 << math.ceil(math.log2(2 * nodes))
    waiting = Heap(np.empty(nodes), np.empty(nodes, np.int64), np.zeros(1, np.int64))
    return PoseSearch(  # rows of nodes are written before they are read; the table has to be empty
        window=np.array(search_window.area.box),
        ends_at=np.concatenate((goal[None], np.unique(starts[:, :2], axis=0))),
        care=np.array(search_window.care),
        scales=np.column_stack((CELL_SHARE * steps, around, search_window.rooms(steps))),
        nodes=np.empty((nodes, 5)),
        links=np.empty((nodes, 5), np.int64),
        keys=np.zeros(table, np.int64),
        cells=np.zeros(table, np.int64),
        heap=waiting,
        counts=np.zeros(4, np.int64),
        goal=np.ascontiguousarray(goal, np.float64),
        headings=np.ascontiguousarray(headings, np.float64),
        arrivals=np.zeros((len(headings), 3)),
        ends=np.zeros(len(headings), np.int64),
    )
