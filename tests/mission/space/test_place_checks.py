"""Where a robot in space may be, and what is advised where it may not."""

from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import Fault, MissionError
from viaspline.maps.terrain import Terrain
from viaspline.mission.model import Mission

PLACES = ["route.via[0].at", "route.via[0].agl_m"]


def crowded(rng: np.random.Generator) -> dict[str, Any]:
    """A via point among boxes, balls and lines over hills; start and goal are far above."""
    hills = Terrain(rng.uniform(0, 6, (21, 21)), 5.0, (-50.0, -50.0))
    known: list[dict[str, Any]] = []
    for _ in range(6):
        low = rng.uniform((-10, -10, 0), (10, 10, 20))
        high = low + rng.uniform(1, 12, 3)
        known.append({"box": {"min": low, "max": high, "yaw_deg": float(rng.uniform(0, 90))}})
        ball = {"center": rng.uniform((-10, -10, 0), (10, 10, 30)), "radius": rng.uniform(1, 4)}
        known.append({"ball": ball})
        ends = rng.uniform((-12, -12, 0), (12, 12, 30), (2, 3))
        known.append({"capsule": {"from": ends[0], "to": ends[1], "radius": 0.3}})
    x, y, z = rng.uniform((-10, -10, -3), (10, 10, 35)).round(2).tolist()
    via = {"at": [x, y, z]} if rng.random() < 0.5 else {"at": [x, y], "agl_m": z}
    robot = {"radius_m": 0.5, "clearance_m": 0.7}
    return {
        "world": {
            "known": known,
            "ground": {"terrain": hills},
            "altitude": {"min_m": 4, "max_m": 90, "above": str(rng.choice(["home", "ground"]))},
        },
        "robot": robot | ({"half_height_m": 0.2} if rng.random() < 0.5 else {}),
        "route": {"start": [-30, 0, 80], "via": [via], "goal": [30, 0, 80]},
    }


def faults_of(data: dict[str, Any]) -> list[Fault]:
    try:
        Mission.model_validate(data)
    except MissionError as error:
        return [fault for fault in error.faults if fault.key in PLACES]
    return []


@settings(deadline=None, max_examples=60)
@given(seed=st.integers(0, 10_000))
def test_whatever_height_is_advised_is_free(seed: int) -> None:
    data = crowded(np.random.default_rng(seed))
    for fault in faults_of(data):
        for change in fault.changes:
            via = data["route"]["via"][0] | {fault.key.rpartition(".")[2]: change.value}
            assert not faults_of({**data, "route": {**data["route"], "via": [via]}})
