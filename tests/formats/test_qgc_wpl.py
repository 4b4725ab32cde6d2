import warnings
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.errors import MissionError, MissionWarning
from viaspline.formats.load import load
from viaspline.formats.qgc_wpl import QgcWpl
from viaspline.mission.model import Mission

DATA = Path(__file__).parent / "data"
HOME = "0 16 47.0 8.0 400 0"


def written(tmp_path: Path, *rows: str) -> Path:
    """A file; each row is: frame, command, latitude, longitude, altitude, parameter 1."""
    lines = ["QGC WPL 110"]
    for number, row in enumerate(rows):
        frame, command, latitude, longitude, altitude, p1 = row.split()
        fields = (number, 0, frame, command, p1, 0, 0, 0, latitude, longitude, altitude, 1)
        lines.append("\t".join(map(str, fields)))
    file = tmp_path / "tour.txt"
    file.write_text("\r\n".join(lines))
    return file


def quiet(file: Path) -> Mission:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MissionWarning)
        return load(file)


def test_hold_times_become_stations_and_altitudes_are_kept(tmp_path: Path) -> None:
    file = written(
        tmp_path, HOME, "3 16 47.001 8.0 20 5", "3 82 47.001 8.001 30 0", "0 16 47.0 8.001 450 0"
    )
    route = load(file).route
    assert [point.at[2] for _, point in route.points()] == [0, 20, 30, 50]
    assert route.via[0].dwell_s == 5
    assert route.via[0].at[1] == pytest.approx(111.17, abs=0.05)


def test_a_climb_on_the_spot_is_one_point_and_is_named(tmp_path: Path) -> None:
    file = written(tmp_path, HOME, "3 22 0 0 30 0", "3 16 47.001 8.0 30 0")
    with pytest.warns(MissionWarning, match="item 1: climb or descent on the spot"):
        route = load(file).route
    assert route.start.at == (0, 0, 30)
    assert len(route.via) == 0


def test_items_at_one_place_become_one_station(tmp_path: Path) -> None:
    file = written(
        tmp_path, HOME, "3 16 47.001 8 9 2", "3 16 0 0 9 3", "3 93 0 0 0 4", "3 16 47.002 8 9 0"
    )
    route = load(file).route
    assert len(route.via) == 1
    assert route.via[0].dwell_s == 9


def test_return_to_launch_is_the_goal_and_what_follows_is_named(tmp_path: Path) -> None:
    file = written(
        tmp_path, HOME, "3 16 47.001 8 9 0", "2 20 0 0 0 0", "3 16 47.002 8 9 0", "3 16 47.1 8 9 0"
    )
    with pytest.warns(MissionWarning, match="items 3, 4: way point after the return to launch"):
        route = load(file).route
    assert route.goal is not None
    assert route.goal.at[:2] == (0, 0)


def test_each_kind_that_cannot_be_represented_is_one_warning(tmp_path: Path) -> None:
    file = written(
        tmp_path,
        HOME,
        "3 16 47.001 8 9 0",
        "2 177 0 0 0 1",
        "2 206 0 0 0 1",
        "2 206 0 0 0 2",
        "2 31999 0 0 0 2",
        "3 18 47.002 8 9 3",
        "10 16 47.003 8 9 0",
        "3 19 47.004 8 9 7",
        "3 17 47.005 8 9 0",
        "2 201 0 0 0 0",
    )
    with pytest.warns(MissionWarning) as caught:
        mission = load(file)
    messages = [str(warning.message) for warning in caught]
    for words in (
        "item 2: jump",
        "items 3, 4: camera trigger distance",
        "item 5: MAV_CMD 31999",
        "item 6: loiter turns",
        "item 7: altitude above terrain",
        "item 10: region of interest after the unlimited loiter",
    ):
        assert sum(words in message for message in messages) == 1, words
    assert len(messages) == 6
    assert mission.route.via[-1].dwell_s == 7


def test_fences_among_the_items_become_fences_and_obstacles(tmp_path: Path) -> None:
    square = [(46.99, 7.99), (46.99, 8.02), (47.02, 8.02), (47.02, 7.99)]
    file = written(
        tmp_path,
        HOME,
        "3 16 47.001 8 9 0",
        *(f"3 5001 {lat} {lon} 0 4" for lat, lon in square),
        "3 5004 47.01 8.01 0 50",
    )
    world = load(file).world
    assert len(world.fences[0]) == 4
    (obstacle,) = world.known
    assert obstacle.name == "exclusion 1"
    assert obstacle.circle is not None
    assert obstacle.circle.radius == 50


def test_a_mission_across_the_antimeridian_stays_together(tmp_path: Path) -> None:
    file = written(
        tmp_path, "0 16 -17 179.999 4 0", "3 16 -17 -179.999 9 0", "3 16 -17.001 179.9995 9 0"
    )
    xs = [point.at[0] for _, point in load(file).route.points()]
    assert xs == pytest.approx([0, 212.9, 53.2], abs=0.2)


def test_without_a_home_the_first_position_is_the_start() -> None:
    route = load(DATA / "mission_planner_sample.txt").route
    assert route.start.at == (0, 0, 0)
    assert route.goal is not None
    assert route.goal.at == (0, 0, 0)
    assert len(route.via) == 2


@pytest.mark.parametrize(
    ("text", "place", "words"),
    [
        ("QGC WPL 300\n", ":1:9", "version 300"),
        ("QGC WPL 110\n1 2 3\n", ":2:1", "3 fields instead of 12"),
        ("QGC WPL 110\n0 0 3 16 0 0 0 0 x 8 9 1\n", ":2:18", "latitude"),
        ("QGC WPL 110\n0 0 3 1.5 0 0 0 0 7 8 9 1\n", ":2:7", "whole number"),
        ("QGC WPL 110\n", "", "no item has a position"),
        ("QGC WPL 110\n0 0 0 16 0 0 0 0 7 8 9 1\n", ":2:1", "two distinct points"),
        (
            "QGC WPL 110\n0 0 0 16 0 0 0 0 7 8 9 1\n1 0 3 16 0 0 0 0 95 8 9 1\n",
            ":3:1",
            "a latitude",
        ),
        (
            "QGC WPL 110\n0 0 0 16 0 0 0 0 7 8 9 1\n1 0 3 16 0 0 0 0 -7 -170 9 1\n",
            ":3:1",
            "more than 500 km away",
        ),
    ],
)
def test_faults_have_their_line_and_column(
    tmp_path: Path, text: str, place: str, words: str
) -> None:
    file = tmp_path / "tour.waypoints"
    file.write_text(text)
    with pytest.raises(MissionError) as caught:
        load(file)
    assert str(caught.value).startswith(f"{file}{place}:")
    assert words in str(caught.value)


def test_a_fault_of_the_mission_is_told_in_the_line_of_its_item(tmp_path: Path) -> None:
    file = written(tmp_path, HOME, "3 16 47.001 8 9 0", "3 5004 47.001 8 0 50")
    with pytest.raises(MissionError) as caught:
        load(file)
    assert str(caught.value).startswith(f"{file}:3:1: item 1: (route.goal.at) goal lies 50 m")
    assert "obstacle 'exclusion 1'" in str(caught.value)


@given(st.lists(st.tuples(*[st.integers(0, 6000), st.floats(-200, 200), st.floats()]), max_size=8))
def test_any_table_is_a_mission_or_a_mission_error(rows: list[tuple[int, float, float]]) -> None:
    from viaspline.formats.interpret import mission_of

    text = "QGC WPL 110\n" + "".join(
        f"{i} 0 3 {command} {p} 0 0 0 {x} {x} {p} 1\n" for i, (command, x, p) in enumerate(rows)
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MissionWarning)
        try:
            mission = mission_of(QgcWpl().parse(text, "t"))
        except MissionError:
            return
    assert mission.route.start.at


@given(fast=st.sampled_from([0.5, 2.5, 12.0]), kind=st.sampled_from([0, 1]))
def test_a_speed_that_is_set_before_setting_off_holds_for_the_whole_way(
    fast: float, kind: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    file = with_speeds(tmp_path_factory.mktemp("tour"), (1, kind, fast))
    with warnings.catch_warnings():
        warnings.simplefilter("error", MissionWarning)
        assert load(file).robot.max_speed_mps == fast


@pytest.mark.parametrize(
    "speeds", [[(2, 1, 0.7)], [(1, 1, 0.7), (2, 1, 3.0)], [(1, 2, 0.7)], [(1, 1, -1.0)]]
)
def test_a_speed_under_way_or_of_a_climb_or_none_is_not_the_missions(
    speeds: list[tuple[int, int, float]], tmp_path: Path
) -> None:
    with pytest.warns(MissionWarning, match="change of speed"):
        mission = load(with_speeds(tmp_path, *speeds))
    assert (
        mission.robot.max_speed_mps
        == Mission.model_validate({"route": {"start": [0, 0], "goal": [1, 0]}}).robot.max_speed_mps
    )


def with_speeds(folder: Path, *speeds: tuple[int, int, float]) -> Path:
    """Three way points; changes of speed go in by row, kind and speed [m/s]."""
    rows = [(16, 0, 0, *HOME.split()[2:4])] + [(16, 0, 0, f"47.00{i}", "8.0") for i in (1, 2)]
    for where, kind, fast in sorted(speeds, reverse=True):
        rows.insert(where, (178, kind, fast, "0", "0"))
    lines = ["QGC WPL 110"]
    for number, (command, p1, p2, latitude, longitude) in enumerate(rows):
        fields = (number, 0, 3, command, p1, p2, 0, 0, latitude, longitude, 0, 1)
        lines.append("\t".join(map(str, fields)))
    file = folder / "tour.txt"
    file.write_text("\n".join(lines))
    return file
