"""The exact shortest route between two places, on a side of a group if that is asked for."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.certificate import SPARE
from viaspline.kernels.corners import X, Y
from viaspline.kernels.route import barrier_crossings, shortest_route
from viaspline.kernels.segment import mark_near_segment
from viaspline.kernels.taut import bends_of, detour_points, taut_length
from viaspline.world.world import World

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

# How far off an obstacle a route turns beyond what is required, and how finely it wraps arcs:
# coarse first, and finer for gaps that are hardly wider than the robot. Below nothing at last: a
# via point may stand at just what is required, and a route turns only round what it is outside of.
RESOLUTIONS = ((1e-3, np.pi / 6), (1e-4, np.pi / 32), (-0.25 * SPARE, np.pi / 200))
MANY = 32  # obstacles in the way of a leg beyond which it is sought piece by piece
NEAR = 5  # corners of either piece that are sought again where two pieces meet
NO_BARRIERS = np.empty((0, 4))


@dataclass(frozen=True)
class Way:
    """A route between two places.

    Attributes:
        corners: Corner rows, see ``kernels.corners``, shape (k, 8), start and goal among them.
        bends: The same pulled taut, see ``kernels.taut``, shape (m, 6); empty where the arcs have
            no common tangents.
        length: [m].
    """

    corners: Floats
    bends: Floats
    length: float

    @property
    def is_direct(self) -> bool:
        """Whether nothing stands between the two places."""
        return len(self.corners) == 2

    @property
    def turns(self) -> Floats:
        """The corners between start and goal [m], shape (n, 2): their polyline is clear."""
        return np.ascontiguousarray(self.corners[1:-1, X : Y + 1])

    def points(self, step: float, excess: float, stretch: float, ease: float) -> Floats:
        """Detour via points along it [m], shape (n, 2); see ``kernels.taut.detour_points``."""
        if len(self.bends) == 0:
            return self.turns
        points: Floats = detour_points(self.bends, step, excess, stretch, ease)
        return points

    @classmethod
    def through(cls, corners: Floats) -> Way:
        """The way along given corners."""
        bends = bends_of(corners)
        return cls(corners, bends, float(taut_length(corners, bends)))

    def crosses(self, barrier: Floats) -> bool:
        """Whether it crosses a barrier, shape (1, 4), an odd number of times."""
        return barrier_crossings(self.corners, barrier)[0] % 2 == 1

    def window(self, barrier: Floats, reach: int) -> tuple[int, int]:
        """The corners ``reach`` before and after the place where it crosses a barrier first."""
        crossing = barrier_crossings(self.corners, barrier)[1]
        return max(0, crossing - reach), min(len(self.corners) - 1, crossing + 1 + reach)

    def spliced(self, first: int, last: int, part: Way) -> Way:
        """The same with ``part`` between two of its corners."""
        inner = part.corners[1:-1]
        rows = (self.corners[: first + 1], inner, self.corners[last:])
        return Way.through(np.concatenate(rows))


def find_way(
    world: World, start: Floats, goal: Floats, required: float, barriers: Floats, active: Flags
) -> Way | None:
    """The shortest way that keeps ``required`` from everything and crosses no barrier.

    Args:
        world: What to keep clear of.
        start: [m], at least (2,).
        goal: [m], at least (2,).
        required: Distance to keep [m].
        barriers: Segments not to cross, (b, 4).
        active: (n,): obstacles to begin with; those met are added in place.

    Returns:
        The way, or None where there is none.
    """
    if not len(barriers) and np.count_nonzero(active) > MANY:
        way = _piecewise(world, start, goal, required, active)
        if way is not None:
            return way
    floor = required - 0.5 * SPARE
    a, b = np.ascontiguousarray(start[:2]), np.ascontiguousarray(goal[:2])
    for margin, step in RESOLUTIONS:
        corners = shortest_route(
            world.packed, a, b, required + margin, floor, step, barriers, active
        )
        if len(corners):
            return Way.through(corners)
    return None


def _piecewise(
    world: World, start: Floats, goal: Floats, required: float, active: Flags
) -> Way | None:
    """A way along a leg with very many obstacles, sought piece by piece.

    The straight line is cut at places on it that are free, each piece is led round what it meets,
    and where two pieces meet the way is sought again between corners on both of them. It is a
    little longer than the shortest way, where the search for that would take minutes.
    """
    pieces = int(np.ceil(np.count_nonzero(active) / (0.5 * MANY)))
    places = [start[:2], *_gates(world, start, goal, required, pieces), goal[:2]]
    ways = [_part(world, a, b, required, active) for a, b in pairwise(places)]
    if len(ways) < 2:
        return None
    corners = None
    for way in ways:
        if way is None:
            return None
        if corners is None:
            corners = way.corners
            continue
        joint = len(corners) - 1
        corners = np.concatenate((corners, way.corners[1:]))
        first, last = max(0, joint - NEAR), min(len(corners) - 1, joint + NEAR)
        ends = corners[first, X : Y + 1], corners[last, X : Y + 1]
        part = _part(world, *ends, required, active)
        if part is None:
            return None
        inner = part.corners[1:-1]
        corners = np.concatenate((corners[: first + 1], inner, corners[last:]))
    return None if corners is None else Way.through(corners)


def _part(world: World, start: Floats, goal: Floats, required: float, active: Flags) -> Way | None:
    """The shortest way on a part of a leg; what it meets is added to ``active``."""
    near = on_the_line(world, start, goal, required)
    if np.count_nonzero(near) > MANY:
        return None
    way = find_way(world, start, goal, required, NO_BARRIERS, near)
    active |= near
    return way


def _gates(world: World, start: Floats, goal: Floats, required: float, pieces: int) -> list[Floats]:
    """Free places on a straight line, about equally far apart; fewer where there are none."""
    share = np.linspace(0.0, 1.0, 40 * pieces + 1)[1:-1]
    places = start[None, :2] + share[:, None] * (goal[:2] - start[:2])[None, :]
    free = world.distance(places) > 2 * required
    gates = []
    for k in range(1, pieces):
        near = np.flatnonzero(free[40 * k - 20 : 40 * k + 20])
        if near.size:
            gates.append(places[40 * k - 20 + near[np.argmin(np.abs(near - 20))]])
    return gates


def on_the_line(world: World, start: Floats, goal: Floats, width: float) -> Flags:
    """Which obstacles are nearer than ``width`` to the straight line, (n,)."""
    found = np.zeros(len(world), np.bool_)
    mark_near_segment(world.packed, start[0], start[1], goal[0], goal[1], width, found)
    return found
