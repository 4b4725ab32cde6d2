import math
import re
import subprocess
import sys
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import Fault, MissionError
from viaspline.mission.model import Mission
from viaspline.mission.sensor_spec import Lidar, Sensor

Make: TypeAlias = Callable[..., dict[str, Any]]


def faults_of(data: Any) -> list[str]:
    with pytest.raises(MissionError) as caught:
        Mission.model_validate(data)
    return [str(fault) for fault in caught.value.faults]


def test_a_good_mission_is_accepted(good: Make) -> None:
    mission = Mission.model_validate(good())
    assert mission.route.via[0].at == (90.0, 330.0)
    assert [key for key, _ in mission.route.points()][-1] == "route.goal"
    assert Mission.model_validate(mission) is mission


def lidar(**changes: Any) -> dict[str, Any]:
    return {"range_m": 5, **changes}


@pytest.mark.parametrize(
    ("path", "value", "key", "words"),
    [
        ("robot.radius_m", True, "robot.radius_m", "found true"),
        ("robot.radius_m", "0.5", "robot.radius_m", "write 0.5 without quotes"),
        ("route.start", ["30.5 6"], "route.start.at[0]", "write commas, [30.5, 6]"),
        ("route.start", [30, 5, 6, 2], "route.start.at", "a decimal has a point: [30.5, 6.2]"),
        ("robot.radius_m", -1, "robot.radius_m", "-1 is negative"),
        ("robot.clearance_m", math.nan, "robot.clearance_m", "NaN"),
        ("robot.clearance_m", math.inf, "robot.clearance_m", "infinity"),
        ("robot.clearence_m", 1, "robot.clearence_m", "did you mean 'clearance_m'?"),
        ("robot.tension", 1, "robot.tension", "belongs under spline"),
        ("robot.footprint", [[0, 0], [1, 0], [0, 1]], "robot.radius_m", "exclude each other"),
        ("robot.min_turn_radius_m", 0, "robot.min_turn_radius_m", "not less than 1e-06"),
        ("robot.turn_on_spot", "yes", "robot.turn_on_spot", "never, stations or vias"),
        (
            "robot.drive",
            {},
            "robot.drive",
            "has none of differential, ackermann, skid_steer and omnidirectional",
        ),
        ("robot.drive", {"differential": {}}, "robot.drive.differential.track_m", "is missing"),
        ("robot.drive", {"track_m": 1}, "robot.drive.track_m", "belongs under differential"),
        ("world.speed_zones", [{"max_speed_mps": 1}], "world.speed_zones[0].polygon", "is missing"),
        ("route.laps", 0, "route.laps", "not less than 1"),
        ("robot.sensor", {}, "robot.sensor", "{range_m: 40} or {lidar: {range_m: 5}}"),
        ("robot.sensor.lidar", {"range_m": 5}, "robot.sensor.range_m", "keep one of range_m and"),
        ("robot.sensor", {"lidar": {}}, "robot.sensor.lidar.range_m", "is missing"),
        ("robot.sensor", {"lidar": 5}, "robot.sensor.lidar", "found 5"),
        ("robot.sensor", {"lidar": lidar(range_m=0)}, "robot.sensor.lidar.range_m", "not less"),
        ("robot.sensor", {"lidar": lidar(fov_deg=0)}, "robot.sensor.lidar.fov_deg", "not less"),
        ("robot.sensor", {"lidar": lidar(fov_deg=361)}, "robot.sensor.lidar.fov_deg", "than 360"),
        ("robot.sensor", {"lidar": lidar(beams=0)}, "robot.sensor.lidar.beams", "less than 1"),
        ("robot.sensor", {"lidar": lidar(beams=9.5)}, "robot.sensor.lidar.beams", "whole number"),
        ("robot.sensor", {"lidar": lidar(noise_m=-1)}, "robot.sensor.lidar.noise_m", "negative"),
        ("robot.sensor", {"lidar": lidar(noise=1)}, "robot.sensor.lidar.noise", "'noise_m'"),
        ("robot.sensor.fov_deg", 90, "robot.sensor.fov_deg", "'fov_deg' belongs under lidar"),
        ("robot.sensor", None, "world.unseen", "no sensor"),
        ("robot", None, "robot", "found nothing"),
        ("world.known.0", {"map": "no.yaml"}, "world.known[0].map", "no.yaml: there is no such f"),
        ("world.known.0.unknown", "free", "world.known[0].unknown", "goes with a map only; give"),
        ("world.known.0.grid", 5, "world.known[0].grid", "unknown key"),
        ("world.known.0.mop", "a", "world.known[0].mop", "did you mean 'map'?"),
        ("world.known.0", {}, "world.known[0]", "has no shape"),
        ("world.known.0", 5, "world.known[0]", "found 5"),
        ("world.known.1.circle", {"center": [1, 2], "radius": 1}, "world.known[1]", "two shapes"),
        ("world.known.0.holes", [[[0, 0], [1, 0], [0, 1]]], "world.known[0].holes", "no polygon"),
        ("world.known.0.circle.radius", 0, "world.known[0].circle.radius", "not less than 1e-06"),
        ("world.known.0.circle.center", [1], "world.known[0].circle.center", "a list of 1"),
        (
            "world.known.0.circle.center",
            [1, 2, 3],
            "world.known[0].circle.center",
            "this shape is flat",
        ),
        ("world.known.0.never_pass_on", "left", "world.known[0].never_pass_on", "contradicts"),
        ("world.known.0.pass_on", "up", "world.known[0].pass_on", "left, right, over or under"),
        ("world.known.0.pass_on", [], "world.known[0].pass_on", "left, right, over or under"),
        ("world.known.0.name", "tank", "world.known[1].name", "'tank' is taken"),
        (
            "world.known.1.polygon",
            [[0, 0], [9, 9], [9, 0], [0, 9]],
            "world.known[1].polygon",
            "crosses itself at (4.5, 4.5)",
        ),
        (
            "world.known.1.polygon",
            [[0, 0], [5, 5], [9, 9]],
            "world.known[1].polygon",
            "has no area",
        ),
        (
            "world.known.2.holes",
            [[[0, 0], [1, 0], [0, 1]]],
            "world.known[2].polygon",
            "a hole that reaches outside it",
        ),
        ("world.fences.0", [[0, 0], [9, 9], [9, 0], [0, 9]], "world.fences[0]", "crosses itself"),
        (
            "world.speed_zones",
            [{"polygon": [[0, 0], [9, 9], [9, 0], [0, 9]], "max_speed_mps": 1}],
            "world.speed_zones[0].polygon",
            "crosses itself",
        ),
        ("world.bounds", [9, 0, 1, 5], "world.bounds", "x_min 9 is not less than x_max 1"),
        ("world.bounds", [0, 0, 1], "world.bounds", "a list of 3"),
        ("route.start", [50, 1e10], "route.start.at[1]", "not greater than 1000000000"),
        ("route.via.0", [90, 330, 5], "route.via[0].at", "3 coordinates"),
        ("route.via.0", [90], "route.via[0].at", "a list of 1"),
        ("route.via.0", [90, "x"], "route.via[0].at[1]", 'the text "x"'),
        ("route.via.0", [50, 250], "route.via[0].at", "same place as route.start"),
        ("route.via.0", [50, 250 + 5e-7], "route.via[0].at", "to within 5e-07 m"),
        (
            "route",
            {"start": [5, 250], "via": [[50, 250], [90, 330], [50, 250]], "order": "shortest"},
            "route.via[2].at",
            "same place as route.via[0], and the shortest order serves one right after the other",
        ),
        ("route.goal", {"at": [3, 300], "name": "pump"}, "route.goal.name", "'pump' is taken"),
        ("route.goal", [350, 498.2], "route.goal.at", "0.2 m inside the clearance of fence"),
        ("route.goal", [497.6, 300], "route.goal.at", ""),
        ("route.closed", True, "route.goal", "a closed route has a goal"),
        ("route.closed", 1, "route.closed", "true or false"),
        ("spline.slack", 0.5, "spline.slack", "two names of one thing"),
        ("spline.tension", [0.1, 0.2], "spline.tension", "2 values for 3 spans"),
        ("spline.tension", 1.5, "spline.tension", "more than 1"),
        ("spline.tension", [0, "a", 0], "spline.tension[1]", 'the text "a"'),
        ("spline.tension", "a", "spline.tension", 'the text "a"'),
        ("spline.knots", "cordal", "spline.knots", "centripetal"),
        ("extra", 1, "extra", "unknown key"),
        ("starts", [1, 2], "starts", "unknown key"),
    ],
)
def test_each_mistake_is_one_fault_that_names_key_and_remedy(
    path: str, value: Any, key: str, words: str, spoiled: Make
) -> None:
    data = spoiled(path, value)
    if not words:
        Mission.model_validate(data)
        return
    faults = faults_of(data)
    assert len(faults) == 1, faults
    assert faults[0].startswith(f"<mission>: {key}: ")
    assert words in faults[0]


def test_all_faults_come_at_once_in_the_order_of_the_data(spoiled: Make) -> None:
    data = spoiled("robot.radius_m", "x")
    data["route"]["via"][0] = [50, 250]
    data["world"]["known"][0] = {}
    data["spline"]["tension"] = 2
    keys = [fault.split(": ")[1] for fault in faults_of(data)]
    assert keys == ["world.known[0]", "robot.radius_m", "route.via[0].at", "spline.tension"]


def test_a_lidar_looks_all_round_without_noise_unless_told_otherwise() -> None:
    data = {"start": [0, 0], "goal": [9, 0]}
    mission = Mission.model_validate({"robot": {"sensor": {"lidar": lidar()}}, "route": data})
    sensor = mission.robot.sensor
    assert sensor is not None
    assert sensor.range_m is None
    assert sensor.reach == 5
    assert sensor.lidar == Lidar(range_m=5, fov_deg=360, beams=360, noise_m=0)
    assert hash(sensor) == hash(Sensor(lidar=Lidar(range_m=5)))


@pytest.mark.parametrize(
    ("key", "value"),
    [("drive", {"differential": {"track_m": 0.5}}), ("localization", {"position_noise_m": 0.1})],
)
def test_a_robot_that_is_simulated_in_the_plane_has_no_route_with_heights(
    key: str, value: Any
) -> None:
    route = {"start": [0, 0, 5], "goal": [9, 0, 8]}
    [fault] = faults_of({"robot": {key: value}, "route": route})
    assert fault.startswith(f"<mission>: robot.{key}: is for routes in the plane; leave it out")


def test_a_mistyped_required_key_is_one_fault(spoiled: Make) -> None:
    data = spoiled("world.known.0.circle", {"centre": [1, 2], "radius": 3})
    assert len(faults_of(data)) == 1


@pytest.mark.parametrize("data", [None, 5, "x", [], [1, 2], {}, {"route": None}, {5: 6}])
def test_what_is_no_mission_is_a_mission_error(data: Any) -> None:
    assert faults_of(data)


def test_one_point_is_no_route() -> None:
    assert "two distinct points" in faults_of({"route": {"start": [0, 0]}})[0]


def test_a_closed_route_needs_no_goal_but_does_not_repeat_its_start() -> None:
    route = {"start": [0, 0], "via": [[9, 0], [9, 9]], "closed": True}
    assert Mission.model_validate({"route": route, "spline": {"tension": [0, 0, 0]}})
    route["via"] = [[9, 0], [0, 0]]
    assert "returns anyway" in faults_of({"route": route})[0]


def test_a_ring_may_repeat_its_first_corner(spoiled: Make) -> None:
    data = spoiled("world.known.1.polygon", [[9, 9], [12, 9], [9, 12], [9, 9]])
    polygon = Mission.model_validate(data).world.known[1].polygon
    assert polygon == ((9.0, 9.0), (12.0, 9.0), (9.0, 12.0))


def test_arrays_and_numbers_of_numpy_are_accepted() -> None:
    route = {"start": (np.int64(0), np.float32(2)), "via": np.array([[1, 2], [3, 4]])}
    mission = Mission.model_validate({"route": route})
    assert mission.route.start.at == (0.0, 2.0)
    assert mission.route.via[1].at == (3.0, 4.0)


def test_the_promised_message_for_a_point_in_a_clearance(spoiled: Make) -> None:
    data = spoiled("route.via.1", {"at": [215, 299.42], "name": "pump"})
    data["world"]["known"][1]["polygon"] = [[200, 300], [230, 300], [230, 340], [200, 340]]
    (fault,) = faults_of(data)
    assert fault == (
        "<mission>: route.via[1].at: via 'pump' lies 0.42 m inside the clearance of obstacle "
        "'tank'; move it to (215, 298.998) or set robot.clearance_m to at most 0.079"
    )


coordinates = st.floats(-20, 20).map(lambda x: round(x, 2))


@settings(deadline=None, max_examples=60)
@given(
    at=st.tuples(coordinates, coordinates),
    discs=st.lists(st.tuples(coordinates, coordinates, st.floats(0.1, 6)), max_size=12),
    radius=st.floats(0, 2),
    clearance=st.floats(0, 2),
)
def test_whatever_is_advised_is_valid(
    at: tuple[float, float],
    discs: list[tuple[float, float, float]],
    radius: float,
    clearance: float,
) -> None:
    square = [[x - 1 + dx, y + dy] for x, y in [(3, 3)] for dx, dy in [(0, 0), (4, 0), (2, 3)]]
    known: list[dict[str, Any]] = [{"circle": {"center": d[:2], "radius": d[2]}} for d in discs]
    known.append({"polygon": square})
    data = {
        "world": {"bounds": [-20, -20, 20, 20], "known": known},
        "robot": {"radius_m": radius, "clearance_m": clearance},
        "route": {"start": [900, 900], "via": [at]},
    }

    def fault() -> Any:
        with pytest.raises(MissionError) as caught:
            Mission.model_validate(data)
        found = [fault for fault in caught.value.faults if fault.key == "route.via[0].at"]
        return found[0] if found else None

    found = fault()
    if found is None:
        return
    if moved := re.search(r"move it to \((\S+), (\S+)\)", found.remedy):
        data["route"]["via"] = [[float(moved[1]), float(moved[2])]]
        assert fault() is None
        data["route"]["via"] = [at]
    if lowered := re.search(r"at most (\S+)$", found.remedy):
        data["robot"]["clearance_m"] = float(lowered[1])
        assert fault() is None


def paths(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    found = [path] if path else []
    items = value.items() if isinstance(value, dict) else ()
    items = enumerate(value) if isinstance(value, list) else items
    return found + [deep for key, item in items for deep in paths(item, (*path, key))]


scalars = (
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=5)
    | st.sampled_from([-1, 0, 1e308, 10**400, "0.5", float("nan"), b"x"])
)
junk = st.recursive(
    scalars,
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(
            st.text(max_size=3) | st.sampled_from(["at", "circle", "map", "name"]), inner
        )
    ),
    max_leaves=6,
)


@settings(deadline=None, max_examples=200)
@given(data=st.data())
def test_a_mutation_gives_a_mission_or_a_mission_error(data: st.DataObject, good: Make) -> None:
    mission = good()
    for _ in range(data.draw(st.integers(1, 3))):
        *parents, last = data.draw(st.sampled_from(paths(mission) or [("x",)]))
        node = mission
        for part in parents:
            node = node[part]
        action = data.draw(st.sampled_from(["replace", "delete", "add"]))
        if action == "delete":
            del node[last]
        elif action == "add" and isinstance(node, dict):
            node[data.draw(st.text(max_size=4) | st.integers())] = data.draw(junk)
        else:
            node[last] = data.draw(junk)
    faults: tuple[Fault, ...] | None = None
    try:
        Mission.model_validate(mission)
    except MissionError as error:
        faults = error.faults
    assert faults is None or (faults and all(fault.problem and fault.remedy for fault in faults))


def test_importing_the_mission_loads_no_heavy_library() -> None:
    code = (
        "import sys, viaspline.mission.model, viaspline.formats.mission_yaml\n"
        "import viaspline.formats.load\n"
        "print([m for m in ('numba', 'scipy', 'matplotlib', 'shapely', 'pymap3d')"
        " if m in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"
