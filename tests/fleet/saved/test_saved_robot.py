"""Robots of saved fleets, read again."""

import json
from pathlib import Path

import pytest

import viaspline as vs

CAR = {
    "radius_m": 0.5, "clearance_m": 0.1,
    "drive": {"ackermann": {"wheelbase_m": 1.0, "max_steer_deg": 30}},
}  # fmt: skip
ROUND_AMONG_OTHERS = {
    "separation_m": 1.0,
    "world": {"bounds": [-1.0, -1.0, 25.0, 24.0]},
    "robots": {
        "car": CAR,
        "smooth": {"radius_m": 0.4, "clearance_m": 0.1, "max_jerk_mps3": 1.0},
        "turner": {"radius_m": 0.4, "clearance_m": 0.1, "min_turn_radius_m": 1.5},
    },
    "fleet": [
        {
            "name": "r0", "robot": "turner", "priority": 2.0, "depart_s": 20.0,
            "route": {"start": [4.22, 16.22], "goal": [10.68, 10.6]},
        },
        {
            "name": "r1", "robot": "car",
            "route": {
                "start": [11.91, 16.84], "via": [[19.87, 12.27], [17.96, 3.34]],
                "goal": [4.79, 22.91],
            },
        },
        {
            "name": "r2", "robot": "smooth", "priority": 1.0, "depart_s": 20.0,
            "route": {
                "start": [12.78, 5.7], "via": [[19.48, 8.44], [2.1, 0.16]], "goal": [20.63, 22.65],
            },
        },
        {
            "name": "r3", "robot": "smooth", "priority": 1.0,
            "route": {
                "start": [20.21, 18.91], "via": [[11.0, 3.48], [15.91, 5.11]], "closed": True,
            },
        },
        {
            "name": "r4", "robot": "car", "priority": 2.0,
            "route": {"start": [8.38, 3.21], "via": [[15.17, 9.04]], "goal": [15.53, 13.49]},
        },
    ],
}  # fmt: skip


def test_laps_with_a_limit_of_the_jerk_are_read_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A law with such a limit is a local optimum: four laps at once have another one than one."""
    monkeypatch.setattr(
        "viaspline.report.files.fleet_results.fleet_picture", lambda plan, name: b""
    )
    plan = vs.plan_fleet(vs.Fleet.model_validate(ROUND_AMONG_OTHERS))
    plan.save(tmp_path)
    assert vs.load_fleet_plan(tmp_path) == plan


def test_a_robot_that_is_given_steering_to_correct_with_is_read_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its turns are wider than its steering allows: that is part of how its path was laid."""
    monkeypatch.setattr(
        "viaspline.report.files.fleet_results.fleet_picture", lambda plan, name: b""
    )
    steered = {"ackermann": {"wheelbase_m": 1, "max_steer_deg": 32}, "delay_s": 0.1, "lag_s": 0.1}
    footprint = [[-0.3, -0.35], [1.2, -0.35], [1.2, 0.35], [-0.3, 0.35]]
    robot = {
        "footprint": footprint, "clearance_m": 0.358, "max_speed_mps": 1.72,
        "max_accel_mps2": 1.651, "max_jerk_mps3": 0.55, "drive": steered,
        "localization": {"position_noise_m": 0.01, "heading_noise_deg": 0.5},
    }  # fmt: skip
    route = {"start": [21.71, 8.21], "via": [[10.31, 4.09], [15.25, 1.57]], "goal": [1.82, 12.92]}
    plan = vs.plan_fleet(vs.Fleet.model_validate({
        "world": {"bounds": [-6.18, -6.43, 30.47, 26.26]}, "spline": {"tension": 0.743},
        "fleet": [{"name": "r1", "robot": "car", "route": route}], "robots": {"car": robot},
    }))  # fmt: skip
    asked, laid = plan.fleet.members[0].mission.robot, plan.plans["r1"].mission.robot
    assert laid.turn_radius > asked.turn_radius + 0.05
    plan.save(tmp_path)
    assert vs.load_fleet_plan(tmp_path) == plan
    told = json.loads((tmp_path / "r1" / "plan.json").read_text())
    told["mission"]["turn_radius_m"] = 0.1 + asked.turn_radius
    (tmp_path / "r1" / "plan.json").write_text(json.dumps(told))
    assert vs.load_fleet_plan(tmp_path) != plan
