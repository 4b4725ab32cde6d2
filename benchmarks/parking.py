"""Cars in car parks, and carts in warehouses: between random poses, forwards only.

    python benchmarks/parking.py BENCHMR [PAIRS]

BENCHMR is the folder of Bench-MR's scenarios (https://github.com/robot-motion/bench-mr), of which
the worlds and outlines in ``polygon_mazes`` and the turning circle in ``benchmark_template.json``
are taken. Reversing is not asked for: a pair of poses is solved, or refused with the reason. What
is solved is checked by brute force: the outline in poses every 2 cm, with shapely.

Assumed: the car's rear axle is 0.9 m before its rear end, the cart turns about its middle; there is
open ground for 10 m round the drawing.
"""

from __future__ import annotations

import json
import math
import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np
import shapely
from shapely_bodies import bodies_at

import viaspline as vs
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.mission.robot_parts import RobotSpec
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.turning.hybrid_astar.pose_sequence import find_row
from viaspline.planning.turning.hybrid_astar.search_outcome import Chain, Goal, NotFound, Pose

WORLDS = {
    "parking1": ("car", 0.9), "parking2": ("car", 0.9), "parking3": ("car", 0.9),
    "warehouse": ("warehouse_robot", None), "warehouse2": ("warehouse_robot", None),
}  # fmt: skip
MARGIN, CLEARANCE, STEP = 10.0, 0.05, 0.02  # [m]
PAIRS = 20


def outline(file: Path, rear: float | None) -> tuple[tuple[float, float], ...]:
    """An outline about its reference point: so far from its rear end, or its middle [m]."""
    ring = np.array(vs.load_map(file)[0].polygon)
    low, high = ring.min(axis=0), ring.max(axis=0)
    middle = 0.5 * (low + high)
    at = np.array([middle[0] if rear is None else low[0] + rear, middle[1]])
    return tuple(map(tuple, (ring - at).tolist()))


def poses(walls, footprint, box, kept: float, count: int, seed: int) -> list[Pose]:
    """Poses drawn at random in which the body keeps its clearance and a little more."""
    random = np.random.default_rng(seed)
    found: list[Pose] = []
    while len(found) < count:
        pose = Pose(*random.uniform(box[:2], box[2:]).tolist(), random.uniform(-math.pi, math.pi))
        (placed,) = bodies_at(footprint, [(pose.x, pose.y)], [pose.heading])
        if walls.distance(placed) > 1.1 * kept + 0.1:
            found.append(pose)
    return found


def least_gap(walls, footprint, spans) -> float:
    """Of the body on its way to the walls, by brute force [m]."""
    curve = PiecewiseCubic(spans)
    at = np.linspace(*curve.domain, 2 + int(1.5 * curve.length / STEP))
    swept = bodies_at(footprint, curve.evaluate(at), curve.heading(at))
    return float(shapely.distance(walls, swept).min())


def main(folder: str, pairs: str = str(PAIRS)) -> None:
    steer = json.loads((Path(folder) / "benchmark_template.json").read_text())["settings"]["steer"]
    rho, ramp = steer["car_turning_radius"], steer["hc_cc"]["kappa"] / steer["hc_cc"]["sigma"]
    one(vs.World([]), Requirements(radius=1, clearance=0), rho, ramp, Pose(0, 0, 0), Pose(9, 9, 0))
    print(f"turning circle {rho} m, ramps {ramp} m, clearance {CLEARANCE} m; CPU ms\n")
    names = ("pairs", "solved", "median ms", "most ms", "length m", "gap m")
    print(f"{'world':12s}" + "".join(f"{name:>11s}" for name in names) + "  refused")
    for name, (robot, rear) in WORLDS.items():
        mazes = Path(folder) / "polygon_mazes"
        known = vs.load_map(mazes / f"{name}.svg")
        walls = shapely.union_all([shapely.Polygon(o.polygon) for o in known])
        shapely.prepare(walls)
        box = np.array(walls.bounds)
        world = vs.World(known, bounds=(box + MARGIN * np.array((-1, -1, 1, 1))).tolist())
        footprint = outline(mazes / f"{robot}.svg", rear)
        inner = RobotSpec(footprint=footprint).inner_radius
        brief = Requirements(radius=inner, clearance=CLEARANCE, footprint=footprint)
        ends = poses(walls, footprint, box, CLEARANCE, 2 * int(pairs), seed=1)
        run = [
            one(world, brief, rho, ramp, a, b) for a, b in zip(ends[::2], ends[1::2], strict=True)
        ]
        chains = [found for found, _ in run if isinstance(found, Chain)]
        reasons = Counter(found.reason.name for found, _ in run if not isinstance(found, Chain))
        times = np.array([spent for _, spent in run])
        gap = min((least_gap(walls, footprint, chain.spans) for chain in chains), default=math.nan)
        figures = (
            f"{len(run):11d}{len(chains):11d}{np.median(times):11.0f}{times.max():11.0f}"
            f"{sum(chain.length for chain in chains):11.1f}{gap:11.4f}"
        )
        refused = ", ".join(f"{count} {reason}" for reason, count in sorted(reasons.items()))
        print(f"{name:12s}{figures}  {refused}", flush=True)


def one(world, brief, rho, ramp, start: Pose, end: Pose) -> tuple[Chain | NotFound, float]:
    """What is found from one pose to another, and the time [ms]."""
    goal = Goal(end.x, end.y, (end.heading,))
    begin = time.process_time()
    found = find_row(world, brief, rho, ramp, [start], [goal], WorkBudget(math.inf))
    chain = found if isinstance(found, NotFound) else found[0]
    return chain, 1e3 * (time.process_time() - begin)


if __name__ == "__main__":
    main(*sys.argv[1:])
