"""Maps of random cells with two places in them, a seed each."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import count

import numpy as np
from problems import Place, Problem, places_with_room

SHARES = (0.1, 0.2, 0.25, 0.3, 0.35, 0.4)
"""Of the cells that are blocked."""

KINDS = ("thin 40", "thin 100", "wide 100", "thin 40", "thin disc", "wide clumps", "thin 40",
         "wide disc", "thin 512", "thin 40", "wide 512")  # fmt: skip
"""By the seed: thinner than a cell or wider, the map's cells aside, with a disc or in clumps."""

ASIDE = (40, 512)  # cells, where it isn't 100

RESOLUTIONS_M = (1.0, 1.0, 1.0, 0.25, 0.05)
FAR_SHARE = 0.2  # of the maps that have a disc a thousand widths away
LEAST_SPARE = 1e-3  # of the room at start and goal, beyond what is required, in cells


def cell_problem(seed: int) -> Problem:
    """The problem of a seed."""
    random = np.random.default_rng((1, seed))
    kind = KINDS[seed % len(KINDS)]
    aside = next((n for n in ASIDE if kind.endswith(str(n))), 100)
    side = float(random.choice(RESOLUTIONS_M))
    for attempt in count():
        thin = kind.startswith("thin")
        required = side * float(random.uniform(0.05, 0.49) if thin else random.uniform(0.51, 2.4))
        cells, share = _cells(random, aside, kind, required / side, attempt)
        obstacles = _disc(random, aside * side, kind)
        bounds = (0.0, 0.0, aside * side, aside * side)
        problem = Problem(
            kind=kind,
            bounds=bounds,
            radius=required,
            start=(0.0, 0.0),
            goal=(0.0, 0.0),
            obstacles=obstacles,
            cells=cells,
            resolution=side,
            note=f"{share:.0%} blocked, cells of {side:g} m",
        )
        ends = places_with_room(
            random, problem.solids, bounds, required + LEAST_SPARE * side, 2000, tries=2000
        )
        if len(ends) > 1:
            start, goal = _pair(random, ends)
            return replace(problem, start=start, goal=goal).shared_out(random)
    raise AssertionError


def _pair(random: np.random.Generator, places: list[Place]) -> tuple[Place, Place]:
    """Two of the places: any, or those at opposite ends of a diagonal."""
    if random.random() < 0.5:
        return places[0], places[1]
    sign = random.choice((-1, 1))
    along = [x + sign * y for x, y in places]
    return places[int(np.argmin(along))], places[int(np.argmax(along))]


def _cells(random: np.random.Generator, aside: int, kind: str, required: float, attempt: int):
    """True where blocked; for a wide robot about as much of it as leaves a way through."""
    share = float(random.choice(SHARES))
    size = int(random.integers(2, 8)) if kind.endswith("clumps") else 1
    if kind.startswith("wide"):
        grown = 1.0 + 4.0 * required / size + math.pi * (required / size) ** 2  # by one clump
        share = min(0.4, float(random.uniform(0.3, 1.6)) / grown) / (1 + attempt)
    coarse = random.random((-(-aside // size), -(-aside // size))) < share
    return coarse.repeat(size, axis=0).repeat(size, axis=1)[:aside, :aside].copy(), share


def _disc(random: np.random.Generator, width: float, kind: str):
    """One disc somewhere in the map, or now and then far away from it."""
    if kind.endswith("disc"):
        at, radius = random.uniform(0, width, 2), float(random.uniform(0.02, 0.2) * width)
    elif random.random() < FAR_SHARE:
        at, radius = np.full(2, 1e3 * width), width
    else:
        return ()
    return ({"circle": {"center": at.tolist(), "radius": radius}},)
