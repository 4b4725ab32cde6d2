from __future__ import annotations

from typing import Any

import pytest

from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate

YARD: dict[str, Any] = {
    "world": {
        "bounds": [0, 0, 100, 60],
        "known": [
            {"name": "tank $1", "circle": {"center": [36, 34], "radius": 6}},
            {"name": "shed", "polygon": [[70, 10], [80, 10], [80, 20], [70, 20]]},
        ],
        "unseen": [{"name": "crate", "circle": {"center": [62, 40], "radius": 3}}],
    },
    "robot": {"sensor": {"range_m": 15}, "max_lateral_accel_mps2": 0.5},
    "route": {
        "start": [10, 30],
        "via": [{"at": [52, 40], "name": "pump", "dwell_s": 5}, [75, 40]],
        "goal": [90, 30],
    },
}


@pytest.fixture(scope="session")
def mission() -> Mission:
    return Mission.model_validate(YARD)


@pytest.fixture(scope="session")
def planned(mission: Mission) -> Plan:
    return plan(mission)


@pytest.fixture(scope="session")
def driven(mission: Mission, planned: Plan) -> Run:
    return simulate(mission, plan=planned)


@pytest.fixture(scope="session")
def scanned() -> Run:
    """A run with a lidar among many posts, none of them on the map."""
    posts = [[x, y] for x in range(8, 33, 4) for y in range(-9, 10, 3)]
    unseen = [{"circle": {"center": [x + 0.3 * (y % 2), y], "radius": 0.5}} for x, y in posts]
    mission = Mission.model_validate(
        {
            "world": {"unseen": unseen},
            "robot": {"sensor": {"lidar": {"range_m": 12, "fov_deg": 270, "beams": 540}}},
            "route": {"start": [0, 0], "goal": [40, 0]},
        }
    )
    return simulate(mission)
