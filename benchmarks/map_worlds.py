"""Maps of games and streets (https://movingai.com/benchmarks) with places of our own, by a seed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from problems import Problem, places_with_room

import viaspline as vs

RADII = (0.1, 0.4, 0.49)  # of the robot, in cells
LEAST_SPARE = 1e-3  # of the room at start and goal, beyond what is required, in cells


def map_problem(seed: int, folder: str) -> Problem:
    """The problem of a seed on the maps of a folder."""
    random = np.random.default_rng((3, seed))
    files = sorted(Path(folder).rglob("*.map"))
    if not files:
        raise SystemExit(f"{folder!r} has no maps; give --maps FOLDER with MovingAI's .map files")
    (obstacle,) = vs.load_map(files[seed % len(files)])
    cells, radius = obstacle.grid.blocked, float(random.choice(RADII))
    bounds = obstacle.grid.extent
    problem = Problem(
        kind=files[seed % len(files)].stem, bounds=bounds, radius=radius, start=(0, 0),
        goal=(0, 0), cells=cells, note="a map",
    )  # fmt: skip
    start, goal = _spread(random, problem)
    return Problem(
        kind=problem.kind, bounds=bounds, radius=radius, start=start, goal=goal, cells=cells,
        note=problem.note,
    )  # fmt: skip


def _spread(random: np.random.Generator, problem: Problem):
    """Two places with room."""
    spare = problem.required + LEAST_SPARE
    return places_with_room(random, problem.solids, problem.bounds, spare, 2, tries=2000)
