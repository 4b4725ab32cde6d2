"""The exact shortest route between two places, on a side of a group if that is asked for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.corners import X, Y
from viaspline.kernels.distance import mark_near_segment
from viaspline.kernels.route import barrier_crossings, shortest_route
from viaspline.kernels.taut import bends_of, detour_points, taut_length
from viaspline.mission.model import Side
from viaspline.world.world import World

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

SPARE = 1e-6  # what a proof may lack of the required distance [m]
# How far off an obstacle a route turns beyond what is required, and how finely it wraps arcs:
# coarse first, and finer for gaps that are hardly wider than the robot. Below nothing at last: a
# via point may stand at just what is required, and a route turns only round what it is outside of.
RESOLUTIONS = ((1e-3, np.pi / 6), (1e-4, np.pi / 32), (-0.25 * SPARE, np.pi / 200))
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
    floor = required - 0.5 * SPARE
    a, b = np.ascontiguousarray(start[:2]), np.ascontiguousarray(goal[:2])
    for margin, step in RESOLUTIONS:
        corners = shortest_route(
            world.packed, a, b, required + margin, floor, step, barriers, active
        )
        if len(corners):
            return Way.through(corners)
    return None


def on_the_line(world: World, start: Floats, goal: Floats, width: float) -> Flags:
    """Which obstacles are nearer than ``width`` to the straight line, (n,)."""
    found = np.zeros(len(world), np.bool_)
    mark_near_segment(world.packed, start[0], start[1], goal[0], goal[1], width, found)
    return found


def barrier(world: World, index: int, side: Side, start: Floats, goal: Floats) -> Floats:
    """A segment from an obstacle outwards that closes one side of it, seen from start to goal.

    Shape (1, 4). It reaches beyond everything that there is.
    """
    along = goal[:2] - start[:2]
    length = float(np.hypot(*along))
    along = along / length if length > 0 else np.array([1.0, 0.0])
    outward = np.array([-along[1], along[0]])
    inside = _place_in(world, index, start[:2], goal[:2])
    foot = float((inside - start[:2]) @ along)
    if not 0.0 <= foot <= length:  # beyond an end of the leg: aslant, so that it still meets it
        away = inside - start[:2] - np.clip(foot, 0.1 * length, 0.9 * length) * along
        outward = away / np.hypot(*away) * (1.0 if away @ outward >= 0.0 else -1.0)
    if side == "right":
        outward = -outward
    return np.array([[*inside, *(inside + _extent(world, start, goal) * outward)]])


def _place_in(world: World, index: int, start: Floats, goal: Floats) -> Floats:
    """A place in an obstacle: on the straight line if that goes through it, else near to it."""
    circle = world.obstacles[index].circle
    if circle is not None:
        return np.array(circle.center)
    ring = np.array(world.obstacles[index].polygon)
    along = goal - start
    offset = ring - start
    across = along[0] * offset[:, 1] - along[1] * offset[:, 0]
    ahead = offset @ along / max(float(along @ along), 1e-300)
    following = np.roll(across, -1)
    meets = (across > 0.0) != (following > 0.0)
    w = across[meets] / (across - following)[meets]
    crossings = np.sort(ahead[meets] + w * (np.roll(ahead, -1) - ahead)[meets])
    crossings = crossings[(crossings > 0.0) & (crossings < 1.0)]
    if len(crossings) > 1:
        return np.asarray(start + crossings[:2].mean() * along)
    gaps = offset - np.clip(ahead, 0.0, 1.0)[:, None] * along
    return np.asarray(ring[np.argmin(np.sum(gaps * gaps, axis=1))])


def _extent(world: World, start: Floats, goal: Floats) -> float:
    """A length beyond everything [m]."""
    corners = [start[:2], goal[:2]]
    if len(world.packed.boxes):
        corners += [world.packed.boxes[0, :2], world.packed.boxes[0, 2:]]
    if world.bounds is not None:
        corners += [np.array(world.bounds[:2]), np.array(world.bounds[2:])]
    stack = np.array(corners)
    return 4.0 * float(np.linalg.norm(stack.max(axis=0) - stack.min(axis=0))) + 1.0
