"""A fleet is opened, edited, planned and saved over the studio's connection."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.plan_fleet import plan_fleet
from viaspline.formats.load import load
from viaspline.formats.yaml_document import read_document
from viaspline.mission.fleet.fleet import Fleet

Start = Callable[..., Any]

TEXT = """\
# three carts and what stands between them
world:
  bounds: [-10, -30, 60, 30]
  known:   # on the map
    - {name: rock, circle: {center: [10, 4], radius: 2}}
separation_m: 1.0   # between bodies
robots:
  cart: {radius_m: 0.5, clearance_m: 0.3}
fleet:
  - {name: east, robot: cart, route: {start: [0, 0], via: [[12, 0]], goal: [40, 0]}}   # first
  - {name: north, robot: cart, priority: 2, route: {start: [20, -20], goal: [20, 20]}}
  - {name: third, robot: cart, route: {start: [0, -10], goal: [45, -10]}, rest: leave}
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "fleet.yaml"
    path.write_text(TEXT)
    return path


def planned(path: Path) -> FleetPlan:
    fleet = load(path)
    assert isinstance(fleet, Fleet)
    return plan_fleet(fleet)


def by_name(answer: dict[str, Any]) -> dict[str, dict[str, Any]]:
    return {robot["name"]: robot for robot in answer["fleet"]["robots"]}


def test_every_robot_is_told_with_its_path_its_law_and_the_proof(start: Start, file: Path) -> None:
    plan = planned(file)
    with start(file).client() as client:
        assert client.hello["document"] == read_document(file).data
        answer = client.edit()
    assert answer["ok"]
    assert answer["fleet"]["served"]
    proof = answer["fleet"]["certificate"]
    assert proof["separation"] == plan.certificate.separation
    assert proof["separation"] >= proof["required"] == 1.0
    assert tuple(proof["pair"]) == plan.certificate.pair
    robots = by_name(answer)
    assert list(robots) == ["east", "north", "third"]
    for name, own in plan.plans.items():
        assert robots[name]["path"]["length"] == own.path.length
        assert robots[name]["law"]["times"][0] == round(own.trajectory.start_time, 4)
        assert robots[name]["law"]["times"][-1] == round(own.trajectory.end_time, 4)
    assert robots["third"]["leaves"]


def test_who_waits_for_whom_is_told_with_its_time(start: Start, file: Path) -> None:
    with start(file).client() as client:
        waits = client.edit()["fleet"]["waits"]
    assert ("east", "north") in {(wait["robot"], wait["waits_for"]) for wait in waits}
    for wait in waits:
        assert wait["seconds"] > 0
        assert wait["until"] - wait["from"] == pytest.approx(wait["seconds"], abs=2e-3)


def test_of_a_drag_only_what_is_new_is_told(start: Start, file: Path) -> None:
    with start(file).client() as client:
        client.edit()
        answer = client.edit([["fleet", 0, "route", "via", 0], [12, -1]])
        client.ask("save", "saved", name="moved.yaml")
    robots = by_name(answer)
    assert robots["east"]["path"]["vias"][1][1:3] == [12, -1]
    assert "path" not in robots["north"]
    assert "path" not in robots["third"]
    assert "law" not in robots["north"]  # who has priority drives as before
    plan = planned(file.parent / "moved.yaml")
    assert robots["east"]["law"]["times"][-1] == round(plan.plans["east"].trajectory.end_time, 4)


def test_another_page_is_told_everything(start: Start, file: Path) -> None:
    studio = start(file)
    for _ in range(2):
        with studio.client() as client:
            robots = by_name(client.edit())
            assert all("path" in robot and "law" in robot for robot in robots.values())


def test_a_fault_names_its_robot_and_what_was_told_before_is_not_told_again(
    start: Start, file: Path
) -> None:
    with start(file).client() as client:
        client.edit()
        faulty = client.edit([["fleet", 0, "route", "via", 0], [10, 4]])
        assert not faulty["ok"]
        assert faulty["fleet"] is None
        assert faulty["problems"][0]["path"][:5] == ["fleet", 0, "route", "via", 0]
        again = client.edit([["fleet", 0, "route", "via", 0], [12, 0]])
    assert again["ok"]
    assert all("path" not in robot for robot in again["fleet"]["robots"])


def test_who_is_not_served_is_told_with_the_reason(start: Start, file: Path) -> None:
    wall = {"name": "wall", "polygon": [[30, -31], [32, -31], [32, 31], [30, 31]]}
    with start(file).client() as client:
        answer = client.edit([["world", "known", 1], wall])
    assert answer["ok"]
    assert not answer["fleet"]["served"]
    robots = by_name(answer)
    for name in ("east", "third"):
        assert robots[name]["missing"]["outcome"] == "refused"
        assert "wall" in robots[name]["missing"]["reason"]
        assert robots[name]["path"] is None
    assert robots["north"]["missing"] is None


def test_what_priority_leaves_out_is_served_once_nobody_drags(start: Start, file: Path) -> None:
    there, back = {"start": [0, 0], "goal": [40, 0]}, {"start": [40, 0], "goal": [0, 0]}
    members = [{"name": "there", "route": there}, {"name": "back", "route": back}]
    with start(file).client() as client:
        first = client.edit([["fleet"], members], [["separation_m"], 0.5])
        assert not first["fleet"]["served"]
        assert not first["fleet"]["is_whole"]  # the page says that more is tried
        then = client.hear("planned")
        client.ask("save", "saved", name="swapped.yaml")
    assert then["rev"] == first["rev"]
    assert then["fleet"]["is_whole"]
    plan = planned(file.parent / "swapped.yaml")
    assert then["fleet"]["served"] == plan.served
    assert {name for name, one in by_name(then).items() if not one["missing"]} == set(plan.plans)


def test_a_saved_fleet_keeps_its_comments(start: Start, file: Path) -> None:
    with start(file).client() as client:
        client.edit(
            [["fleet", 0, "route", "via", 0], [12, -1]],
            [["fleet", 3], {"name": "r4", "robot": "cart", "route": {"start": [0, 20]}}],
            [["fleet", 3, "route", "goal"], [9, 20]],
        )
        client.ask("save", "saved", name=file.name)
    text = file.read_text()
    for comment in ("# three carts", "# on the map", "# between bodies", "# first"):
        assert comment in text
    assert "via: [[12, -1]]" in text
    assert "  - {name: r4, robot: cart, route: {start: [0, 20], goal: [9, 20]}}" in text


def test_a_fleet_is_saved_as_yaml_only(start: Start, file: Path) -> None:
    with start(file).client() as client:
        refused = client.ask("save", "refused", name="fleet.plan")
    assert "fleet.yaml" in refused["message"]


def test_the_files_of_robots_are_read_and_named_from_where_the_fleet_is_saved(
    start: Start, file: Path
) -> None:
    own = {"robot": {"radius_m": 0.4}, "route": {"start": [0, 25], "goal": [40, 26]}}
    (file.parent / "own.yaml").write_text(
        "robot: {radius_m: 0.4}\nroute: {start: [0, 25], goal: [40, 26]}\n"
    )
    (file.parent / "sub").mkdir()
    with start(file).client() as client:
        client.edit()
        answer = client.edit([["fleet", 3], {"name": "own", "mission": "own.yaml"}])
        saved = client.ask("save", "saved", name="sub/fleet.yaml")
    assert by_name(answer)["own"]["path"]["length"] == pytest.approx(40.0125, abs=1e-3)
    assert answer["missions"] == {"own.yaml": own}
    assert saved["document"]["fleet"][3]["mission"] == "../own.yaml"


def test_no_mission_is_read_from_outside_of_the_folder(start: Start, tmp_path: Path) -> None:
    (tmp_path / "secret.yaml").write_text("route: {start: [0, 0], goal: [9, 0]}\n")
    inner = tmp_path / "inner"
    inner.mkdir()
    file = inner / "fleet.yaml"
    file.write_text("fleet:\n  - {name: r1, mission: ../secret.yaml}\n")
    with start(file).client() as client:
        answer = client.edit()
    assert not answer["ok"]
    (problem,) = answer["problems"]
    assert problem["path"] == ["fleet", 0, "mission"]
    assert "outside of the studio's folder" in problem["text"]


def test_the_plan_of_one_robot_can_be_taken_away(start: Start, file: Path) -> None:
    with start(file).client() as client:
        client.edit()
        name = client.ask("export", "exported", kind="path.csv", robot="north")["name"]
        nobody = client.ask("export", "refused", kind="path.csv", robot="nobody")["message"]
    assert name == "fleet-north-path.csv"
    assert "no path" in nobody


def test_what_is_asked_of_one_robot_is_refused_for_a_fleet(start: Start, file: Path) -> None:
    with start(file).client() as client:
        client.edit()
        assert "this is a fleet" in client.ask("advise", "refused")["message"]
