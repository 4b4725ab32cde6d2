from __future__ import annotations

from typing import Any

import pytest

import viaspline as vs
from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_plan import FleetPlan

YARD: dict[str, Any] = {
    "world": {
        "bounds": [-5, -25, 45, 25],
        "known": [{"name": "shed", "polygon": [[30, 10], [36, 10], [36, 16], [30, 16]]}],
    },
    "separation_m": 1,
    "robots": {"cart": {"radius_m": 0.5}, "tug": {"radius_m": 0.9, "max_speed_mps": 1}},
    "fleet": [
        {"name": "east", "robot": "cart", "depart_s": 3,
         "route": {"start": [0, 0], "goal": [40, 0]}},
        {"name": "north", "robot": "cart", "rest": "leave",
         "route": {"start": [20, -20], "via": [{"at": [20, -12], "dwell_s": 2}], "goal": [20, 20]}},
        {"name": "tug", "robot": "tug", "priority": 1,
         "route": {"start": [10, 15], "goal": [10, -15]}},
    ],
}  # fmt: skip


@pytest.fixture(scope="session")
def fleet_plan() -> FleetPlan:
    """Three robots that cross; one stops on its way and leaves the world where it arrives."""
    return vs.plan_fleet(vs.Fleet.model_validate(YARD))


@pytest.fixture(scope="session")
def fleet_run(fleet_plan: FleetPlan) -> FleetRun:
    """What they drove when they were slow and halted."""
    delays = vs.Delays(slowed=0.3, halts=1, halts_s=10)
    return vs.simulate_fleet(fleet_plan.fleet, delays, plan=fleet_plan, seed=5)
