"""The time law among things that move: how long it takes to find, and how good it is.

python benchmarks/yielding.py worlds FOLDER    # worlds of moving discs, straight from start to goal
python benchmarks/yielding.py long             # 300 m among 200 discs with 4,000 pieces of motion
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from collections.abc import Callable
from pathlib import Path as FilePath

import numpy as np

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.method import Found, Outcome
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.retime import retime
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.law_among import law_among
from viaspline.world.moving_obstacles import MovingObstacles

LIMITS = Limits(max_speed=2.0, max_accel=1.0)
RADIUS_M = 0.25
SAMPLE_S = 0.0005


def world(file: FilePath) -> tuple[Path, MovingObstacles]:
    """The straight path through a world, and what moves in it."""
    data = json.loads(file.read_text())
    start, goal = np.array(data["start"], float), np.array(data["goal"], float)
    span = start + np.linspace(0.0, 1.0, 4)[:, None] * (goal - start)
    obstacles = [
        Obstacle(
            name=one["name"],
            circle={"center": (0, 0), "radius": one["radius_m"]},
            motion={"keyframes": one["keyframes_t_x_y"], "after": "loop"},
        )
        for one in data["obstacles"]
    ]
    return Path([span], vias=[]), MovingObstacles(obstacles)


def long_drive(seed: int = 1) -> tuple[CardinalSpline, MovingObstacles]:
    """A winding path of 300 m, and 200 discs that go to and fro across it with 20 pieces each."""
    rng = np.random.default_rng(seed)
    x = np.linspace(0.0, 280.0, 15)
    path = CardinalSpline(np.stack((x, 12.0 * np.sin(x / 20.0)), 1))
    obstacles = []
    for _ in range(200):
        middle = path.at_distance(rng.uniform(10.0, path.length - 10.0))
        places = middle + rng.uniform(-12.0, 12.0, (21, 2))
        speed = rng.uniform(0.4, 1.2)
        steps = np.hypot(*np.diff(places, axis=0).T) / speed
        times = np.concatenate(([0.0], np.cumsum(np.maximum(steps, 0.5))))
        obstacles.append(
            Obstacle(
                circle={"center": (0, 0), "radius": 0.4},
                motion={
                    "keyframes": np.column_stack((times, places)).tolist(), "after": "bounce",
                },
            )
        )  # fmt: skip
    return path, MovingObstacles(obstacles)


def spent_ms(work: Callable[[], object], runs: int) -> float:
    """The median of the processor's time [ms]."""
    found = []
    for _ in range(runs):
        begin = time.process_time()
        work()
        found.append(1e3 * (time.process_time() - begin))
    return statistics.median(found)


def nearest(law: Trajectory, path: Path | CardinalSpline, moving: MovingObstacles) -> float:
    """The smallest distance of the robot's centre from a shape at samples in time [m]."""
    times = np.arange(law.start_time, law.end_time, SAMPLE_S)
    places = path.at_distance(np.minimum(law.distance_at(times), path.length))
    return float(moving.distance(places, times).min())


def row(
    name: str, path: Path | CardinalSpline, moving: MovingObstacles, runs: int
) -> tuple[Outcome[Trajectory], float]:
    """Print what a law takes, and hand it out with the time of finding it [ms]."""

    def work() -> Outcome[Trajectory]:
        return law_among(path, LIMITS, moving=moving, required=RADIUS_M)

    found = work()
    ms = spent_ms(work, runs)
    if isinstance(found, Found):
        law = found.value
        print(
            f"{name:10} {len(moving):4} {ms:8.2f} ms {retime(path, LIMITS).duration:7.2f} s -> "
            f"{law.duration:7.2f} s {len(law.times):3} points, {nearest(law, path, moving):.4f} m"
        )
    else:
        print(f"{name:10} {len(moving):4} {ms:8.2f} ms {found}")
    return found, ms


def main() -> None:
    """Print a line for each world, and the middle of all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=("worlds", "long"))
    parser.add_argument("folder", nargs="?", type=FilePath)
    parser.add_argument("--runs", type=int, default=9)
    args = parser.parse_args()
    if args.what == "long":
        row("long", *long_drive(), args.runs)
        return
    files = sorted(args.folder.glob("world_*.json"), key=lambda file: int(file.stem[6:]))
    rows = [row(file.stem, *world(file), args.runs) for file in files]
    laws = [found.value for found, _ in rows if isinstance(found, Found)]
    times = [ms for _, ms in rows]
    mean = statistics.mean(law.duration for law in laws)
    print(f"{len(laws)} of {len(files)}, mean {mean:.2f} s")
    print(f"time: median {statistics.median(times):.2f} ms, worst {max(times):.2f} ms")


if __name__ == "__main__":
    main()
