"""BARN's worlds, unseen: a robot with a lidar and no map among 181 to 365 posts.

    python benchmarks/barn_unseen.py FOLDER [--worlds N] [--noise M] [--seed S]

FOLDER holds BARN's files (github.com/Daffan/the-barn-challenge, MIT) somewhere below it: the worlds
as ``world_N.world``, plain or compressed by xz, or as one ``cylinders*.csv.gz`` with the columns
world, x, y; and its paths as ``path_N.npy``.

The robot has a radius of 0.15 m, 2 m/s and 2 m/s², and sees 5 m far, 270 degrees wide, by 720
beams. It is to reach the goal without a contact; that is proven on the curve that was driven. The
score is BARN's: 1 / clip(actual, 4, 8) in multiples of the optimal time, which is the length of
BARN's own path over 2 m/s; later challenges clip at 2 in place of 4. It is 0 after a contact.
Re-plans are timed by what the processor spends on them, so that the machine's load doesn't count.
"""

from __future__ import annotations

import argparse
import csv
import gzip
import lzma
import re
import time
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import numpy as np

import viaspline as vs
from viaspline.robot import navigator_step

Post = tuple[float, float, float]
START, GOAL, SPEED, RADIUS = (-2.25, 3.0), (-2.25, 13.0), 2.0, 0.075
POST = re.compile(
    r"<model name='unit_cylinder_\d+'>.*?<pose[^>]*>(\S+) (\S+) .*?<radius>(\S+)</radius>", re.S
)


def worlds(folder: Path) -> Iterator[tuple[int, list[Post], float]]:
    """Number, posts and length of BARN's own path [m] of each world."""
    paths = {number_of(file): file for file in folder.rglob("path_*.npy")}
    found = posts_of_table(folder) or posts_of_files(folder)
    for number in sorted(found.keys() & paths.keys()):
        cells = np.load(paths[number])
        middle = np.column_stack((0.15 * cells[:, 0] - 4.575, 0.15 * cells[:, 1] + 5.075))
        way = np.vstack((START, middle, GOAL))
        yield number, found[number], float(np.linalg.norm(np.diff(way, axis=0), axis=1).sum())


def number_of(file: Path) -> int:
    return int(re.findall(r"\d+", file.name)[0])


def posts_of_table(folder: Path) -> dict[int, list[Post]]:
    found: dict[int, list[Post]] = defaultdict(list)
    for table in folder.rglob("cylinders*.csv.gz"):
        with gzip.open(table, "rt") as file:
            for row in csv.DictReader(file):
                found[int(row["world"])].append((float(row["x"]), float(row["y"]), RADIUS))
    return found


def posts_of_files(folder: Path) -> dict[int, list[Post]]:
    found = {}
    for world in folder.rglob("world_*.world*"):
        with (lzma.open if world.suffix == ".xz" else open)(world, "rt") as file:
            models = file.read().partition("<state ")[0]  # they come again in there
        found[number_of(world)] = [
            (float(x), float(y), float(r)) for x, y, r in POST.findall(models)
        ]
    return found


def mission(posts: list[Post], noise: float) -> vs.Mission:
    lidar = {"range_m": 5, "fov_deg": 270, "beams": 720, "noise_m": noise}
    return vs.Mission.model_validate(
        {
            "world": {"unseen": [{"circle": {"center": p[:2], "radius": p[2]}} for p in posts]},
            "robot": {
                "radius_m": 0.15, "clearance_m": 0, "max_speed_mps": SPEED, "max_accel_mps2": 2,
                "sensor": {"lidar": lidar},
            },
            "route": {"start": {"at": START, "heading_deg": 90}, "goal": GOAL},
        }
    )  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--worlds", type=int, default=1000, help="at most so many")
    parser.add_argument("--noise", type=float, default=0.0, help="of a measured distance [m]")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    navigator_step.clock = SimpleNamespace(perf_counter=time.thread_time)
    runs, spent, scores, late = 0, [], [], []
    reached = contacts = 0
    nearest = np.inf
    todo = list(worlds(options.folder))[: options.worlds]
    vs.simulate(mission(todo[0][1], options.noise))  # compiles
    for number, posts, length in todo:
        run = vs.simulate(mission(posts, options.noise), seed=options.seed)
        touched = run.certificate.clearance < 0
        ratio = run.duration / (length / SPEED)
        good = run.reached and not touched
        runs, reached, contacts = runs + 1, reached + good, contacts + touched
        nearest = min(nearest, run.certificate.clearance)
        spent += run.compute_times
        late.append(ratio)
        scores.append([good / np.clip(ratio, low, 8) for low in (4, 2)])
        modes = " ".join(replan.mode for replan in run.replans)
        print(f"world {number}: {run.duration:.1f} s, {ratio:.2f} optimal times, clear by "
              f"{1e3 * run.certificate.clearance:.0f} mm {run.reason or ''} ({modes})",
              flush=True)  # fmt: skip
    print(f"{reached} of {runs} reached the goal, {contacts} touched something, "
          f"the nearest kept {1e3 * nearest:.1f} mm")  # fmt: skip
    print(f"time to goal: {np.median(late):.2f} optimal times, worst {max(late):.2f}")
    at_4, at_2 = np.mean(scores, axis=0)
    print(f"score: {at_4:.4f} of 0.25 (clipped at 4), {at_2:.4f} of 0.5 (clipped at 2)")
    times = 1e3 * np.percentile(spent or [0.0], (50, 90, 99, 100))
    print(f"{len(spent)} re-plans: median {times[0]:.1f} ms, 90 % {times[1]:.1f} ms, "
          f"99 % {times[2]:.1f} ms, longest {times[3]:.0f} ms")  # fmt: skip


if __name__ == "__main__":
    main()
