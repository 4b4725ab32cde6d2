"""Missions of many keys at once: what is written of them keeps what is promised.

``benchmarks/strange_runs.py`` plans and drives hundreds; here it is made sure that its oracle sees
what is wrong, and that a few missions have nothing of that.
"""

from __future__ import annotations

import copy
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.report.files.csv_tables import path_csv, run_csv
from viaspline.report.files.plan_json import plan_json
from viaspline.report.files.run_json import run_json

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"
MISSION: dict[str, Any] = {
    "world": {
        "bounds": [-6, -6, 24, 24],
        "known": [
            {"name": "tank", "circle": {"center": [6, 0.2], "radius": 1}, "pass_on": "left"},
            {"name": "wall", "capsule": {"from": [12, 3], "to": [12, 8], "radius": 0.3}},
        ],
    },
    "robot": {"radius_m": 0.3, "clearance_m": 0.2, "max_speed_mps": 1.5, "max_accel_mps2": 1.0},
    "route": {"start": {"at": [0, 0]}, "via": [{"at": [10, 1]}], "goal": {"at": [18, 6]}},
    "spline": {},
}


@pytest.fixture(scope="module")
def modules() -> Any:
    sys.path.insert(0, str(BENCHMARKS))
    try:
        import strange_drives
        import strange_missions
        import strange_oracle
        import strange_plans
    finally:
        sys.path.remove(str(BENCHMARKS))
    return strange_missions, strange_oracle, strange_plans, strange_drives


@pytest.fixture(scope="module")
def written() -> tuple[dict[str, Any], str, dict[str, Any], str]:
    """What is written of ``MISSION``."""
    plan = vs.plan(vs.Mission.model_validate(MISSION))
    run = vs.simulate(plan.mission, plan=plan)
    told = json.loads(plan_json(plan, "strange", spacing=0.1))
    return told, path_csv(plan), json.loads(run_json(run, "strange")), run_csv(run)


@pytest.mark.parametrize("kind", ["plain", "circle", "moving", "map", "rounds"])
def test_missions_that_are_drawn_are_sound_and_the_same_every_time(
    modules: Any, tmp_path: Path, kind: str
) -> None:
    for seed in range(8):
        first, second = (
            modules[0].StrangeMissions(np.random.default_rng(seed), kind, tmp_path).draw()
            for _ in range(2)
        )
        assert first == second
        file = tmp_path / f"{seed}.yaml"
        file.write_text(json.dumps(first), encoding="utf-8")
        assert isinstance(vs.load(file), vs.Mission)


def test_what_is_written_of_a_plan_and_its_drive_is_as_promised(
    modules: Any, written: Any, tmp_path: Path
) -> None:
    _, oracle, plans, drives = modules
    asked = oracle.Asked(MISSION, tmp_path)
    plan, path, run, driven = written
    assert list(plans.plan_faults(asked, plan, path)) == []
    assert list(drives.run_faults(asked, run, driven)) == []


def changed(**robot: Any) -> dict[str, Any]:
    mission = copy.deepcopy(MISSION)
    mission["robot"] |= robot
    return mission


def passed_on_the_right() -> dict[str, Any]:
    mission = copy.deepcopy(MISSION)
    mission["world"]["known"][0]["pass_on"] = "right"
    return mission


def with_another_via() -> dict[str, Any]:
    mission = copy.deepcopy(MISSION)
    mission["route"]["via"] = [{"at": [10, 1.001]}]
    return mission


def in_a_zone() -> dict[str, Any]:
    mission = copy.deepcopy(MISSION)
    zone = {"polygon": [[2, -3], [4, -3], [4, 3], [2, 3]], "max_speed_mps": 0.5}
    mission["world"]["speed_zones"] = [zone]
    return mission


@pytest.mark.parametrize(
    ("asked", "word"),
    [
        (lambda: changed(radius_m=0.32), "clearance"),
        (lambda: changed(max_speed_mps=1.4), "speed"),
        (lambda: changed(max_accel_mps2=0.8), "acceleration"),
        (lambda: changed(max_brake_mps2=0.8), "braking of rows"),
        (lambda: changed(max_lateral_accel_mps2=0.05), "lateral"),
        (lambda: changed(max_yaw_rate_degps=2), "yaw rate"),
        (lambda: changed(max_jerk_mps3=0.1), "jerk"),
        (lambda: changed(min_turn_radius_m=40), "circle"),
        (passed_on_the_right, "side"),
        (with_another_via, "vias"),
        (in_a_zone, "zone"),
    ],
)
def test_the_oracle_sees_a_plan_that_does_not_keep_what_is_asked(
    modules: Any, written: Any, tmp_path: Path, asked: Callable[[], dict[str, Any]], word: str
) -> None:
    _, oracle, plans, _ = modules
    plan, path, _, _ = written
    found = plans.plan_faults(oracle.Asked(asked(), tmp_path), plan, path)
    assert word in {kind for kind, _ in found}


def test_the_oracle_sees_a_drive_that_is_told_otherwise_than_it_was(
    modules: Any, written: Any, tmp_path: Path
) -> None:
    _, oracle, _, drives = modules
    asked = oracle.Asked(MISSION, tmp_path)
    _, _, run, driven = written
    lines = driven.splitlines(keepends=True)
    stands = "".join(lines[: len(lines) // 2])
    assert {"goal", "served"} <= {word for word, _ in drives.run_faults(asked, run, stands)}
    nearer = run | {"min_clearance_m": run["min_clearance_m"] + 0.01}
    assert "run clearance" in {word for word, _ in drives.run_faults(asked, nearer, driven)}
    silent = run | {"reached": False}
    assert "verdict" in {word for word, _ in drives.run_faults(asked, silent, driven)}


def test_the_oracle_sees_a_turn_on_the_spot_that_takes_no_time(
    modules: Any, tmp_path: Path
) -> None:
    _, oracle, _, drives = modules
    rows = "time_s,speed_mps,heading_rad\n0,0.1,0\n0.05,0,0\n{0},0,1.5\n{1},0.1,1.5\n"
    for late, words in ((1.0, {"driven turn"}), (3.0, set())):
        table = oracle.table(rows.format(late, late + 0.05))
        asked = oracle.Asked(changed(max_yaw_rate_degps=30), tmp_path)
        assert {word for word, _ in drives.driven_turn_faults(asked, table)} == words
