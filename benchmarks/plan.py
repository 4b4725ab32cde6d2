"""Vector worlds, from obstacles to certified curve, beside OMPL and extremitypathfinder.

    pip install ".[bench]" && python benchmarks/plan.py [SEEDS]

Every seed is planned by every planner in turn, so that the machine's load falls on all alike.
"""

from __future__ import annotations

import sys
import time

import numpy as np
from extremitypathfinder import PolygonEnvironment
from ompl import base, geometric, util
from shapely.geometry import Polygon
from worlds import GOAL, RADIUS, SIZE, START, clearance, inflated, length, mission

import viaspline as vs

ROUNDS = 9
SAFE = 0.0002  # resolution at which OMPL no longer cuts corners here
util.setLogLevel(util.LogLevel.LOG_ERROR)


def clock(work):
    begin = time.perf_counter()
    result = work()
    return time.perf_counter() - begin, result


def viaspline_path(task):
    """All of it: world, spline, both sides of every group, certificate, time law."""
    return vs.plan(task)


def corner_path(outlines):
    holes = [ring[::-1] if Polygon(ring).exterior.is_ccw else ring for ring in outlines]
    frame = np.array([(0, 0), (SIZE, 0), (SIZE, SIZE), (0, SIZE)])
    environment = PolygonEnvironment()
    environment.store(frame, holes, validate=False)
    return np.array(environment.find_shortest_path(START, GOAL)[0])


class Validity:
    """Whether a disc is free, as fast as numpy makes it for 20 obstacles."""

    def __init__(self, found):
        self.discs = np.array([[*o.circle.center, o.circle.radius] for o in found if o.circle])
        self.polygons = []
        for obstacle in found:
            if obstacle.polygon is not None:
                ring = np.array(obstacle.polygon)
                ring = ring if Polygon(ring).exterior.is_ccw else ring[::-1]
                edge = np.roll(ring, -1, 0) - ring
                normal = np.c_[edge[:, 1], -edge[:, 0]] / np.linalg.norm(edge, axis=1)[:, None]
                self.polygons.append((normal, (normal * ring).sum(1)))

    def __call__(self, state):
        x, y = state[0], state[1]
        if not (0 <= x <= SIZE and 0 <= y <= SIZE):
            return False
        gap = (self.discs[:, 0] - x) ** 2 + (self.discs[:, 1] - y) ** 2
        if (gap < (self.discs[:, 2] + RADIUS) ** 2).any():
            return False
        return all((n @ (x, y) - offset).max() >= RADIUS for n, offset in self.polygons)


def rrt_path(found, resolution):
    space = base.RealVectorStateSpace(2)
    limits = base.RealVectorBounds(2)
    limits.setLow(0)
    limits.setHigh(SIZE)
    space.setBounds(limits)
    setup = geometric.SimpleSetup(space)
    setup.setStateValidityChecker(Validity(found))
    if resolution is not None:
        setup.getSpaceInformation().setStateValidityCheckingResolution(resolution)
    start, goal = space.allocState(), space.allocState()
    start[0], start[1] = START
    goal[0], goal[1] = GOAL
    setup.setStartAndGoalStates(start, goal)
    setup.setPlanner(geometric.RRTConnect(setup.getSpaceInformation()))
    setup.solve(5.0)
    if not setup.haveExactSolutionPath():
        return None
    setup.simplifySolution()
    return np.array([[s[0], s[1]] for s in setup.getSolutionPath().getStates()])


def main(seeds):
    times = {name: [] for name in ("viaspline", "RRTConnect", "RRTConnect safe", "corners")}
    close = {"RRTConnect": 0, "RRTConnect safe": 0}
    certified, ratios, gaps, bends = 0, [], [], []
    vs.plan(mission(0))
    for seed in seeds:
        task = mission(seed)
        found = list(task.world.known)
        outlines = inflated(found)
        for _ in range(ROUNDS):
            spent, plan = clock(lambda task=task: viaspline_path(task))
            times["viaspline"].append(spent)
            spent, path = clock(lambda found=found: rrt_path(found, None))
            times["RRTConnect"].append(spent)
            close["RRTConnect"] += path is None or clearance(path, found) < RADIUS - 1e-6
        spent, path = clock(lambda found=found: rrt_path(found, SAFE))
        times["RRTConnect safe"].append(spent)
        close["RRTConnect safe"] += path is None or clearance(path, found) < RADIUS - 1e-6
        spent, corners = clock(lambda outlines=outlines: corner_path(outlines))
        times["corners"].append(spent)
        points = plan.path.evaluate(np.linspace(0, len(plan.path.spans), 200_001))
        certified += plan.certificate.holds
        gaps.append(clearance(points, found) - RADIUS)
        ratios.append(plan.path.length / length(corners))
        bends.append(1 / plan.path.max_curvature()[0])
    report(len(seeds), times, close, certified, ratios, gaps, bends)


def report(count, times, close, certified, ratios, gaps, bends):
    median = {name: 1e3 * float(np.median(values)) for name, values in times.items()}
    print(f"certified: {certified} of {count}")
    print(f"least gap beyond the radius, by shapely: {min(gaps):+.6f} m")
    print(f"length / corner path: worst {max(ratios):.6f}, median {np.median(ratios):.6f}")
    print(f"sharpest turn: radius {min(bends):.2f} m, median {np.median(bends):.2f} m")
    print(f"{'planner':18s} {'median ms':>10s} {'/ viaspline':>12s}  too close")
    for name, value in median.items():
        where = f"{close[name]} of {len(times[name])}" if name in close else "0"
        print(f"{name:18s} {value:10.2f} {value / median['viaspline']:12.1f}  {where}")


if __name__ == "__main__":
    main(range(int(sys.argv[1]) if len(sys.argv) > 1 else 20))
