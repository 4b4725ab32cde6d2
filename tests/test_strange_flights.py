"""Missions in space of many keys at once: what is written of them keeps what is promised.

``benchmarks/strange_flight_runs.py`` plans and flies hundreds; here it is made sure that its oracle
sees what is wrong, and that a mission has nothing of that.
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
from viaspline.report.space.spatial_json import (
    flight_csv,
    flight_json,
    spatial_path_csv,
    spatial_plan_json,
)
from viaspline.space.plan_spatial import plan_spatial

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"
MISSION: dict[str, Any] = {
    "world": {
        "bounds": [-20, -30, 90, 30],
        "ground": {"flat_m": 100},
        "altitude": {"min_m": 4, "max_m": 40, "above": "ground"},
        "known": [
            {"name": "hall", "box": {"min": [15, -28, 100], "max": [22, 28, 116]},
             "pass_on": "over"},
            {"name": "cable", "capsule": {"from": [50, -9, 108], "to": [52, 9, 114],
                                           "radius": 0.1}},
        ],
    },
    "robot": {"radius_m": 0.5, "half_height_m": 0.3, "clearance_m": 1.0, "max_speed_mps": 6,
              "max_accel_mps2": 2, "max_climb_mps": 2, "max_descent_mps": 1.5,
              "max_yaw_rate_dps": 45},
    "route": {
        "start": {"at": [0, 0]}, "takeoff": {"to_agl_m": 8},
        "via": [{"gate": {"at": [35, 4, 112], "facing_deg": 10, "width_m": 4, "height_m": 4}},
                {"at": [60, 0], "agl_m": 11, "dwell_s": 2, "look_at": [60, 20, 105]}],
        "land": {"at": [70, -10]},
    },
    "spline": {},
}  # fmt: skip


@pytest.fixture(scope="module")
def modules() -> Any:
    sys.path.insert(0, str(BENCHMARKS))
    try:
        import strange_flight_drives
        import strange_flight_oracle
        import strange_flight_plans
        import strange_flights
    finally:
        sys.path.remove(str(BENCHMARKS))
    return strange_flights, strange_flight_oracle, strange_flight_plans, strange_flight_drives


@pytest.fixture(scope="module")
def written() -> tuple[dict[str, Any], str, dict[str, Any], str]:
    """What is written of ``MISSION``."""
    plan = plan_spatial(vs.Mission.model_validate(MISSION))
    run = vs.fly(plan)
    told, flown = spatial_plan_json(plan, "strange"), flight_json(run, "strange")
    return json.loads(told), spatial_path_csv(plan), json.loads(flown), flight_csv(run)


@pytest.mark.filterwarnings("ignore:.*jump")  # loops that begin elsewhere than they end
@pytest.mark.parametrize("kind", ["town", "plant", "hills", "gates", "patrol", "moving", "hidden"])
def test_flights_that_are_drawn_are_sound_and_the_same_every_time(
    modules: Any, tmp_path: Path, kind: str
) -> None:
    for seed in range(3):
        first, second = (
            modules[0].StrangeFlights(np.random.default_rng(seed), kind, tmp_path).draw()
            for _ in range(2)
        )
        assert first == second
        file = tmp_path / f"{seed}.yaml"
        file.write_text(json.dumps(first), encoding="utf-8")
        mission = vs.load(file)
        assert isinstance(mission, vs.Mission)
        assert mission.is_spatial


def test_what_is_written_of_a_flight_is_as_promised(
    modules: Any, written: Any, tmp_path: Path
) -> None:
    _, oracle, plans, drives = modules
    asked = oracle.AskedFlight(MISSION, tmp_path)
    plan, path, run, flown = written
    assert list(plans.flight_plan_faults(asked, plan, path)) == []
    assert list(drives.flight_faults(asked, run, flown)) == []


def changed(part: str, **keys: Any) -> dict[str, Any]:
    mission = copy.deepcopy(MISSION)
    mission[part] |= keys
    return mission


def with_via(number: int, **keys: Any) -> dict[str, Any]:
    mission = copy.deepcopy(MISSION)
    mission["route"]["via"][number] |= keys
    return mission


def passed_on_the_left() -> dict[str, Any]:
    mission = copy.deepcopy(MISSION)
    mission["world"]["known"][0]["pass_on"] = "left"
    return mission


GATE = {"at": [35, 4, 112], "facing_deg": 12, "width_m": 4, "height_m": 4}


@pytest.mark.parametrize(
    ("asked", "word"),
    [
        (lambda: changed("robot", radius_m=0.52), "clearance"),
        (lambda: changed("robot", half_height_m=0.35), "clearance"),
        (lambda: changed("robot", clearance_m=1.3), "nearer than asked"),
        (lambda: changed("robot", max_speed_mps=4), "speed"),
        (lambda: changed("robot", max_climb_mps=1.8), "climb"),
        (lambda: changed("robot", max_descent_mps=1.3), "descent"),
        (lambda: changed("robot", max_accel_mps2=1.5), "acceleration"),
        (lambda: changed("robot", max_lateral_accel_mps2=0.3), "across"),
        (lambda: changed("robot", max_vertical_accel_mps2=0.5), "vertical"),
        (lambda: changed("robot", max_yaw_rate_dps=30), "yaw rate"),
        (lambda: changed("world", altitude={"max_m": 15, "above": "ground"}), "band"),
        (lambda: with_via(0, gate=GATE), "gate"),
        (lambda: with_via(1, agl_m=11.001), "vias"),
        (lambda: with_via(1, dwell_s=3), "dwell"),
        (lambda: with_via(1, look_at=[62, 20, 105]), "look"),
        (passed_on_the_left, "side"),
    ],
)
def test_the_oracle_sees_a_flight_that_does_not_keep_what_is_asked(
    modules: Any, written: Any, tmp_path: Path, asked: Callable[[], dict[str, Any]], word: str
) -> None:
    _, oracle, plans, _ = modules
    plan, path, _, _ = written
    found = plans.flight_plan_faults(oracle.AskedFlight(asked(), tmp_path), plan, path)
    assert word in {kind for kind, _ in found}


def test_the_oracle_sees_a_flight_that_is_told_otherwise_than_it_was(
    modules: Any, written: Any, tmp_path: Path
) -> None:
    _, oracle, _, drives = modules
    asked = oracle.AskedFlight(MISSION, tmp_path)
    _, _, run, flown = written
    lines = flown.splitlines(keepends=True)
    stops = "".join(lines[: len(lines) // 2])
    assert {"goal", "via"} <= {word for word, _ in drives.flight_faults(asked, run, stops)}
    nearer = run | {"clearance_m": run["clearance_m"] + 0.2}
    assert "run clearance" in {word for word, _ in drives.flight_faults(asked, nearer, flown)}
    silent = run | {"reached": False}
    assert "verdict" in {word for word, _ in drives.flight_faults(asked, silent, flown)}
