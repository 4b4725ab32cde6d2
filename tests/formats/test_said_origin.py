"""Where on earth a mission says that its 0, 0 is, in files and in values."""

from pathlib import Path

import pytest

import viaspline as vs
from viaspline.formats.mission_yaml import yaml_text
from viaspline.formats.qgc_wpl import QgcWpl
from viaspline.formats.said_origin import said_origin
from viaspline.mission.fleet.fleet import Fleet
from viaspline.mission.model import Mission

ROUTE = {"start": [0, 0], "goal": [9, 0]}
EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ([47.1], r"it should be \[latitude, longitude\] in degrees such as \[47.1, 8.5\]"),
        ([91, 8], "91 is out of range; it should be a number not greater than 90"),
        ([47, -181], "-181 is negative; it should be a number not less than -180"),
        ([0, 0], r"\[0, 0\] means nowhere; give the latitude and longitude of the site"),
        (["47", 8], "it should be a number of degrees"),
        (47, r"it should be \[latitude, longitude\] in degrees"),
        ([float("nan"), 8], "is not a place or a size"),
    ],
)
def test_a_place_that_can_not_be_meant_is_refused_by_name(said: object, words: str) -> None:
    with pytest.raises(vs.MissionError, match=rf"world\.origin_deg.*{words}"):
        Mission.model_validate({"world": {"origin_deg": said}, "route": ROUTE})
    assert said_origin({"world": {"origin_deg": said}}) is None


@pytest.mark.parametrize("data", [None, [], "x", {}, {"world": None}, {"world": [47.1, 8.5]}])
def test_what_says_no_place_has_none(data: object) -> None:
    assert said_origin(data) is None


def test_a_mission_in_yaml_says_where_it_lies(tmp_path: Path) -> None:
    file = tmp_path / "yard.yaml"
    mission = Mission.model_validate({"world": {"origin_deg": [47.1, 8.5]}, "route": ROUTE})
    file.write_text(yaml_text(mission, file.parent), "utf-8")
    assert vs.load(file) == mission
    assert vs.origin_of(file) == (47.1, 8.5)


def test_a_fleet_lies_where_its_world_does(tmp_path: Path) -> None:
    file = tmp_path / "fleet.yaml"
    file.write_text(
        "world: {origin_deg: [-33.9, 151.2]}\n"
        "fleet:\n  - {name: a, route: {start: [0, 0], goal: [9, 0]}}\n"
    )
    fleet = vs.load(file)
    assert isinstance(fleet, Fleet)
    assert vs.origin_of(file) == fleet.members[0].mission.world.origin_deg == (-33.9, 151.2)
    assert fleet.lying_at((47.1, 8.5)).members[0].mission.world.origin_deg == (47.1, 8.5)


@pytest.mark.filterwarnings("ignore::viaspline.errors.MissionWarning")
def test_what_is_read_in_degrees_says_its_origin() -> None:
    file = EXAMPLES / "fence-survey.plan"
    mission = vs.load(file)
    assert isinstance(mission, Mission)
    assert mission.world.origin_deg == vs.origin_of(file)
    west = "QGC WPL 110\n0 1 3 16 0 0 0 0 47 352 0 1\n1 0 3 16 0 0 0 0 47.001 352.001 0 1\n"
    assert QgcWpl().read(west, "w.waypoints").world.origin_deg == (47.0, -8.0)
