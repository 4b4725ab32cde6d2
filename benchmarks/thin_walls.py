"""Walls of a few centimetres with a gap at one end, beside OMPL at its default resolution.

    pip install ".[bench]" && python benchmarks/thin_walls.py [RUNS]

A point goes from one side of a wall across 500 m x 500 m to the other. Shapely tells what became of
it: a path goes *through* if it crosses the wall's full thickness 10 m or more from the gap, and
*clips* it if any other part lies inside.
"""

from __future__ import annotations

import sys
from collections import Counter

import numpy as np
from ompl import base, geometric, util
from shapely.geometry import LineString, box

import viaspline as vs

SIZE, END = 500.0, 480.0  # [m], of the world, of the wall
THICKNESSES = (5.0, 2.0, 0.5, 0.05)  # [m]
SAMPLES = 200_001
util.setLogLevel(util.LogLevel.LOG_ERROR)


def ends(run: int):
    """Start and goal of a run."""
    random = np.random.default_rng(run)
    (x0, x1), (y0, y1) = random.uniform(10, 200, 2), random.uniform(10, 400, 2)
    return (float(x0), float(y0)), (float(SIZE - x1), float(y1))


def viaspline_path(thickness: float, start, goal):
    left, right = SIZE / 2 - thickness / 2, SIZE / 2 + thickness / 2
    wall = [(left, -1), (right, -1), (right, END), (left, END)]
    task = vs.Mission.model_validate(
        {
            "world": {"bounds": [0, 0, SIZE, SIZE], "known": [{"polygon": wall}]},
            "robot": {"radius_m": 0, "clearance_m": 0},
            "route": {"start": start, "goal": goal},
        }
    )
    plan = vs.plan(task)
    assert plan.certificate.holds
    return plan.path.evaluate(np.linspace(0, len(plan.path.spans), SAMPLES))


def rrt_path(thickness: float, start, goal):
    left, right = SIZE / 2 - thickness / 2, SIZE / 2 + thickness / 2
    space = base.RealVectorStateSpace(2)
    limits = base.RealVectorBounds(2)
    limits.setLow(0)
    limits.setHigh(SIZE)
    space.setBounds(limits)
    setup = geometric.SimpleSetup(space)
    setup.setStateValidityChecker(lambda s: not (left <= s[0] <= right and s[1] <= END))
    a, b = space.allocState(), space.allocState()
    a[0], a[1] = start
    b[0], b[1] = goal
    setup.setStartAndGoalStates(a, b)
    setup.setPlanner(geometric.RRTConnect(setup.getSpaceInformation()))
    setup.solve(5.0)
    if not setup.haveExactSolutionPath():
        return None
    setup.simplifySolution()
    return np.array([[s[0], s[1]] for s in setup.getSolutionPath().getStates()])


def fate(points, thickness: float) -> str:
    if points is None:
        return "none"
    line, (left, right) = LineString(points), (SIZE / 2 + s * thickness / 2 for s in (-1, 1))
    if line.intersection(box(left, -1, right, END - 10)).length >= 0.999 * thickness:
        return "through"
    inside = line.intersection(box(left, -1, right, END)).length
    return "clipped" if inside > 1e-6 else "clear"


def main(runs: int) -> None:
    fates = ("clear", "clipped", "through", "none")
    print(f"{'wall m':>6s} {'planner':12s} " + " ".join(f"{name:>8s}" for name in fates))
    for thickness in THICKNESSES:
        for name, planner in (("viaspline", viaspline_path), ("RRTConnect", rrt_path)):
            found = Counter(fate(planner(thickness, *ends(run)), thickness) for run in range(runs))
            counts = " ".join(f"{found[one]:8d}" for one in fates)
            print(f"{thickness:6.2f} {name:12s} {counts}", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 20)
