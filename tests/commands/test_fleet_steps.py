"""Fleets on the command line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from viaspline.cli import cli

FLEET = """\
world: {bounds: [-10, -30, 60, 30]}
separation_m: 1
robots: {cart: {radius_m: 0.5}}
fleet:
  - {name: east, robot: cart, route: {start: [0, 0], goal: [40, 0]}, priority: 1}
  - {name: north, robot: cart, route: {start: [20, -20], goal: [20, 20]}}
"""
WALL = "known: [{name: wall, polygon: [[30, -40], [31, -40], [31, 40], [30, 40]]}]"
WALLED = FLEET.replace("bounds: [-10, -30, 60, 30]", f"bounds: [-10, -30, 60, 30], {WALL}")


def call(*arguments: object) -> Result:
    return CliRunner().invoke(cli, [str(argument) for argument in arguments])


@pytest.fixture
def fleet(tmp_path: Path) -> Path:
    file = tmp_path / "yard.yaml"
    file.write_text(FLEET)
    return file


def test_check_sums_up_a_fleet(fleet: Path) -> None:
    result = call("check", fleet)
    assert result.exit_code == 0, result.stderr
    assert "is sound" in result.stdout
    assert "2 robots" in result.stdout
    assert "1 m between any two bodies" in result.stdout


def test_check_names_every_fault_of_a_fleet(tmp_path: Path) -> None:
    file = tmp_path / "yard.yaml"
    file.write_text(FLEET.replace("priority: 1", "prio: 1").replace("robot: cart", "robot: crt"))
    result = call("check", file)
    assert result.exit_code == 2
    assert [line.partition(" ")[0] for line in result.stderr.splitlines()] == [
        f"{file}:5:25:", f"{file}:5:69:", f"{file}:6:26:",
    ]  # fmt: skip


def test_the_schema_is_of_missions_and_fleets() -> None:
    schema = json.loads(call("check", "--schema").stdout)
    assert {"route", "fleet"} <= set(schema["properties"])


def test_plan_writes_the_fleet_and_a_folder_for_each_robot(fleet: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    result = call("plan", fleet, "--out", out, "--improve", 0.1)
    assert result.exit_code == 0, result.stderr
    files = {file.relative_to(out).as_posix() for file in out.rglob("*") if file.is_file()}
    assert files == {
        "fleet.json", "fleet.png", "courses.npz", "planned-fleet.yaml", "timing.json",
        "east/plan.json", "east/path.csv",
        "north/plan.json", "north/path.csv",
    }  # fmt: skip
    assert json.loads((out / "fleet.json").read_text())["served"] is True
    assert "2 of 2" in result.stdout
    assert f"into {out}" in result.stdout
    assert "each of 2 robots: east, north" in result.stdout
    timing = json.loads((out / "timing.json").read_text())
    assert {"laying_paths_s", "proving_s", "report_s"} <= set(timing)


def test_run_drives_the_fleet_as_well(fleet: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    result = call("run", fleet, "--out", out, "--seed", 5, "--animate", tmp_path / "round.gif")
    assert result.exit_code == 0, result.stderr
    run = json.loads((out / "run.json").read_text())
    assert run["reached"] is True
    assert run["fleet"]["seed"] == 5
    assert (out / "fleet.json").exists()
    assert (out / "run.png").read_bytes() != (out / "fleet.png").read_bytes()
    assert (tmp_path / "round.gif").read_bytes().startswith(b"GIF")
    assert (out / "north" / "path.csv").exists()
    assert "Run · yard" in result.stdout


def test_quiet_says_nothing_of_a_fleet(fleet: Path, tmp_path: Path) -> None:
    result = call("plan", fleet, "--out", tmp_path / "out", "--quiet")
    assert (result.exit_code, result.stdout, result.stderr) == (0, "", "")


def test_who_is_not_served_is_said_and_the_others_are_written(tmp_path: Path) -> None:
    file = tmp_path / "yard.yaml"
    file.write_text(WALLED)
    out = tmp_path / "out"
    result = call("plan", file, "--out", out)
    assert result.exit_code == 3, result.stderr
    assert "1 of 2 robots is not served" in result.stderr
    assert "there is no plan for 'east'" in result.stderr
    assert "remedy: " in result.stderr
    assert not (out / "east").exists()
    assert (out / "north" / "plan.json").exists()
    (refused,) = json.loads((out / "fleet.json").read_text())["refused"]
    assert (refused["name"], refused["outcome"]) == ("east", "refused")


def test_a_robot_that_is_not_served_any_more_keeps_no_plan_of_an_earlier_run(
    fleet: Path, tmp_path: Path
) -> None:
    out = tmp_path / "out"
    call("plan", fleet, "--out", out)
    assert (out / "east" / "plan.json").exists()
    fleet.write_text(WALLED)
    result = call("plan", fleet, "--out", out)
    assert "removed what an earlier run left of 1 robot: east" in result.stdout
    assert not (out / "east").exists()
    assert (out / "north" / "plan.json").exists()


def test_a_file_in_the_way_of_a_folder_is_told_before_the_work(fleet: Path, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "north").write_text("")
    result = call("plan", fleet, "--out", tmp_path / "out")
    assert result.exit_code == 2
    assert "is a file where a folder has to go" in result.stderr
    assert [file.name for file in (tmp_path / "out").iterdir()] == ["north"]


def test_options_of_one_kind_of_file_are_refused_with_the_other(
    fleet: Path, tmp_path: Path
) -> None:
    one = tmp_path / "one.yaml"
    one.write_text("route: {start: [0, 0], goal: [20, 5]}\n")
    high = tmp_path / "high.yaml"
    high.write_text("robot: {max_climb_mps: 2}\nroute: {start: [0, 0, 2], goal: [20, 5, 3]}\n")
    for arguments, words in (
        (("plan", one, "--improve", 3), "--improve is for fleets"),
        (("run", one, "--improve", 3), "--improve is for fleets"),
        (("plan", one, "--workers", 2), "--workers is for fleets"),
        (("run", one, "--scheduler", "tcp://a:1"), "--scheduler is for fleets"),
        (("plan", fleet, "--improve", -1), "is not in the range"),
        (("plan", fleet, "--workers", 0), "is not in the range"),
        (("run", fleet, "--workers", 2, "--scheduler", "tcp://a:1"), "not both"),
        (("tension", fleet), "this is a fleet"),
        (("tension", high), "for a mission in the plane"),
        (("run", fleet, "--real-time"), "--real-time is for one robot in the plane"),
        (("run", fleet, "--bag", "a.mcap"), "this mission is one of a fleet"),
        (("run", high, "--real-time"), "this mission is one in space"),
    ):
        result = call(*arguments)
        assert result.exit_code == 2
        assert words in result.stderr


@pytest.mark.slow
def test_files_are_the_same_whoever_lays_the_paths(fleet: Path, tmp_path: Path) -> None:
    here, there = tmp_path / "here", tmp_path / "there"
    assert call("plan", fleet, "--out", here, "--quiet").exit_code == 0
    assert call("plan", fleet, "--out", there, "--quiet", "--workers", 2).exit_code == 0
    files = sorted(file.relative_to(here) for file in here.rglob("*.json"))
    assert len(files) > 2
    for file in files:
        if file.name != "timing.json":
            assert (here / file).read_bytes() == (there / file).read_bytes()


@pytest.mark.filterwarnings("ignore")
def test_a_scheduler_that_is_not_there_is_told(
    fleet: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("viaspline.fleet.laying.chosen_workers.CONNECT_S", 0.3)
    result = call("plan", fleet, "--out", tmp_path / "out", "--scheduler", "tcp://127.0.0.1:1")
    assert result.exit_code == 2
    assert "no scheduler of dask answers at tcp://127.0.0.1:1" in result.stderr
    assert not any((tmp_path / "out").glob("*"))
