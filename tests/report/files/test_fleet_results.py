"""What a fleet's plan leaves in its folder, and says on the terminal."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console, RenderableType

import viaspline as vs
from viaspline.errors import OutputError
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.not_served import NotServed
from viaspline.report.earlier_robots import earlier_robots, forget_robots
from viaspline.report.files.fleet_json import fleet_json
from viaspline.report.files.fleet_results import (
    ROBOT_FILES,
    check_robot_folders,
    fleet_contents,
    folder_names,
    forget_earlier,
    write_robots,
)
from viaspline.report.fleet_summary import fleet_plan_remarks, fleet_remarks, fleet_summary
from viaspline.report.terminal.fleet_tables import fleet_tables, unserved_lines

CROSSING: dict[str, Any] = {
    "separation_m": 1,
    "robots": {"cart": {"radius_m": 0.5}},
    "fleet": [
        {"name": "east", "robot": "cart", "route": {"start": [0, 0], "goal": [40, 0]}},
        {"name": "north/1", "robot": "cart", "rest": "leave", "depart_s": 1,
         "route": {"start": [20, -20], "goal": [20, 20]}},
    ],
}  # fmt: skip


@pytest.fixture(scope="module")
def planned() -> FleetPlan:
    return vs.plan_fleet(vs.Fleet.model_validate(CROSSING))


@pytest.fixture(scope="module")
def half_served(planned: FleetPlan) -> FleetPlan:
    """The plan as it would be if the second robot were not served."""
    missing = NotServed("north/1", "refused", "'east' rests on its goal", "let 'east' leave")
    only = {"east": planned.plans["east"]}
    return replace(planned, plans=only, not_served=(missing,), precedences=())


def text_of(table: RenderableType) -> str:
    console = Console(width=160, record=True, file=StringIO())
    console.print(table)
    return console.export_text()


def test_fleet_json_says_who_drives_when_and_what_is_proven(planned: FleetPlan) -> None:
    data = json.loads(fleet_contents(planned, "yard")["fleet.json"])
    assert data["fleet"]["name"] == "yard"
    assert data["served"] is True
    east, north = data["robots"]
    assert (east["plan"], north["plan"]) == ("east/plan.json", "north_1/plan.json")
    assert north["departs_s"] >= 1.0
    for robot in (east, north):
        plan = planned.plans[robot["name"]]
        assert robot["arrives_s"] == pytest.approx(plan.trajectory.end_time)
        assert robot["late_s"] >= 0.0
    certificate = data["certificate"]
    assert set(certificate["pair"]) == {"east", "north/1"}
    assert certificate["separation_m"] >= 1.0 - 1e-6
    (order,) = data["precedences"]
    assert {order["first"], order["second"]} == {"east", "north/1"}
    assert data["refused"] == []


def test_the_same_plan_gives_the_same_bytes(planned: FleetPlan) -> None:
    again = vs.plan_fleet(vs.Fleet.model_validate(CROSSING))
    assert fleet_contents(again, "yard") == fleet_contents(planned, "yard")


def test_each_robot_has_a_folder_with_its_path_by_the_clock_of_the_fleet(
    planned: FleetPlan, tmp_path: Path
) -> None:
    shares: list[float] = []
    folders = write_robots(planned, tmp_path, shares.append)
    assert [folder.name for folder in folders] == ["east", "north_1"]
    assert shares == sorted(shares)
    for folder in folders:
        assert {file.name for file in folder.iterdir()} == {"plan.json", "path.csv"}
    plan = planned.plans["north/1"]
    rows = list(csv.DictReader((tmp_path / "north_1" / "path.csv").read_text().splitlines()))
    assert float(rows[0]["time_s"]) == pytest.approx(plan.trajectory.start_time, abs=1e-5)
    assert float(rows[-1]["time_s"]) == pytest.approx(plan.trajectory.end_time, abs=1e-5)
    assert (
        json.loads((tmp_path / "north_1" / "plan.json").read_text())["mission"]["name"] == "north/1"
    )


def test_robots_that_are_not_served_are_named_and_the_others_written(
    half_served: FleetPlan, tmp_path: Path
) -> None:
    data = json.loads(fleet_json(half_served, "yard", folder_names(["east", "north/1"])))
    assert data["served"] is False
    assert data["robots"][1]["plan"] is None
    assert data["refused"] == [
        {"name": "north/1", "outcome": "refused", "reason": "'east' rests on its goal",
         "remedy": "let 'east' leave", "in_the_way": [], "at": None}
    ]  # fmt: skip
    assert [folder.name for folder in write_robots(half_served, tmp_path, print)] == ["east"]
    lines = unserved_lines(half_served)
    assert lines == [
        "1 of 2 robots is not served",
        "  there is no plan for 'north/1': 'east' rests on its goal",
        "    remedy: let 'east' leave",
    ]


def test_the_tables_say_what_is_proven_and_who_waits(
    planned: FleetPlan, half_served: FleetPlan
) -> None:
    text = text_of(fleet_tables(planned, "yard"))
    assert "2 of 2" in text
    assert "(asked 1.00 m)" in text
    assert "later than alone" in text
    assert "1 of 2" in text_of(fleet_tables(half_served, "yard"))
    nobody = replace(half_served, plans={})
    assert "0 of 2" in text_of(fleet_tables(nobody, "yard"))


def test_a_fleet_in_a_few_words() -> None:
    fleet = vs.Fleet.model_validate(CROSSING)
    lines = dict(fleet_summary(fleet))
    assert lines["robots"] == "2 robots, 1 leaving at the goal, 1 departing later"
    assert lines["kinds"].startswith("cart (2): of radius 0.5 m")
    assert lines["apart"] == "1 m between any two bodies"
    assert lines["rounds"] == "40.0 m from point to point in the mean"
    assert len(fleet_plan_remarks(fleet)) == 1


def test_what_may_not_be_meant_is_said_once_for_each_kind() -> None:
    kinds = {"cart": {"sensor": {"range_m": 5}}, "lift": {}}
    zone = {"polygon": [[5, -1], [8, -1], [8, 1]], "max_speed_mps": 9}
    fleet = vs.Fleet.model_validate({**CROSSING, "robots": kinds, "world": {"speed_zones": [zone]}})
    found = fleet_remarks(fleet)
    assert len(found) == 3
    assert "no robot is of the kind 'lift'" in found
    assert any("sensor" in words for words in found)


@given(st.lists(st.text(min_size=1, max_size=12), max_size=30, unique=True))
def test_folders_have_names_of_their_own_that_lead_nowhere_else(robots: list[str]) -> None:
    names = folder_names(robots)
    assert list(names) == robots
    assert len({name.casefold() for name in names.values()}) == len(robots)
    for name in names.values():
        assert name not in ("", ".", "..", "fleet.json", "timing.json")
        assert "/" not in name
        assert "\\" not in name
        assert name == Path(name).name


def test_a_file_in_the_place_of_a_folder_is_told_before_the_work(tmp_path: Path) -> None:
    (tmp_path / "east").write_text("")
    with pytest.raises(OutputError, match="is a file where a folder has to go"):
        check_robot_folders(tmp_path, ["west", "east"])
    check_robot_folders(tmp_path, ["west"])


def test_what_never_ends_is_told_with_its_period_and_proven_for_all_time(tmp_path: Path) -> None:
    fleet = vs.Fleet.model_validate(
        {
            "fleet": [
                {"name": "guard", "route": {"start": [0, 0], "via": [[9, 0], [9, 9]],
                                            "closed": True}},
                {"name": "guest", "route": {"start": [4, -9], "goal": [4, 19]}},
            ]
        }
    )  # fmt: skip
    plan = vs.plan_fleet(fleet)
    data = json.loads(fleet_json(plan, "yard", folder_names(["guard", "guest"])))
    assert plan.patrols is not None
    assert data["certificate"]["for"] == "all time"
    assert data["certificate"]["period_s"] == data["patrols"]["period_s"] == plan.patrols.period
    (robot,) = data["patrols"]["robots"]
    assert (robot["name"], robot["begins_s"], robot["laps_a_period"]) == ("guard", 0.0, 1)
    write_robots(plan, tmp_path, lambda _share: None)
    written = json.loads((tmp_path / "guard" / "plan.json").read_text())
    assert len(written["path"]["spans"]) % robot["laps_planned"] == 0
    words = " ".join(words for _, words in fleet_summary(fleet))
    assert "1 on patrols that never end" in words
    console = Console(width=120, record=True, file=StringIO())
    console.print(fleet_tables(plan, "yard"))
    assert "proven for all time" in console.export_text()


def test_robots_of_an_earlier_run_that_have_no_plan_now_are_removed(
    planned: FleetPlan, half_served: FleetPlan, tmp_path: Path
) -> None:
    write_robots(planned, tmp_path, lambda _: None)
    text = fleet_json(planned, "yard", folder_names(["east", "north/1"]))
    (tmp_path / "fleet.json").write_text(text)
    (tmp_path / "mine").mkdir()
    earlier = earlier_robots(tmp_path)
    assert earlier == {"east", "north_1"}
    written = write_robots(half_served, tmp_path, lambda _: None)
    assert forget_earlier(tmp_path, earlier, written) == ["north_1"]
    assert {one.name for one in tmp_path.iterdir()} == {"east", "mine", "fleet.json"}
    assert {one.name for one in (tmp_path / "east").iterdir()} == set(ROBOT_FILES)


def test_what_somebody_else_put_into_a_robots_folder_stays(tmp_path: Path) -> None:
    (tmp_path / "r1").mkdir()
    for name in ("plan.json", "path.csv", "notes.txt"):
        (tmp_path / "r1" / name).write_text("")
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "plan.json").write_text("")
    (tmp_path / "link").symlink_to(tmp_path / "elsewhere")
    assert forget_robots(tmp_path, ["r1", "link", "never"], ROBOT_FILES) == ["r1"]
    assert [one.name for one in (tmp_path / "r1").iterdir()] == ["notes.txt"]
    assert (tmp_path / "elsewhere" / "plan.json").exists()


@pytest.mark.parametrize(
    "text",
    [
        "", "[]", "{", "null", '{"robots": 5}', '{"robots": [5, null, {"plan": 7}]}',
        '{"robots": [{"plan": "../plan.json"}, {"plan": "/etc/plan.json"}]}',
        '{"robots": [{"plan": "a/b/plan.json"}, {"plan": "plan.json"}, {"plan": null}]}',
        '{"robots": [{"plan": "/plan.json"}, {"plan": "./plan.json"}]}',
        '{"robots": [{"plan": "a\\\\b/plan.json"}]}',
        "[" * 100_000,
    ],
)  # fmt: skip
def test_a_fleet_json_that_is_not_ours_names_no_folder(tmp_path: Path, text: str) -> None:
    (tmp_path / "fleet.json").write_text(text)
    assert earlier_robots(tmp_path) == frozenset()
    assert earlier_robots(tmp_path / "nothing") == frozenset()
