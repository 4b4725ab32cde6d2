import json
import os
import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import viaspline as vs
from viaspline.cli import cli

MISSION = vs.Mission.model_validate(
    {
        "world": {"known": [{"circle": {"center": [25, 0.5], "radius": 4}}]},
        "route": {"start": [0, 0], "goal": [50, 0]},
    }
)
TEXT = """
world:
  known:
    - circle: {center: [25, 0.5], radius: 4}
route: {start: [0, 0], goal: [50, 0]}
"""
TOWER = {"circle": {"center": [25, 0.5], "radius": 4}, "height_m": [0, 30]}
FLIGHT = vs.Mission.model_validate(
    {"world": {"known": [TOWER]}, "route": {"start": [0, 0, 10], "goal": [50, 0, 10]}}
)
PAIR = vs.Fleet.model_validate(
    {
        "fleet": [
            {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
            {"name": "b", "route": {"start": [20, -20], "goal": [20, 20]}},
        ]
    }
)
FLEET_FILES = {"fleet.json", "fleet.png", "courses.npz", "planned-fleet.yaml"}
PLAN_FILES = {"plan.json", "path.csv", "plan.png", "planned-mission.yaml"}


@cache
def planned() -> vs.Plan:
    return vs.plan(MISSION)


@cache
def flown() -> Any:
    return vs.plan(FLIGHT)


@cache
def fleet_plan() -> vs.FleetPlan:
    return vs.plan_fleet(PAIR)


SAVED: dict[str, tuple[Callable[[], Any], set[str]]] = {
    "plan": (planned, PLAN_FILES),
    "flight plan": (flown, PLAN_FILES),
    "run": (
        lambda: vs.simulate(MISSION, plan=planned()),
        PLAN_FILES | {"run.json", "run.csv", "run.png"},
    ),
    "flight": (lambda: vs.fly(flown()), PLAN_FILES | {"run.json", "run.csv", "run.png"}),
    "fleet plan": (fleet_plan, FLEET_FILES | {"a", "b"}),
    "fleet run": (lambda: vs.simulate_fleet(PAIR, plan=fleet_plan()), {"run.json"}),
}


@cache
def saved(name: str) -> tuple[Any, set[str]]:
    made, files = SAVED[name]
    return made(), files


@pytest.mark.parametrize("name", SAVED)
def test_what_is_saved_is_said_and_the_same_every_time_in_any_folder(
    name: str, tmp_path: Path
) -> None:
    value, files = saved(name)
    folder, other = tmp_path / "deep" / "patrol", tmp_path / "another"
    written = value.save(folder)
    assert {path.name for path in folder.iterdir()} == files
    assert {path.relative_to(folder).parts[0] for path in written} == files
    for path in written:
        if path.suffix == ".json":
            assert json.loads(path.read_text())
    shutil.copytree(folder, other)
    for path in filter(Path.is_file, other.rglob("*")):
        path.write_text("from before")
    again = value.save(str(other))
    assert [path.relative_to(other) for path in again] == [
        path.relative_to(folder) for path in written
    ]
    assert contents(again, other) == contents(written, folder)


def contents(written: list[Path], folder: Path) -> dict[Path, bytes]:
    return {path.relative_to(folder): path.read_bytes() for path in written if path.is_file()}


def test_a_plan_is_called_as_is_asked(tmp_path: Path) -> None:
    planned().save(tmp_path, name="round of the yard")
    assert (
        json.loads((tmp_path / "plan.json").read_text())["mission"]["name"] == "round of the yard"
    )
    with pytest.raises(vs.GeometryError, match="name is of the class"):
        planned().save(tmp_path, name=5)  # type: ignore[arg-type]


@pytest.mark.parametrize("command", ["plan", "run"])
def test_the_command_line_writes_the_same_files(command: str, tmp_path: Path) -> None:
    file, out = tmp_path / "patrol.yaml", tmp_path / "cli" / "patrol"
    file.write_text(TEXT)
    done = CliRunner().invoke(cli, [command, str(file), "--out", str(out), "--quiet"])
    assert done.exit_code == 0, done.output
    made = saved("plan" if command == "plan" else "run")[0]
    written = made.save(tmp_path / "api", name="patrol")
    assert {path.name for path in out.iterdir()} - {"timing.json"} == {p.name for p in written}
    for path in written:
        assert path.read_bytes() == (out / path.name).read_bytes(), path.name
    assert vs.load_plan(out) == planned()


def test_a_folder_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for value, _ in map(saved, SAVED):
        with pytest.raises(vs.OutputError, match="is a file, not a folder"):
            value.save(tmp_path / "file" / "patrol")
        with pytest.raises(vs.GeometryError, match="path is of the class"):
            value.save(5)
    if os.geteuid() != 0:
        tmp_path.chmod(0o500)
        with pytest.raises(vs.OutputError, match="can't be written"):
            planned().save(tmp_path / "patrol")


def test_a_single_file_is_for_those_who_write_such_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for value, _ in map(saved, SAVED):
        if not isinstance(value, vs.Plan | vs.SpatialPlan):
            with pytest.raises(vs.OutputError, match="isn't written as such a file; give a folder"):
                value.save(tmp_path / "patrol.kml")

    with pytest.raises(vs.OutputError, match="origin"):
        planned().save(tmp_path / "patrol.kml")
    for name in ("patrol.plan", "patrol.geojson", "patrol.csv", "patrol.path.yaml"):
        (written,) = planned().save(tmp_path / name, origin=(47.4, 8.5))
        assert written.stat().st_size > 200
    (tmp_path / "old.csv").mkdir()  # a folder, whatever it is called
    assert planned().save(tmp_path / "old.csv")
