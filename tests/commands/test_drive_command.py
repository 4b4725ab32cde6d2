"""``viaspline drive --mavlink``, in real time on a real port."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from pymavlink_vehicle import COPTER, PymavlinkVehicle
from vehicle_on_udp import VehicleOnUdp

from free_ports import free_port
from viaspline.cli import cli

SHORT = """\
robot: {radius_m: 0.3, clearance_m: 0.4, drive: {differential: {track_m: 0.4}, lag_s: 0.2}}
world: {known: [{circle: {center: [2, 1.4], radius: 0.5}}]}
route: {start: {at: [0, 0], heading_deg: 0}, goal: [4, 0]}
"""
AT_HOME = ("--origin", "47.1,8.2", "--system", "1")


@pytest.fixture
def mission(tmp_path: Path) -> Path:
    file = tmp_path / "yard.yaml"
    file.write_text(SHORT)
    return file


def words_of(file: Path, port: int, *more: str) -> list[str]:
    return ["drive", str(file), "--mavlink", f"udp:127.0.0.1:{port}", *more]


def driven(file: Path, port: int, *more: str) -> Result:
    return CliRunner().invoke(cli, words_of(file, port, *more))


def test_a_rover_drives_to_its_goal_and_holds(mission: Path) -> None:
    port, vehicle = free_port(), PymavlinkVehicle()
    with VehicleOnUdp(vehicle, port):
        result = driven(mission, port, *AT_HOME, "--arm")
    assert result.exit_code == 0, result.output
    assert "it has reached its goal; HOLD" in result.output
    assert abs(vehicle.x - 4.0) < 0.3
    assert abs(vehicle.y) < 0.3
    assert vehicle.mode == 4


def test_it_begins_where_it_stands_if_that_is_asked_for(mission: Path) -> None:
    port, vehicle = free_port(), PymavlinkVehicle(at=(1.0, -1.5), heading=0.5)
    with VehicleOnUdp(vehicle, port):
        refused = driven(mission, port, *AT_HOME, "--arm")
        assert refused.exit_code == 2
        assert "m from the start" in refused.output
        assert not vehicle.armed
        result = driven(mission, port, *AT_HOME, "--arm", "--from-here")
    assert result.exit_code == 0, result.output
    assert abs(vehicle.x - 4.0) < 0.3


def test_unarmed_it_stays_where_it_is(mission: Path) -> None:
    port, vehicle = free_port(), PymavlinkVehicle()
    with VehicleOnUdp(vehicle, port):
        result = driven(mission, port, *AT_HOME, "--wait", "4")
    assert result.exit_code == 4
    assert "arm it, or give --arm" in result.output
    assert vehicle.x == 0.0


@pytest.mark.skipif(os.name != "posix", reason="signals are sent as POSIX has them")
def test_ctrl_c_stops_it_before_the_process_ends(mission: Path) -> None:
    port, vehicle = free_port(), PymavlinkVehicle()
    mission.write_text(SHORT.replace("goal: [4, 0]", "goal: [60, 0]"))
    words = words_of(mission, port, *AT_HOME, "--arm")
    with VehicleOnUdp(vehicle, port):
        with subprocess.Popen(
            [sys.executable, "-m", "viaspline", *words], stderr=subprocess.PIPE, text=True
        ) as process:
            deadline = time.monotonic() + 400.0
            while vehicle.x < 1.0 and time.monotonic() < deadline:
                assert process.poll() is None, process.communicate()[1]
                time.sleep(0.05)
            process.send_signal(signal.SIGINT)
            _, said = process.communicate(timeout=120.0)
        assert process.returncode == 130
        assert "interrupted; HOLD" in said
        deadline = time.monotonic() + 60.0
        while abs(vehicle.speed) >= 0.05 and time.monotonic() < deadline:
            time.sleep(0.05)
        assert vehicle.mode == 4
        assert vehicle.setpoints[-1][1].vx == 0.0
        assert abs(vehicle.speed) < 0.05


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("robot: {sensor: {lidar: {range_m: 5}}}\nroute: {start: [0, 0], goal: [6, 0]}\n",
         "MAVLink brings no scans"),
        ("robot: {drive: {omnidirectional: {max_speed_along_mps: 1, max_speed_across_mps: 1, "
         "hold_heading_deg: 0}}}\nroute: {start: [0, 0], goal: [6, 0]}\n", "holds its heading"),
        ("world: {known: [{circle: {center: [0, 0], radius: 1}, "
         "motion: {from: [0, 9], velocity_mps: [1, 0]}}]}\nroute: {start: [0, 0], goal: [6, 0]}\n",
         "things move in the mission"),
    ],
)  # fmt: skip
def test_what_mavlink_cannot_do_is_refused_before_anything_moves(
    tmp_path: Path, text: str, words: str
) -> None:
    file = tmp_path / "odd.yaml"
    file.write_text(text)
    result = driven(file, free_port(), *AT_HOME)
    assert result.exit_code == 2, result.output
    assert words in result.output


def test_a_plane_is_not_driven(mission: Path) -> None:
    port, vehicle = free_port(), PymavlinkVehicle(kind=1)
    with VehicleOnUdp(vehicle, port):
        result = driven(mission, port, *AT_HOME)
    assert result.exit_code == 2
    assert "system 1 (ArduPilot plane) isn't one that is known how to drive" in result.output


def test_a_mission_in_space_is_for_copters(tmp_path: Path) -> None:
    file = tmp_path / "space.yaml"
    file.write_text(
        "world: {ground: {flat_m: 0}}\n"
        "robot: {radius_m: 0.4, half_height_m: 0.2, clearance_m: 0.8, max_speed_mps: 2}\n"
        "route: {start: [0, 0], takeoff: {to_agl_m: 1.5}, via: [{at: [2, 0], agl_m: 2}],\n"
        "        land: {at: [3, 0]}}\n"
    )
    port = free_port()
    with VehicleOnUdp(PymavlinkVehicle(), port):
        result = driven(file, port, *AT_HOME)
    assert result.exit_code == 2
    assert "can't fly" in result.output
    vehicle, port = PymavlinkVehicle(kind=COPTER), free_port()
    with VehicleOnUdp(vehicle, port):
        result = driven(file, port, *AT_HOME, "--arm")
    assert result.exit_code == 0, result.output
    assert "it has landed" in result.output


def test_it_has_to_be_said_how_the_vehicle_is_reached(mission: Path) -> None:
    result = CliRunner().invoke(cli, ["drive", str(mission)])
    assert result.exit_code == 2
    assert "--mavlink ADDRESS" in result.output


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--rmw", "carrier-pigeon"], "give zenoh or dds"),
        (["--rmw", "rmw_fastrtps_cpp", "--connect", "tcp/localhost:7447"], "CYCLONEDDS_URI"),
    ],
)
def test_it_has_to_be_said_by_what_the_nodes_speak(
    options: list[str], words: str, mission: Path
) -> None:
    result = CliRunner().invoke(cli, ["drive", str(mission), "--ros", *options])
    assert result.exit_code == 2
    assert words in " ".join(result.output.split())
