"""Worlds that are most often refused: via points in pockets, and robots too fat for a large map."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import count

import numpy as np
from problems import Problem, core_of, places_with_room, turned

LARGE = 512  # cells aside
SHARES = (0.02, 0.05, 0.1, 0.2)  # of the cells that are blocked
MOUTHS = (0.0, 0.002, 0.3, 0.95, 0.999)  # of a pocket, in what is needed
WALL_M = 0.05  # half of a wall's thickness


def pocket_problem(seed: int) -> Problem:
    """A start at any place of a box with a mouth, turned by any angle, among a few discs."""
    random = np.random.default_rng((3, seed))
    bounds = (-20.0, -20.0, 20.0, 20.0)
    for _ in count():
        required = float(random.uniform(0.2, 1.0))
        width, depth = required * random.uniform(2.3, 8.0, 2) + 2.0 * WALL_M
        mouth = float(random.choice(MOUTHS)) * 2.0 * required + 2.0 * WALL_M
        left, angle = float(random.uniform(0.0, width - mouth)), float(random.uniform(0, math.tau))
        ring = [(left, 0), (0, 0), (0, depth), (width, depth), (width, 0), (left + mouth, 0)]
        lines = turned(np.array(ring), angle)
        walls = [
            {"capsule": {"from": a, "to": b, "radius": WALL_M}}
            for a, b in zip(lines[:-1].tolist(), lines[1:].tolist(), strict=True)
        ]
        discs = [
            {"circle": {"center": random.uniform(-18, 18, 2).tolist(), "radius": 1.0}}
            for _ in range(4)
        ]
        problem = Problem(kind="pocket", bounds=bounds, radius=required, start=(0.0, 0.0),
                          goal=(0.0, 0.0), obstacles=(*walls, *discs),
                          note=f"mouth of {mouth - 2 * WALL_M:.4f} m")  # fmt: skip
        places = places_with_room(random, problem.solids, bounds, required + 2e-3, 300, 3000)
        inside = core_of({"polygon": lines.tolist()})[0]
        start = [p for p in places if inside.contains(core_of(_at(p))[0])]
        goal = [p for p in places if p not in start]
        if start and goal:
            ends = (start[0], goal[0]) if random.random() < 0.5 else (goal[0], start[0])
            return _between(problem, *ends).shared_out(random)
    raise AssertionError


def large_problem(seed: int) -> Problem:
    """A robot of several cells on a map of 512 cells aside, too fat for most of its gaps."""
    random = np.random.default_rng((4, seed))
    for _ in count():
        cells = random.random((LARGE, LARGE)) < float(random.choice(SHARES))
        required = float(random.uniform(0.6, 4.0))
        bounds = (0.0, 0.0, float(LARGE), float(LARGE))
        problem = Problem(kind="fat 512", bounds=bounds, radius=required, start=(0.0, 0.0),
                          goal=(0.0, 0.0), cells=cells,
                          note=f"{cells.mean():.0%} blocked")  # fmt: skip
        places = places_with_room(random, problem.solids, bounds, required + 1e-3, 2, 3000)
        if len(places) == 2:
            return _between(problem, *places).shared_out(random)
    raise AssertionError


def _at(place: tuple[float, float]) -> dict:
    return {"circle": {"center": place, "radius": 0.0}}


def _between(problem: Problem, start, goal) -> Problem:

    return replace(problem, start=start, goal=goal)
