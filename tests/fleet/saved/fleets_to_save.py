"""Fleets of every kind whose plans are saved."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

import viaspline as vs

Saved = dict[str, tuple[Path, vs.FleetPlan]]


@contextmanager
def unpainted() -> Iterator[None]:
    """Within the block plans are saved without pictures, which nobody looks at here."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(
            "viaspline.report.files.fleet_results.fleet_picture", lambda plan, name: b""
        )
        yield


def go(name: str, start: list[float], goal: list[float], **more: Any) -> dict[str, Any]:
    return {"name": name, "route": {"start": start, "goal": goal}, **more}


SQUARE = {"start": [0, 0], "via": [[20, 0], [20, 20]], "closed": True}
CART = {
    "name": "cart",
    "circle": {"center": [0, 0], "radius": 1},
    "motion": {"from": [15, -10], "velocity_mps": [0, 1.0]},
}
DRONE = {"radius_m": 0.4, "half_height_m": 0.2}
CAR = {"radius_m": 0.5, "drive": {"ackermann": {"wheelbase_m": 1.0, "max_steer_deg": 30}}}
BROAD = {
    "drive": {"omnidirectional": {"max_speed_along_mps": 2, "max_speed_across_mps": 1}},
    "footprint": [[-0.6, -0.3], [0.6, -0.3], [0.6, 0.3], [-0.6, 0.3]],
}
ASKED: dict[str, dict[str, Any]] = {
    "crossing": {
        "separation_m": 1,
        "world": {"known": [{"circle": {"center": [30, 0], "radius": 1}}]},
        "fleet": [
            go("a", [0, 0], [40, 0], depart_s=2),
            go("b 1/2", [20, -20], [20, 20]),
            go("c", [20, 30], [22, -30], rest="leave", priority=2),
        ],
    },
    "not all served": {
        "separation_m": 0.3,
        "world": {"bounds": [-1, -1.05, 21, 1.05]},
        "fleet": [
            go("a", [0, 0], [20, 0]), go("b", [20, 0], [0, 0]), go("c", [14, 0], [9, 0]),
            go("d", [17, 0], [18.5, 0]),
        ],
    },
    "patrols": {
        "separation_m": 1,
        "fleet": [
            {"name": "p", "route": SQUARE},
            {"name": "q", "route": {"start": [10, -5], "via": [[10, 25]], "closed": True}},
            go("b", [30, 10], [-10, 12]),
        ],
    },
    "a patrol that hardly turns": {  # its speeds change within nanometres
        "robots": {"van": {"max_yaw_rate_degps": 0.03}},
        "fleet": [
            {
                "name": "p",
                "robot": "van",
                "route": {"start": [0, 0], "via": [[6, 0], [3, 5]], "closed": True},
            },
        ],
    },
    "laps": {
        "fleet": [
            {"name": "p", "route": {**SQUARE, "laps": 1}},
            {"name": "q", "route": {**SQUARE, "start": [10, -5], "via": [[10, 25]], "laps": 2}},
        ],
    },
    "smooth patrol with stations, long body on two laps": {
        "robots": {"soft": {"max_jerk_mps3": 1.0}, "broad": BROAD},
        "world": {"known": [{"circle": {"center": [5, 24], "radius": 1}}]},
        "fleet": [
            {
                "name": "p", "robot": "soft", "depart_s": 2,
                "route": {**SQUARE, "via": [{"at": [20, 0], "dwell_s": 4}, [20, 20]]},
            },
            {
                "name": "b", "robot": "broad",
                "route": {"start": [0, 20], "via": [[0, 27], [10, 27]], "closed": True, "laps": 2},
            },
        ],
    },
    "nobody has a path": {
        "world": {
            "bounds": [-1, -5, 41, 5],
            "known": [{"polygon": [[19, -5], [21, -5], [21, 5], [19, 5]]}],
        },
        "fleet": [go("a", [0, 0], [40, 0])],
    },
    "kinds": {
        "robots": {"car": CAR, "broad": BROAD, "soft": {"max_jerk_mps3": 1.0}},
        "fleet": [
            {
                "name": "car", "robot": "car",
                "route": {"start": [0, 0], "via": [{"at": [10, 0], "dwell_s": 5}], "goal": [20, 0]},
            },
            go("broad", [10, -10], [10, 10], robot="broad"),
            go("soft", [15, 10], [15, -10], robot="soft"),
        ],
    },
    "settled order and tension": {
        "spline": {"tension": "auto"},
        "fleet": [
            {
                "name": "p",
                "route": {
                    "start": [0, 0], "via": [[20, 0], [5, 3], [12, -3]], "order": "shortest",
                    "goal": [30, 0],
                },
            },
            go("b", [10, -9], [10, 9]),
        ],
    },
    "among what moves": {
        "separation_m": 1,
        "world": {"known": [CART]},
        "fleet": [go("a", [0, 0], [40, 0]), go("b", [20, -20], [20, 20])],
    },
    "flights": {
        "separation_m": 2,
        "robots": {"drone": DRONE},
        "fleet": [
            go("a", [0, 0, 10], [40, 0, 10], robot="drone"),
            go("b", [20, -20, 10.5], [20, 20, 10.5], robot="drone"),
        ],
    },
    "flights past what moves": {
        "separation_m": 2,
        "world": {
            "known": [
                {"ball": {"center": [9, 9, 10], "radius": 1}},
                {
                    "name": "balloon", "ball": {"center": [0, 0, 0], "radius": 1.5},
                    "motion": {"from": [8, -16, 10], "velocity_mps": [0, 4, 0]},
                },
                {"box": {"min": [19, 30, 0], "max": [21, 31, 20]}},
            ],
        },
        "robots": {"drone": DRONE},
        "fleet": [
            go("a", [0, 0, 10], [40, 0, 10], robot="drone", depart_s=1),
            go("b", [20, -20, 10.5], [20, 20, 10.5], robot="drone", rest="leave"),
        ],
    },
    "flights that never end": {
        "separation_m": 1,
        "world": {"known": [{"ball": {"center": [12, 12, 11], "radius": 1}}]},
        "robots": {"drone": DRONE},
        "fleet": [
            {
                "name": "p", "robot": "drone",
                "route": {
                    "start": [0, 0, 10], "closed": True,
                    "via": [{"at": [20, 0, 10], "dwell_s": 2, "look_at": [20, 9, 9]},
                            [20, 20, 12]],
                },
            },
            {
                "name": "q", "robot": "drone",
                "route": {"start": [10, -5, 10], "via": [[10, 25, 11]], "closed": True},
            },
            go("b", [30, 10, 10], [-10, 12, 11], robot="drone"),
        ],
    },
    "flights in the order that is shortest": {
        "robots": {"drone": DRONE},
        "fleet": [
            {
                "name": "p", "robot": "drone",
                "route": {
                    "start": [0, 0, 9], "via": [[20, 0, 9], [5, 3, 9], [12, -3, 12]],
                    "order": "shortest", "goal": [30, 0, 9],
                },
            },
        ],
    },
    "on a lattice": {
        "separation_m": 0.3,
        "world": {"bounds": [-1, -1, 7, 7]},
        "robots": {"k": {"radius_m": 0.4, "clearance_m": 0.1}},
        "fleet": [
            go("a", [0, 0], [6, 0], robot="k"), go("b", [6, 0], [0, 0], robot="k"),
            go("c", [0, 6], [6, 6], robot="k"), go("d", [6, 6], [0, 6], robot="k"),
        ],
    },
}  # fmt: skip
