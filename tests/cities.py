"""Cities at random, which a body that is an upright cylinder flies through."""

from __future__ import annotations

import numpy as np

RADIUS, HALF, CLEARANCE = 0.5, 0.25, 1.0


def city(seed: int) -> dict[str, object]:
    """Boxes and balls, a start and a goal that are clear of them."""
    rng = np.random.default_rng(seed)
    known: list[dict[str, object]] = []
    for _ in range(int(rng.integers(1, 9))):
        x, y = rng.uniform(25, 125, 2).tolist()
        w, d = rng.uniform(5, 25, 2).tolist()
        roof = float(rng.uniform(8, 40))
        known.append({"box": {"min": [x, y, 0], "max": [x + w, y + d, roof]}})
    for _ in range(int(rng.integers(0, 4))):
        center = rng.uniform((25, 25, 8), (125, 125, 30)).tolist()
        known.append({"ball": {"center": center, "radius": float(rng.uniform(1, 6))}})
    return {
        "world": {
            "bounds": [0, 0, 160, 160],
            "altitude": {"min_m": 2, "max_m": 60, "above": "home"},
            "ground": {"flat_m": 0},
            "known": known,
        },
        "robot": {"radius_m": RADIUS, "half_height_m": HALF, "clearance_m": CLEARANCE,
                  "max_speed_mps": 8, "max_accel_mps2": 2, "max_climb_mps": 3,
                  "max_descent_mps": 2},
        "route": {"start": [8, 8, float(rng.uniform(4, 30))], "via": [],
                  "goal": [152, 152, float(rng.uniform(4, 30))]},
    }  # fmt: skip
