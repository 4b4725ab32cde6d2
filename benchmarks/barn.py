"""The worlds of BARN, a robot navigation benchmark: cylinders of 7.5 cm, some hundreds in each.

    python benchmarks/barn.py FOLDER

FOLDER has ``cylinders*.csv`` or ``.csv.gz`` (world, x, y: the poses of the cylinders in the world
files) and ``path_files/path_N.npy``, as in https://github.com/Daffan/the-barn-challenge.

The reference paths are rows of cells between y = 5.075 m and 9.425 m, within which the clutter is.
As the challenge itself does, they are made whole by straight lines from the start and to the goal.
That compares ways of which neither is bound to a place in the middle; the stretch alone is compared
by planning from the reference path's first cell to its last.

A robot of 0.15 m gets through every world, larger ones don't: whether they should is told by a
flood over a lattice of 10 mm, and of 2.5 mm where that can't tell.
"""

from __future__ import annotations

import csv
import gzip
import sys
from pathlib import Path

import numpy as np
from oracle import distances_to, inside_bounds, verdict
from scipy.spatial import cKDTree
from timing import clock, in_turn
from worlds import length

import viaspline as vs

START, GOAL, CYLINDER = (-2.25, 3.0), (-2.25, 13.0), 0.075
BOX = (-4.7, -1.0, 0.2, 14.0)
SMALL, LARGE = 0.15, (0.215, 0.3, 0.4)
STEPS = (0.01, 0.0025)
ROUNDS = 3


def worlds(folder: str) -> dict[int, np.ndarray]:
    """The middles of the cylinders of every world, (n, 2)."""
    file = next(Path(folder).glob("cylinders*.csv*"))
    found: dict[int, list] = {}
    with gzip.open(file, "rt") if file.suffix == ".gz" else file.open() as lines:
        for row in csv.DictReader(lines):
            found.setdefault(int(row["world"]), []).append((float(row["x"]), float(row["y"])))
    return {world: np.array(centres) for world, centres in sorted(found.items())}


def reference(folder: str, world: int) -> np.ndarray:
    """The cells of the reference path [m], (n, 2)."""
    cells = np.load(Path(folder) / "path_files" / f"path_{world}.npy")
    return 0.15 * cells + (-4.575, 5.075)


def mission(centres: np.ndarray, radius: float, start=START, goal=GOAL) -> vs.Mission:
    known = [{"circle": {"center": c, "radius": CYLINDER}} for c in centres.tolist()]
    return vs.Mission.model_validate(
        {
            "world": {"bounds": BOX, "known": known},
            "robot": {"radius_m": radius, "clearance_m": 0},
            "route": {"start": start, "goal": goal},
        }
    )


def room(path: vs.Path, centres: np.ndarray) -> float:
    """Least distance between points every millimetre of a path and the cylinders [m]."""
    points = path.evaluate(np.linspace(0, len(path.spans), int(1000 * path.length)))
    return float(cKDTree(centres).query(points)[0].min()) - CYLINDER


def is_there_a_way(centres: np.ndarray, radii: tuple[float, ...]) -> list[tuple[str, float]]:
    """What the flood says for every radius, and on which lattice [m]."""
    discs = [(x, y, CYLINDER) for x, y in centres]
    told = [("unsure", 0.0)] * len(radii)
    for step in STEPS:
        if all(says != "unsure" for says, _ in told):
            break
        gaps = distances_to(discs, max(radii) + 0.1, BOX, step)
        gaps = inside_bounds(gaps, BOX, step)
        told = [
            (verdict(gaps, BOX, step, START, GOAL, radius), step)
            if says == "unsure"
            else (says, at)
            for radius, (says, at) in zip(radii, told, strict=True)
        ]
    return told


def small(folder: str, found: dict[int, np.ndarray]) -> None:
    """Every world with the robot that gets through: length, time, distance kept."""
    spent, whole, stretch, rooms, solved = [], [], [], [], 0
    vs.plan(mission(next(iter(found.values())), SMALL))
    for world, centres in found.items():
        try:
            task = mission(centres, SMALL)
            times, plans = in_turn({"plan": lambda task=task: vs.plan(task)}, ROUNDS)
            cells = reference(folder, world)
            ends = cells[0].tolist(), cells[-1].tolist()
            part = vs.plan(mission(centres, SMALL, *ends))
        except vs.PlanningError as error:
            print(f"world {world}: {error}")
            continue
        plan = plans["plan"]
        solved += plan.certificate.holds and part.certificate.holds
        spent.append(1e3 * times["plan"])
        whole.append(plan.path.length / length(np.vstack((START, cells, GOAL))))
        stretch.append(part.path.length / length(cells))
        rooms.append(room(plan.path, centres))
    print(
        f"radius {SMALL} m: {solved} of {len(found)} certified, least distance {min(rooms):.6f} m"
    )
    print(f"plan: median {np.median(spent):.2f} ms, worst {max(spent):.1f} ms")
    for name, values in (("start to goal", whole), ("the reference's stretch", stretch)):
        print(f"length / reference, {name}: mean {np.mean(values):.4f}, worst {max(values):.4f}")


def large(found: dict[int, np.ndarray]) -> None:
    """Every world with robots that get through some."""
    floods = {world: is_there_a_way(centres, LARGE) for world, centres in found.items()}
    for i, radius in enumerate(LARGE):
        agreed, finer, named, spent = {"open": 0, "closed": 0, "unsure": 0}, 0, 0, []
        for world, centres in found.items():
            told, step = floods[world][i]
            finer += step < STEPS[0]
            task, error = mission(centres, radius), None
            try:
                seconds, plan = clock(lambda task=task: vs.plan(task))
                says = "open" if plan.certificate.holds else "uncertified"
                spent.append(1e3 * seconds)
            except vs.PlanningError as refusal:
                says, error = "closed", refusal
                gaps = np.sort(cKDTree(centres).query(refusal.where, k=2)[0]) - CYLINDER
                named += len(refusal.obstacles) >= 2 and gaps[1] < radius
            if says == told:
                agreed[told] += 1
            else:
                print(f"world {world}: {says}; the flood at {1e3 * step} mm: {told}; {error}")
        print(f"radius {radius} m: {agreed['open']} solved and {agreed['closed']} refused, as the "
              f"flood says, of {len(found)}, {finer} of them told at {1e3 * STEPS[1]} mm only; "
              f"refused for a narrow gap between two cylinders by name: {named}; "
              f"plan: median {np.median(spent):.2f} ms, worst {max(spent):.1f} ms",
              flush=True)  # fmt: skip


if __name__ == "__main__":
    every = worlds(sys.argv[1])
    small(sys.argv[1], every)
    large(every)
