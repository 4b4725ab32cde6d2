"""Worlds of many obstacles of which few are met: which search finds the shorter route.

    python benchmarks/exact_or_lattice.py [WORLDS]

Every leg is routed by the search of the tangent graph alone, by the lattice alone, and by both as
the planner asks them. The tangent graph is searched for as long as it takes here, so that the
lattice's error is known; "met" is how many obstacles its route had to be held against.
"""

from __future__ import annotations

import math
import sys
import time

import numpy as np

import viaspline as vs
from viaspline.planning.problem.method import Found
from viaspline.planning.routing.exact_route import ExactRoute
from viaspline.planning.routing.lattice_route import LatticeRoute
from viaspline.planning.routing.route_problem import NO_BARRIERS, RouteProblem, on_the_line
from viaspline.planning.routing.router import MAX_EXACT_AGAIN, MAX_EXACT_OBSTACLES, Router

SIZE, COUNTS, SHARES = 100.0, (30, 60, 120, 250, 500), (0.05, 0.1, 0.2, 0.3)
MAX_MET = 200
TOLD = 1e-3  # part of the length from which on a difference is told


def world(rng: np.random.Generator) -> vs.World:
    """Discs and star-shaped polygons that cover a share of a square."""
    count, share = int(rng.choice(COUNTS)), float(rng.choice(SHARES))
    most = 1.4 * math.sqrt(share * SIZE**2 / count / math.pi)
    found = []
    for _ in range(count):
        centre = rng.uniform(0, SIZE, 2)
        if rng.random() < 0.6:
            radius = float(rng.uniform(0.3 * most, most))
            found.append(vs.Obstacle(circle={"center": centre.tolist(), "radius": radius}))
            continue
        corners = int(rng.integers(3, 8))
        angles = (np.arange(corners) + rng.uniform(0, 0.8, corners)) * math.tau / corners
        reach = rng.uniform(0.3 * most, 1.5 * most, (corners, 1))
        ring = centre + reach * np.column_stack((np.cos(angles), np.sin(angles)))
        found.append(vs.Obstacle(polygon=ring.tolist()))
    return vs.World(found)


def leg(rng: np.random.Generator, found: vs.World, required: float) -> np.ndarray | None:
    """Two places with room, often the farthest apart of many."""
    places = rng.uniform(2, SIZE - 2, (300, 2))
    places = places[found.distance(places) > required + 0.01]
    if len(places) < 2:
        return None
    apart = np.hypot(*(places - places[0]).T)
    return places[[0, int(np.argmax(apart)) if rng.random() < 0.5 else 1]]


def problem(router: Router, ends: np.ndarray) -> RouteProblem:
    active = on_the_line(router.world, *ends, router.required)
    return RouteProblem(router, *ends, NO_BARRIERS, active)


def clocked(route) -> tuple[float, float]:
    """The length of a route [m], infinite where there is none, and the time it took [ms]."""
    begin = time.perf_counter()
    outcome = route()
    spent = 1e3 * (time.perf_counter() - begin)
    return (outcome.length if isinstance(outcome, Found) else math.inf), spent


def routed_both(found: vs.World, required: float, ends: np.ndarray) -> tuple[float, ...]:
    """What the searches meet and find [m], and how long they take [ms]."""
    router = Router(found, required, ends)
    _ = router.lattice.mesh
    searched, routed = problem(router, ends), problem(router, ends)
    exact, exact_ms = clocked(lambda: ExactRoute(max_met=MAX_MET).lay(searched))
    lattice, lattice_ms = clocked(lambda: LatticeRoute().lay(problem(router, ends)))
    taken, both_ms = clocked(lambda: router.find(*ends, NO_BARRIERS, routed.active))
    met = searched.active_count
    return met, exact, lattice, taken, exact_ms, lattice_ms, both_ms


def main() -> None:
    worlds = int(sys.argv[1]) if len(sys.argv) > 1 else 300
    rows = []
    print("world  obstacles  met    exact [m]  lattice [m]  taken [m]  lattice/exact")
    for seed in range(worlds):
        rng = np.random.default_rng(seed)
        found, required = world(rng), float(rng.choice([0.2, 0.5, 1.0]))
        ends = leg(rng, found, required)
        if ends is None:
            continue
        row = routed_both(found, required, ends)
        rows.append(row)
        met, exact, lattice, taken = row[:4]
        if math.isfinite(exact) and lattice > (1.0 + TOLD) * exact:
            print(
                f"{seed:5}  {len(found):9}  {met:3.0f}  {exact:11.3f}  {lattice:11.3f}"
                f"  {taken:9.3f}  {lattice / exact:13.4f}"
            )
    table = np.array(rows)
    print("\nmet         legs  lattice longer by 0.1 %  worst  taken longer  worst  [ms] e/l/both")
    low = 0
    for high in (MAX_EXACT_OBSTACLES, MAX_EXACT_AGAIN, 48, MAX_MET):
        part = table[(table[:, 0] > low - (low == 0)) & (table[:, 0] <= high)]
        part = part[np.isfinite(part[:, 1]) & np.isfinite(part[:, 2])]
        if len(part):
            worse, taken = part[:, 2] / part[:, 1] - 1.0, part[:, 3] / part[:, 1] - 1.0
            spent = "/".join(f"{one:.2f}" for one in np.median(part[:, 4:], axis=0))
            print(
                f"{low:3} to {high:3}  {len(part):4}  {(worse > TOLD).sum():22}"
                f"  {100 * worse.max():4.1f} %  {(taken > TOLD).sum():12}"
                f"  {100 * taken.max():4.1f} %  {spent}"
            )
        low = high + 1


if __name__ == "__main__":
    main()
