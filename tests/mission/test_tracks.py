"""Recorded motions: one moving disc for each id of a file."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from viaspline.errors import MissionError
from viaspline.formats.load import load
from viaspline.mission.model import Mission
from viaspline.mission.tracks_file import read_tracks

ROUTE = "route: {start: [0, 0], goal: [9, 0]}\n"


def mission_file(folder: Path, rows: str, more: str = "") -> Path:
    (folder / "people.csv").write_text(rows)
    file = folder / "mission.yaml"
    item = f"{{tracks: people.csv, radius_m: 0.25{more}}}"
    file.write_text(f"world:\n  known:\n    - {item}\n{ROUTE}")
    return file


def test_each_id_becomes_a_disc_that_comes_and_then_stays(tmp_path: Path) -> None:
    rows = "id,t_s,x_m,y_m\nanna,0,1,2\nbo,1,5,5\nanna,2,3,2\nbo,0,5,4\n"
    mission = load(mission_file(tmp_path, rows))
    anna, bo = mission.world.moving
    assert (anna.name, bo.name) == ("anna", "bo")
    assert bo.motion is not None
    assert bo.motion.keyframes == ((0, 5, 4), (1, 5, 5))  # in the order of time
    assert (bo.motion.before, bo.motion.after) == ("absent", "stay")
    assert bo.circle is not None
    assert bo.circle.radius == 0.25


@pytest.mark.parametrize(
    "rows",
    ["7 0 1 2\n7 1 2 2\n", "# recorded\n7;0;1;2\n7;1;2;2\n", "t,id,y,x\n0,7,2,1\n1,7,2,2\n"],
)
def test_rows_are_separated_as_people_do_and_columns_may_be_named(
    tmp_path: Path, rows: str
) -> None:
    (tmp_path / "a.csv").write_text(rows)
    assert read_tracks(tmp_path / "a.csv") == {"7": [(0, 1, 2), (1, 2, 2)]}


def test_what_comes_after_and_the_name_can_be_said(tmp_path: Path) -> None:
    file = mission_file(tmp_path, "1,0,1,2\n1,1,2,2\n", ", after: vanish, name: guest")
    [guest] = load(file).world.moving
    assert guest.name == "guest 1"
    assert guest.motion is not None
    assert guest.motion.after == "vanish"


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ("1,0,1\n", "people.csv:1:1: has 3 columns"),
        ("1,0,1,2\n1,x,1,2\n", "people.csv:2:1: 'x' is not a number"),
        ("1,0,nan,2\n", "x_m is NaN"),
        ("1,1e300,1,2\n", "t_s is out of range"),
        ("1,0,1,2\n1,0,1,3\n", "puts '1' in two places at 0 s"),
        (",0,1,2\n", "has no id"),
        ("1,0,1,2\n2,1e-9,1,4\n2,0,1,2\n", "the row of '2' at 1e-09 s is 2 m from the one before"),
        ("", "has no rows"),
    ],
)
def test_a_row_that_makes_no_sense_is_named_by_its_line(
    tmp_path: Path, rows: str, words: str
) -> None:
    with pytest.raises(MissionError) as caught:
        load(mission_file(tmp_path, rows))
    assert words in str(caught.value)
    assert "mission.yaml:3:" in str(caught.value)


def test_a_file_that_is_none_is_refused_at_once(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.csv")
    for name in ("nowhere.csv", "pipe.csv", "/dev/zero"):
        data = {"known": [{"tracks": str(tmp_path / name), "radius_m": 0.3}]}
        with pytest.raises(MissionError, match="tracks"):
            Mission.model_validate({"world": data, "route": {"start": [0, 0], "goal": [9, 0]}})


def test_tracks_without_a_radius_are_refused() -> None:
    with pytest.raises(MissionError, match="radius_m"):
        Mission.model_validate(
            {"world": {"known": [{"tracks": "x.csv"}]}, "route": {"start": [0, 0], "goal": [9, 0]}}
        )
