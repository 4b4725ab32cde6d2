"""A map of what scans have hit, and the shortest way over its cells: what leads a local planner.

Cells of 0.05 m on which a beam has ended are taken; the way keeps the body's radius and a clearance
from them. Cells that nothing has been seen on are free. Nothing is ever taken off the map.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra
from sim_bridge import SimulatedCart

CELL, MARGIN = 0.05, 1.5
"""[m]; by so much the map reaches beyond start and goal, and thrice as far to the sides [m]."""

STEPS = [(1, 0), (0, 1), (1, 1), (1, -1)]


class ScanMap:
    """Leads a cart to its goal.

    Args:
        start: x, y [m].
        goal: x, y [m].
        kept: From the middle of the cart [m].
    """

    def __init__(self, start: tuple[float, float], goal: tuple[float, float], kept: float) -> None:
        ends = np.array([start, goal])
        aside = np.array([3.0 * MARGIN, MARGIN])
        self.low, high = ends.min(axis=0) - aside, ends.max(axis=0) + aside
        self.taken = np.zeros(np.ceil((high - self.low) / CELL).astype(int), bool)
        self.goal, self.kept = np.array(goal), kept

    def cell(self, places: NDArray[np.float64]) -> NDArray[np.int64]:
        inside = np.floor((places - self.low) / CELL).astype(np.int64)
        return np.clip(inside, 0, np.array(self.taken.shape) - 1)

    def saw(self, cart: SimulatedCart, ranges: NDArray[np.float64]) -> None:
        state, seen = cart.state, np.isfinite(ranges)
        ways = state.heading + cart.angles[seen]
        hits = np.column_stack((np.cos(ways), np.sin(ways))) * ranges[seen, None] + state.position
        self.taken[tuple(self.cell(hits).T)] = True

    def ahead(self, place: NDArray[np.float64], far: float) -> NDArray[np.float64]:
        """A place so far ahead on the shortest way [m]; the goal if there is none."""
        free = CELL * distance_transform_edt(~self.taken) > self.kept
        index = np.arange(free.size).reshape(free.shape)
        rows, columns, costs = [], [], []
        for dx, dy in STEPS:
            a = index[: free.shape[0] - dx, max(-dy, 0) : free.shape[1] - max(dy, 0)]
            b = index[dx:, max(dy, 0) : free.shape[1] + min(dy, 0)]
            both = free.ravel()[a] & free.ravel()[b]
            rows.append(a[both])
            columns.append(b[both])
            costs.append(np.full(int(both.sum()), CELL * np.hypot(dx, dy)))
        graph = coo_array(
            (np.concatenate(costs), (np.concatenate(rows), np.concatenate(columns))),
            shape=(free.size, free.size),
        ).tocsr()
        end = int(index[tuple(self.cell(self.goal))])
        left, before = dijkstra(graph, directed=False, indices=end, return_predecessors=True)
        here = self.cell(place)
        near = np.abs(np.array(np.unravel_index(np.arange(free.size), free.shape)).T - here)
        near = np.where(np.isfinite(left), near.sum(axis=1), free.size)
        at = int(near.argmin())
        if not np.isfinite(left[at]):
            return self.goal
        first = left[at]
        while at != end and first - left[at] < far:
            at = int(before[at])
        return self.low + CELL * (np.array(np.unravel_index(at, free.shape)) + 0.5)
