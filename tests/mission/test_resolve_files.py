import copy
import math
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import jsonschema
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import viaspline as vs
from viaspline.errors import MissionError, OutputError
from viaspline.formats.load import load
from viaspline.formats.mission_yaml import yaml_text
from viaspline.maps.grid import Grid
from viaspline.maps.squares import signed_distance
from viaspline.mission.json_schema import json_schema
from viaspline.mission.load_map import load_map
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle

Site: TypeAlias = Callable[..., Path]

ROUTE = {"start": [0.5, 0.5], "goal": [4.5, 0.5]}
POINT = {"radius_m": 0, "clearance_m": 0}
DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg"><path d="M1 -3H2V-4z"/><path d="M3 -3H4V-4z"/></svg>'
)
FEATURES = (
    '{"type": "FeatureCollection", "features": ['
    '{"type": "Feature", "properties": {"Name": "shed"}, "geometry": {"type": "MultiPolygon",'
    ' "coordinates": [[[[1, 3], [2, 3], [2, 4]]], [[[3, 3], [4, 3], [4, 4]]]]}},'
    '{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates":'
    " [[[1, 6], [2, 6], [2, 7]]]}}]}"
)


@pytest.fixture
def site(tmp_path: Path) -> Site:
    """A folder with maps: 5 x 4 squares of a metre, the third row from below blocked."""
    pixels = [254] * 5 + [0] * 5 + [254, 254, 254, 150, 254] + [254] * 5
    (tmp_path / "maps").mkdir()
    (tmp_path / "maps" / "a.pgm").write_bytes(b"P5 5 4 255\n" + bytes(pixels))
    (tmp_path / "b.map").write_text("type octile\nheight 2\nwidth 3\nmap\n...\n.@.\n")
    (tmp_path / "cars.svg").write_text(DRAWING)
    (tmp_path / "site.geojson").write_text(FEATURES)

    def write(**keys: Any) -> Path:
        spec = {"image": "a.pgm", "resolution": 1, "origin": [0, 0, 0], "negate": 0} | {
            "occupied_thresh": 0.65, "free_thresh": 0.25, **keys,
        }  # fmt: skip
        text = "".join(f"{key}: {value}\n" for key, value in spec.items())
        (tmp_path / "maps" / "a.yaml").write_text(text)
        return tmp_path

    write()
    return write


def mission_in(folder: Path, *known: str, more: str = "", route: str = "") -> Path:
    file = folder / "mission.yaml"
    items = "".join(f"    - {item}\n" for item in known)
    file.write_text(
        f"world:\n  known:\n{items}{more}robot: {{radius_m: 0, clearance_m: 0}}\n"
        f"route: {route or '{start: [0.5, 0.5], goal: [4.5, 0.5]}'}\n"
    )
    return file


def mission_of(*known: Any, **world: Any) -> Mission:
    return Mission.model_validate(
        {"world": {"known": list(known), **world}, "robot": POINT, "route": ROUTE}
    )


def faults_of(file: Path) -> list[str]:
    with pytest.raises(MissionError) as caught:
        vs.load(file)
    return [str(fault).replace(f"{file.parent}/", "") for fault in caught.value.faults]


def test_a_map_of_squares_is_one_obstacle_and_the_robot_stays_on_it(site: Site) -> None:
    mission = vs.load(mission_in(site(), "{map: maps/a.yaml, name: hall}"))
    (hall,) = mission.world.known
    assert hall.grid is not None
    assert (hall.name, hall.grid.source) == ("hall", "maps/a.yaml")
    assert hall.grid.blocked.astype(int).tolist() == [
        [0, 0, 0, 0, 0], [0, 0, 0, 1, 0], [1, 1, 1, 1, 1], [0, 0, 0, 0, 0],
    ]  # fmt: skip
    assert mission.world.bounds == (0, 0, 5, 4)


def test_the_file_is_looked_for_beside_the_mission_or_from_the_working_directory(
    site: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = site()
    monkeypatch.chdir(folder / "maps")
    loaded = vs.load(mission_in(folder, "map: maps/a.yaml"))
    assert mission_of({"map": "a.yaml"}) == loaded
    assert mission_of({"map": folder / "maps" / "a.yaml"}) == loaded


def test_what_is_unknown_is_blocked_unless_said_otherwise(site: Site) -> None:
    folder = site()
    blocked = vs.load(mission_in(folder, "{map: maps/a.yaml, unknown: blocked}"))
    assert blocked == vs.load(mission_in(folder, "map: maps/a.yaml"))
    free = vs.load(mission_in(folder, "{map: maps/a.yaml, unknown: free}"))
    counts = [m.world.known[0].grid.blocked.sum() for m in (blocked, free) if m.world.known[0].grid]
    assert counts == [6, 5]


def test_several_maps_are_in_one_world_and_the_robot_stays_in_the_box_round_them(
    site: Site,
) -> None:
    disc = "circle: {center: [3, 9], radius: 1}"
    file = mission_in(site(), "map: maps/a.yaml", "{map: b.map, resolution_m: 6}", disc)
    mission = vs.load(file)
    assert mission.world.bounds == (0, 0, 18, 12)
    assert [item.grid is not None for item in mission.world.known] == [True, True, False]


def test_a_map_that_is_turned_brings_its_corners_as_a_fence(site: Site) -> None:
    folder = site(origin=[0, 0, 0.5])
    route = "{start: [0.5, 0.6], goal: [3, 2]}"
    file = mission_in(folder, "map: maps/a.yaml", "{map: maps/a.yaml, unknown: free}", route=route)
    mission = vs.load(file)
    assert mission.world.bounds is None
    (fence,) = mission.world.fences
    cos, sin = math.cos(0.5), math.sin(0.5)
    expected = [(0, 0), (5 * cos, 5 * sin), (5 * cos - 4 * sin, 5 * sin + 4 * cos)]
    assert np.allclose(fence[:3], expected)
    outside = mission_in(folder, "map: maps/a.yaml", route="{start: [0.5, 0.6], goal: [1, 0.2]}")
    assert "goal lies 0.304 m outside the edge of the map; move it to" in faults_of(outside)[0]


def test_bounds_that_are_given_stay_and_maps_of_areas_and_unseen_ones_bring_none(
    site: Site,
) -> None:
    folder = site()
    assert vs.load(mission_in(folder, "map: cars.svg")).world.bounds is None
    given = mission_in(folder, "map: maps/a.yaml", more="  bounds: [0, 0, 9, 9]\n")
    assert vs.load(given).world.bounds == (0, 0, 9, 9)
    unseen = mission_in(
        folder, "circle: {center: [9, 9], radius: 1}", more="  unseen: [{map: maps/a.yaml}]\n"
    )
    unseen.write_text(unseen.read_text().replace("radius_m", "sensor: {range_m: 9}, radius_m"))
    world = vs.load(unseen).world
    assert world.bounds is None
    assert world.unseen[0].grid is not None


def test_a_grid_that_was_made_in_memory_brings_its_edge_too() -> None:
    grid = Grid(np.zeros((4, 6)), 1.0)
    mission = mission_of(Obstacle(grid=grid))
    assert mission.world.bounds == (0, 0, 6, 4)
    assert mission_of({"grid": grid}) == mission
    assert Mission(world=mission.world, route=mission.route, robot=mission.robot) == mission


def test_each_polygon_of_a_drawing_is_an_obstacle(site: Site) -> None:
    folder = site()
    world = vs.load(mission_in(folder, "{map: cars.svg, pass_on: left}")).world
    assert [item.name for item in world.known] == [None, None]
    assert world.known[0].polygon == ((1, 3), (2, 3), (2, 4))
    assert {item.pass_on for item in world.known} == {"left"}
    scaled = vs.load(mission_in(folder, "{map: cars.svg, resolution_m: 2, name: car}")).world
    assert [item.name for item in scaled.known] == ["car 1", "car 2"]
    assert scaled.known[0].polygon == ((2, 6), (4, 6), (4, 8))


def test_names_of_a_file_are_kept_apart(site: Site) -> None:
    items = (
        "map: site.geojson", "{map: site.geojson, name: depot}",
        "{circle: {center: [9, 9], radius: 1}, name: shed-2}",
    )  # fmt: skip
    world = vs.load(mission_in(site(), *items)).world
    assert [item.name for item in world.known] == [
        "shed", "shed-3", None, "depot shed", "depot shed-2", "depot 3", "shed-2",
    ]  # fmt: skip


def test_a_fault_behind_a_map_of_areas_stands_where_it_stands(site: Site) -> None:
    file = mission_in(
        site(), "map: cars.svg", "{circle: {center: [9, 9], radius: 0}}", "{name: nothing}"
    )
    assert [fault.partition(";")[0] for fault in faults_of(file)] == [
        "mission.yaml:4:41: world.known[1].circle.radius: 0 is out of range",
        "mission.yaml:5:7: world.known[2]: the obstacle has no shape",
    ]
    sound = mission_in(site(), "map: cars.svg", "{name: nothing}")
    assert faults_of(sound)[0].startswith("mission.yaml:4:7: world.known[1]: the obstacle has no")


@pytest.mark.parametrize(
    ("item", "fault"),
    [
        ("map: no.yaml", "3:7: world.known[0].map: no.yaml: there is no such file; give the path"),
        ("map: maps", "3:7: world.known[0].map: maps: is a folder; understood are ROS's map_se"),
        ("map: maps/a.pgm", "3:7: world.known[0].map: maps/a.pgm: is a picture, not a map; give"),
        ("map: a.kml", "3:7: world.known[0].map: a.kml: is a kind of map that isn't understood;"),
        ("map: [1]", "3:12: world.known[0].map: found a list of 1; it should be the path of a"),
        ("{map: b.map, unknown: free}", "3:20: world.known[0].unknown: nothing is unknown in a"),
        ("{map: cars.svg, unknown: free}", "3:23: world.known[0].unknown: nothing is unknown in"),
        ("{map: maps/a.yaml, unknown: 1}", "3:35: world.known[0].unknown: found 1; it should be"),
        ("{map: maps/a.yaml, resolution_m: 2}", "3:26: world.known[0].resolution_m: a map of map"),
        ("{map: site.geojson, resolution_m: 2}", "3:27: world.known[0].resolution_m: GeoJSON is"),
        ("{map: b.map, resolution_m: 0}", "3:34: world.known[0].resolution_m: 0 is out of range;"),
        (
            "{map: maps/a.yaml, pass_on: left}",
            "3:26: world.known[0].pass_on: a map of squares has no",
        ),
        ("{map: b.map, resolution: 2}", "3:20: world.known[0].resolution: unknown key; did you"),
        (
            "{map: b.map, circle: {center: [1, 1], radius: 1}}",
            "3:20: world.known[0].circle: doesn't go with a map; keep one of the two, or make it",
        ),
        (
            "{circle: {center: [9, 9], radius: 1}, unknown: free}",
            "3:45: world.known[0].unknown: goes with a map only; give map, or leave it out",
        ),
    ],
)
def test_each_mistake_about_a_map_is_one_fault_in_its_place(
    item: str, fault: str, site: Site
) -> None:
    (found,) = faults_of(mission_in(site(), item))
    assert found.startswith(f"mission.yaml:{fault}")
    assert "; " in found


def test_faults_of_a_map_name_their_own_place_and_come_with_all_others(site: Site) -> None:
    folder = site(resolution=-1, image="none.pgm", free_thresh=0.9)
    file = mission_in(folder, "map: maps/a.yaml", "{map: b.map}", "circle: 5")
    assert [fault.rpartition(";")[0] for fault in faults_of(file)] == [
        "mission.yaml:3:7: world.known[0].map: maps/a.yaml:2:13: resolution: found -1",
        "mission.yaml:3:7: world.known[0].map: maps/a.yaml:5:18: occupied_thresh: found 0.65",
        "mission.yaml:5:15: world.known[2].circle: found 5",
    ]
    broken = mission_in(site(image="none.pgm"), "map: maps/a.yaml")
    assert faults_of(broken)[0].startswith(
        "mission.yaml:3:7: world.known[0].map: maps/a.yaml:1:8: image: maps/none.pgm: there is no"
    )


@pytest.mark.parametrize(
    ("start", "words"),
    [
        ("[2.5, 2.25]", "start lies 0.25 m inside map 'maps/a.yaml'; move it to (2.5, 2)"),
        (
            "[3.5, 1.6]",
            "start lies in unknown space of map 'maps/a.yaml'; move it to (2.999, 1.6) or set "
            "unknown: free for the map",
        ),
        ("[5.25, 0.5]", "start lies 0.25 m outside the edge of the map; move it to (5, 0.5)"),
    ],
)
def test_a_start_on_a_blocked_or_unknown_square_is_told_the_nearest_free_place(
    start: str, words: str, site: Site
) -> None:
    file = mission_in(site(), "map: maps/a.yaml", route=f"{{start: {start}, goal: [0.5, 0.5]}}")
    (fault,) = faults_of(file)
    found, _, place = fault.partition("move it to")
    expected, _, near = words.partition("move it to")
    assert found == f"mission.yaml:5:16: route.start.at: {expected}"
    x, y = map(float, place.partition(")")[0].strip(" (").split(", "))
    x_near, y_near = map(float, near.partition(")")[0].strip(" (").split(", "))
    assert math.dist((x, y), (x_near, y_near)) < 2e-3
    assert place.partition(")")[2] == near.partition(")")[2]


cells = arrays.arrays(bool, st.tuples(st.integers(3, 12), st.integers(3, 12)))


@settings(deadline=None, max_examples=60)
@given(
    blocked=cells, radius=st.floats(0, 1), yaw=st.sampled_from([0.0, 0.4]),
    at=st.tuples(st.floats(0, 1), st.floats(0, 1)),
)  # fmt: skip
def test_whatever_place_is_advised_is_free_and_hardly_any_is_nearer(
    blocked: Any, radius: float, yaw: float, at: tuple[float, float]
) -> None:
    grid = Grid(blocked, 0.5, (0, 0, yaw))
    start = tuple(grid.to_world([(at[0] * grid.width, at[1] * grid.height)])[0].tolist())
    data: Any = {
        "world": {"known": [{"grid": grid}], "bounds": [-50, -50, 50, 50]},
        "robot": {"radius_m": radius, "clearance_m": 0},
        "route": {"start": start, "goal": [40, 40]},
    }
    try:
        Mission.model_validate(data)
    except MissionError as error:
        (fault,) = error.faults
    else:
        assert signed_distance(grid, start, 5) >= radius - 1e-6
        return
    assert signed_distance(grid, start, 5) < radius
    place = fault.remedy.partition("(")[2].partition(")")[0]
    advised = tuple(map(float, place.split(", ")))
    Mission.model_validate({**data, "route": {"start": advised, "goal": [40, 40]}})
    away = math.dist(advised, start)
    for angle in np.linspace(0, 2 * np.pi, 60):
        near = start + 0.97 * max(away - 0.01, 0) * np.array([math.cos(angle), math.sin(angle)])
        assert signed_distance(grid, near, 5) < radius + 0.01 * radius + 0.004


@pytest.mark.parametrize(
    "items",
    [
        ["map: maps/a.yaml"],
        ["{map: maps/a.yaml, unknown: free, name: hall}", "{map: b.map, resolution_m: 6}"],
        ["{map: cars.svg, name: car}", "map: site.geojson"],
    ],
)
@pytest.mark.parametrize("yaw", [0, 0.1])
def test_a_mission_with_maps_is_the_same_when_it_was_written_elsewhere(
    items: list[str], yaw: float, site: Site
) -> None:
    folder = site(origin=[0, 0, yaw])
    mission = vs.load(mission_in(folder, *items, route="{start: [0.3, 0.5], goal: [2, 0.7]}"))
    (folder / "out").mkdir()
    (folder / "out" / "m.yaml").write_text(yaml_text(mission, folder / "out"), "utf-8")
    assert load(folder / "out" / "m.yaml") == mission
    assert hash(load(folder / "out" / "m.yaml")) == hash(mission)
    for again in (copy.deepcopy(mission), pickle.loads(pickle.dumps(mission))):
        assert again == mission
    assert Mission.model_validate(mission.model_dump()) == mission


def test_a_map_is_written_by_its_name_without_the_bounds_that_it_brings(
    site: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = site()
    monkeypatch.chdir(folder)
    mission = mission_of({"map": "maps/a.yaml", "unknown": "free", "name": "hall"})
    text = yaml_text(mission)
    assert '\n    - {map: "maps/a.yaml", unknown: free, name: hall}\n' in text
    assert "bounds" not in text
    assert '{map: "a.yaml"' in yaml_text(mission, folder / "maps")
    absolute = mission_of({"map": str(folder / "maps" / "a.yaml")})
    assert f'{{map: "{folder}/maps/a.yaml"}}' in yaml_text(absolute, folder / "maps")


def test_a_grid_that_was_made_in_memory_is_not_written(tmp_path: Path) -> None:
    mission = mission_of(Obstacle(grid=Grid(np.zeros((4, 6)), 1.0), name="hall"))
    with pytest.raises(OutputError, match="obstacle 'hall' is a grid made in memory"):
        (tmp_path / "m.yaml").write_text(yaml_text(mission, tmp_path), "utf-8")
    assert list(tmp_path.iterdir()) == []


def test_maps_are_read_from_python_too(site: Site, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(site())
    (hall,) = vs.load_map("maps/a.yaml", unknown="free", name="hall")
    assert isinstance(hall.grid, vs.Grid)
    assert mission_of(hall) == mission_of({"map": "maps/a.yaml", "unknown": "free", "name": "hall"})
    assert len(load_map(Path("cars.svg"), name="car")) == 2
    with pytest.raises(MissionError, match=r"^maps/none\.yaml: there is no such file"):
        load_map("maps/none.yaml")
    with pytest.raises(MissionError, match='unknown: found the text "no"; it should be blocked or'):
        load_map("maps/a.yaml", unknown="no")  # type: ignore[arg-type]


def test_the_schema_knows_maps() -> None:
    validator = jsonschema.Draft202012Validator(json_schema())

    def is_sound(item: Any) -> bool:
        world = {"known": [item], "unseen": [item]}
        return bool(validator.is_valid({"world": world, "route": ROUTE}))

    assert is_sound({"map": "depot.yaml"})
    assert is_sound({"map": "depot.yaml", "unknown": "free", "name": "hall", "resolution_m": 2})
    for wrong in ({"map": ""}, {"map": 5}, {"map": "a", "unknown": "no"}, {"unknown": "free"}):
        assert not is_sound(wrong)
    assert not is_sound({"map": "a", "circle": {"center": [1, 1], "radius": 1}})
    assert not is_sound({"grid": {}})
