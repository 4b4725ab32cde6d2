"""Tours of places drawn at random on maps of buildings and car parks, with a picture of each.

    python benchmarks/maps.py OUT RADIUS,CLEARANCE MAP[+MASK] ...

MAP is what ``map:`` in a mission takes (map_server's YAML, SVG, ...), MASK another that is laid
over it; ``R,C`` holds for the maps after it [m]. Maps are published with Nav2
(https://github.com/ros-navigation/navigation2), TurtleBot3, AWS's small warehouse world and
Bench-MR (https://github.com/robot-motion/bench-mr).
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from scipy.ndimage import label
from timing import in_turn

import viaspline as vs
from viaspline.report.plan_picture import plan_picture

PLACES, ROUNDS, SAMPLES = 12, 3, 600  # start, ten via points, goal
SPARE = 0.1  # room beyond what is required at a via point, as a share of it


def box_of(known) -> list[float]:
    """What the obstacles cover [m]; of areas, with a margin."""
    grids = [o.grid.extent for o in known if o.grid is not None]
    if grids:
        return list(grids[0])
    rings = np.vstack([np.array(o.polygon) for o in known])
    margin = 0.02 * float(np.ptp(rings, axis=0).max())
    return [*(rings.min(axis=0) - margin).tolist(), *(rings.max(axis=0) + margin).tolist()]


def places(world: vs.World, box, required: float, seed: int) -> np.ndarray:
    """Places that are joined, drawn at random and visited nearest first, (n, 2)."""
    random = np.random.default_rng(seed)
    step = min(required / 2, max(box[2] - box[0], box[3] - box[1]) / SAMPLES)
    x, y = (np.arange(box[i] + step / 2, box[i + 2], step) for i in (0, 1))
    points = np.stack(np.meshgrid(x, y), axis=-1)
    free = world.distance(points) > (1.0 + SPARE) * required
    areas, _ = label(free)
    largest = np.argmax(np.bincount(areas[free]))
    left = list(random.permutation(points[areas == largest])[:PLACES])
    tour = [left.pop(0)]
    while left:
        nearest = int(np.argmin([np.hypot(*(p - tour[-1])) for p in left]))
        tour.append(left.pop(nearest))
    return np.array(tour)


def tour(file: str, radius: float, clearance: float, seed: int = 0) -> vs.Mission:
    known = [obstacle for part in file.split("+") for obstacle in vs.load_map(part)]
    box = box_of(known)
    world = vs.World(known, bounds=box)
    start, *via, goal = places(world, box, radius + clearance, seed).round(3).tolist()
    return vs.Mission.model_validate(
        {
            "world": {"bounds": box, "known": known},
            "robot": {"radius_m": radius, "clearance_m": clearance},
            "route": {"start": start, "via": via, "goal": goal},
        }
    )


def main(out: str, *arguments: str) -> None:
    Path(out).mkdir(parents=True, exist_ok=True)
    radius = clearance = 0.0
    names = ("required m", "places", "length m", "proven m", "ms")
    print(f"{'map':26s} " + " ".join(f"{name:>10s}" for name in names))
    for argument in arguments:
        if not Path(argument.split("+")[0]).exists():
            radius, clearance = map(float, argument.split(","))
            continue
        file = Path(argument.split("+")[0])
        name = f"{file.parent.name}-{file.stem}"
        task = tour(argument, radius, clearance)
        try:
            vs.plan(task)
        except vs.PlanningError as error:
            print(f"{name}: {error}")
            continue
        times, plans = in_turn({"plan": lambda task=task: vs.plan(task)}, ROUNDS)
        plan = plans["plan"]
        (Path(out) / f"{name}.png").write_bytes(plan_picture(plan, name))
        proven = radius + plan.certificate.clearance if plan.certificate.holds else np.nan
        figures = f"{radius + clearance:10.2f} {PLACES:10d} {plan.path.length:10.1f}"
        print(f"{name:26s} {figures} {proven:10.4f} {1e3 * times['plan']:10.1f}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
