"""The protocol: what the page is answered, and what is refused to whoever isn't the page."""

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
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from viaspline.cli import cli
from viaspline.mission.document import read_document
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan
from viaspline.studio import planning
from viaspline.studio.messages import LARGEST
from viaspline.studio.page_files import PAGE

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
    modules = {path.relative_to(PAGE).as_posix() for path in PAGE.rglob("*.js")}
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

    monkeypatch.setattr(planning, "plan", endless)
    return rounds


def wait_for(rounds: list[int]) -> None:
    deadline, before = time.monotonic() + 20, rounds[0]
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


# --- whoever is not the page


@pytest.mark.parametrize(
    "origin", [None, "http://evil.example", "null", "http://127.0.0.1:1", "https://127.0.0.1"]
)
def test_pages_of_others_may_not_connect(start: START, patrol: Path, origin: str | None) -> None:
    with pytest.raises(InvalidStatus) as caught, start(patrol).client(origin=origin):
        pass
    assert caught.value.response.status_code == 403


def test_a_name_that_was_made_to_point_here_is_refused(start: START, patrol: Path) -> None:
    studio = start(patrol)
    assert fetch(studio.url, Host="evil.example")[0] == 403
    assert fetch(studio.url, Origin="http://evil.example")[0] == 403
    assert fetch(studio.url.replace("127.0.0.1", "localhost"))[0] == 200


def test_another_address_needs_its_token(start: START, patrol: Path) -> None:
    studio = start(patrol, host="0.0.0.0")
    token = studio.address.token
    assert token is not None
    assert len(token) > 20
    assert token in studio.url
    base = f"http://127.0.0.1:{studio.address.port}/"
    assert fetch(base)[0] == 403
    assert fetch(f"{base}?token=wrong")[0] == 403
    assert fetch(f"{base}?token={token}")[0] == 200
    assert fetch(f"{base}grids/x.png")[0] == 403
    with pytest.raises(InvalidStatus), studio.client():
        pass
    with studio.client(query=f"?token={token}") as client:
        assert client.hello["name"] == patrol.name


def test_a_message_that_is_too_large_closes_the_connection_with_its_code(
    start: START, patrol: Path
) -> None:
    with start(patrol).client() as client:
        # The head of a frame is enough; a client that is still sending may not hear the answer.
        client.socket.socket.sendall(b"\x81\xff" + (LARGEST + 10).to_bytes(8, "big") + b"mask")
        with pytest.raises(ConnectionClosed) as caught:
            client.hear("never")
        assert caught.value.rcvd is not None
        assert caught.value.rcvd.code == 1009


HOSTILE = [
    "",
    "no json",
    "[]",
    "5",
    "null",
    '{"type": 7}',
    '{"type": "edit"}',
    '{"type": "nothing"}',
    '{"type": "edit", "rev": 1, "changes": [[["route","start",0], NaN]]}',
    '{"type": "edit", "rev": 1, "changes": [[["route","start",0], Infinity]]}',
    '{"type": "edit", "rev": -1, "changes": []}',
    '{"type": "edit", "rev": "x", "changes": []}',
    '{"type": "edit", "rev": 1, "changes": {"a": 1}}',
    '{"type": "edit", "rev": 1, "changes": [[[], 5]]}',
    "[" * 50_000,
    '{"type": "open"}',
    '{"type": "open", "name": 5}',
    '{"type": "open", "name": "../../etc/passwd"}',
    '{"type": "open", "name": "/etc/passwd"}',
    '{"type": "save", "name": "../x.yaml"}',
    '{"type": "save", "name": "/tmp/x.yaml"}',
    '{"type": "save", "name": "x.sh"}',
    '{"type": "export", "kind": "../x"}',
    '{"type": "drive", "seed": -5}',
    '{"type": "export"}',
]


def test_hostile_messages_are_answered_and_nothing_breaks(start: START, patrol: Path) -> None:
    with start(patrol).client() as client:
        for text in HOSTILE:
            client.socket.send(text)
            message = client.hear("refused")["message"]
            assert "defect" not in message, (text, message)
        assert client.edit()["ok"]


@pytest.mark.parametrize(
    "change",
    [
        [["route", "start"], ["a", "b"]],
        [["route", "start"], None],
        [["route"], 5],
        [["world"], []],
        [["world", "known"], "x"],
        [["world", "known", 0], 7],
        [["world", "known", 0, "circle"], {"center": [1e300, 0], "radius": -1}],
        [["world", "known"], [{"map": 5}, {"map": "no.yaml"}]],
        [["world", "known"], [{"map": "../secret.map"}]],
        [["robot"], {"radius_m": "big"}],
        [["robot", "sensor"], {"lidar": []}],
        [["spline"], {"tension": [1, 2]}],
        [["route", "via"], {}],
        [["route", "start"], [1e308, 1e308]],
        [["world", "bounds"], [5, 5, 1, 1]],
    ],
)
def test_missions_of_the_wrong_kind_are_answered_with_their_faults(
    start: START, patrol: Path, change: Any
) -> None:
    (patrol.parent.parent / "secret.map").write_text("type octile\nheight 1\nwidth 1\nmap\n.\n")
    with start(patrol).client() as client:
        answer = client.edit(change)
        assert answer["ok"] is False
        assert answer["problems"][0]["text"]
        assert client.edit([[], client.hello["document"]])["ok"]


def test_maps_and_their_pictures_are_not_read_from_elsewhere(start: START, tmp_path: Path) -> None:
    root = tmp_path / "missions"
    root.mkdir()
    (tmp_path / "out.pgm").write_bytes(b"P5 2 2 255\n\xff\xff\xff\xff")
    (tmp_path / "out.map").write_text("type octile\nheight 2\nwidth 2\nmap\n..\n..\n")
    keys = "resolution: 10\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n"
    (root / "in.yaml").write_text(f"image: ../out.pgm\n{keys}")
    (root / "link.map").symlink_to(tmp_path / "out.map")
    mission = root / "m.yaml"
    mission.write_text("route: {start: [2, 2], goal: [15, 15]}\n")
    with start(mission).client() as client:
        for name in ("in.yaml", "link.map", "../out.map", str(tmp_path / "out.map")):
            answer = client.edit([["world"], {"known": [{"map": name}]}])
            assert "outside" in answer["problems"][0]["text"], name
        answer = client.edit([["world"], {}], [["route", "corridor"], {"csv": "../track.csv"}])
        assert answer["problems"][0]["path"] == ["route", "corridor", "csv"]


def test_a_scene_that_is_too_large_is_refused_and_the_old_one_kept(
    start: START, patrol: Path
) -> None:
    with start(patrol).client() as client:
        circles = [{"circle": {"center": [0, 0], "radius": 1}}] * 5001
        client.send(type="edit", rev=1, changes=[[["world", "known"], circles]])
        assert "5001" in client.hear("refused")["message"]
        assert client.edit()["ok"]


def test_one_page_does_not_see_the_edits_of_another(start: START, patrol: Path) -> None:
    studio = start(patrol)
    with studio.client() as one, studio.client() as two:
        one.edit([["route", "goal"], [60, 60]])
        assert two.edit()["spans"][-2:] == [430.0, 180.0]


def test_the_connection_needs_no_port_but_its_own(start: START, patrol: Path) -> None:
    studio = start(patrol)
    with (
        pytest.raises(InvalidStatus),
        connect(f"ws://127.0.0.1:{studio.address.port}/other", origin=studio.url.rstrip("/")),
    ):  # type: ignore[arg-type]
        pass
