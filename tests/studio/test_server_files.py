"""The protocol: missions are opened and saved as files of every kind."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from viaspline.cli import cli
from viaspline.formats.yaml_document import read_document

EXAMPLES = Path(__file__).parents[2] / "examples"
START = Any


def test_plans_and_waypoints_of_others_are_opened_and_saved_as_yaml(
    start: START, tmp_path: Path
) -> None:
    (tmp_path / "survey.plan").write_text((EXAMPLES / "fence-survey.plan").read_text())
    with start(tmp_path).client() as client:
        opened = client.ask("open", "opened", name="survey.plan")
        assert opened["warnings"]
        assert client.edit()["ok"]
        exported = client.ask("export", "exported", kind="plan.json")
        assert "survey.yaml" in client.ask("save", "refused", name="survey.json")["message"]
        client.ask("save", "saved", name="survey.yaml")
    out = tmp_path / "out"
    result = CliRunner().invoke(
        cli, ["plan", str(tmp_path / "survey.yaml"), "--out", str(out), "-q"]
    )
    assert result.exit_code == 0, result.output
    assert base64.b64decode(exported["data"]) == (out / "plan.json").read_bytes()


def test_a_fleet_in_json_is_refused_with_what_to_call_it(start: START, tmp_path: Path) -> None:
    fleet = '{"fleet": [{"name": "r1", "route": {"start": [0, 0], "goal": [9, 0]}}]}'
    (tmp_path / "fleet.json").write_text(fleet)
    with start(tmp_path).client() as client:
        message = client.ask("open", "refused", name="fleet.json")["message"]
    assert message == "'fleet.json' is a fleet in JSON: call it 'fleet.yaml'"


def test_missions_are_saved_as_plans_and_waypoints_with_what_they_can_not_carry(
    start: START, patrol: Path
) -> None:
    folder = patrol.parent
    with start(patrol).client() as client:
        assert client.hello["origin"] is None
        for name in ("patrol.plan", "patrol.waypoints", "patrol.txt"):
            assert "origin" in client.ask("save", "refused", name=name)["message"]
            assert not (folder / name).exists()
        for words in ("north", "1", "1, 2, 3", "nan, 8", "91, 8", "0, 0"):
            message = client.ask("save", "refused", name="patrol.plan", origin=words)["message"]
            assert "origin" in message
        assert client.ask("save", "refused", name="../x.plan", origin="47, 8")
        saved = client.ask("save", "saved", name="patrol.plan", origin="47, 8")
        assert saved["origin"] == [47, 8]
        assert any(line.startswith("unseen obstacle: crate") for line in saved["lost"])
        assert client.ask("save", "exists", name="patrol.plan")["lost"] == []
        assert client.ask("save", "saved", name="patrol.txt")["lost"]  # the origin is remembered
        client.edit([["robot", "wheels"], 4])
        message = client.ask("save", "refused", name="new.plan")["message"]
        assert "sound mission" in message
    with start(folder).client() as client:
        opened = client.ask("open", "opened", name="patrol.plan")
        assert (opened["origin"], opened["warnings"]) == ([47, 8], [])
        was = read_document(patrol).data["route"]["start"]
        start_at = opened["document"]["route"]["start"]
        assert start_at == pytest.approx(was if isinstance(was, list) else was["at"], abs=1e-3)


def test_a_plan_that_can_be_carried_whole_is_saved_under_its_own_name(
    start: START, tmp_path: Path
) -> None:
    (tmp_path / "a.yaml").write_text("route: {start: [5, 0], goal: [90, 0]}\n")
    with start(tmp_path / "a.yaml").client() as client:
        client.edit()
        saved = client.ask("save", "saved", name="a.plan", origin="47, 8")
        assert saved["lost"] == []
        client.edit([["route", "goal"], [80, 5]])
        client.ask("save", "saved", name="a.plan")
        opened = client.ask("open", "opened", name="a.plan")
        assert opened["document"]["route"]["goal"] == pytest.approx([80, 5], abs=1e-3)


def test_what_a_plan_of_others_holds_is_replaced_only_when_asked(
    start: START, tmp_path: Path
) -> None:
    survey = tmp_path / "survey.plan"
    survey.write_text((EXAMPLES / "fence-survey.plan").read_text())
    before = survey.read_text()
    with start(tmp_path).client() as client:
        opened = client.ask("open", "opened", name="survey.plan")
        client.edit()
        assert client.ask("save", "exists", name="survey.plan")["lost"] == opened["warnings"]
        assert survey.read_text() == before
        client.ask("save", "saved", name="survey.plan", replace=True)
        again = client.ask("open", "opened", name="survey.plan")
    for a, b in zip(
        opened["document"]["route"]["via"], again["document"]["route"]["via"], strict=True
    ):
        a, b = (p["at"] if isinstance(p, dict) else p for p in (a, b))
        assert a == pytest.approx(b, abs=1e-3)


def test_a_file_that_is_there_is_replaced_only_when_asked(start: START, patrol: Path) -> None:
    other = patrol.parent / "other.yaml"
    other.write_text("route: {start: [0, 0], goal: [9, 0]}\n")
    with start(patrol).client() as client:
        assert client.ask("save", "exists", name="other.yaml")["name"] == "other.yaml"
        assert "goal: [9, 0]" in other.read_text()
        client.ask("save", "saved", name="other.yaml", replace=True)
    assert "pump-house" in other.read_text()


def test_maps_keep_their_place_when_a_mission_is_saved_elsewhere(
    start: START, tmp_path: Path
) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "m.map").write_text("type octile\nheight 2\nwidth 2\nmap\n..\n..\n")
    (tmp_path / "a.yaml").write_text(
        "world: {known: [{map: m.map, resolution_m: 10}]}\nroute: {start: [2, 2], goal: [15, 15]}\n"
    )
    with start(tmp_path / "a.yaml").client() as client:
        assert client.edit()["ok"]
        saved = client.ask("save", "saved", name="sub/b.yaml")
        assert saved["document"]["world"]["known"][0]["map"] == "../m.map"
        assert client.edit([["route", "start"], [2, 3]])["ok"]


def test_two_pages_on_one_mission_plan_each_their_own_and_lose_nothing(
    start: START, patrol: Path
) -> None:
    studio = start(patrol)
    with studio.client() as one, studio.client() as other:
        places = {"one": [92, 331], "other": [95, 320]}
        for client, place in zip((one, other), places.values(), strict=True):
            client.send(type="edit", rev=1, changes=[[["route", "via", 0], place]])
        drawn = [client.hear("planned")["spans"] for client in (one, other)]
        assert [row[6:8] for row in drawn] == list(places.values())
        assert one.ask("save", "saved", name=patrol.name)["name"] == patrol.name
        asked = other.ask("save", "exists", name=patrol.name)
        assert asked["lost"] == ["what was saved there since it was opened here"]
        assert "[92, 331]" in patrol.read_text()
        assert other.ask("save", "saved", name=patrol.name, replace=True)["name"] == patrol.name
        assert "[95, 320]" in patrol.read_text()
        assert other.ask("save", "saved", name=patrol.name)["name"] == patrol.name


def test_the_path_is_exported_to_formats_of_others_with_what_is_proven_of_it(
    start: START, patrol: Path, tmp_path: Path
) -> None:
    with start(patrol).client() as client:
        assert client.edit()["ok"]
        for kind in ("path.geojson", "path.kml"):
            refused = client.ask("export", "refused", kind=kind)
            assert "give the origin" in refused["message"]
            done = client.ask("export", "exported", kind=kind, origin="47, 8")
            assert done["name"] == f"{patrol.stem}-{kind}"
            assert "m clear" in done["told"][0]
        done = client.ask("export", "exported", kind="path.yaml")
        assert base64.b64decode(done["data"]).startswith(f"# {patrol.stem}: ".encode())
        plan = client.ask("export", "exported", kind="path.plan", origin="47, 8")
    file = tmp_path / "exported.plan"
    file.write_bytes(base64.b64decode(plan["data"]))
    checked = CliRunner().invoke(cli, ["check", str(file)])
    assert checked.exit_code == 0, checked.output
