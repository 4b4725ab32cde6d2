from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import MissionError
from viaspline.maps.esri_ascii import read_esri_ascii
from viaspline.maps.terrain import Terrain

GOOD = "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\nNODATA_value -9999\n"


def written(folder: Path, text: str) -> Path:
    file = folder / "dem.asc"
    file.write_text(text)
    return file


def test_rows_come_from_the_north_and_heights_are_those_of_the_middles(tmp_path: Path) -> None:
    terrain = read_esri_ascii(written(tmp_path, GOOD + "1 2 3\n4 5 -9999\n"))
    assert terrain == Terrain([[4, 5, np.nan], [1, 2, 3]], 2.0, (11.0, 21.0))


def test_the_header_may_come_in_any_order_and_say_middles(tmp_path: Path) -> None:
    text = "CELLSIZE 2\nYLLCENTER 21\nxllcenter 11\nNROWS 2\r\nNCOLS 3\n1 2 3 4 5 nan"
    terrain = read_esri_ascii(written(tmp_path, text))
    assert terrain == Terrain([[4, 5, np.nan], [1, 2, 3]], 2.0, (11.0, 21.0))


@settings(deadline=None)
@given(seed=st.integers(0, 9999))
def test_what_was_written_is_read(seed: int, tmp_path_factory: pytest.TempPathFactory) -> None:
    rng = np.random.default_rng(seed)
    heights = rng.normal(0, 300, rng.integers(2, 7, 2))
    heights[rng.random(heights.shape) < 0.2] = np.nan
    cell, (x, y) = rng.uniform(0.1, 30), rng.normal(0, 1e5, 2)
    keys = [
        f"ncols {heights.shape[1]}", f"nrows {heights.shape[0]}", f"xllcenter {x!r}",
        f"yllcenter {y!r}", f"cellsize {cell!r}", "nodata_value -32768",
    ]  # fmt: skip
    rng.shuffle(keys)
    rows = [" ".join(f"{h!r}" for h in np.nan_to_num(row, nan=-32768).tolist()) for row in heights]
    text = "\n".join([*keys, *rows[::-1]]).replace("np.float64(", "").replace(")", "")
    folder = tmp_path_factory.mktemp("dem")
    assert read_esri_ascii(written(folder, text)) == Terrain(heights, cell, (x, y))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", r"dem.asc:1:1: the header of the terrain is broken"),
        ("1 2 3\n", r"dem.asc:1:1: the header of the terrain is broken"),
        (GOOD.replace("ncols", "cols"), r"dem.asc:1:1: the key cols isn't one"),
        (GOOD.replace("nrows 2\n", ""), "nrows: the header lacks nrows"),
        (GOOD.replace("ncols 3", "ncols 2.5"), "dem.asc:1:1: ncols: ncols is 2.5"),
        (GOOD.replace("ncols 3", "ncols many"), 'dem.asc:1:1: ncols: found "many"'),
        (GOOD.replace("ncols 3", "ncols 1"), "1 x 2 heights; give at least 2 x 2"),
        (GOOD.replace("cellsize 2", "cellsize 0"), "dem.asc:5:1: cellsize: cellsize is 0"),
        (GOOD.replace("cellsize 2", "dx 2\ndy 3"), "dem.asc:6:1: dy: dx and dy differ"),
        (GOOD + "1 2 3\n4 5\n", "has 5 heights, but its header says 6"),
        (GOOD + "1 2 3\n4 x 6\n", r'dem.asc:8:3: found "x"'),
        (
            GOOD + "1 2 3\n4 -3.4e38 6\n",
            r"dem.asc: a height is -3.4e\+38 m; say that it is the nodata",
        ),
        (GOOD + "1 2 3\n4 inf 6\n", r'dem.asc:8:3: found "inf"'),
        (
            GOOD.replace("ncols 3", "ncols 10000").replace("nrows 2", "nrows 10000"),
            "10000 x 10000 heights; cut it, or take every second height: .* 50000000 in all",
        ),
    ],
)
def test_what_is_wrong_is_told_with_its_line(text: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(MissionError, match=words):
        read_esri_ascii(written(tmp_path, text))


DEGREES = (
    "ncols 2\nnrows 2\nxllcorner 8.2\nyllcorner 47.1\ncellsize 0.000833333\n400 401\n402 403\n"
)


def test_a_grid_that_lies_and_is_spaced_as_degrees_are_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MissionError, match="seems to be in degrees; project it to metres"):
        read_esri_ascii(written(tmp_path, DEGREES))
    fine = read_esri_ascii(written(tmp_path, DEGREES.replace("47.1", "5200000")))
    assert fine.cell == 0.000833333


@pytest.mark.parametrize(
    ("prj", "unit"),
    [
        (
            'GEOGCS["WGS 84",DATUM["D",SPHEROID["S",6378137,298.25]],UNIT["degree",0.0174]]',
            "degrees",
        ),
        ("Projection    GEOGRAPHIC\nUnits         DD\nZunits        NO\n", "degrees"),
        ('PROJCS["x",GEOGCS["y",UNIT["degree",0.0174]],UNIT["Foot_US",0.304800609]]', "Foot_US"),
        ("Projection    STATEPLANE\nUnits    FEET\n", "feet"),
    ],
)
def test_what_the_prj_file_beside_says_is_believed(tmp_path: Path, prj: str, unit: str) -> None:
    file = written(tmp_path, GOOD + "1 2 3\n4 5 6\n")
    file.with_suffix(".prj").write_text(prj)
    with pytest.raises(MissionError, match=f"says that it is in {unit}"):
        read_esri_ascii(file)


@pytest.mark.parametrize(
    "prj",
    [
        'PROJCS["WGS 84 / UTM 32N",GEOGCS["y",UNIT["degree",0.0174]],UNIT["metre",1]]',
        "Projection    UTM\nUnits         METERS\n",
        "nothing that is known",
        "",
    ],
)
def test_a_prj_file_of_metres_changes_nothing(tmp_path: Path, prj: str) -> None:
    file = written(tmp_path, GOOD + "1 2 3\n4 5 6\n")
    alone = read_esri_ascii(file)
    file.with_suffix(".prj").write_text(prj)
    assert read_esri_ascii(file) == alone


def test_a_broken_unit_of_a_prj_file_is_no_unit(tmp_path: Path) -> None:
    file = written(tmp_path, GOOD + "1 2 3\n4 5 6\n")
    file.with_suffix(".prj").write_text('PROJCS["x",UNIT["metre",1e]]')
    assert read_esri_ascii(file).cell == 2.0
