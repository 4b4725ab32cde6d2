"""Fleet files: read with every fault in its place, written so that they read the same."""

from __future__ import annotations

import json
import random
import re
import textwrap
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.errors import MissionError, OutputError
from viaspline.formats.fleet_yaml import FleetYaml, fleet_text
from viaspline.formats.mission_format import Whereabouts
from viaspline.maps.grid import Grid

FLEET = """\
world:
  bounds: [-10, -10, 60, 60]
  known:
    - {name: tank, circle: {center: [30, 30], radius: 3}}
separation_m: 1.0
robots: {cart: {radius_m: 0.5, max_speed_mps: 2}}
fleet:
  - {name: r1, robot: cart, route: {start: [0, 0], goal: [9, 0]}, priority: 2, rest: stay}
  - name: r2
    robot: cart
    route:
      start: [0, 5]
      via:
        - [20, 5]
        - [30, 9]
      goal: [50, 5]
"""


def test_a_fleet_file_is_loaded_as_a_fleet(tmp_path: Path) -> None:
    file = tmp_path / "fleet.yaml"
    file.write_text(FLEET)
    found = vs.load(file)
    assert isinstance(found, vs.Fleet)
    assert [each.name for each in found.members] == ["r1", "r2"]
    assert found.separation_m == 1.0
    assert found.members[1].mission.route.via[1].at == (30.0, 9.0)


def test_every_fault_has_its_line_and_column_in_the_order_of_the_file(tmp_path: Path) -> None:
    file = tmp_path / "fleet.yaml"
    file.write_text(
        "separation_m: far\n"
        "robots:\n"
        "  cart: {radius_m: -1, clearence_m: 0}\n"
        "fleet:\n"
        "  - {name: r1, robot: cat, route: {start: [0, 0], goal: [9, 0]}}\n"
        "  - name: r1\n"
        "    robot: cart\n"
        "    route: {start: [0, 5], via: [[3, 3], [3, 3]], goal: [9, x]}\n"
        "    name: r3\n"
        "  - {name: r4, mission: none.yaml}\n"
        "fleets: 3\n"
    )
    with pytest.raises(MissionError) as refused:
        vs.load(file)
    found = [str(fault).removeprefix(f"{file}:").split(": ")[:2] for fault in refused.value.faults]
    assert found == [
        ["1:15", "separation_m"],
        ["3:20", "robots.cart.radius_m"],
        ["3:24", "robots.cart.clearence_m"],
        ["5:23", "fleet[0].robot"],
        ["6:11", "fleet[1].name"],
        ["8:42", "fleet[1].route.via[1].at"],
        ["8:61", "fleet[1].route.goal.at[1]"],
        ["9:5", "fleet[1].name"],
        ["10:25", "fleet[2].mission"],
        ["11:1", "fleets"],
    ]


def test_a_mistyped_fleet_is_still_told_from_a_mission(tmp_path: Path) -> None:
    file = tmp_path / "fleet.yaml"
    file.write_text("robots: {cart: {}}\nflet: []\n")
    with pytest.raises(MissionError, match=r"flet: unknown key; did you mean \'fleet\'\?"):
        vs.load(file)


@pytest.mark.parametrize("page", ["README.md", "docs/fleets.md"])
def test_the_fleet_of_the_documentation_is_sound(page: str, tmp_path: Path) -> None:
    text = (Path(__file__).parents[2] / page).read_text()
    blocks = re.findall(r"```yaml[^\n]*\n(.*?)```", text, re.DOTALL)
    (found,) = [block for block in blocks if "\nfleet:" in block]
    (tmp_path / "fleet.yaml").write_text(found)
    fleet = vs.load(tmp_path / "fleet.yaml")
    assert isinstance(fleet, vs.Fleet)
    assert len(fleet.members) > 1


NUMBERS = st.floats(0, 50).map(lambda value: round(value, 3))
NAMES = st.text(min_size=1, max_size=8)
OPTIONS = st.fixed_dictionaries(
    {},
    optional={
        "priority": st.floats(-9, 9),
        "depart_s": NUMBERS,
        "rest": st.sampled_from(["stay", "leave"]),
        "spline": st.fixed_dictionaries({"tension": st.floats(-1, 1)}),
    },
)
KIND = st.fixed_dictionaries(
    {"radius_m": st.floats(0.1, 1)},
    optional={"max_speed_mps": st.floats(0.5, 3), "clearance_m": st.floats(0, 1)},
)


@st.composite
def fleets(draw: st.DrawFn) -> dict[str, Any]:
    kinds = draw(st.dictionaries(NAMES, KIND, min_size=1, max_size=3))
    members = []
    for i, name in enumerate(draw(st.lists(NAMES, min_size=1, max_size=5, unique=True))):
        route = {"start": [0, 10 * i], "via": [[draw(NUMBERS), 10 * i + 1]], "goal": [99, 10 * i]}
        kind = draw(st.sampled_from(sorted(kinds)))
        members.append({"name": name, "robot": kind, "route": route, **draw(OPTIONS)})
    found = {"robots": kinds, "fleet": members, "separation_m": draw(st.floats(0, 3))}
    return {**found, "world": {"bounds": [-50, -50, 150, 150]}} if draw(st.booleans()) else found


@settings(
    max_examples=50, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=fleets())
def test_what_is_written_reads_the_same(data: dict[str, Any], tmp_path: Path) -> None:
    fleet = vs.Fleet.model_validate(data)
    (tmp_path / "again.yaml").write_text(fleet_text(fleet, tmp_path), "utf-8")
    assert vs.load(tmp_path / "again.yaml") == fleet
    text = fleet_text(fleet)
    assert FleetYaml().write(fleet, Whereabouts()).text == text
    assert FleetYaml().sniff(Path("again.yaml"), text)


def escaped(value: Any) -> Any:
    """A value with names of plain letters: not all that JSON may hold can stand in YAML."""
    if isinstance(value, dict):
        return {escaped(key): escaped(item) for key, item in value.items()}
    if isinstance(value, list):
        return [escaped(item) for item in value]
    return value.encode("unicode_escape").decode() if isinstance(value, str) else value


@settings(
    max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    data=fleets(),
    order=st.randoms(use_true_random=False),
    indent=st.sampled_from([None, 0, 1, 4]),
    before=st.sampled_from(["", "  ", "# a fleet\n\n", "---\n"]),
)
def test_a_fleet_in_braces_is_one_however_it_is_laid_out(
    data: dict[str, Any], order: random.Random, indent: int | None, before: str, tmp_path: Path
) -> None:
    asked = {key: escaped(data[key]) for key in order.sample(sorted(data), len(data))}
    (tmp_path / "braces.yaml").write_text(before + json.dumps(asked, indent=indent))
    assert vs.load(tmp_path / "braces.yaml") == vs.Fleet.model_validate(asked)


def test_a_fleet_whose_lines_are_all_indented_is_one(tmp_path: Path) -> None:
    (tmp_path / "fleet.yaml").write_text(textwrap.indent(FLEET, "  "))
    assert isinstance(vs.load(tmp_path / "fleet.yaml"), vs.Fleet)


def test_a_mission_that_has_words_of_fleets_in_it_is_none(tmp_path: Path) -> None:
    text = '{"world": {"known": [{"name": "fleet: 2", "circle": {"center": [0, 9], "radius": 1}}]},'
    (tmp_path / "one.yaml").write_text(f'{text} "route": {{"start": [0, 0], "goal": [9, 0]}}}}')
    assert isinstance(vs.load(tmp_path / "one.yaml"), vs.Mission)


def test_files_are_named_from_where_the_fleet_is_written(tmp_path: Path) -> None:
    (tmp_path / "depot.pgm").write_bytes(b"P5 4 2 255\n" + bytes([254] * 8))
    (tmp_path / "depot.yaml").write_text(
        "image: depot.pgm\nresolution: 5.0\norigin: [0, 0, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    (tmp_path / "track.csv").write_text("3, 8, 2, 2\n17, 8, 2, 2\n")
    (tmp_path / "a.yaml").write_text(
        "world: {known: [{map: depot.yaml}]}\nroute: {start: [3, 3], goal: [17, 3]}\n"
    )
    (tmp_path / "fleet.yaml").write_text(
        "world: {known: [{map: depot.yaml}]}\n"
        "fleet:\n"
        "  - {name: a, mission: a.yaml}\n"
        "  - {name: b, route: {start: [4, 8], goal: [16, 8], corridor: {csv: track.csv}}}\n"
    )
    fleet = vs.load(tmp_path / "fleet.yaml")
    assert isinstance(fleet, vs.Fleet)
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "again.yaml").write_text(fleet_text(fleet, tmp_path / "sub"), "utf-8")
    text = (tmp_path / "sub" / "again.yaml").read_text()
    for name in ("../depot.yaml", "../a.yaml", "../track.csv"):
        assert name in text
    again = vs.load(tmp_path / "sub" / "again.yaml")
    assert isinstance(again, vs.Fleet)
    assert again.members == fleet.members


def test_what_was_made_in_memory_is_not_written() -> None:
    route = {"start": [1, 1], "goal": [7, 1]}
    grid = {"known": [{"grid": Grid(np.zeros((4, 8), dtype=bool), 1.0)}]}
    on_grid = vs.Fleet.model_validate({"world": grid, "fleet": [{"name": "a", "route": route}]})
    mission = vs.Mission.model_validate({"route": route})
    of_mission = vs.Fleet.model_validate({"fleet": [{"name": "a", "mission": mission}]})
    for fleet in (on_grid, of_mission):
        with pytest.raises(OutputError, match="made in memory"):
            fleet_text(fleet)


def test_a_thousand_robots_are_read_in_a_second_or_two_and_their_map_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened = []
    read = vs.load  # imported before the clock starts
    monkeypatch.setattr("viaspline.mission.resolve_files.read_grid", _counting(opened, "read_grid"))
    (tmp_path / "depot.map").write_text(
        "type octile\nheight 64\nwidth 600\nmap\n" + ("." * 600 + "\n") * 64
    )
    world = "world: {known: [{map: depot.map}]}\n"
    rows = [
        f"  - {{name: r{i}, robot: cart, route: {{start: [{x}, {y}], "
        f"via: [[30, {i % 60 + 2}], [90, 20]], goal: [{x}, {y + 4}]}}}}\n"
        for i in range(1000)
        for x, y in [(2 + 2 * (i % 250), 2 + 8 * (i // 250))]
    ]
    kinds = "separation_m: 0.5\nrobots: {cart: {radius_m: 0.5}}\n"
    (tmp_path / "fleet.yaml").write_text(world + kinds + "fleet:\n" + "".join(rows))
    began = time.process_time()
    fleet = read(tmp_path / "fleet.yaml")
    assert isinstance(fleet, vs.Fleet)
    assert len(fleet.members) == 1000
    assert len(opened) == 1
    assert time.process_time() - began < 10.0  # a second on an idle machine


def _counting(calls: list[Any], name: str) -> Any:
    from viaspline.maps.kinds import read_grid

    def counted(*arguments: Any, **named: Any) -> Any:
        calls.append(name)
        return read_grid(*arguments, **named)

    return counted


def test_a_round_of_one_lap_is_written_as_one_and_a_patrol_as_one() -> None:
    square = {"start": [0, 0], "via": [[9, 0], [9, 9]], "closed": True}
    fleet = vs.Fleet.model_validate(
        {
            "fleet": [
                {"name": "once", "route": {**square, "laps": 1}},
                {"name": "for ever", "route": {**square, "start": [20, 0]}},
            ]
        }
    )
    again = FleetYaml().read(fleet_text(fleet), "round.yaml")
    assert [one.mission.route.is_patrol for one in again.members] == [False, True]
    assert again == fleet
