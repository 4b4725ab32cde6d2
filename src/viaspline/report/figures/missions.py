"""The missions of figures 6, 7 and 8, in the words of a mission file; ``examples/`` has them."""

from __future__ import annotations

from typing import Any

_BOUNDS = [0, 0, 500, 500]

SURVEY: dict[str, Any] = {
    "world": {"bounds": _BOUNDS},
    "robot": {
        "radius_m": 0.5, "clearance_m": 0.5, "max_speed_mps": 2, "max_accel_mps2": 1,
        "max_lateral_accel_mps2": 0.5,
    },
    "route": {
        "start": [50, 250],
        "via": [[80 + 30 * i, 150 if i % 2 else 350] for i in range(9)],
        "goal": [350, 250],
        "optimise": "length",
    },
    "spline": {"slack": 0.5, "knots": "uniform", "tangents": "cardinal"},
}  # fmt: skip

OBSTACLES: dict[str, Any] = {
    "world": {
        "bounds": _BOUNDS,
        "known": [
            {"name": "north silo", "circle": {"center": [235, 300], "radius": 30}},
            {"name": "silo", "circle": {"center": [250, 240], "radius": 31}},
            {"name": "store", "polygon": [[262, 262], [310, 268], [304, 308], [268, 300]]},
            {"name": "pond", "circle": {"center": [390, 150], "radius": 35}},
        ],
    },
    "robot": {"radius_m": 1.0, "clearance_m": 1.0, "max_speed_mps": 2, "max_accel_mps2": 1},
    "route": {"start": [50, 250], "goal": [450, 260], "optimise": "length"},
    "spline": {"tangents": "cardinal"},
}

PATROL: dict[str, Any] = {
    "world": {
        "bounds": _BOUNDS,
        "known": [
            {"name": "well", "circle": {"center": [120, 250], "radius": 12}},
            {"name": "tank", "polygon": [[200, 300], [230, 300], [215, 340]]},
            {"name": "silo", "circle": {"center": [305, 300], "radius": 28}},
            {"name": "barn", "polygon": [[330, 130], [385, 120], [392, 160], [337, 170]]},
        ],
        "unseen": [
            {"name": "crate", "circle": {"center": [200, 150], "radius": 8}},
            {"name": "fallen tree", "polygon": [[405, 266], [446, 262], [447, 270], [407, 276]]},
        ],
    },
    "robot": {
        "radius_m": 0.5, "clearance_m": 0.5, "max_speed_mps": 2, "max_accel_mps2": 1,
        "max_lateral_accel_mps2": 0.5, "sensor": {"range_m": 40},
    },
    "route": {
        "start": {"at": [50, 250], "heading_deg": 45},
        "via": [
            [90, 330],
            {"at": [140, 170], "name": "pump-house", "dwell_s": 20},
            [270, 150],
            {"at": [290, 390], "name": "gate", "dwell_s": 10},
            [400, 380],
        ],
        "goal": {"at": [430, 180], "name": "charger"},
        "optimise": "length",
    },
    "spline": {"tension": 0.1, "tangents": "cardinal"},
}  # fmt: skip
