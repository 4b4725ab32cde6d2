from __future__ import annotations

import csv
import io
import json

import numpy as np
import pytest

from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan
from viaspline.report.files.csv_tables import path_csv, run_csv, spacing
from viaspline.report.files.plan_json import plan_json
from viaspline.report.files.run_json import changed_spans, run_json, timing_json
from viaspline.robot.run import Run


def _rows(text: str) -> dict[str, list[float]]:
    reader = csv.DictReader(io.StringIO(text))
    rows = list(reader)
    return {name: [float(row[name]) for row in rows] for name in reader.fieldnames or ()}


def test_plan_json_holds_the_exact_curve(planned: Plan) -> None:
    data = json.loads(plan_json(planned, "yard", spacing=0.1))
    assert np.array_equal(np.array(data["path"]["spans"]), planned.path.spans)


def test_plan_json_has_the_keys_that_the_design_fixes(planned: Plan) -> None:
    data = json.loads(plan_json(planned, "yard", spacing=0.1))
    assert {"spans", "vias", "length_m", "max_curvature_1pm"} <= set(data["path"])
    assert {"name", "at", "distance_m", "kind"} <= set(data["path"]["vias"][0])
    assert {via["kind"] for via in data["path"]["vias"]} == {"user", "detour"}
    assert {"clearance_m", "tightest_at", "tightest_distance_m"} <= set(data["certificate"])
    assert data["trajectory"]["duration_s"] == planned.trajectory.duration
    assert data["trajectory"]["stations"][0]["name"] == "pump"
    (entry,) = data["ledger"]
    assert entry["members"] == ["tank $1"]
    keys = {"side", "vias", "length_m", "duration_s", "clearance_m", "max_curvature_1pm"}
    keys |= {"impossible", "passed_over", "chosen", "spans"}
    assert all(set(candidate) == keys for candidate in entry["candidates"])
    assert [c["side"] for c in entry["candidates"] if c["chosen"]] == [entry["chosen"]]


def test_plan_json_says_how_the_path_drives(planned: Plan) -> None:
    drive = json.loads(plan_json(planned, "yard", spacing=0.1))["drivability"]
    fixed = {"sharpest_radius_m", "sharpest_at", "max_lateral_accel_mps2", "curvature_jumps"}
    assert fixed | {"turns_on_spot", "verdict", "reasons", "near_cusps"} <= set(drive)
    peak, u = planned.path.max_curvature()
    assert drive["sharpest_radius_m"] == pytest.approx(1 / peak, rel=1e-6)
    assert drive["sharpest_at"] == pytest.approx(planned.path.evaluate(u).tolist(), abs=1e-4)
    s = np.linspace(0.0, planned.path.length, 5001)
    bends = np.abs(planned.path.curvature(planned.path.parameter(s)))
    across = np.interp(s, planned.trajectory.distances, planned.trajectory.speeds) ** 2 * bends
    assert drive["max_lateral_accel_mps2"] == pytest.approx(across.max(), rel=0.01)
    assert 0.1 < drive["max_lateral_accel_mps2"] <= 0.5
    assert (drive["verdict"], drive["reasons"]) == ("good", [])


def test_plan_json_has_what_more_clearance_would_cost(mission: Mission, planned: Plan) -> None:
    assert "preferred_clearance" not in json.loads(plan_json(planned, "yard", spacing=0.1))
    robot = mission.robot.model_copy(update={"prefer_clearance_m": 0.4})
    roomy = plan(mission.model_copy(update={"robot": robot}))
    data = json.loads(plan_json(roomy, "yard", spacing=0.1))
    weighed = data["preferred_clearance"]
    assert (weighed["asked_m"], weighed["taken_m"]) == (0.4, 0.4)
    (tried,) = weighed["tried"]
    assert (tried["clearance_m"], tried["taken"]) == (0.4, True)
    moving = planned.trajectory.duration - 5.0  # without its stay at the pump
    assert weighed["required_duration_s"] == pytest.approx(moving, rel=0.01)
    assert tried["duration_s"] <= weighed["most_duration_s"]
    assert data["certificate"]["required_clearance_m"] == 0.5


def test_plan_json_says_what_a_reader_needs_later(planned: Plan) -> None:
    mission = json.loads(plan_json(planned, "yard", spacing=0.1))["mission"]
    assert mission["name"] == "yard"
    assert (mission["robot_radius_m"], mission["required_clearance_m"]) == (0.5, 0.5)


def test_run_json_has_the_keys_that_the_design_fixes(driven: Run) -> None:
    data = json.loads(run_json(driven, "yard", seed=3))
    assert data["reached"] is True
    assert data["mission"]["seed"] == 3
    assert data["min_clearance_m"] >= 0.5 - 1e-6
    assert data["distance_m"] == pytest.approx(driven.path.length)
    assert [via["status"] for via in data["vias"]] == ["served"] * 4
    assert all(via["miss_m"] < 1e-6 for via in data["vias"])
    assert {"detected", "replanned", "arrived", "reached"} <= {e["kind"] for e in data["events"]}


def test_run_json_gives_the_jumps_and_the_changed_spans_of_a_new_path(driven: Run) -> None:
    (replan,) = json.loads(run_json(driven, "yard"))["replans"]
    assert replan["position_jump_m"] < 1e-6
    assert replan["heading_jump_rad"] < 1e-6
    assert replan["curvature_jump_1pm"] < 1e-3
    first, last = replan["spans_changed"]
    assert 0 <= first <= last < replan["spans"]


def test_changed_spans_are_those_between_leaving_and_rejoining(driven: Run) -> None:
    path = driven.path
    joints = np.asarray(path.distance(np.linspace(*path.domain, len(path.spans) + 1)))
    assert changed_spans(path, float(joints[1]), float(joints[3])) == [1, 2]
    assert changed_spans(path, float(joints[2]), None) == [2, len(path.spans) - 1]


def test_path_csv_is_equally_spaced_and_ends_at_the_end(planned: Plan) -> None:
    rows = _rows(path_csv(planned))
    assert list(rows) == [
        "distance_m", "x_m", "y_m", "heading_rad", "curvature_1pm", "speed_mps", "time_s",
    ]  # fmt: skip
    steps = np.diff(rows["distance_m"])
    assert np.ptp(steps) < 3e-6
    assert steps[0] <= spacing(planned.path.length)
    assert rows["distance_m"][-1] == pytest.approx(planned.path.length, abs=1e-6)
    assert rows["time_s"][-1] == pytest.approx(planned.trajectory.duration, abs=1e-6)
    assert rows["speed_mps"][0] == rows["speed_mps"][-1] == 0.0


def test_run_csv_follows_the_run(driven: Run) -> None:
    rows = _rows(run_csv(driven))
    assert list(rows) == ["time_s", "x_m", "y_m", "heading_rad", "speed_mps", "curvature_1pm"]
    assert len(rows["time_s"]) == len(driven.times)
    assert rows["x_m"][-1] == pytest.approx(90, abs=1e-6)


@pytest.mark.parametrize("length", [0.0, 1e-6, 0.5, 4.9, 5.1, 80.0, 640.0, 7e3, 1e5, 2e6])
def test_a_table_has_neither_too_few_nor_too_many_lines(length: float) -> None:
    lines = length / spacing(length)
    assert lines <= 50_000
    assert length < 1e-3 or lines >= 45


def test_timing_json_keeps_the_wall_clock_apart() -> None:
    data = json.loads(timing_json({"plan": 0.25}, [0.001, 0.003]))
    assert data["plan_s"] == 0.25
    assert data["replan_median_s"] == 0.002
    assert data["replan_max_s"] == 0.003
