"""Barriers: what closes one side of an obstacle, so that a way has to take the other.

Tested through ``planning/routing/test_router``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.obstacle import Side
from viaspline.world.world import World


class Barriers(NamedTuple):
    """Segments from an obstacle outwards, beyond everything that there is, shape (1, 4) each.

    Attributes:
        left: Closes the left side of the obstacle, seen from the start of a leg to its goal.
        right: Closes the right side.
    """

    left: Floats
    right: Floats

    def closing(self, side: Side) -> Floats:
        """The one that closes a side."""
        return self.left if side == "left" else self.right

    def forcing(self, side: Side | None) -> Floats:
        """The one that leaves only this side; none, (0, 4), where either will do."""
        if side is None:
            return np.empty((0, 4))
        return self.right if side == "left" else self.left


def barriers_of(world: World, index: int, start: Floats, goal: Floats) -> Barriers:
    """The barriers of an obstacle on the leg from start to goal."""
    return barriers_at(world, _place_in(world, index, start[:2], goal[:2]), start, goal)


def barriers_at(world: World, inside: Floats, start: Floats, goal: Floats) -> Barriers:
    """The barriers of what a place lies in, on the leg from start to goal."""
    along = goal[:2] - start[:2]
    length = math.hypot(along[0], along[1])
    along = along / length if length > 0 else np.array([1.0, 0.0])
    outward = np.array([-along[1], along[0]])
    foot = float((inside - start[:2]) @ along)
    if not 0.0 <= foot <= length:  # beyond an end of the leg: aslant, so that it still meets it
        away = inside - start[:2] - np.clip(foot, 0.1 * length, 0.9 * length) * along
        outward = away / np.hypot(*away) * (1.0 if away @ outward >= 0.0 else -1.0)
    arm = _reach(world, start, goal) * outward
    left, right = inside + arm, inside - arm
    return Barriers(np.array([[*inside, *left]]), np.array([[*inside, *right]]))


def _place_in(world: World, index: int, start: Floats, goal: Floats) -> Floats:
    """A place in an obstacle: on the straight line if that goes through it, else near to it."""
    shape = world.obstacles[index].ring
    assert shape is not None  # a grid has barriers where a path meets it
    ring = shape.vertices
    if shape.is_disc:
        return np.asarray(ring[0])
    along = goal - start
    offset = ring - start
    across = along[0] * offset[:, 1] - along[1] * offset[:, 0]
    ahead = offset @ along / max(float(along @ along), 1e-300)
    following, ahead_there = (np.append(row[1:], row[0]) for row in (across, ahead))
    meets = (across > 0.0) != (following > 0.0)
    w = across[meets] / (across - following)[meets]
    crossings = np.sort(ahead[meets] + w * (ahead_there - ahead)[meets])
    crossings = crossings[(crossings > 0.0) & (crossings < 1.0)]
    if len(crossings) > 1:
        return np.asarray(start + crossings[:2].mean() * along)
    gaps = offset - np.clip(ahead, 0.0, 1.0)[:, None] * along
    return np.asarray(ring[np.argmin(np.sum(gaps * gaps, axis=1))])


def _reach(world: World, start: Floats, goal: Floats) -> float:
    """A length beyond everything [m]."""
    boxes = [(*start[:2], *start[:2]), (*goal[:2], *goal[:2])]
    if len(world.packed.boxes):
        boxes.append(tuple(world.packed.boxes[0].tolist()))
    if world.bounds is not None:
        boxes.append(world.bounds)
    x0, y0, x1, y1 = zip(*boxes, strict=True)
    return 4.0 * math.hypot(max(x1) - min(x0), max(y1) - min(y0)) + 1.0
