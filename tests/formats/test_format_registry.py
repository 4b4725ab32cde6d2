from pathlib import Path

import pytest

from viaspline.errors import MissionError
from viaspline.formats.format_registry import FORMATS, format_of, format_to_save, formats
from viaspline.formats.load import load, origin_of
from viaspline.formats.mission_format import MissionFormat, Whereabouts
from viaspline.mission.model import Mission

TABLE = "QGC WPL 110\n0 1 0 16 0 0 0 0 47.1 8.2 400 1\n1 0 3 16 5 0 0 0 47.2 8.2 9 1\n"
MISSION = {"route": {"start": [0, 0], "via": [{"at": [40, 30], "dwell_s": 2}], "goal": [90, 0]}}


def test_every_format_of_the_list_is_there_with_all_that_a_format_has() -> None:
    found = list(formats())
    assert [type(each).__name__ for each in found] == [e.partition(":")[2] for e in FORMATS]
    for each in found:
        assert set(each.saved_endings) <= set(each.endings)
        assert each.description


@pytest.mark.parametrize(
    ("name", "text", "kind"),
    [
        ("a.yaml", "", "MissionYaml"),
        ("a.YML", "{}", "MissionYaml"),
        ("a.yaml", "route: {start: [0, 0], goal: [9, 0]}  # fleet: none", "MissionYaml"),
        ("a.yml", "world: {}\nfleet: []\n", "FleetYaml"),
        ("a.yml", "separation_m: 2\n'robots' : {}\n", "FleetYaml"),
        ("a.yaml", '{"fleet": []}', "FleetYaml"),
        ("a.plan", "", "QgcPlan"),
        ("a.plan", TABLE, "QgcWpl"),
        ("a.mission", " {}", "QgcPlan"),
        ("a.mission", TABLE, "QgcWpl"),
        ("a.json", '{"mission": 1}', "QgcPlan"),
        ("a.json", '{"MAV_AUTOPILOT": 3, "items": []}', "QgcPlan"),
        ("a.json", '{"route": {"start": [0, 0]}}', "MissionYaml"),
        ("a.JSON", '{"rout": 1}', "MissionYaml"),
        ("a.json", '{"world": {},\n"fleet": [{"name": "r1"}]}', "FleetYaml"),
        ("a", "\n" + TABLE, "QgcWpl"),
    ],
)
def test_a_file_is_what_it_holds_or_else_what_it_is_called(name: str, text: str, kind: str) -> None:
    assert type(format_of(Path(name), text)).__name__ == kind


@pytest.mark.parametrize(
    ("text", "problem"),
    [("", "the file is empty"), (" \n", "the file is empty"), ("kml", "isn't understood")],
)
def test_what_is_of_no_kind_is_refused_with_those_that_there_are(text: str, problem: str) -> None:
    with pytest.raises(MissionError) as caught:
        format_of(Path("a.txt"), text)
    (fault,) = caught.value.faults
    assert problem in fault.problem
    assert fault.remedy == (
        "understood are viaspline's YAML of a fleet (.yaml, .yml, .json), viaspline's YAML "
        "(.yaml, .yml, .json), "
        "QGroundControl's plans (.plan, and .mission in JSON) and texts that begin with "
        "QGC WPL 110 (.txt, .waypoints, .mission)"
    )


@pytest.mark.parametrize("each", list(formats()), ids=lambda each: type(each).__name__)
def test_what_a_format_writes_it_recognises_and_reads_again(
    each: MissionFormat, tmp_path: Path
) -> None:
    mission, origin = Mission.model_validate(MISSION), (47.4, 8.5)
    for ending in each.saved_endings:
        file = tmp_path / f"m{ending}"
        kind = format_to_save(file)
        assert kind is not None
        assert type(kind) is type(each)
        file.write_text(kind.write(mission, Whereabouts(tmp_path, origin)).text)
        assert load(file).route.via[0].dwell_s == 2
        assert origin_of(file) in (None, pytest.approx(origin))


def test_a_file_of_another_ending_is_saved_in_no_format() -> None:
    assert format_to_save(Path("a.kml")) is None


def test_a_result_is_no_mission() -> None:
    with pytest.raises(MissionError, match=r"a\.json: is a result .*; give the planned-\*\.yaml"):
        format_of(Path("a.json"), '{"mission": {}, "proven_means": "docs/proven.md"}')


@pytest.mark.parametrize(("text", "what"), [
    ('{"type": "FeatureCollection", "features": []}', "is GeoJSON, not a mission; areas in metres"),
    ('<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2"/>', "is KML, not a mission"),
    ('<gpx version="1.1"/>', "is GPX, not a mission"),
])  # fmt: skip
def test_a_file_of_another_kind_is_told_by_its_name_and_what_to_do_with_it(
    text: str, what: str
) -> None:
    with pytest.raises(MissionError, match=what):
        format_of(Path("swaths.geojson"), text)
