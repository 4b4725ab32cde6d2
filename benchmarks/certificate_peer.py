"""The certificate among moving discs beside commonroad-drivability-checker, in one run.

    python benchmarks/certificate_peer.py FOLDER

FOLDER has DynaBARN's worlds. A robot drives straight from the start to the goal of each; the peer
looks at it every 50 ms and says whether it touches anything, the certificate proves how far it
stays from everything. ``pip install --no-deps commonroad-drivability-checker`` brings the peer.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path as FilePath
from typing import Any

import numpy as np
from commonroad_dc import pycrcc
from yielding import LIMITS, RADIUS_M, world

from viaspline.kernels.arrays import Floats
from viaspline.trajectory.moving_certificate import certify_moving
from viaspline.trajectory.retime import retime
from viaspline.world.moving_obstacles import MovingObstacles

STEP_S = 0.05
RUNS = 15


def median_us(work: Callable[[], object]) -> float:
    """The median of the processor's time [µs]."""
    work()
    found = []
    for _ in range(RUNS):
        begin = time.process_time()
        work()
        found.append(1e6 * (time.process_time() - begin))
    return statistics.median(found)


def collides(checker: Any, robot: Floats) -> bool:
    """Whether a disc touches anything at any of the instants at which it is at (n, 2) [m]."""
    driven = pycrcc.TimeVariantCollisionObject(0)
    for x, y in robot.tolist():
        driven.append_obstacle(pycrcc.Circle(RADIUS_M, x, y))
    return bool(checker.collide(driven))


def checker_of(moving: MovingObstacles, times: Floats) -> Any:
    """The peer's checker with all discs at all instants [s]."""
    checker = pycrcc.CollisionChecker()
    frames = np.stack([moving.frames(time) for time in times.tolist()])
    for i, obstacle in enumerate(moving.obstacles):
        assert obstacle.ring is not None
        moved = pycrcc.TimeVariantCollisionObject(0)
        for x, y, _ in frames[:, i].tolist():
            moved.append_obstacle(pycrcc.Circle(obstacle.ring.radius, x, y))
        checker.add_collision_object(moved)
    return checker


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=FilePath)
    ours, theirs, apart = [], [], 0
    for file in sorted(parser.parse_args().folder.glob("world_*.json")):
        path, moving = world(file)
        law = retime(path, LIMITS)
        times = np.arange(law.start_time, law.end_time, STEP_S)
        check = partial(
            collides, checker_of(moving, times), path.at_distance(law.distance_at(times))
        )
        prove = partial(certify_moving, path, law, moving, 0.0, radius=RADIUS_M)
        theirs.append(median_us(check))
        ours.append(median_us(prove))
        apart += check() != (prove().clearance < 0.0)
    print(f"certificate {statistics.median(ours):.0f} µs, peer {statistics.median(theirs):.0f} µs")
    ratio = statistics.median(t / o for t, o in zip(theirs, ours, strict=True))
    print(f"{ratio:.1f} times as fast in the median; they say otherwise in {apart} worlds")


if __name__ == "__main__":
    main()
