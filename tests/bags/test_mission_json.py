"""Missions and obstacles as JSON: equal when read again, maps of squares too."""

from pathlib import Path

import numpy as np
import pytest

import viaspline as vs
from viaspline.bags.mission_json import (
    mission_from,
    mission_text,
    obstacle_from,
    obstacle_text,
)
from viaspline.errors import MessageError

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.yaml"))


@pytest.mark.filterwarnings("ignore::viaspline.errors.MissionWarning")
@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_example_in_the_plane_is_equal_when_read_again(path: Path) -> None:
    asked = vs.load(path)
    if not isinstance(asked, vs.Mission):
        pytest.skip("a fleet")
    if asked.is_spatial:
        with pytest.raises(vs.GeometryError, match="in space"):
            mission_text(asked)
        return
    text = mission_text(asked)
    again = mission_from(text)
    assert again == asked
    assert mission_text(again) == text


def test_a_map_that_was_made_in_memory_is_kept() -> None:
    cells = np.random.default_rng(1).random((13, 29)) < 0.3
    grid = vs.Grid(cells, 0.25, (1.0, -2.0, 0.3))
    again = obstacle_from(obstacle_text(vs.Obstacle(grid=grid, name="shed")))
    assert again.grid is not None
    np.testing.assert_array_equal(again.grid.blocked, cells)
    assert (again.grid.resolution, again.grid.origin) == (0.25, (1.0, -2.0, 0.3))


@pytest.mark.parametrize(
    "text",
    ["", "{", '{"squares_of": [2, 2]}', '{"squares_of": [99999999, 99999999], "bits": ""}',
     '{"squares_of": [2, 2], "resolution": 1, "origin": [0, 0, 0], "source": null, "bits": "xx"}'],
)  # fmt: skip
def test_what_is_no_mission_is_refused(text: str) -> None:
    with pytest.raises(MessageError, match="the JSON of a mission"):
        mission_from(text)
    with pytest.raises(vs.MissionError):
        mission_from("[1, 2]")
