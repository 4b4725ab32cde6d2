"""Vector worlds of ever more obstacles: is every way found, how soon, how long is it.

    pip install ".[bench]" && python benchmarks/clutter.py [SEEDS] [SECONDS]

Whether there is a way is told by a flood over samples of the distance, how long it has to be by
extremitypathfinder's shortest corner path. That is given the obstacles only that a shorter path
than ours could meet, those in the ellipse of all points from which start and goal are together no
farther than ours is long, and SECONDS a world (120; 0: left out).
"""

from __future__ import annotations

import math
import sys
from multiprocessing import get_context

import numpy as np
import shapely
from extremitypathfinder import PolygonEnvironment
from oracle import distances_to, inside_bounds, verdict
from shapely.geometry import Polygon
from timing import in_turn
from worlds import GOAL, RADIUS, SIZE, START, crossing, dense, inflated, length, obstacles

import viaspline as vs

ROBOTS = {20: RADIUS, 100: 2.0, 300: 2.0, 1000: 1.0}  # for which worlds are made [m]
ROWS = (*ROBOTS.items(), (300, 5.0), (1000, 2.5))  # the last two get through few worlds
BOX, STEPS = (0.0, 0.0, SIZE, SIZE), (0.25, 0.1)
ROUNDS = 5


def world(seed: int, count: int) -> list[vs.Obstacle]:
    return obstacles(seed) if count == 20 else dense(seed, count, ROBOTS[count])


def is_there_a_way(found: list[vs.Obstacle], radius: float) -> str:
    shapes = [
        (*o.circle.center, o.circle.radius) if o.circle else np.array(o.polygon) for o in found
    ]
    for step in STEPS:
        gaps = inside_bounds(distances_to(shapes, radius + 1.0, BOX, step), BOX, step)
        told = verdict(gaps, BOX, step, START, GOAL, radius)
        if told != "unsure":
            break
    return told


def room(path: vs.Path, found: list[vs.Obstacle]) -> float:
    """Least distance between points every centimetre or so of a path and the obstacles [m]."""
    points = path.evaluate(np.linspace(0, len(path.spans), int(100 * path.length)))
    discs = np.array([(*o.circle.center, o.circle.radius) for o in found if o.circle])
    tree = shapely.STRtree([Polygon(o.polygon) for o in found if o.polygon])
    _, gaps = tree.query_nearest(shapely.points(points), return_distance=True, all_matches=False)
    to_discs = min((np.hypot(*(points - (x, y)).T) - r).min() for x, y, r in discs)
    return min(float(gaps.min()), to_discs)


def in_reach(outlines: list[np.ndarray], longest: float) -> list[np.ndarray]:
    """Outlines that a path of such a length can meet; those that overlap as one."""
    middle, (dx, dy) = np.add(START, GOAL) / 2, np.subtract(GOAL, START)
    apart = math.hypot(dx, dy)
    turns = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    half = np.c_[longest * np.cos(turns), math.sqrt(longest**2 - apart**2) * np.sin(turns)] / 2
    turn = np.array(((dx, dy), (-dy, dx))) / apart
    ellipse = Polygon(middle + 1.0001 * half @ turn)
    near = [shape for shape in map(Polygon, outlines) if ellipse.intersects(shape)]
    met = shapely.union_all(near)
    return [np.array(part.exterior.coords)[:-1] for part in getattr(met, "geoms", [met])]


def corner_path(outlines: list[np.ndarray], answer) -> None:
    holes = [ring[::-1] if Polygon(ring).exterior.is_ccw else ring for ring in outlines]
    low = np.min([ring.min(axis=0) for ring in outlines], axis=0).min() - 1
    high = np.max([ring.max(axis=0) for ring in outlines], axis=0).max() + 1
    low, high = min(low, 0.0), max(high, SIZE)
    environment = PolygonEnvironment()
    frame = np.array([(low, low), (high, low), (high, high), (low, high)])
    environment.store(frame, holes, validate=False)
    answer.send(length(np.array(environment.find_shortest_path(START, GOAL)[0])))


def shortest(outlines: list[np.ndarray], seconds: float) -> float | None:
    """Length of the corner path [m], None if it takes longer."""
    context = get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=corner_path, args=(outlines, sender), daemon=True)
    process.start()
    sender.close()
    try:
        return receiver.recv() if receiver.poll(seconds) else None
    except EOFError:
        return None
    finally:
        process.terminate()
        process.join()


class Row:
    """What became of all worlds with so many obstacles."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.told: list[str] = []
        self.spent: list[float] = []
        self.ratios: list[float] = []
        self.bends: list[float] = []
        self.rooms: list[float] = []
        self.solved = self.refused = 0

    def plan(self, seed: int, count: int, radius: float, patience: float) -> bool:
        """Plan a world; False where the length of the corner path took too long to find."""
        found = world(seed, count)
        task = crossing(found, radius)
        self.told.append(is_there_a_way(found, radius))
        try:
            vs.plan(task)
        except vs.PlanningError as error:
            self.refused += 1
            if self.told[-1] != "closed":
                print(f"{self.name}, seed {seed}, {self.told[-1]}: {error}")
            return True
        times, plans = in_turn({"plan": lambda: vs.plan(task)}, ROUNDS)
        plan = plans["plan"]
        self.spent.append(1e3 * times["plan"])
        self.solved += plan.certificate.holds
        self.rooms.append(room(plan.path, found) - radius)
        self.bends.append(1 / plan.path.max_curvature()[0])
        if not patience:
            return False
        near = in_reach(inflated(found, radius=radius), plan.path.length)
        least = shortest(near, patience)
        if least is not None:
            self.ratios.append(plan.path.length / least)
        return least is not None

    def __str__(self) -> str:
        told = " ".join(f"{self.told.count(one):6d}" for one in ("open", "closed", "unsure"))
        median, worst = (f(self.ratios) if self.ratios else np.nan for f in (np.median, max))
        return (
            f"{self.name:18s} {told} {self.solved:6d} {self.refused:7d} "
            f"{np.median(self.spent):8.1f} {max(self.spent):7.1f} {median:9.6f} {worst:9.6f} "
            f"{len(self.ratios):3d} {min(self.bends):9.2f} {min(self.rooms):+10.6f}"
        )


def main(seeds: int, seconds: float) -> None:
    print(f"{'obstacles, radius':18s} {'open':>6s} {'closed':>6s} {'unsure':>6s} {'solved':>6s} "
          f"{'refused':>7s} {'ms':>8s} {'worst':>7s} {'length':>9s} {'worst':>9s} {'of':>3s} "
          f"{'sharpest':>9s} {'room':>10s}")  # fmt: skip
    for count, radius in ROWS:
        row, patience = Row(f"{count}, {radius:g} m"), seconds
        for seed in range(seeds):
            if not row.plan(seed, count, radius, patience):
                patience = 0.0  # it won't do better on the next
        print(row, flush=True)


if __name__ == "__main__":
    main(
        int(sys.argv[1]) if len(sys.argv) > 1 else 20,
        float(sys.argv[2]) if len(sys.argv) > 2 else 120.0,
    )
