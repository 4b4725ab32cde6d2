"""Drives that were recorded."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import viaspline as vs
from viaspline.bags.bag_file import BagFile
from viaspline.robot.run import Run

MISSIONS: dict[str, dict[str, Any]] = {
    "exact": {
        "world": {
            "bounds": [-5, -15, 55, 15],
            "known": [{"name": "tank", "circle": {"center": [15, 0.5], "radius": 2}}],
            "unseen": [{"name": "rock", "circle": {"center": [35, 1], "radius": 2}}],
        },
        "robot": {"sensor": {"range_m": 10}},
        "route": {"start": [0, 0], "via": [{"at": [25, 0], "name": "pump", "dwell_s": 1}],
                  "goal": [50, 0]},
    },
    "lidar": {
        "world": {
            "bounds": [-2, -6, 14, 6],
            "unseen": [{"name": "post", "circle": {"center": [6, 0.2], "radius": 0.4}}],
        },
        "robot": {"radius_m": 0.3, "clearance_m": 0.1, "max_speed_mps": 1,
                  "sensor": {"lidar": {"range_m": 5, "fov_deg": 270, "beams": 90,
                                       "noise_m": 0.005}}},
        "route": {"start": [0, 0], "goal": [12, 0]},
    },
    "driven": {
        "world": {"known": [{"name": "tank", "circle": {"center": [5, 0.3], "radius": 0.6}}]},
        "robot": {"radius_m": 0.3, "clearance_m": 0.2, "max_speed_mps": 1, "tracking_error_m": 0.1,
                  "drive": {"differential": {"track_m": 0.4}, "delay_s": 0.1}},
        "route": {"start": [0, 0], "goal": [10, 0]},
    },
    "moving": {
        "world": {"unseen": [{"name": "cart", "circle": {"center": [0, 0], "radius": 0.5},
                              "motion": {"from": [20, -6], "velocity_mps": [0, 0.8]}}]},
        "robot": {"sensor": {"range_m": 12}, "moving": {"max_speed_mps": 1.5}},
        "route": {"start": [0, 0], "goal": [30, 0]},
    },
}  # fmt: skip


@pytest.fixture(scope="session")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], tuple[Path, Run]]:
    """Gives the bag of a mission by its name, and its run; each is driven once."""
    made: dict[str, tuple[Path, Run]] = {}

    def give(name: str) -> tuple[Path, Run]:
        if name not in made:
            path = tmp_path_factory.mktemp(name) / "run.mcap"
            mission = vs.Mission.model_validate(MISSIONS[name])
            plan = vs.plan(mission)
            assert isinstance(plan, vs.Plan)
            with BagFile(path).recording(mission, plan, seed=3) as watch:
                run = vs.simulate(plan.mission, plan=plan, seed=3, watch=watch)
            made[name] = path, run
        return made[name]

    return give
