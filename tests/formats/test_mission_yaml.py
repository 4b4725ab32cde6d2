import cProfile
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from viaspline.errors import MissionError
from viaspline.formats.load import load
from viaspline.formats.mission_yaml import yaml_text
from viaspline.mission.model import Mission

Make: TypeAlias = Callable[..., dict[str, Any]]


ROUTE = "route: {start: [0, 0], goal: [9, 0]}\n"


def faults_of(tmp_path: Path, text: str | bytes) -> list[str]:
    file = tmp_path / "m.yaml"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(MissionError) as caught:
        load(file)
    return [str(fault).removeprefix(str(file)) for fault in caught.value.faults]


def test_every_fault_has_its_line_and_column_and_they_come_in_file_order(tmp_path: Path) -> None:
    text = (
        "world:\n"
        "  known:\n"
        "    - {circle: {center: [9, 2], radius: -3}}\n"
        "    - map: depot.yaml\n"
        "robot: {radius_m: true, clearence_m: 2}\n"
        "route:\n"
        "  start: [0, 0]\n"
        "  via: [[5, 5], [5, 5]]\n"
        "  start: [1, 1]\n"
        "  goal: {at: [9, .nan]}\n"
    )
    faults = faults_of(tmp_path, text)
    places = [fault.split(": ")[:2] for fault in faults]
    assert places == [
        [":3:41", "world.known[0].circle.radius"],
        [":4:7", "world.known[1].map"],
        [":5:19", "robot.radius_m"],
        [":5:25", "robot.clearence_m"],
        [":8:17", "route.via[1].at"],
        [":9:3", "route.start"],
        [":10:18", "route.goal.at[1]"],
    ]
    assert "line 7" in faults[5]


@pytest.mark.parametrize(
    ("text", "place", "words"),
    [
        ("", ":1:1", "empty"),
        ("# nothing\n", ":1:1", "empty"),
        ("- a\n- b\n", ":1:1", "a list of 2"),
        ("just text\n", ":1:1", "the text"),
        (ROUTE + "---\n" + ROUTE, ":3:1", "second document"),
        ("route:\n\tstart: [0, 0]\n", ":2:1", "tab"),
        ("route: {start: [0, 0\n", ":2:1", "is not YAML"),
        ("route: [}\n", ":1:9", "is not YAML"),
        (b"route: \xff\n", ":1:8", "0xFF is not UTF-8"),
        ("\ufeffroute: 5\n", ":1:8", "found 5"),
        ("a\x00: 5\n", ":1:2", "can't stand in YAML"),
        (ROUTE + "spline: !mine {tension: 0}\n", ":2:9", "tag"),
        (ROUTE + "spline: !!python/object:os.system {tension: 0}\n", ":2:9", "tag"),
        ("route: {start: !point [0, 0], goal: [1, 2]}", ":1:16", "the tag !point means nothing"),
        (ROUTE + "<<: {}\n", ":2:1", "merge keys"),
        (ROUTE + "5: {}\n", ":2:1", "the key 5"),
        (ROUTE + "robot: *nobody\n", ":2:8", "is not YAML"),
        ("route: &a [*a]\n", ":1:8", "a list of 1"),
        ("[" * 5000, ":1:1", "nested too deeply"),
        ("route: {start: [0, 2001-01-01], goal: [1, 2]}", ":1:20", "2001-01-01"),
    ],
)
def test_what_is_no_mission_file_is_said_in_its_place(
    tmp_path: Path, text: str | bytes, place: str, words: str
) -> None:
    faults = faults_of(tmp_path, text)
    assert len(faults) == 1, faults
    assert faults[0].startswith(place + ":")
    assert words in faults[0]


def test_missing_files_and_folders_are_named(tmp_path: Path) -> None:
    with pytest.raises(MissionError, match="there is no such file"):
        load(tmp_path / "none.yaml")
    with pytest.raises(MissionError, match="is a folder"):
        load(tmp_path)
    with pytest.raises(MissionError, match="can't be read"):
        load("a\0b")


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_an_unreadable_file_is_named(tmp_path: Path) -> None:
    file = tmp_path / "secret.yaml"
    file.write_text(ROUTE)
    file.chmod(0)
    with pytest.raises(MissionError, match="can't be read: permission denied"):
        load(file)


def test_numbers_may_be_written_in_every_way_of_yaml(tmp_path: Path) -> None:
    file = tmp_path / "m.yaml"
    file.write_text("route: {start: [1e3, 0x10], goal: [-1_000, 010]}")
    mission = load(file)
    assert mission.route.start.at == (1000.0, 16.0)
    assert mission.route.goal is not None
    assert mission.route.goal.at == (-1000.0, 10.0)


def calls_of(read: Callable[[], object]) -> int:
    """How many calls a job takes: its time, without the clock."""
    profile = cProfile.Profile()
    profile.runcall(read)
    return sum(entry.callcount for entry in profile.getstats())


def test_the_work_of_reading_grows_with_the_file_not_with_its_square(tmp_path: Path) -> None:
    work = []
    for count in (100, 800):
        known = "".join(
            f"    - circle: {{center: [{9 + i}, 9], radius: 1}}\n" for i in range(count)
        )
        file = tmp_path / f"{count}.yaml"
        file.write_text("world:\n  known:\n" + known + ROUTE)
        work.append(calls_of(lambda file=file: load(file)))  # type: ignore[misc]
    assert work[1] < 9 * work[0]


def test_a_sound_mission_is_read_without_what_only_others_need(tmp_path: Path, good: Make) -> None:
    file = tmp_path / "m.yaml"
    file.write_text(yaml_text(Mission.model_validate(good()), file.parent), "utf-8")
    code = (
        "import sys; from viaspline.formats.load import load; load(sys.argv[1])\n"
        "others = ('formats.qgc_plan', 'formats.qgc_wpl', 'formats.interpret',"
        " 'mission.key_words', 'mission.schema_errors', 'mission.json_schema')\n"
        "heavy = ('numba', 'scipy', 'matplotlib', 'pymap3d')\n"
        "names = [*heavy, *(f'viaspline.{name}' for name in others)]\n"
        "print([name for name in names if name in sys.modules])"
    )
    run = subprocess.run(
        [sys.executable, "-c", code, str(file)], capture_output=True, text=True, check=True
    )
    assert run.stdout.strip() == "[]"


def test_a_mission_written_and_read_is_the_same(tmp_path: Path, good: Make) -> None:
    mission = Mission.model_validate(good())
    (tmp_path / "m.yaml").write_text(yaml_text(mission, tmp_path), "utf-8")
    assert load(tmp_path / "m.yaml") == mission
    assert [file.name for file in tmp_path.iterdir()] == ["m.yaml"]


numbers = st.floats(-1e6, 1e6) | st.sampled_from([1e-7, -1e-300, 1e-5, 0.1 + 0.2, 123456.789e-12])
sizes = st.floats(1e-4, 1e4)
names = st.text(
    st.characters(exclude_categories=["Cs"]), min_size=1, max_size=12
) | st.sampled_from(
    ["true", "no", "null", "~", "1", "a: b", "- x", "#", "\u2028", "\x85", "\U0001f600", "\ufffe"]
)


@st.composite
def generated(draw: st.DrawFn) -> dict[str, Any]:
    xs = draw(st.lists(numbers, min_size=2, max_size=6))
    points = [{"at": [x, 10.0 * i], "dwell_s": draw(sizes)} for i, x in enumerate(xs)]
    points[0]["name"] = draw(names)
    return {
        "world": {
            "unseen": [
                {"circle": {"center": [draw(numbers), draw(numbers)], "radius": draw(sizes)}},
                {"polygon": [[0, 0], [draw(sizes) + 1, 0], [0, 9]], "name": draw(names)},
            ]
        },
        "robot": {"max_speed_mps": draw(sizes), "sensor": {"range_m": draw(sizes)}},
        "route": {"start": points[0], "via": points[1:-1], "goal": points[-1]},
        "spline": {"tension": draw(st.floats(-9, 1)), "knots": "uniform"},
    }


@settings(
    deadline=None, max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=generated())
def test_whatever_is_written_reads_back_equal(tmp_path: Path, data: dict[str, Any]) -> None:
    mission = Mission.model_validate(data)
    (tmp_path / "m.yaml").write_text(yaml_text(mission, tmp_path), "utf-8")
    assert load(tmp_path / "m.yaml") == mission
    assert yaml_text(load(tmp_path / "m.yaml")) == yaml_text(mission)


def test_a_part_with_nothing_but_default_values_is_still_there(tmp_path: Path) -> None:
    mission = Mission.model_validate({
        "world": {"altitude": {"above": "home"}},
        "robot": {"moving": {}, "sensor": {"range_m": 9}},
        "route": {"start": [0, 0, 5], "goal": [9, 0, 5]},
    })  # fmt: skip
    (tmp_path / "m.yaml").write_text(yaml_text(mission, tmp_path), "utf-8")
    back = load(tmp_path / "m.yaml")
    assert isinstance(back, Mission)
    assert back.world.altitude == mission.world.altitude
    assert back == mission


def test_whole_numbers_are_written_as_numbers(tmp_path: Path) -> None:
    mission = Mission.model_validate(
        {
            "robot": {"sensor": {"lidar": {"range_m": 5, "beams": 72}}},
            "route": {"start": [0, 0], "via": [[9, 0], [5, 5]], "closed": True, "laps": 3},
        }
    )
    (tmp_path / "m.yaml").write_text(yaml_text(mission, tmp_path), "utf-8")
    assert load(tmp_path / "m.yaml") == mission


@pytest.mark.parametrize("number", ["9" * 5000, "0x" + "f" * 3600, "0b" + "1" * 20000])
def test_a_whole_number_that_is_too_long_to_be_written_out_is_a_fault(
    tmp_path: Path, number: str
) -> None:
    text = f"route: {{start: [0, 0], via: [[5, 5]], closed: true, laps: {number}}}\n"
    (fault,) = faults_of(tmp_path, text)
    assert fault.startswith(":1:59: route.laps: ")
    assert len(fault) < 200
