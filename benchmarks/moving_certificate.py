"""The certificate among moving obstacles against samples every half millisecond, by numpy alone.

    python benchmarks/moving_certificate.py FIRST LAST

For each number from FIRST to LAST a random spline is driven by its fastest law past discs and
turning polygons. What is proven may nowhere be above what is sampled, and is within a millimetre of
it but for what lies between samples.
"""

from __future__ import annotations

import argparse
import time

import numpy as np

from viaspline.curve.cardinal import CardinalSpline
from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.moving_certificate import certify_moving
from viaspline.trajectory.retime import retime
from viaspline.world.moving_obstacles import MovingObstacles

SAMPLE_S = 5e-4
GAP_M = 1e-3  # how far below the truth a certificate may be
RADIUS_M = 0.25


def corners_of(rng: np.random.Generator) -> Floats:
    """A convex polygon round the origin of its frame [m], (5, 2)."""
    angle = np.sort(rng.uniform(0.0, 2.0 * np.pi, 5))
    return np.column_stack((np.cos(angle), np.sin(angle))) * rng.uniform(0.3, 1.2)


def to_polygon(corners: Floats, points: Floats) -> Floats:
    """Distance of points (n, 2) from the outline of a polygon [m]."""
    found = np.full(len(points), np.inf)
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        edge = b - a
        share = np.clip((points - a) @ edge / max(float(edge @ edge), 1e-12), 0.0, 1.0)
        found = np.minimum(found, np.hypot(*(points - a - share[:, None] * edge).T))
    return found


def case(number: int) -> tuple[float, float, float]:
    """What is proven, what is sampled [m], and the time of proving it [s]."""
    rng = np.random.default_rng(number)
    path = CardinalSpline(np.cumsum(rng.uniform(-4.0, 6.0, (5, 2)), axis=0))
    law = retime(path, Limits(max_speed=2.0, max_accel=1.0, max_lateral_accel=1.0))
    times = np.append(np.arange(law.start_time, law.end_time, SAMPLE_S), law.end_time)
    robot = path.at_distance(np.minimum(law.distance_at(times), path.length))
    obstacles, sampled = [], np.inf
    for k in range(6):
        near = robot[rng.integers(len(robot))]
        frames = np.column_stack(
            (
                np.linspace(0.0, law.end_time, 4),
                near + rng.uniform(-5.0, 5.0, (4, 2)),
                np.cumsum(rng.uniform(-90.0, 90.0, 4)),
            )
        )
        x, y, heading = (np.interp(times, frames[:, 0], frames[:, j]) for j in (1, 2, 3))
        motion = {"keyframes": frames.tolist(), "after": "stay"}
        dx, dy = robot[:, 0] - x, robot[:, 1] - y
        if k < 4:
            radius = float(rng.uniform(0.2, 0.8))
            obstacles.append(Obstacle(circle={"center": (0, 0), "radius": radius}, motion=motion))
            sampled = min(sampled, float(np.hypot(dx, dy).min()) - radius)
            continue
        corners = corners_of(rng)
        obstacles.append(Obstacle(polygon=corners.tolist(), motion=motion))
        c, s = np.cos(np.radians(heading)), np.sin(np.radians(heading))
        inside = np.column_stack((c * dx + s * dy, c * dy - s * dx))
        sampled = min(sampled, float(to_polygon(corners, inside).min()))
    moving = MovingObstacles(obstacles)
    _ = moving.packed
    began = time.process_time()
    proven = certify_moving(path, law, moving, 0.0, radius=RADIUS_M).clearance
    return proven, sampled - RADIUS_M, time.process_time() - began


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    asked = parser.parse_args()
    above, far, spent = 0, 0, []
    for number in range(asked.first, asked.last + 1):
        proven, sampled, took = case(number)
        spent.append(took)
        above += proven > sampled + 1e-9
        far += sampled > 0.0 and proven < sampled - GAP_M - 4.0 * SAMPLE_S
    print(
        f"{len(spent)} cases: {above} proven above what is sampled, {far} more than a millimetre "
        f"below; {1e6 * np.median(spent):.0f} µs in the median"
    )


if __name__ == "__main__":
    main()
