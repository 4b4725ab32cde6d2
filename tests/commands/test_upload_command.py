"""``viaspline upload``, on a real port to a vehicle that speaks through pymavlink."""

import json
from pathlib import Path
from typing import Any

import pytest
import shapely
from click.testing import CliRunner, Result
from pymavlink_vehicle import COPTER, PX4, PymavlinkVehicle, metres_per_degree
from vehicle_on_udp import VehicleOnUdp

from free_ports import free_port
from viaspline.cli import cli

MISSION = """\
world:
  bounds: [-10, -10, 50, 50]
  known:
    - circle: {center: [20, 10], radius: 3}
    - polygon: [[5, 10], [8, 10], [8, 14]]
robot: {max_speed_mps: 1.5}
route: {start: [0, 0], via: [{at: [20, 0], dwell_s: 7}], goal: [30, 20]}
"""


@pytest.fixture
def mission(tmp_path: Path) -> Path:
    file = tmp_path / "yard.yaml"
    file.write_text(MISSION)
    return file


def uploaded(file: Path, port: int, *more: str) -> Result:
    words = ["upload", str(file), "--to", f"udp:127.0.0.1:{port}", *more]
    return CliRunner().invoke(cli, words)


def test_via_points_fences_and_speed_are_on_board(mission: Path) -> None:
    port, vehicle = free_port(), PymavlinkVehicle()
    with VehicleOnUdp(vehicle, port):
        result = uploaded(mission, port, "--vias", "--origin", "47.1,8.2")
    assert result.exit_code == 0, result.output
    assert "has on board what was sent: fence: 8 items, mission: 4 items" in result.output
    assert [item.command for item in vehicle.board[0]] == [16, 178, 16, 16, 16]  # home, speed, way
    assert vehicle.board[0][1].param2 == 1.5
    assert vehicle.board[0][3].param1 == 7.0
    assert vehicle.board[0][0].x == 471000000
    assert sorted(item.command for item in vehicle.board[1]) == [5001] * 4 + [5002] * 3 + [5004]


@pytest.mark.parametrize("more", [(), ("--vias",)])
def test_no_copter_is_sent_along_the_ground(mission: Path, more: tuple[str, ...]) -> None:
    port, vehicle = free_port(), PymavlinkVehicle(kind=COPTER)
    with VehicleOnUdp(vehicle, port):
        result = uploaded(mission, port, "--origin", "47.1,8.2", *more)
    assert result.exit_code == 2, result.output
    assert "the mission has no heights" in result.output
    assert not any(vehicle.board.values())


def test_what_is_on_board_comes_down_again_with_its_rally_points(tmp_path: Path) -> None:
    file = tmp_path / "tour.plan"
    write_plan(file)
    port, vehicle = free_port(), PymavlinkVehicle(autopilot=PX4)
    with VehicleOnUdp(vehicle, port):
        result = uploaded(file, port, "--vias")
        assert result.exit_code == 0, result.output
        assert "rally points: 2 items" in result.output
        out = tmp_path / "board.plan"
        words = ["download", str(out), "--from", f"udp:127.0.0.1:{port}"]
        read = CliRunner().invoke(cli, words)
    assert read.exit_code == 0, read.output
    plan = json.loads(out.read_text())
    assert plan["rallyPoints"]["points"] == [[47.1, 8.2, 5.0], [47.2, 8.3, 6.0]]
    places = [item["params"][4:6] for item in plan["mission"]["items"] if item["command"] == 16]
    assert places[-1] == pytest.approx([47.101, 8.201])
    assert plan["mission"]["firmwareType"] == 12
    checked = CliRunner().invoke(cli, ["check", str(out)])
    assert checked.exit_code == 0, checked.output


def write_plan(file: Path) -> None:
    def item(latitude: float, longitude: float) -> dict[str, Any]:
        params = [0, 0, 0, None, latitude, longitude, 0]
        return {"type": "SimpleItem", "command": 16, "frame": 3, "params": params}

    items = [item(47.1, 8.2), item(47.1005, 8.2005), item(47.101, 8.201)]
    plan = {
        "fileType": "Plan", "version": 1,
        "mission": {"version": 2, "items": items, "cruiseSpeed": 2, "hoverSpeed": 2,
                    "vehicleType": 10, "plannedHomePosition": [47.1, 8.2, 400]},
        "rallyPoints": {"version": 2, "points": [[47.1, 8.2, 5], [47.2, 8.3, 6]]},
    }  # fmt: skip
    file.write_text(json.dumps(plan))


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ((), "say where its 0, 0 is: --origin LAT,LON"),
        (("--origin", "here"), "give --origin 47.1,8.2"),
        (("--origin", "0,0"), "0,0 means nowhere"),
        (("--origin", "95,8"), "latitudes are -90 to 90"),
        (("--origin", "nan,8"), "latitudes are -90 to 90"),
    ],
)
def test_without_an_origin_nothing_is_sent(
    mission: Path, more: tuple[str, ...], words: str
) -> None:
    result = uploaded(mission, free_port(), "--vias", *more)
    assert result.exit_code == 2
    assert words in result.output


def test_two_origins_are_one_too_many(tmp_path: Path) -> None:
    file = tmp_path / "tour.plan"
    write_plan(file)
    result = uploaded(file, free_port(), "--vias", "--origin", "47.2,8.2")
    assert result.exit_code == 2
    assert "the file has its own origin, 47.1,8.2; leave out --origin" in result.output


def test_an_origin_that_was_set_in_the_studio_is_told_before_anything_is_sent(
    mission: Path,
) -> None:
    mission.with_name("yard.yaml.studio.json").write_text('{"origin": [47.25, 8.5]}')
    port, vehicle = free_port(), PymavlinkVehicle()
    with VehicleOnUdp(vehicle, port):
        result = uploaded(mission, port, "--vias")
    assert result.exit_code == 0, result.output
    told = "note: 0, 0 lies at 47.25, 8.5, as yard.yaml.studio.json says"
    assert told in " ".join(result.output.split())
    assert vehicle.board[0][0].x == 472500000


def test_nobody_answers(mission: Path) -> None:
    result = uploaded(mission, free_port(), "--vias", "--origin", "47.1,8.2", "--wait", "1")
    assert result.exit_code == 2
    assert "no autopilot was heard in 1 s" in result.output


def test_a_fence_may_be_left_as_it_is(mission: Path) -> None:
    port, vehicle = free_port(), PymavlinkVehicle()
    vehicle.unsupported = {1}
    with VehicleOnUdp(vehicle, port):
        result = uploaded(mission, port, "--vias", "--origin", "47.1,8.2")
        assert result.exit_code == 2
        assert "--no-fence sends the mission alone" in result.output
        result = uploaded(mission, port, "--vias", "--origin", "47.1,8.2", "--no-fence")
        assert result.exit_code == 0, result.output


def test_a_rally_point_that_is_no_place_is_a_fault(tmp_path: Path) -> None:
    file = tmp_path / "tour.plan"
    write_plan(file)
    file.write_text(file.read_text().replace("47.2", '"x"'))
    result = uploaded(file, free_port(), "--vias")
    assert result.exit_code == 2
    assert "rallyPoints.points[1]" in result.output


def test_a_fleet_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "fleet.yaml"
    file.write_text(
        "fleet:\n"
        "  - {name: a, route: {start: [0, 0], goal: [9, 0]}}\n"
        "  - {name: b, route: {start: [0, 9], goal: [9, 9]}}\n"
    )
    result = uploaded(file, free_port(), "--vias", "--origin", "47.1,8.2")
    assert result.exit_code == 2
    assert "this is a fleet" in result.output


def test_the_proven_path_is_on_board_with_its_speeds_and_radius(mission: Path) -> None:
    mission.write_text(MISSION.replace("[20, 0], dwell_s: 7", "[20, 16], dwell_s: 7"))
    port, vehicle = free_port(), PymavlinkVehicle()
    with VehicleOnUdp(vehicle, port):
        result = uploaded(mission, port, "--origin", "47.1,8.2")
    assert result.exit_code == 0, result.output
    assert "proven" in result.output
    way = [item for item in vehicle.board[0][1:] if item.command == 16]
    assert len(way) > 4
    assert {item.param2 for item in way} == {way[0].param2}
    assert any(item.param1 == 7.0 for item in way)
    north, east = metres_per_degree(47.1)
    points = [((item.y / 1e7 - 8.2) * east, (item.x / 1e7 - 47.1) * north) for item in way]
    line = shapely.LineString(points)
    assert line.distance(shapely.Point(20, 10)) > 3 + 0.5 + 0.45 - way[0].param2
    assert line.distance(shapely.Polygon([[5, 10], [8, 10], [8, 14]])) > 0.95 - way[0].param2


def test_what_was_exported_goes_up_as_it_stands(mission: Path, tmp_path: Path) -> None:
    file = tmp_path / "round.plan"
    words = ["export", str(mission), str(file), "--origin", "47.1,8.2"]
    exported = CliRunner().invoke(cli, words)
    assert exported.exit_code == 0, exported.output
    port, vehicle = free_port(), PymavlinkVehicle(autopilot=PX4)
    with VehicleOnUdp(vehicle, port):
        result = uploaded(file, port, "--vias")
    assert result.exit_code == 0, result.output
    items = json.loads(file.read_text())["mission"]["items"]
    assert [item.command for item in vehicle.board[0]] == [one["command"] for one in items]
