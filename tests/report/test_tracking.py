"""What a report says of a robot with a drive, and that it says nothing of one without."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.report.files.csv_tables import run_csv
from viaspline.report.files.plan_json import plan_json
from viaspline.report.files.run_json import run_json
from viaspline.report.run_picture import run_picture
from viaspline.report.terminal.run_tables import run_tables
from viaspline.report.terminal.terminal_tables import console
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


def test_they_say_when_it_was_farther_beside_its_path_than_was_kept(run: Run) -> None:
    tracking = json.loads(run_json(run, "x"))["tracking"]
    assert tracking["kept_to"]
    assert tracking["beyond_allowed"] == []
    stated = driven(
        drive={"differential": {"track_m": 0.5}, "delay_s": 0.1, "speed_noise_mps": 0.1},
        localization={"position_noise_m": 0.05}, tracking_error_m=1e-4,
    )  # fmt: skip
    tracking = json.loads(run_json(stated, "x"))["tracking"]
    assert not tracking["kept_to"]
    worst = max(tracking["beyond_allowed"], key=lambda one: one["off_m"])
    assert stated.tracking is not None
    farthest = float(np.abs(stated.tracking.cross_track).max())  # at rest as well
    assert worst["off_m"] == pytest.approx(farthest, abs=1e-6)
    assert worst["off_m"] >= tracking["cross_track_max_m"] - 1e-6
    assert worst["beyond_m"] == pytest.approx(worst["off_m"] - 1e-4, abs=1e-6)
    assert worst["since_s"] <= worst["worst_time_s"] <= worst["until_s"]
    screen = console()
    with screen.capture() as said:
        screen.print(run_tables(stated, "x"))
    assert "BEYOND WHAT IS KEPT" in said.get()


def test_without_a_drive_they_say_that_nothing_is_kept() -> None:
    run = driven()
    data = json.loads(run_json(run, "x"))
    assert "tracking" not in data
    assert data["note"].startswith("the robot has no drive")
    assert run_csv(run).splitlines()[0].endswith("speed_mps,curvature_1pm")
    planned = json.loads(plan_json(plan(run.plan.mission), "x", spacing=0.1))
    assert "tracking_error_m" not in planned
    assert planned["note"].startswith("the robot has no drive")


def test_the_picture_has_a_strip_for_it_and_the_same_bytes_twice(run: Run) -> None:
    assert run_picture(run, "x") == run_picture(run, "x")
