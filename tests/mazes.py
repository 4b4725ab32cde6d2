"""Worlds at random in which a way is easily missed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray


def random_cells(seed: int, aside: int, share: float) -> NDArray[np.bool_]:
    blocked: NDArray[np.bool_] = np.random.default_rng(seed).random((aside, aside)) < share
    return blocked


def rooms_with_doors(random: np.random.Generator) -> tuple[list[dict[str, Any]], float, float]:
    """Rooms of 6 m, doors in most of their walls, some a little too narrow for the robot.

    Returns:
        The walls, what the robot keeps from them, and how wide the world is [m].
    """
    aside, rooms, half = 6.0, int(random.integers(2, 5)), float(random.choice((0.05, 0.15)))
    required = float(random.uniform(0.15, 0.6))
    walls: list[dict[str, Any]] = []

    def wall(flipped: bool, across: float, begin: float, end: float) -> None:
        box = [(begin, across - half), (end, across - half), (end, across + half),
               (begin, across + half)]  # fmt: skip
        walls.append({"polygon": [[y, x] if flipped else [x, y] for x, y in box]})

    for i, j, flipped in np.ndindex(rooms, rooms - 1, 2):
        begin, across = aside * i, aside * (j + 1)
        wider = float(random.choice((-1, 1, 1))) * 10 ** random.uniform(-2.5, -0.3)
        door = max(2.0 * required + wider, 0.05)
        left = float(random.uniform(0.3, aside - door - 0.3))
        if random.random() < 0.2:
            wall(bool(flipped), across, begin, begin + aside)
        else:
            wall(bool(flipped), across, begin, begin + left)
            wall(bool(flipped), across, begin + left + door, begin + aside)
    return walls, required, aside * rooms


def concave_rings(random: np.random.Generator) -> tuple[list[dict[str, Any]], float, float]:
    """Stars with deep notches, over each other here and there; see ``rooms_with_doors``."""
    width, rings = 30.0, []
    for _ in range(int(random.integers(5, 30))):
        corners = int(random.integers(5, 14))
        angles = np.sort(random.uniform(0, math.tau, corners))
        far = random.uniform(0.3, random.uniform(1.0, 5.0), corners)
        ring = random.uniform(0, width, 2) + (far * np.array((np.cos(angles), np.sin(angles)))).T
        if shapely.Polygon(ring).is_valid and shapely.Polygon(ring).area > 0.05:
            rings.append({"polygon": ring.tolist()})
    return rings, float(random.uniform(0.1, 0.9)), width


def thin_walls(random: np.random.Generator, width: float) -> list[dict[str, Any]]:
    """Walls of a few millimetres to centimetres, and discs, at any angle."""
    obstacles: list[dict[str, Any]] = []
    for _ in range(int(random.integers(10, 60))):
        at, angle = random.uniform(0, width, 2), random.uniform(0, math.tau)
        along = random.uniform(0.5, 3.0) * np.array((math.cos(angle), math.sin(angle)))
        half = float(random.choice((5e-4, 0.01, 0.05)))
        across = half * np.array((-math.sin(angle), math.cos(angle)))
        made = random.integers(3)
        if made == 0:
            line = {"from": (at - along).tolist(), "to": (at + along).tolist(), "radius": half}
            obstacles.append({"capsule": line})
        elif made == 1:
            ring = np.array([-along - across, along - across, along + across, -along + across])
            obstacles.append({"polygon": (at + ring).tolist()})
        else:
            size = float(random.uniform(0.05, 0.8))
            obstacles.append({"circle": {"center": at.tolist(), "radius": size}})
    return obstacles


def nested_traps(random: np.random.Generator) -> tuple[list[dict[str, Any]], float, float]:
    """Traps of three walls, each inside of the next and open to any side, about the origin.

    Walls are millimetres to centimetres thick, with both corners of their ends, and lanes between
    them from hardly wider to much wider than the robot.

    Returns:
        (obstacles, what the robot needs [m], half the width of all of it [m]).
    """
    required, half = float(random.uniform(0.1, 0.6)), float(random.choice((5e-4, 0.01, 0.05)))
    spare = float(10.0 ** random.uniform(-3.0, -0.3))
    lane = 2.0 * (required + half) + spare
    obstacles, reach = [], 1.5 * required + 2.0 * half
    for _ in range(int(random.integers(1, 6))):
        corners = reach * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
        sides = np.delete(np.stack((corners, np.roll(corners, -1, axis=0)), axis=1),
                          random.integers(4), axis=0)  # fmt: skip
        for a, b in sides:
            along = (b - a) / np.linalg.norm(b - a)
            across = half * np.array((-along[1], along[0]))
            ring = (a - across, b - across, b + across, a + across)
            obstacles.append({"polygon": np.array(ring).tolist()})
        reach += lane
    return obstacles, required, reach + 3.0 * required
