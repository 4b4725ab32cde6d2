"""Maps of games and streets with their problems, beside tcod's A*.

    pip install ".[bench]" && python benchmarks/movingai.py FOLDER [PROBLEMS]

FOLDER has the maps (.map) and their problems (.scen), as https://movingai.com/benchmarks publishes
them. Of each map, PROBLEMS (50) spread over its buckets are planned for a robot of radius 0.4
cells. Both search a map that is ready, which it was made once for all its problems.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from grids import Prepared, tcod_graph, tcod_path
from timing import clock

import viaspline as vs
from viaspline.maps.movingai import read_movingai, read_problems

RADIUS = 0.4


def chosen(problems, count: int):
    """Problems spread evenly over all that have a way to go, which are sorted by its length."""
    some = sorted((p for p in problems if p.optimal > 0), key=lambda p: p.optimal)
    at = np.unique(np.linspace(0, len(some) - 1, min(count, len(some))).round().astype(int))
    return [some[i] for i in at]


def tried(problem, graph, ready, known, extent):
    """One problem: times [s] of tcod, of a route, of a plan, and the plan or what went wrong."""
    start, goal = ((int(p[1]), int(p[0])) for p in (problem.start, problem.goal))
    peer, _ = clock(lambda: tcod_path(graph, start, goal))
    route, _ = clock(lambda: ready.route(problem.start, problem.goal))
    task = vs.Mission.model_validate(
        {
            "world": {"bounds": extent, "known": known},
            "robot": {"radius_m": RADIUS, "clearance_m": 0},
            "route": {"start": problem.start, "goal": problem.goal},
        }
    )
    try:
        whole, plan = clock(lambda: vs.plan(task))
    except vs.PlanningError as error:
        return peer, route, np.nan, error
    return peer, route, whole, plan


def main(folder: str, count: int) -> None:
    names = ("tcod ms", "route ms", "plan ms", "worst", "/ route", "/ plan")
    print(f"{'map':16s} {'problems':>8s} certified length  " + " ".join(f"{n:>8s}" for n in names))
    sums = []
    for path in sorted(Path(folder).rglob("*.map")):
        grid = read_movingai(path)
        known = [vs.Obstacle(grid=grid)]
        world = vs.World(known, bounds=grid.extent)
        problems = chosen(read_problems(f"{path}.scen"), count)
        places = [place for p in problems for place in (p.start, p.goal)]
        graph, ready = tcod_graph(grid.blocked), Prepared(world, RADIUS, places)
        tried(problems[-1], graph, ready, known, grid.extent)
        rows, ratios, certified = [], [], 0
        for problem in problems:
            *times, plan = tried(problem, graph, ready, known, grid.extent)
            rows.append(times)
            if isinstance(plan, vs.PlanningError):
                print(f"{path.name} {problem.start} {problem.goal}: {plan}")
                continue
            certified += plan.certificate.holds
            ratios.append(plan.path.length / problem.optimal)
        peer, route, whole = 1e3 * np.array(rows).T
        shares = float(np.median(peer / route)), float(np.nanmedian(peer / whole))
        times = np.median(peer), np.median(route), np.nanmedian(whole), np.nanmax(whole)
        sums.append((len(problems), certified, np.mean(ratios), *shares))
        print(f"{path.stem:16s} {len(problems):8d} {certified:9d} {np.mean(ratios):6.4f}  "
              + " ".join(f"{t:8.2f}" for t in (*times, *shares)), flush=True)  # fmt: skip
    total = np.array(sums)
    counts, (longer, *shares) = total[:, :2].sum(axis=0).astype(int), np.mean(total[:, 2:], axis=0)
    print(f"{len(total)} maps: {counts[1]} of {counts[0]} certified, length / octile optimum "
          f"{longer:.4f}; tcod / route {shares[0]:.2f}, tcod / plan {shares[1]:.2f}")  # fmt: skip


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 50)
