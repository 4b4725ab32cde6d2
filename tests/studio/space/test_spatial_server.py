"""A mission in space is opened, edited, planned, flown and saved over the studio's connection."""

from __future__ import annotations

import base64
import json
import urllib.request
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from viaspline.formats.load import load
from viaspline.formats.yaml_document import read_document
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.model import Mission
from viaspline.mission.world_spec import WorldSpec
from viaspline.report.space.spatial_json import flight_csv, spatial_plan_json
from viaspline.space.online.fly import fly
from viaspline.space.plan_spatial import plan_spatial
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.studio.space.scene_data import Scenes

Start = Callable[..., Any]

TEXT = """\
# a tower between a pad and a yard
world:
  bounds: [-20, -40, 120, 40]
  altitude: {min_m: 2, max_m: 60, above: home}   # the airfield is near
  ground: {flat_m: 0}
  known:
    - {name: tower, circle: {center: [60, 1], radius: 6}, height_m: [0, 35]}
    - {name: cable, capsule: {from: [20, -30, 25], to: [20, 30, 25], radius: 0.05}}
robot: {radius_m: 0.4, half_height_m: 0.2, clearance_m: 1, max_speed_mps: 6, max_climb_mps: 2}
route:
  start: {at: [0, 0], name: pad}
  takeoff: {to_agl_m: 10}
  via:
    - {at: [40, 0], agl_m: 12}   # before the tower
    - [90, 0, 20]
  land: {at: [110, 0]}
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "tower.yaml"
    path.write_text(TEXT)
    return path


def planned(path: Path) -> SpatialPlan:
    mission = load(path)
    assert isinstance(mission, Mission)
    return plan_spatial(mission)


def scene_of(studio: Any, name: str) -> Any:
    with urllib.request.urlopen(f"{studio.url}scenes/{name}.json") as response:
        assert response.headers["content-type"].startswith("application/json")
        return json.loads(response.read())


def whole(client: Any, answer: Any) -> Any:
    """The answer for which all ways were weighed."""
    while not answer["space"]["is_whole"]:
        answer = client.hear("planned")
    return answer


def test_the_plan_of_a_mission_in_space_is_that_of_the_command_line(
    start: Start, file: Path
) -> None:
    plan = planned(file)
    with start(file).client() as client:
        assert client.hello["document"] == read_document(file).data
        answer = whole(client, client.edit())
    assert answer["ok"]
    assert answer["space"]["spans"] == np.asarray(plan.path.spans).ravel().tolist()
    assert answer["spans"] == np.asarray(plan.path.spans)[:, :, :2].ravel().tolist()
    assert answer["certificate"]["clearance"] == plan.certificate.clearance
    assert answer["duration"] == plan.trajectory.duration
    stops = answer["space"]["stops"]
    assert [stop["at"][2] for stop in stops] == [10, 12, 20, 20]
    assert [stop["index"] for stop in stops] == [0, 1, 2, 3]
    assert answer["space"]["band"] == [2, 60, None, None]


def test_a_tension_that_is_left_to_the_planner_is_that_of_the_command_line(
    start: Start, file: Path
) -> None:
    file.write_text(f"{TEXT}spline: {{tension: auto}}\n")
    plan = planned(file)
    assert plan.mission.spline.tension != "auto"
    with start(file).client() as client:
        answer = whole(client, client.edit())
    assert answer["ok"]
    assert answer["space"]["spans"] == np.asarray(plan.path.spans).ravel().tolist()


def test_a_cheapest_way_comes_first_and_then_the_best_of_all_weighed(
    start: Start, file: Path
) -> None:
    with start(file).client() as client:
        first = client.edit()
        assert not first["space"]["is_whole"]
        assert first["certificate"]["holds"]
        best = whole(client, first)
        ledger = client.hear("ledger")
    assert best["rev"] == first["rev"]
    assert best["duration"] <= first["duration"] + 1e-6
    (entry,) = ledger["entries"]
    assert entry["members"] == ["tower"]
    assert entry["items"] == [0]
    sides = [candidate["side"] for candidate in entry["candidates"]]
    assert len(set(sides)) == len(sides) >= 2
    assert sum(candidate["chosen"] for candidate in entry["candidates"]) == 1
    loser = next(one for one in entry["candidates"] if not one["chosen"] and one["spans"])
    assert len(loser["spans3"]) * 2 == len(loser["spans"]) * 3


def test_a_leg_that_stays_is_not_searched_again(start: Start, file: Path) -> None:
    with start(file).client() as client:
        whole(client, client.edit())
        moved = client.edit([["route", "land", "at", 1], 5])
    assert moved["ok"]
    assert moved["space"]["is_whole"]  # the leg past the tower was known


def test_what_stands_in_the_world_is_told_once(start: Start, file: Path) -> None:
    studio = start(file)
    with studio.client() as client:
        answer = client.edit()
        name = answer["space"]["scene"]
        scene = scene_of(studio, name)
        assert client.edit([["route", "via", 0, "agl_m"], 15])["space"]["scene"] == name
        other = client.edit([["world", "known", 0, "height_m"], [0, 20]])["space"]["scene"]
    assert other != name
    tower, cable = scene["solids"]
    assert (tower["kind"], tower["low"], tower["high"], tower["name"]) == ("prism", 0, 35, "tower")
    ring = np.reshape(tower["parts"][0][0], (-1, 2))
    assert np.allclose(np.hypot(*(ring - (60, 1)).T), 6, atol=0.03)
    assert (cable["kind"], cable["first"], cable["radius"]) == ("segment", [20, -30, 25], 0.05)
    assert scene["flat"] == 0
    assert scene["terrain"] is None


def test_the_elevation_says_ground_band_and_what_is_near(start: Start, file: Path) -> None:
    with start(file).client() as client:
        answer = client.edit()
        profile = client.hear("profile")
    assert profile["rev"] == answer["rev"]
    assert profile["distances"][-1] == pytest.approx(answer["length"], abs=1e-3)
    assert set(profile["ground"]) == {0}
    assert set(profile["low"]) == {2}
    assert set(profile["high"]) == {60}
    near = {one["name"]: one for one in profile["near"]}
    assert {"tower", "cable"} <= set(near)
    assert max(near["cable"]["meets"]) == 1  # the path runs under it
    assert set(near["tower"]["high"]) == {35}


def test_heights_are_edited_and_saved_with_every_comment(start: Start, file: Path) -> None:
    with start(file).client() as client:
        client.edit()
        answer = client.edit([["route", "via", 0, "agl_m"], 17.5], [["route", "via", 1, 2], 22])
        assert answer["ok"]
        assert [stop["at"][2] for stop in answer["space"]["stops"]][1:3] == [17.5, 22]
        client.ask("save", "saved", name=file.name)
    expected = TEXT.replace("agl_m: 12}   #", "agl_m: 17.5}   #").replace(
        "[90, 0, 20]", "[90, 0, 22]"
    )
    assert file.read_text().split() == expected.split()


@pytest.mark.parametrize(
    ("change", "words", "path"),
    [
        ([["route", "via", 0, "agl_m"], 80], "above the altitude band", ["route", "via", 0]),
        ([["route", "via", 0, "at"], [60, 0]], "tower", ["route", "via", 0]),
        ([["route", "via", 1], [90, 0, -3]], "ground", ["route", "via", 1]),
        ([["world", "altitude"], {"min_m": 50, "max_m": 10}], "", ["world", "altitude"]),
    ],
)
def test_what_cannot_be_flown_is_refused_in_words_with_its_place(
    start: Start, file: Path, change: Any, words: str, path: list[Any]
) -> None:
    with start(file).client() as client:
        answer = client.edit(change)
        again = client.edit(*([change[0], value] for value in [part(change[0])]))
    assert not answer["ok"]
    problem = answer["problems"][0]
    assert words in problem["text"]
    assert problem["path"][: len(path)] == path
    assert again["ok"]


def part(path: list[Any]) -> Any:
    """What stands at a path in the mission of this file."""
    from viaspline.studio.yaml_round_trip import read

    node = read(TEXT)
    for step in path:
        node = node[step]
    return node


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ([["world", "ground"], {"terrain": "../elsewhere.asc"}], "outside of the studio's folder"),
        ([["world", "ground"], {"terrain": "none.asc"}], "none.asc"),
        ([["world", "known", 0], {"voxels": {"file": "none.bt"}}], "none.bt"),
        (
            [["world", "known", 0], {"voxels": {"file": "../x.bt"}}],
            "outside of the studio's folder",
        ),
    ],
)
def test_files_that_cannot_be_read_are_named(
    start: Start, file: Path, change: Any, words: str
) -> None:
    with start(file).client() as client:
        answer = client.edit(change)
    assert not answer["ok"]
    problem = answer["problems"][0]
    assert words in problem["text"] + problem["remedy"]
    assert problem["path"][:2] == change[0][:2]
    assert str(file.parent) not in problem["text"]


def test_a_flight_is_told_with_its_heights_and_what_the_sensor_saw(
    start: Start, file: Path
) -> None:
    with start(file).client() as client:
        whole(client, client.edit())
        run = client.ask("drive", "driven")
        exported = client.ask("export", "exported", kind="run.csv")
        picture = client.ask("export", "exported", kind="run.png")
        crane = {"name": "crane", "circle": {"center": [20, 0], "radius": 3}, "height_m": [0, 30]}
        client.edit([["world", "unseen"], [crane]], [["robot", "sensor"], {"range_m": 15}])
        surprised = client.ask("drive", "driven")
    flight = fly(planned(file))
    assert run["reached"]
    assert run["samples"]["z"] == np.round(flight.positions[:, 2], 4).tolist()
    assert run["sight"] is None
    assert "passed 'via 2'" in [event["message"] for event in run["events"]]
    assert base64.b64decode(exported["data"]).decode() == flight_csv(flight)
    assert base64.b64decode(picture["data"]).startswith(b"\x89PNG")
    kinds = [event["kind"] for event in surprised["events"]]
    assert kinds.index("detected") < kinds.index("replanned") < kinds.index("reached")
    assert surprised["sight"]["reach"] == 15
    assert 0 < surprised["sight"]["seen"][0] < surprised["duration"]
    (replan,) = surprised["replans"]
    assert replan["spans"]
    assert len(replan["spans"]) % 8 == 0
    assert surprised["clearance"] >= 1 - 1e-6


def test_what_moves_unseen_is_told_when_the_sensor_first_shows_it(start: Start, file: Path) -> None:
    bird = {"name": "bird", "ball": {"center": [0, 0, 0], "radius": 1},
            "motion": {"from": [40, 30, 12], "velocity_mps": [0, -2, 0]}}  # fmt: skip
    with start(file).client() as client:
        client.edit([["world", "unseen"], [bird]], [["robot", "sensor"], {"range_m": 15}])
        run = client.ask("drive", "driven")
    (seen,) = run["sight"]["seen"]
    samples = run["samples"]
    at = np.column_stack([samples[axis] for axis in "xyz"])
    times = np.array(samples["time"])
    away = np.linalg.norm(at - [40, 30, 12] - times[:, None] * [0, -2, 0], axis=1) - 1.0
    first = float(times[int(np.argmax(away <= 15.0))])
    assert abs(seen - first) <= 0.15


def test_the_files_of_a_plan_are_those_of_the_command_line(start: Start, file: Path) -> None:
    with start(file).client() as client:
        whole(client, client.edit())
        exported = client.ask("export", "exported", kind="plan.json")
        refused = client.ask("advise", "refused")
    assert base64.b64decode(exported["data"]).decode() == spatial_plan_json(planned(file), "tower")
    assert "space" in refused["message"]


def test_voxels_and_terrain_are_drawn_from_their_own_numbers() -> None:
    cubes = np.zeros((3, 2, 2), bool)
    cubes[1, 0, 1] = cubes[2, 1, 0] = True
    slope = np.add.outer(np.zeros(4), 10.0 * np.arange(5))
    slope[3, 4] = np.nan
    world = WorldSpec.model_validate({
        "ground": {"terrain": Terrain(slope, cell=10.0, origin=(-5.0, 0.0))},
        "known": [{"voxels": Voxels(cubes, cell=0.5, origin=(1.0, 2.0, 0.0))}],
    })  # fmt: skip
    scenes = Scenes()
    name = scenes.name_of(world)
    assert scenes.name_of(world.model_copy()) == name
    assert scenes.content("none") is None
    scene = json.loads(scenes.content(name) or b"")
    (voxels,) = scene["solids"]
    indices = np.frombuffer(base64.b64decode(voxels["cubes"]), "<i2").reshape(-1, 3)
    assert {tuple(index) for index in indices.tolist()} == {(1, 0, 1), (2, 1, 0)}
    assert base64.b64decode(voxels["roofs"])[:4] == b"\x89PNG"
    mesh = scene["terrain"]
    assert (mesh["nx"], mesh["ny"], mesh["cell"], mesh["heights"][-1]) == (5, 4, 10.0, None)
    assert mesh["heights"][:5] == [0, 10, 20, 30, 40]
    for contour in scene["contours"]:  # the slope rises 1 m in a metre
        x = np.reshape(contour["line"], (-1, 2))[:, 0]
        assert np.allclose(x + 5, contour["height"], atol=0.02)


def test_in_another_folder_voxels_and_terrain_are_named_from_there(
    start: Start, file: Path
) -> None:
    (file.parent / "maps").mkdir()
    (file.parent / "maps" / "deep").mkdir()
    grid = "ncols 3\nnrows 3\nxllcorner -100\nyllcorner -100\ncellsize 150\n"
    (file.parent / "maps" / "even.asc").write_text(grid + "0 0 0\n" * 3)
    (file.parent / "maps" / "one.3dmap").write_text("voxel 4 4 4\n1 1 1\n")
    with start(file).client() as client:
        client.edit()
        voxels = {"voxels": {"file": "maps/one.3dmap", "cell_m": 0.5, "origin_m": [50, -20, 0]}}
        answer = client.edit(
            [["world", "ground"], {"terrain": "maps/even.asc"}],
            [["world", "known", 2], voxels],
        )
        assert answer["ok"], answer["problems"]
        saved = client.ask("save", "saved", name="maps/deep/tower.yaml")
        again = client.edit([["route", "land", "at", 1], 1])
    assert again["ok"], again["problems"]
    assert saved["document"]["world"]["ground"] == {"terrain": "../even.asc"}
    assert saved["document"]["world"]["known"][2]["voxels"]["file"] == "../one.3dmap"
    assert planned(file.parent / "maps" / "deep" / "tower.yaml").certificate.holds


def test_way_points_are_saved_with_their_heights(start: Start, file: Path) -> None:
    with start(file).client() as client:
        client.edit()
        saved = client.ask("save", "saved", name="tower.plan", origin="47.1, 8.5")
    assert saved["name"] == "tower.plan"
    items = json.loads((file.parent / "tower.plan").read_text())["mission"]["items"]
    assert 12 in [item.get("Altitude") for item in items]


def test_the_path_of_a_flight_is_exported_with_its_heights(start: Start, file: Path) -> None:
    with start(file).client() as client:
        whole(client, client.edit())
        told = {
            kind: client.ask("export", "exported", kind=kind, origin="47.4, 8.5")
            for kind in ("path.geojson", "path.waypoints")
        }
    line = json.loads(base64.b64decode(told["path.geojson"]["data"]))["features"][0]["geometry"]
    heights = np.array(line["coordinates"])[:, 2]
    flown = planned(file).path
    assert heights[0] == pytest.approx(flown.spans[0, 0, 2], abs=0.05)
    assert heights.max() == pytest.approx(
        flown.evaluate(np.linspace(*flown.domain, 2001))[:, 2].max(), abs=0.3
    )
    assert "m clear" in told["path.geojson"]["told"][0]
    rows = base64.b64decode(told["path.waypoints"]["data"]).decode().splitlines()
    assert rows[0] == "QGC WPL 110"
    commands = [int(row.split("\t")[3]) for row in rows[2:]]
    assert {22, 21} <= set(commands)  # take off and land


def test_variants_in_space_are_planned_whole(start: Start, file: Path) -> None:
    with start(file).client() as client:
        asked = [[], [[["robot", "clearance_m"], 400]]]
        end = client.ask("compare", "compared", number=1, variants=asked)
        rows = [m for m in client.heard if m["type"] == "variant"]
    assert not end["stopped"]
    own = planned(file)
    assert rows[0]["length"] == pytest.approx(own.path.length, rel=1e-9)
    assert rows[0]["duration"] == pytest.approx(own.trajectory.duration, rel=1e-9)
    assert (rows[0]["jumps"], rows[0]["verdict"]) == (None, None)
    assert not rows[1]["ok"]
    assert rows[1]["words"][0]
