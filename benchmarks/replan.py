"""A new path when an unseen obstacle appears among 100 known ones, beside OMPL's safe RRTConnect.

    pip install ".[bench]" && python benchmarks/replan.py [CASES]

Timed is all that the navigator does: take the obstacle into the world, find what is blocked, lay
and prove the new path, and time it.
"""

from __future__ import annotations

import sys
import time

import numpy as np
import shapely
from plan import SAFE, rrt_path
from worlds import GOAL, RADIUS, START

import viaspline as vs
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.replanning.replan import planned, reflex

AHEAD = 20.0  # how far ahead of the obstacle the robot is when it sees it [m]


def scene(seed: int) -> vs.Mission:
    """100 discs that leave room between them."""
    random = np.random.default_rng(seed)
    rows: list[tuple[float, float, float]] = []
    while len(rows) < 100:
        x, y = random.uniform(30, 470, 2)
        radius = random.uniform(4, 14)
        if all(np.hypot(x - a, y - b) > radius + r + 8 for a, b, r in rows):
            rows.append((x, y, radius))
    return vs.Mission.model_validate(
        {
            "world": {
                "bounds": [0, 0, 500, 500],
                "known": [{"circle": {"center": [x, y], "radius": r}} for x, y, r in rows],
            },
            "robot": {"radius_m": RADIUS, "clearance_m": 0},
            "route": {"start": START, "goal": GOAL},
        }
    )


def surprise(plan: vs.Plan, random: np.random.Generator) -> tuple[vs.Obstacle, float] | None:
    """A disc on the path with room on both sides, and the distance where the robot sees it."""
    at = random.uniform(60, plan.path.length - 60)
    centre = np.asarray(plan.path.at_distance(at))
    radius = min(6.0, float(plan.world.distance(centre)) - 2.0)
    if radius < 1.0:
        return None
    obstacle = vs.Obstacle(circle={"center": centre.tolist(), "radius": radius})
    return obstacle, at - radius - RADIUS - AHEAD


def replan(plan: vs.Plan, obstacle: vs.Obstacle, at: float) -> vs.Path:
    world = plan.world.with_obstacles([obstacle])
    brief = Requirements.of(plan.mission)
    try:
        found = reflex(plan.path, at, world, brief)
    except vs.PlanningError:
        found = planned(plan.path, at, world, brief)
    vs.retime(found.path, vs.Limits.of(plan.mission.robot), start=at, start_speed=1.0)
    return found.path


def main(cases: int) -> None:
    random = np.random.default_rng(1)
    spent, peer, gaps, refused = [], [], [], 0
    seed = 0
    while len(spent) < cases:
        seed += 1
        plan = vs.plan(scene(seed))
        for _ in range(20):
            case = surprise(plan, random)
            if case is None:
                continue
            begin = time.perf_counter()
            try:
                path = replan(plan, *case)
            except vs.PlanningError:
                refused += 1
                continue
            finally:
                taken = time.perf_counter() - begin
            spent.append(taken)
            ahead = path.section(float(path.parameter(case[1])), path.domain[1])
            track = shapely.LineString(ahead.sample(0.05)[2])
            discs = [*plan.world.obstacles, case[0]]
            gaps.append(min(
                track.distance(shapely.Point(o.circle.center)) - o.circle.radius for o in discs
            ) - RADIUS)  # fmt: skip
        begin = time.perf_counter()
        rrt_path([*plan.world.obstacles, case[0]] if case else list(plan.world.obstacles), SAFE)
        peer.append(time.perf_counter() - begin)
    first = spent.pop(0)  # it may have compiled kernels
    milliseconds = 1e3 * np.array(spent)
    safe = 1e3 * float(np.median(peer))
    median = float(np.median(milliseconds))
    print(f"{len(spent)} re-plans, {refused} refused with a reason; the first took {first:.2f} s")
    print(f"least gap beyond the radius, by shapely: {min(gaps):+.4f} m")
    print(f"median {median:.2f} ms, 99th percentile {np.percentile(milliseconds, 99):.2f} ms")
    print(f"RRTConnect safe: {safe:.0f} ms, {safe / median:.0f} times as long")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 300)
