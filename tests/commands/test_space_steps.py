from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from viaspline.cli import cli

MISSION = """
world:
  ground: {flat_m: 0}
  known:
    - {name: hall, box: {min: [20, -10, 0], max: [40, 10, 12]}}
robot: {radius_m: 0.5, max_climb_mps: 2, sensor: {range_m: 15}}
route: {start: [0, 0], takeoff: {to_agl_m: 8}, via: [[60, 0, 8]], land: {at: [70, 0]}}
"""


@pytest.fixture
def tower(tmp_path: Path) -> Path:
    file = tmp_path / "tower.yaml"
    file.write_text(MISSION)
    return file


def test_a_mission_in_space_is_checked_planned_and_flown(tower: Path, tmp_path: Path) -> None:
    call = CliRunner()
    checked = call.invoke(cli, ["check", str(tower)])
    assert checked.exit_code == 0
    assert "8 m" in checked.output
    out = tmp_path / "out"
    done = call.invoke(cli, ["run", str(tower), "--out", str(out)])
    assert done.exit_code == 0, done.output
    assert {file.name for file in out.iterdir()} == {
        "plan.json", "path.csv", "plan.png", "planned-mission.yaml", "run.json", "run.csv",
        "run.png", "timing.json",
    }  # fmt: skip
    assert json.loads((out / "run.json").read_text())["reached"]
    assert "hall" in done.output
    assert "Run · tower" in done.output
    assert "reached its goal" in done.output


def test_a_flight_that_finds_no_way_says_so_and_exits_with_4(tower: Path, tmp_path: Path) -> None:
    text = MISSION + "\n"
    text = text.replace(
        "robot:", "  unseen:\n    - {name: tent, ball: {center: [60, 0, 8], radius: 2}}\nrobot:"
    )
    tower.write_text(text)
    done = CliRunner().invoke(cli, ["run", str(tower), "--out", str(tmp_path / "out")])
    assert done.exit_code == 4
    assert "tent" in done.output


def test_what_moves_and_is_not_on_the_map_is_in_the_results(tower: Path, tmp_path: Path) -> None:
    kite = "{name: kite, ball: {center: [0, 0, 0], radius: 1}, motion: {keyframes: " \
           "[[0, 60, -30, 0, 8], [60, 60, 30, 0, 8]], after: stay}}"  # fmt: skip
    tower.write_text(MISSION.replace("robot:", f"  unseen:\n    - {kite}\nrobot:"))
    out = tmp_path / "out"
    done = CliRunner().invoke(cli, ["run", str(tower), "--out", str(out), "--seed", "3"])
    told = json.loads((out / "run.json").read_text())
    assert done.exit_code == (0 if told["reached"] else 4), done.output
    assert told["moving"]["nearest"] == "kite"
    assert told["broken_premises"] == []
    assert isinstance(told["contacts"], list)
