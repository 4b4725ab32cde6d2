"""The protocol: what the page is answered."""

from __future__ import annotations

import base64
import json
import re
import time
import urllib.error
import urllib.request
from pathlib import Path
from typing import Any

import numba
import pytest
from click.testing import CliRunner

from viaspline.cli import cli
from viaspline.formats.yaml_document import read_document
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan
from viaspline.studio import plan_document
from viaspline.studio.page_files import LATE_MODULES, PAGE_FOLDER

EXAMPLES = Path(__file__).parents[2] / "examples"
START = Any


def fetch(url: str, **headers: str) -> tuple[int, bytes, Any]:
    try:
        with urllib.request.urlopen(urllib.request.Request(url, headers=headers)) as response:
            return response.status, response.read(), response.headers
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.read(), error.headers


def test_the_page_and_all_that_it_needs_are_served_from_the_package(
    start: START, patrol: Path
) -> None:
    studio = start(patrol)
    status, page, headers = fetch(studio.url)
    assert status == 200
    assert b"viaspline studio" in page
    assert "script-src 'self'" in headers["content-security-policy"]
    text = page.decode()
    assert "http://" not in text.replace("http://www.w3.org", "")
    assert "https://" not in text
    for name in ("style.css", "panels.css", "icon.svg", "js/main.js", "js/core/store.js"):
        assert fetch(f"{studio.url}page/{name}")[0] == 200
    every = {path.relative_to(PAGE_FOLDER).as_posix() for path in PAGE_FOLDER.rglob("*.js")}
    modules = {name for name in every if not name.startswith(LATE_MODULES)}
    assert all(fetch(f"{studio.url}page/{name}")[0] == 200 for name in every)
    assert set(re.findall(r'(?:href|src)="/page/(js/[^"]+)"', text)) == modules
    assert fetch(f"{studio.url}page/../session.py")[0] == 404
    assert fetch(f"{studio.url}page/%2e%2e/session.py")[0] == 404
    assert fetch(f"{studio.url}grids/none.png")[0] == 404


def test_an_edit_is_answered_by_the_plan_of_the_command_line(start: START, patrol: Path) -> None:
    with start(patrol).client() as client:
        assert client.hello["document"] == read_document(patrol).data
        answer = client.edit([["route", "via", 0], [92, 331]])
        assert answer["ok"]
        assert answer["certificate"]["holds"]
        assert client.ask("save", "saved", name="moved.yaml")["name"] == "moved.yaml"
        exported = client.ask("export", "exported", kind="plan.json")
    out = patrol.parent / "out"
    result = CliRunner().invoke(
        cli, ["plan", str(patrol.parent / "moved.yaml"), "--out", str(out), "--quiet"]
    )
    assert result.exit_code == 0, result.output
    assert base64.b64decode(exported["data"]) == (out / "plan.json").read_bytes()
    plan = json.loads((out / "plan.json").read_text())
    drawn = [x for span in plan["path"]["spans"] for point in span for x in point]
    assert answer["spans"] == drawn


def test_keys_that_the_page_does_not_know_survive(start: START, patrol: Path) -> None:
    with start(patrol).client() as client:
        client.edit([["footprint"], {"corners": [[1, 2]]}], [["robot", "drive"], {"wheels": 4}])
        assert "# on the map" in patrol.read_text()
        client.ask("save", "saved", name=patrol.name)
    saved = read_document(patrol).data
    assert saved["footprint"] == {"corners": [[1, 2]]}
    assert saved["robot"]["drive"] == {"wheels": 4}
    assert "# on the map" in patrol.read_text()


def test_a_mission_without_a_path_is_answered_with_the_place_and_the_remedy(
    start: START, patrol: Path
) -> None:
    with start(patrol).client() as client:
        answer = client.edit([["route", "via", 0], [120, 250]])
        assert not answer["ok"]
        (problem,) = answer["problems"]
        assert problem["path"] == ["route", "via", 0, "at"]
        (change,) = problem["changes"]
        assert change["path"] == ["route", "via", 0, "at"]
        assert client.edit([["route", "via", 0], change["value"]])["ok"]


def test_a_wall_gives_a_remedy_for_the_clearance_that_serves(start: START, tmp_path: Path) -> None:
    file = tmp_path / "gap.yaml"
    file.write_text(
        "world:\n  bounds: [0, 0, 100, 100]\n  known:\n"
        "    - {name: south, polygon: [[49, 0], [51, 0], [51, 49], [49, 49]]}\n"
        "    - {name: north, polygon: [[49, 50.5], [51, 50.5], [51, 100], [49, 100]]}\n"
        "robot: {radius_m: 0.5, clearance_m: 0.5}\nroute: {start: [10, 50], goal: [90, 50]}\n"
    )
    with start(file).client() as client:
        (problem,) = client.edit()["problems"]
        assert abs(problem["where"][0] - 50) < 2
        change = next(c for c in problem["changes"] if c["path"] == ["robot", "clearance_m"])
        assert client.edit([change["path"], change["value"]])["ok"]


def test_a_side_that_can_not_be_had_is_freed_by_its_remedy(start: START, tmp_path: Path) -> None:
    file = tmp_path / "side.yaml"
    file.write_text(
        "world:\n  bounds: [0, 0, 100, 100]\n  known:\n"
        "    - {name: pier, polygon: [[49, 0], [51, 0], [51, 60], [49, 60]], pass_on: right}\n"
        "route: {start: [10, 50], goal: [90, 50]}\n"
    )
    with start(file).client() as client:
        (problem,) = client.edit()["problems"]
        (change,) = problem["changes"]
        assert (change["path"], change["value"]) == (["world", "known", 0, "pass_on"], None)
        assert client.edit([change["path"]])["ok"]


def test_the_page_hears_of_every_kernel_that_is_compiled(start: START, patrol: Path) -> None:
    def later(x: float) -> float:
        return x + 1.0

    later.__module__ = "viaspline.kernels.later"
    with start(patrol).client() as client:
        client.edit()
        numba.njit(later)(1.0)
        while (message := client.hear("compiling"))["done"]:
            pass
        assert message["kernel"] == "later.later"


def test_edits_that_are_overtaken_are_not_planned(start: START, patrol: Path) -> None:
    with start(patrol).client() as client:
        client.edit()
        for i in range(200):
            client.send(
                type="edit", rev=100 + i, changes=[[["route", "via", 0], [90 + 0.01 * i, 330]]]
            )
        answers = [client.hear("planned")]
        while answers[-1]["rev"] != 299:
            answers.append(client.hear("planned"))
        assert len(answers) < 150
        assert [a["rev"] for a in answers] == sorted(a["rev"] for a in answers)


def endless_at_99(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Plans of which the first via point has x = 99 never end; they count their rounds."""
    rounds = [0]

    def endless(mission: Mission) -> Plan:
        while mission.route.via and mission.route.via[0].at[0] == 99:
            rounds[0] += 1
        return plan(mission)

    monkeypatch.setattr(plan_document, "plan", endless)
    return rounds


def wait_for(rounds: list[int]) -> None:
    deadline, before = time.monotonic() + 120, rounds[0]
    while rounds[0] == before:
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_a_slow_plan_is_broken_off_by_the_next_edit(
    start: START, patrol: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rounds = endless_at_99(monkeypatch)
    with start(patrol).client() as client:
        before = client.edit()
        client.send(type="edit", rev=50, changes=[[["route", "via", 0], [99, 330]]])
        wait_for(rounds)
        client.send(type="edit", rev=51, changes=[[[], client.hello["document"]]])
        assert client.hear("planned")["rev"] == 51
        client.send(type="edit", rev=52, changes=[[["route", "via", 0], [99, 330]]])
        client.revision = 60
        assert client.edit([[], client.hello["document"]])["spans"] == before["spans"]


def test_the_endless_plan_of_a_closed_page_holds_up_no_other(
    start: START, patrol: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rounds = endless_at_99(monkeypatch)
    studio = start(patrol)
    with studio.client() as client:
        client.edit()
        client.send(type="edit", rev=50, changes=[[["route", "via", 0], [99, 330]]])
        wait_for(rounds)
    with studio.client() as client:
        assert client.edit()["ok"]


def test_a_drive_is_told_with_what_is_seen_and_can_be_broken_off(
    start: START, patrol: Path
) -> None:
    with start(patrol).client() as client:
        client.edit()
        driven = client.ask("drive", "driven")
        assert driven["id"] == 7
        assert driven["reached"]
        assert [r["obstacles"] for r in driven["replans"]] == [["crate"], ["fallen tree"]]
        assert all(seen is not None for seen in driven["sight"]["seen"])
        assert base64.b64decode(
            client.ask("export", "exported", kind="run.json")["data"]
        ).startswith(b"{")
        client.edit([["route", "via", 0], [91, 330]])
        assert (
            "drive the mission first" in client.ask("export", "refused", kind="run.csv")["message"]
        )


def test_a_lidar_is_shown_by_what_its_beams_hit(start: START, tmp_path: Path) -> None:
    file = tmp_path / "room.yaml"
    file.write_text(
        "world:\n  unseen:\n    - {circle: {center: [6, 0.4], radius: 0.5}}\n"
        "robot: {radius_m: 0.2, clearance_m: 0.1, sensor: {lidar: {range_m: 4, beams: 90}}}\n"
        "route: {start: [0, 0], goal: [10, 0]}\n"
    )
    with start(file).client() as client:
        client.edit()
        sight = client.ask("drive", "driven")["sight"]
    assert sight["kind"] == "lidar"
    assert len(sight["fans"]) == len(sight["times"])
    assert len(sight["hits"]) > 5


def test_maps_are_read_and_their_pictures_served(start: START) -> None:
    studio = start(EXAMPLES / "depot-round.yaml")
    with studio.client() as client:
        answer = client.edit()
        assert answer["ok"]
        assert [grid["item"] for grid in answer["grids"]] == [0, 1]
        status, picture, _ = fetch(f"{studio.url}grids/{answer['grids'][0]['picture']}.png")
        assert status == 200
        assert picture.startswith(b"\x89PNG")
        assert "maps/depot.yaml" in client.ask("files", "files")["maps"]
