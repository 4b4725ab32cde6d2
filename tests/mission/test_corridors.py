"""Corridors and laps in missions: files, faults, writing."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from viaspline.errors import MissionError
from viaspline.formats.load import load
from viaspline.formats.mission_yaml import yaml_text
from viaspline.mission.model import Mission

LINE = [[0, 0, 3, 3], [20, 0, 3, 3], [20, 20, 3, 3], [0, 20, 3, 3]]


def mission(corridor: dict[str, Any], **route: Any) -> Mission:
    data = {"start": [0, 0], "goal": [40, 0], **route, "corridor": corridor}
    return Mission.model_validate({"route": data})


def faults(corridor: dict[str, Any], **route: Any) -> list[str]:
    with pytest.raises(MissionError) as caught:
        mission(corridor, **route)
    return [f"{fault.key}: {fault.problem}" for fault in caught.value.faults]


def test_a_file_is_read_with_comments_names_and_any_separator(tmp_path: Path) -> None:
    (tmp_path / "track.csv").write_text(
        "# made by hand\nx, y, right, left\n0,0,3,3\n20; 0; 3; 3\n\n40 0 2 3\n"
    )
    (tmp_path / "m.yaml").write_text(
        "route: {start: [0, 0], goal: [40, 0], corridor: {csv: track.csv}}\n"
    )
    corridor = load(tmp_path / "m.yaml").route.corridor
    assert corridor is not None
    assert corridor.line == ((0, 0, 3, 3), (20, 0, 3, 3), (40, 0, 2, 3))
    assert corridor.csv == (tmp_path / "track.csv").as_posix()


def test_a_mission_with_a_file_is_written_with_its_name_and_read_the_same(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "track.csv").write_text("0,0,3,3\n40,0,3,3\n")
    first = mission({"csv": str(tmp_path / "a" / "track.csv")})
    (tmp_path / "m.yaml").write_text(yaml_text(first, tmp_path), "utf-8")
    assert 'csv: "a/track.csv"' in (tmp_path / "m.yaml").read_text()
    assert load(tmp_path / "m.yaml") == first
    assert Mission.model_validate(first.model_dump()) == first


def test_a_mission_with_a_line_is_written_and_read_the_same(tmp_path: Path) -> None:
    first = mission({"line": [[0, 0, 3, 3], [40, 0.5, 3, 3]]}, laps=1)
    (tmp_path / "m.yaml").write_text(yaml_text(first, tmp_path), "utf-8")
    assert load(tmp_path / "m.yaml") == first


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("0,0,3\n1,0,3,3\n", "track.csv:1: has 3 columns"),
        ("0,0,3,3\n1,nan,3,3\n", "track.csv:2: y is NaN"),
        ("0,0,3,3\n# c\n1,0,-3,3\n", "track.csv:3: the width to the right is negative: -3"),
        ("0,0,3,3\n1,0,3,wide\n", "track.csv:2: 'wide' is not a number"),
        ("0,0,3,3\n", "has 1 rows"),
        ("", "has 0 rows"),
        ("0,0,3,3\n0,0,3,3\n5,0,3,3\n", "row 2 is the same place as row 1"),
    ],
)
def test_what_is_wrong_with_a_file_names_file_and_row(
    text: str, words: str, tmp_path: Path
) -> None:
    file = tmp_path / "track.csv"
    file.write_text(text)
    (message,) = faults({"csv": str(file)})
    assert message.startswith("route.corridor.csv: ")
    assert words in message


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    (message,) = faults({"csv": str(tmp_path / "none.csv")})
    assert "none.csv: there is no such file" in message


def test_a_file_and_a_line_in_one_mission_file_exclude_each_other(tmp_path: Path) -> None:
    (tmp_path / "m.yaml").write_text(
        "route:\n  start: [0, 0]\n  goal: [40, 0]\n"
        "  corridor: {csv: t.csv, line: [[0, 0, 3, 3], [40, 0, 3, 3]]}\n"
    )
    with pytest.raises(MissionError, match="line and csv, which exclude each other"):
        load(tmp_path / "m.yaml")


@pytest.mark.parametrize(
    ("corridor", "words"),
    [
        ({}, "route.corridor: the corridor has no width"),
        ({"left_m": 2}, "route.corridor: the corridor has left_m only"),
        ({"left_m": 2, "right_m": 2, "line": LINE}, "the corridor has line and left_m"),
        ({"left_m": 0, "right_m": 2}, "route.corridor.left_m: 0 is out of range"),
        ({"line": [[0, 0, 3, 3]]}, "route.corridor.line"),
    ],
)
def test_corridors_without_one_shape_are_refused(corridor: dict[str, Any], words: str) -> None:
    assert any(words in fault for fault in faults(corridor))


def test_an_edge_that_folds_names_its_rows() -> None:
    bend = [[0, 0, 1, 1], [10, 0, 1, 8.5], [12, 2, 1, 8.5], [10, 4, 1, 8.5], [0, 4, 1, 1]]
    messages = faults({"line": bend}, goal=[0, 4])
    words = "the edge on the left folds over itself between rows 2 and 3: 8.5 m is more than"
    assert any(words in text for text in messages)


def test_points_outside_the_corridor_are_refused_with_the_nearest_place() -> None:
    with pytest.raises(MissionError) as caught:
        mission({"line": [[0, 0, 3, 3], [40, 0, 3, 3]]}, start=[5, 4])
    (fault,) = caught.value.faults
    assert fault.key == "route.start.at"
    assert fault.problem == "start lies 1 m outside the corridor"
    assert "move it to (5, 1.998)" in fault.remedy


def test_an_open_route_has_no_laps() -> None:
    with pytest.raises(MissionError, match="an open route can't be driven 3 times over"):
        Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0], "laps": 3}})


def test_a_closed_line_needs_no_more_than_a_start() -> None:
    found = mission({"line": LINE}, closed=True, goal=None)
    assert not found.route.via
