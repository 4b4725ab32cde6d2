"""The protocol: what is refused to whoever isn't the page, and to what no page would send."""

from __future__ import annotations

import urllib.error
import urllib.request
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from viaspline.studio.page_messages import MAX_MESSAGE_BYTES

START = Any


def fetch(url: str, **headers: str) -> tuple[int, bytes, Any]:
    try:
        with urllib.request.urlopen(urllib.request.Request(url, headers=headers)) as response:
            return response.status, response.read(), response.headers
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.read(), error.headers


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
        client.socket.socket.sendall(
            b"\x81\xff" + (MAX_MESSAGE_BYTES + 10).to_bytes(8, "big") + b"mask"
        )
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
        [["world", "fences"], [5]],
        [["world", "fences"], [[[0, 0], [1, 1]]]],
        [["world", "speed_zones"], {"polygon": 1}],
        [["world", "speed_zones"], [{"polygon": [[0, 0], [9, 0], [9, 9]], "max_speed_mps": -1}]],
        [["robot"], {"footprint": [[0, 0], [1, 0]]}],
        [["robot"], {"footprint": "0 0 1 1 2 2"}],
        [["robot", "drive"], {"differential": {"track_m": 1e308}}],
        [["robot", "drive"], {"ackermann": {}, "differential": {}}],
        [["route", "corridor"], {"left_m": 1e300, "right_m": -1}],
        [["route", "laps"], 1.5],
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
