from pathlib import Path

import numpy as np
import pytest

from viaspline.errors import MissionError
from viaspline.maps.movingai import BenchmarkProblem, read_movingai, read_problems

HEAD = "type octile\nheight 2\nwidth 3\nmap\n"


def test_points_are_free_letters_blocked_and_the_first_row_is_the_highest(tmp_path: Path) -> None:
    (tmp_path / "a.map").write_text("type octile\nheight 3\nwidth 4\nmap\n.GS@\nOTW.\n....\n")
    grid = read_movingai(tmp_path / "a.map")
    assert grid.blocked.astype(int).tolist() == [[0, 0, 0, 0], [1, 1, 1, 0], [0, 0, 0, 1]]
    assert (grid.resolution, grid.extent) == (1.0, (0, 0, 4, 3))
    assert grid.center(row=2, column=3) == (3.5, 2.5)


def test_squares_may_have_another_size(tmp_path: Path) -> None:
    (tmp_path / "a.map").write_text(HEAD + "...\n@..\n")
    grid = read_movingai(tmp_path / "a.map", 0.25)
    assert grid.extent == (0, 0, 0.75, 0.5)
    assert grid.reading is not None
    assert grid.reading.resolution == 0.25


@pytest.mark.parametrize("end", ["\n", "\r\n", " \n"])
@pytest.mark.parametrize("last", ["", "\n"])
def test_line_ends_of_every_system_are_read(tmp_path: Path, end: str, last: str) -> None:
    text = HEAD.replace("\n", end) + "@..\n..@".replace("\n", end) + last
    (tmp_path / "a.map").write_bytes(text.encode())
    assert read_movingai(tmp_path / "a.map").blocked.tolist() == [
        [False, False, True],
        [True, False, False],
    ]


def test_the_real_arena_has_its_problems_on_free_squares_as_far_apart_as_they_say(
    data: Path,
) -> None:
    grid = read_movingai(data / "arena.map")
    problems = read_problems(data / "arena.map.scen")
    assert (grid.width, grid.height, len(problems)) == (49, 49, 160)
    ends = np.array([place for problem in problems for place in (problem.start, problem.goal)])
    column, row = np.floor(grid.to_cells(ends)).astype(int).T
    assert not grid.blocked[row, column].any()
    for problem in problems:
        dx, dy = np.abs(np.subtract(problem.goal, problem.start))
        octile = max(dx, dy) + (np.sqrt(2) - 1) * min(dx, dy)
        assert problem.optimal >= octile - 1e-4
        assert problem.bucket == int(problem.optimal) // 4


def test_problems_are_in_metres_from_the_lower_left_corner(tmp_path: Path) -> None:
    line = "3\tmaps/my map.map\t4\t10\t1\t0\t3\t9\t11.5"
    (tmp_path / "a.scen").write_text(f"version 1.0\r\n\r\n{line}\r\n")
    (problem,) = read_problems(tmp_path / "a.scen", 0.5)
    assert problem == BenchmarkProblem(3, "maps/my map.map", (0.75, 4.75), (1.75, 0.25), 5.75)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", ":1:1: the header of the map is broken; it should be type octile, height, width"),
        ("type octile\nheight 2\nmap\n...\n", ":1:1: the header of the map is broken"),
        ("type octile\nheight 0\nwidth 3\nmap\n", ": the map has 3 x 0 cells; give at least one"),
        ("type octile\nheight 1\nwidth 40000\nmap\n", ": the map has 40000 x 1 cells; cut it"),
        (HEAD + "...\n", ":5:1: the map has 1 rows, but its header says 2; correct the height"),
        (HEAD + "...\n...\n...\n", ":7:1: the map has 3 rows, but its header says 2"),
        (HEAD + "...\n..\n", ":6:1: the row has 2 squares, but the header says 3; correct the"),
        (HEAD + "....\n...\n", ":5:1: the row has 4 squares, but the header says 3"),
        (HEAD + "...\n.x.\n", ":6:2: the character 'x' isn't a kind of square; it should be one"),
        (HEAD + "...\n.\u00e9\n", ":6:2: the character '\u00c3' isn't a kind of square"),
    ],
)
def test_each_mistake_in_a_map_has_its_line_and_its_remedy(
    tmp_path: Path, text: str, fault: str
) -> None:
    (tmp_path / "a.map").write_text(text, encoding="utf-8")
    with pytest.raises(MissionError) as caught:
        read_movingai(tmp_path / "a.map")
    assert str(caught.value).startswith(f"{tmp_path / 'a.map'}{fault}")


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", ":1:1: the list of problems has no header; its first line should be version 1"),
        ("version 2\n", ":1:1: the list of problems has no header"),
        ("version 1\n1 2 3\n", ":2:1: found '1 2 3'; it should be bucket, map, width, height, st"),
        ("version 1\n0 a 1 1 0 0 0 x 1\n", ":2:1: found '0 a 1 1 0 0 0 x 1'"),
    ],
)
def test_each_mistake_in_a_list_of_problems_has_its_line(
    tmp_path: Path, text: str, fault: str
) -> None:
    (tmp_path / "a.scen").write_text(text)
    with pytest.raises(MissionError) as caught:
        read_problems(tmp_path / "a.scen")
    assert str(caught.value).startswith(f"{tmp_path / 'a.scen'}{fault}")


def test_missing_files_and_folders_are_named(tmp_path: Path) -> None:
    with pytest.raises(MissionError, match="there is no such file"):
        read_movingai(tmp_path / "a.map")
    with pytest.raises(MissionError, match="is a folder"):
        read_movingai(tmp_path)
