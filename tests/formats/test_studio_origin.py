"""The origin that the studio keeps beside a mission."""

import json
from pathlib import Path

import pytest

from viaspline.errors import MissionError
from viaspline.formats.studio_origin import beside, studio_origin
from viaspline.studio.background.studio_settings import StudioSettings, write_settings
from viaspline.studio.folder import Folder


def test_what_the_studio_writes_is_read(tmp_path: Path) -> None:
    write_settings(Folder(tmp_path), "yard.yaml", StudioSettings((47.1, 8.5)))
    assert studio_origin(tmp_path / "yard.yaml") == (47.1, 8.5)


def test_a_studio_file_without_an_origin_says_none(tmp_path: Path) -> None:
    beside(tmp_path / "yard.yaml").write_text('{"background": {"picture": "a.png"}}')
    assert studio_origin(tmp_path / "yard.yaml") is None


@pytest.mark.parametrize(
    "said", [[47.1], [91, 8], [47, 181], [0, 0], ["47", "8"], [True, 8], 47, [1e400, 8], {}]
)
def test_an_origin_that_can_not_be_meant_is_refused(said: object, tmp_path: Path) -> None:
    beside(tmp_path / "yard.yaml").write_text(json.dumps({"origin": said}))
    with pytest.raises(MissionError, match="isn't a latitude and a longitude; give --origin"):
        studio_origin(tmp_path / "yard.yaml")


def test_a_studio_file_that_is_no_json_is_named(tmp_path: Path) -> None:
    beside(tmp_path / "yard.yaml").write_text("{")
    with pytest.raises(MissionError, match=r"yard.yaml.studio.json: isn't JSON"):
        studio_origin(tmp_path / "yard.yaml")
