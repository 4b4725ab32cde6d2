"""Three of BARN's hardest worlds, unseen: gaps hardly wider than the robot, dead ends, detours."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
import shapely

from viaspline.mission.model import Mission
from viaspline.robot.simulator import simulate

POSTS = Path(__file__).parent / "barn" / "posts.csv"
RADIUS = 0.075


def posts(world: int) -> np.ndarray:
    with POSTS.open() as file:
        rows = [row for row in csv.DictReader(file) if int(row["world"]) == world]
    return np.array([(float(row["x_m"]), float(row["y_m"])) for row in rows])


def mission(middles: np.ndarray, noise: float) -> Mission:
    lidar = {"range_m": 5, "fov_deg": 270, "beams": 720, "noise_m": noise}
    unseen = [{"circle": {"center": middle.tolist(), "radius": RADIUS}} for middle in middles]
    return Mission.model_validate(
        {
            "world": {"unseen": unseen},
            "robot": {
                "radius_m": 0.15, "clearance_m": 0, "max_speed_mps": 2, "max_accel_mps2": 2,
                "sensor": {"lidar": lidar},
            },
            "route": {"start": {"at": [-2.25, 3], "heading_deg": 90}, "goal": [-2.25, 13]},
        }
    )  # fmt: skip


@pytest.mark.parametrize(("world", "noise"), [(85, 0.01), (201, 0.0), (287, 0.01)])
def test_the_goal_is_reached_without_a_contact(world: int, noise: float) -> None:
    middles = posts(world)
    run = simulate(mission(middles, noise), seed=world)
    assert run.reached, run.reason
    assert run.certificate.clearance > 0.0
    driven = shapely.LineString(np.asarray(run.path.evaluate(np.linspace(*run.path.domain, 40000))))
    assert shapely.distance(driven, shapely.points(middles)).min() - RADIUS > 0.15
    assert run.duration < 30.0
    assert len(run.replans) < 60
