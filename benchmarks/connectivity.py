"""Whether there is a way at all, told without the planner, from both sides: open, closed, unknown.

*Maps of cells alone* are told exactly. Where two areas with room join as the required distance gets
less, the place in between has its two nearest points at opposite sides, corners or edges of cells:
half their distance is sqrt(a² + b²) / 2 cells with whole a and b. Between two such levels nothing
joins, so what is joined at one distance is joined at any other up to the next level. Below half a
cell, cells are joined that share an edge. Above, a lattice of samples whose distances are exact
(a blocked cell's nearest point to a node of the lattice is a node) has all of the room between two
levels for the half step that it can't see.

*Other worlds* are grown by a little more and a little less than is required, as polygons that lie
outside and inside of the true shape.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import shapely
from problems import Place, Problem, Solids, core_of
from scipy.ndimage import distance_transform_edt, label

Verdict = Literal["open", "closed", "unknown"]

MARGIN_M = 2e-4
"""By which other worlds are grown more and less than is required [m]."""

CELL_MARGIN_M = 1e-4
"""Nearer to a level of a map's gaps than this, nothing is told [m]."""

SAGITTA_M = 5e-5
"""Of a grown polygon's arcs, at most [m]."""

NODES_A_CELL = 8
"""Of the lattice, along a cell's side."""


def verdict(problem: Problem) -> Verdict:
    """Whether a way surely exists, surely does not, or can't be told."""
    if problem.cells is None:
        return _among_solids(problem.solids, problem.required, problem.start, problem.goal)
    if any(core.distance(shapely.box(*problem.bounds)) < radius + problem.required
           for core, radius in map(core_of, problem.obstacles)):  # fmt: skip
        return _on_lattice(problem)
    return _among_cells(problem)


def _among_cells(problem: Problem) -> Verdict:
    cells, side = problem.cells, problem.resolution
    required = problem.required / side
    low, high = levels_about(required)
    if min(required - low, high - required) * side < CELL_MARGIN_M:
        return "unknown"
    if required < 0.5:
        areas, _ = label(~cells)
        start, goal = (
            areas[int(y / side), int(x / side)] for x, y in (problem.start, problem.goal)
        )
        return "open" if start and start == goal else "closed"
    ends = shapely.points([problem.start, problem.goal])
    rooms = problem.solids.room(ends, (high + 1.0) * side) / side
    free, step = node_distances(cells), 1.0 / NODES_A_CELL
    most = min(high, float(rooms.min()))
    places = np.array([problem.start, problem.goal]) / side
    return _told(free, step, places, rooms, low, most)


def _on_lattice(problem: Problem) -> Verdict:
    """Cells and discs together: the lattice without levels."""
    side, step = problem.resolution, 1.0 / NODES_A_CELL
    free = node_distances(problem.cells)
    y, x = (step * np.arange(n) for n in free.shape)
    for obstacle in problem.obstacles:
        (cx, cy), radius = (np.divide(obstacle["circle"][k], side) for k in ("center", "radius"))
        np.minimum(free, np.hypot(x - cx, y[:, None] - cy) - radius, out=free)
    ends = np.array([problem.start, problem.goal])
    rooms = problem.solids.room(shapely.points(ends), 3.0 * problem.required + side) / side
    required = problem.required / side
    return _told(free, step, ends / side, rooms, required, required)


def levels_about(required: float) -> tuple[float, float]:
    """The levels of a map's gaps next below (or at) and next above a distance, in cells."""
    whole = np.arange(math.ceil(2.0 * required) + 2)
    levels = np.unique(0.5 * np.hypot(*np.meshgrid(whole, whole)))
    above = int(np.searchsorted(levels, required, side="right"))
    return float(levels[above - 1]), float(levels[above])


def node_distances(cells: np.ndarray, nodes: int = NODES_A_CELL) -> np.ndarray:
    """Distance of a lattice's nodes to blocked cells and the map's edge, exact, in cells."""
    fine = cells.repeat(nodes, axis=0).repeat(nodes, axis=1)
    blocked = np.ones((fine.shape[0] + 1, fine.shape[1] + 1), bool)
    blocked[1:-1, 1:-1] = fine[:-1, :-1] | fine[:-1, 1:] | fine[1:, :-1] | fine[1:, 1:]
    return distance_transform_edt(~blocked) / nodes


def _told(
    free: np.ndarray, step: float, ends: np.ndarray, rooms: np.ndarray, low: float, most: float
) -> Verdict:
    """From distances at nodes: open above the level ``low``, or closed at ``most``.

    Args:
        free: Distances of the nodes, (rows, columns).
        step: Between nodes.
        ends: Start and goal (x, y), (2, 2).
        rooms: Of these, (2,).
        low: A way that keeps more than this will do.
        most: A way that is there keeps this.
    """
    areas, _ = label(free > low + 0.5 * step)
    found = [
        {areas[j, i] for j, i, gap in _nodes_about(place, step, free.shape)
         if areas[j, i] and 0.5 * (free[j, i] + room - gap) > low}
        for place, room in zip(ends, rooms, strict=True)
    ]  # fmt: skip
    if found[0] & found[1]:
        return "open"
    areas, _ = label(free >= most - math.sqrt(0.5) * step, np.ones((3, 3)))
    start, goal = (areas[round(y / step), round(x / step)] for x, y in ends)
    return "unknown" if start and start == goal else "closed"


def _nodes_about(place: np.ndarray, step: float, shape: tuple[int, ...]):
    """The nodes within three steps of a place: row, column and how far."""
    column, row = (round(v / step) for v in place)
    for j in range(max(row - 3, 0), min(row + 4, shape[0])):
        for i in range(max(column - 3, 0), min(column + 4, shape[1])):
            yield j, i, math.hypot(i * step - place[0], j * step - place[1])


def _among_solids(solids: Solids, required: float, start: Place, goal: Place) -> Verdict:
    if _joined(_free(solids, required + MARGIN_M, circumscribed=True), start, goal):
        return "open"
    if not _joined(_free(solids, required - MARGIN_M, circumscribed=False), start, goal):
        return "closed"
    return "unknown"


def _free(solids: Solids, required: float, *, circumscribed: bool):
    """What keeps a distance [m] from everything, at most or at least."""
    reach = solids.radii + required
    segments = np.ceil(1.5 * math.pi / 4 / np.arccos(1.0 - SAGITTA_M / np.maximum(reach, 1e-3)))
    if circumscribed:  # an arc's steps may be half as long again as asked for
        reach = reach / np.cos(1.5 * math.pi / 4 / segments)
    grown = [
        shapely.buffer(core, r, quad_segs=int(n))
        for core, r, n in zip(solids.cores, reach, segments, strict=True)
    ]
    x0, y0, x1, y1 = solids.bounds
    inside = shapely.box(x0 + required, y0 + required, x1 - required, y1 - required)
    return shapely.difference(inside, shapely.union_all(grown))


def _joined(free, start: Place, goal: Place) -> bool:
    parts = shapely.get_parts(free)
    a, b = shapely.points([start, goal])
    return bool((shapely.covers(parts, a) & shapely.covers(parts, b)).any())
