"""What a report says of a robot with a drive, and that it says nothing of one without."""

from __future__ import annotations

import json
from typing import Any

import pytest

from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.report.csv_tables import run_csv
from viaspline.report.plan_json import plan_json
from viaspline.report.run_json import run_json
from viaspline.report.run_picture import run_picture
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate


def driven(**robot: Any) -> Run:
    route = {"start": [0, 0], "via": [[10, 4]], "goal": [20, 0]}
    return simulate(Mission.model_validate({"route": route, "robot": robot}))


@pytest.fixture(scope="module")
def run() -> Run:
    return driven(drive={"differential": {"track_m": 0.5}, "delay_s": 0.1})


def test_the_files_say_what_the_robot_was_off(run: Run) -> None:
    tracking = json.loads(run_json(run, "x"))["tracking"]
    assert 0.0 <= tracking["cross_track_p50_m"] <= tracking["cross_track_p99_m"]
    assert tracking["cross_track_p99_m"] <= tracking["cross_track_max_m"] < tracking["allowed_m"]
    header = run_csv(run).splitlines()[0]
    assert header.endswith("curvature_1pm,cross_track_m,along_track_m")
    planned = json.loads(plan_json(run.plan, "x", spacing=0.1))
    assert planned["tracking_error_m"] == tracking["allowed_m"]


def test_without_a_drive_they_are_as_they_were() -> None:
    run = driven()
    assert "tracking" not in json.loads(run_json(run, "x"))
    assert run_csv(run).splitlines()[0].endswith("speed_mps,curvature_1pm")
    planned = json.loads(plan_json(plan(run.plan.mission), "x", spacing=0.1))
    assert "tracking_error_m" not in planned
    assert planned["note"].startswith("the robot has no drive")


def test_the_picture_has_a_strip_for_it_and_the_same_bytes_twice(run: Run) -> None:
    assert run_picture(run, "x") == run_picture(run, "x")
