"""The protocol: where on earth a mission lies, and the picture under it."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import PIL.Image
import pytest

from viaspline.formats.studio_origin import STUDIO_ENDING

MISSION = "route: {start: [0, 0], goal: [90, 0]}\n"
Studio = Any


@pytest.fixture
def site(tmp_path: Path) -> Path:
    """A folder with a mission and pictures, beside one that is none of the studio's business."""
    root = tmp_path / "site"
    (root / "rounds").mkdir(parents=True)
    (root / "a.yaml").write_text(MISSION)
    PIL.Image.new("RGB", (40, 20), (10, 200, 30)).save(root / "site.png")
    PIL.Image.new("RGB", (9, 9)).save(tmp_path / "secret.png")
    (root / "link.png").symlink_to(tmp_path / "secret.png")
    return root


@pytest.fixture
def client(start: Callable[..., Any], site: Path) -> Iterator[Any]:
    studio = start(site / "a.yaml")
    with studio.client() as client:
        client.studio = studio
        yield client


def test_a_picture_is_put_under_a_mission_kept_and_never_planned_with(
    client: Any, site: Path
) -> None:
    assert client.hear("background")["background"] is None
    before = client.edit()
    asked = client.ask("pictures", "pictures")
    assert asked["pictures"] == ["site.png"]  # not what a link leads to
    facts = client.ask("picture", "picture", picture="site.png")
    assert (facts["size"], facts["place"]) == ([40, 20], None)
    wanted = {"picture": "site.png", "corners": [[-10, -5], [100, 50]], "opacity": 0.4}
    answer = client.ask("remember", "remembered", background=wanted)
    found = answer["background"]
    assert found["sheet"] == pytest.approx([-10, 110, 0, 50, 0, -55], abs=1e-9)
    assert json.loads((site / f"a.yaml{STUDIO_ENDING}").read_text())["background"]["opacity"] == 0.4
    assert (site / "a.yaml").read_text() == MISSION
    with urlopen(f"{client.studio.url}backgrounds/{found['name']}") as reply:
        assert reply.headers["content-type"] == "image/png"
        assert PIL.Image.open(reply).size == (40, 20)
    after = client.edit()
    assert {**after, "rev": 0, "ms": 0} == {**before, "rev": 0, "ms": 0}
    client.ask("save", "saved", name="rounds/b.yaml")
    moved = json.loads((site / "rounds" / f"b.yaml{STUDIO_ENDING}").read_text())
    assert moved["background"]["picture"] == "../site.png"
    with client.studio.client() as again:
        assert again.hear("background")["background"] is None  # not that of the mission before
        assert again.hear("background")["background"] == found


def test_an_origin_is_kept_for_a_file_that_can_not_say_its_own(client: Any, site: Path) -> None:
    degrees = {"picture": "site.png", "grid": "degrees", "corners": [[47, 8], [47.001, 8.001]]}
    refused = client.ask("remember", "refused", background=degrees)
    assert "origin" in refused["message"]
    assert not (site / f"a.yaml{STUDIO_ENDING}").exists()
    for words in ("north", "91, 8", "0, 0"):
        assert "origin" in client.ask("remember", "refused", origin=words)["message"]
    assert client.ask("remember", "remembered", origin="47, 8")["origin"] == [47, 8]
    answer = client.ask("remember", "remembered", background=degrees)
    assert answer["background"]["sheet"][3] == pytest.approx(111.2, abs=0.2)
    assert client.ask("open", "opened", name="a.yaml")["origin"] == [47, 8]
    client.ask("save", "saved", name="a.plan")
    assert client.ask("open", "opened", name="a.plan")["origin"] == [47, 8]
    assert "itself" in client.ask("remember", "refused", origin="48, 8")["message"]
    client.ask("save", "saved", name="c.yaml")
    assert client.ask("open", "opened", name="c.yaml")["origin"] == [47, 8]


@pytest.mark.parametrize(
    "name",
    ["../secret.png", "link.png", "/etc/hostname", "", "nothing.png", "rounds", "a.yaml"],
)
def test_no_picture_is_read_from_elsewhere(client: Any, tmp_path: Path, name: str) -> None:
    asked = client.ask("picture", "refused", picture=name)["message"]
    corners = [[0, 0], [9, 9]]
    put = client.ask("remember", "refused", background={"picture": name, "corners": corners})
    assert str(tmp_path) not in asked + put["message"]
    assert "defect" not in asked + put["message"]


def test_a_picture_that_has_gone_is_told_of_and_the_mission_opens(client: Any, site: Path) -> None:
    wanted = {"picture": "site.png", "corners": [[0, 0], [10, 5]]}
    client.ask("remember", "remembered", background=wanted)
    (site / "site.png").unlink()
    client.send(type="open", id=7, name="a.yaml")
    assert client.hear("opened")["name"] == "a.yaml"
    while (told := client.hear("background")["background"]) is None:
        pass
    problem = told["problem"]
    assert problem.startswith("site.png: there is no such file")


def test_an_origin_that_was_typed_to_save_a_copy_is_kept(client: Any, site: Path) -> None:
    client.ask("save", "saved", name="a.plan", origin="47, 8")  # it becomes the mission's file
    client.ask("open", "opened", name="a.yaml")
    named = [["route", "goal"], {"at": [90, 0], "name": "quay"}]  # which a plan can't carry
    assert client.edit(named)["ok"]
    assert client.ask("save", "saved", name="b.plan", origin="46, 7")["lost"]
    wanted = {"picture": "site.png", "corners": [[0, 0], [10, 5]]}
    assert client.ask("remember", "remembered", background=wanted)["origin"] == [46, 7]
    assert client.ask("open", "opened", name="a.yaml")["origin"] == [46, 7]


def test_what_lies_under_a_new_mission_is_kept_when_that_is_saved(client: Any, site: Path) -> None:
    client.ask("new", "opened")
    corners = [[0, 0], [10, 5]]
    wanted = {"picture": "site.png", "corners": corners}
    client.ask("remember", "remembered", background=wanted, origin="47, 8")
    assert not list(site.glob(f"*{STUDIO_ENDING}"))
    client.ask("save", "saved", name="rounds/new.yaml")
    kept = json.loads((site / "rounds" / f"new.yaml{STUDIO_ENDING}").read_text())
    assert (kept["origin"], kept["background"]["picture"]) == ([47, 8], "../site.png")
    client.ask("remember", "remembered", background=None, origin="")
    assert json.loads((site / "rounds" / f"new.yaml{STUDIO_ENDING}").read_text()) == {}
