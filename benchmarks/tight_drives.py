"""Driven robots in tight random worlds that only their lidar shows: how far beside their paths.

    python benchmarks/tight_drives.py [--first SEED] [--worlds N] [--noise]

Discs and thin walls at random in a field of 14 m by 8 m between start and goal, a lidar of 120° and
4 m, 0.1 m of clearance. Counted is the time in which the body is farther beside its path than is
kept for that, and contacts. With ``--noise`` lidar, localisation, speed and yaw rate are off.
"""

from __future__ import annotations

import argparse
import math
import sys

import numpy as np
import shapely

import viaspline as vs

START, GOAL = (0.0, 0.0), (16.0, 0.0)
THINGS, ROOM_M = 28, 1.0  # drawn at random; those nearer to start or goal are left out
LATE = {"delay_s": 0.1, "lag_s": 0.1}
WHEELS = {"differential": {"track_m": 0.4, "max_wheel_speed_mps": 2}, **LATE}
BOX = [[-0.35, -0.25], [0.35, -0.25], [0.35, 0.25], [-0.35, 0.25]]
ROBOTS: dict[str, dict] = {
    "differential": {"radius_m": 0.3, "drive": WHEELS},
    "differential, a box": {"footprint": BOX, "drive": WHEELS},
    "steered": {
        "radius_m": 0.3, "drive": {"ackermann": {"wheelbase_m": 0.4, "max_steer_deg": 40}, **LATE},
    },
}  # fmt: skip
DRIVE_NOISE = {"speed_noise_mps": 0.05, "yaw_rate_noise_degps": 2.0}
PLACE_NOISE = {"position_noise_m": 0.01, "heading_noise_deg": 0.5}
LIDAR_NOISE_M = 0.01


def things(seed: int) -> list[dict]:
    """Discs and walls with room at the start and the goal."""
    random = np.random.default_rng((77, seed))
    found = []
    for _ in range(THINGS):
        at, radius = random.uniform([1.5, -4], [14, 4]), float(random.uniform(0.05, 0.4))
        angle, half = random.uniform(0, math.pi), random.uniform(0.5, 1.5)
        along = half * np.array([math.cos(angle), math.sin(angle)])
        is_wall = random.random() < 0.4
        ends, radius = ((at - along, at + along), 0.1) if is_wall else ((at, at), radius)
        ends_given = {"from": ends[0].tolist(), "to": ends[1].tolist()}
        shape = {"capsule": ends_given} if is_wall else {"circle": {"center": at.tolist()}}
        next(iter(shape.values()))["radius"] = radius
        gap = min(shapely.LineString(ends).distance(shapely.Point(p)) for p in (START, GOAL))
        if gap > radius + ROOM_M:
            found.append(shape)
    return found


def mission(seed: int, robot: str, *, noise: bool) -> vs.Mission:
    """One world with one robot."""
    body = dict(ROBOTS[robot])
    lidar = {"range_m": 4, "fov_deg": 120}
    if noise:
        body |= {"drive": body["drive"] | DRIVE_NOISE, "localization": PLACE_NOISE}
        lidar["noise_m"] = LIDAR_NOISE_M
    return vs.Mission.model_validate({
        "world": {"unseen": things(seed), "bounds": [-2, -6, 18, 6]},
        "robot": {"clearance_m": 0.1, "max_speed_mps": 1.5, "max_accel_mps2": 1.0,
                  "sensor": {"lidar": lidar}, **body},
        "route": {"start": {"at": START, "heading_deg": 0}, "goal": GOAL},
    })  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--worlds", type=int, default=40)
    parser.add_argument("--noise", action="store_true")
    asked = parser.parse_args()
    rows: dict[str, list[tuple[bool, bool, float, float]]] = {name: [] for name in ROBOTS}
    for seed in range(asked.first, asked.first + asked.worlds):
        name = list(ROBOTS)[seed % len(ROBOTS)]
        run = vs.simulate(mission(seed, name, noise=asked.noise), seed=seed)
        beyond = sum(one.until - one.since for one in run.excesses)
        touched = any(event.kind == "contact" for event in run.events)
        rows[name].append((run.reached, touched, beyond, run.duration))
        word = f"{'touched, ' if touched else ''}{run.reason or 'reached'}"
        print(f"{seed}: {name}, {beyond:.2f} of {run.duration:.0f} s beyond, {word}",
              file=sys.stderr)  # fmt: skip
    print("| robot | drives | reached | contacts | driven | beyond what is kept |\n|" + "---|" * 6)
    for name, drives in {**rows, "all": [row for each in rows.values() for row in each]}.items():
        reached, touched, beyond, driven = np.array(drives or np.zeros((1, 4))).sum(axis=0)
        print(f"| {name} | {len(drives)} | {reached:.0f} | {touched:.0f} | {driven:.0f} s | "
              f"{100 * beyond / max(driven, 1e-9):.3f} % |")  # fmt: skip


if __name__ == "__main__":
    main()
