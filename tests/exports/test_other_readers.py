"""What others read from our files: pymavlink, mavsdk, gpxpy, PyYAML's kin, mcap, an XML parser."""

import csv
import importlib.util
import json
import socket
import struct
import subprocess
import sys
import xml.etree.ElementTree as ET
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ruamel.yaml import YAML

from viaspline.exports.export_path import export
from viaspline.formats.local_frame import LocalFrame
from viaspline.mission.model import Mission
from viaspline.plan_mission import plan
from viaspline.whole_plan import Plan

ORIGIN = (47.3977, 8.5456)
FRAME = LocalFrame(*ORIGIN)
KNOWN = [{"name": "tank", "circle": {"center": [25, 0.5], "radius": 4}}]
VIA = [{"at": [60, 20], "name": "quay & <pier>", "dwell_s": 3}]
MISSION = Mission.model_validate(
    {"world": {"known": KNOWN}, "route": {"start": [0, 0], "via": VIA, "goal": [90, 0]}}
)
HEARD = """
import json, sys, threading, time
from pymavlink import mavutil
from mavsdk.component_type import ComponentType
from mavsdk.mavsdk import Configuration, Mavsdk
from mavsdk.plugins.mission_raw.mission_raw import MissionRaw
port, file = sys.argv[1:]
rover, pilot = mavutil.mavlink.MAV_TYPE_GROUND_ROVER, mavutil.mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA
vehicle = mavutil.mavlink_connection(f"udpout:127.0.0.1:{port}", source_component=1)
def beat():
    while True:
        vehicle.mav.heartbeat_send(rover, pilot, 0, 0, 4)
        time.sleep(0.1)
threading.Thread(target=beat, daemon=True).start()
sdk = Mavsdk(Configuration.create_with_component_type(ComponentType.GROUND_STATION))
sdk.add_any_connection(f"udpin://127.0.0.1:{port}")
found = MissionRaw(sdk.first_autopilot(30.0)).import_qgroundcontrol_mission(file)
items = [[i.command, i.frame, i.param1, i.param2, i.x, i.y, i.z] for i in found.mission_items]
print("ITEMS", json.dumps([items, len(found.geofence_items)]))
"""


@cache
def planned() -> Plan:
    return plan(MISSION)


def lines_of(file: Path, **options: Any) -> np.ndarray:
    """The points that a format in metres has of the same lines [m]."""
    table = file.with_suffix(".csv")
    export(planned(), table, origin=ORIGIN, **options)
    rows = csv.DictReader(table.read_text().splitlines())
    return np.array([[float(row["x_m"]), float(row["y_m"])] for row in rows])


def test_pymavlinks_mission_loader_reads_the_way_points(tmp_path: Path) -> None:
    loading = pytest.importorskip("pymavlink.mavwp", reason="pymavlink isn't installed")
    file = tmp_path / "path.waypoints"
    done = export(planned(), file, origin=ORIGIN)
    loader = loading.MAVWPLoader()
    count = loader.load(str(file))
    read = [loader.wp(k) for k in range(count)]
    assert [item.seq for item in read] == list(range(count))
    assert (read[0].frame, read[0].command) == (0, 16)  # home
    ways = [item for item in read[1:] if item.command == 16]
    assert len(ways) == done.points
    assert {item.frame for item in ways} == {3}
    assert [item.param1 for item in ways if item.param1] == [3]
    assert {round(item.param2, 6) for item in ways} == {done.proof.acceptance}
    speeds = [item for item in read if item.command == 178]
    assert speeds
    assert all(item.param1 == 1 and 0 < item.param2 <= 2 for item in speeds)
    own = file.read_text().splitlines()[2:]
    kept = [line.split("\t") for line in own if line.split("\t")[3] == "16"]
    degrees = np.array([[float(line[8]), float(line[9])] for line in kept])
    read_degrees = np.array([[item.x, item.y] for item in ways])
    away = FRAME.to_local(*read_degrees.T) - FRAME.to_local(*degrees.T)
    # The loader's messages hold single precision: half a metre is what that leaves of degrees.
    assert np.hypot(*away.T).max() < 0.6


@pytest.mark.skipif(
    any(importlib.util.find_spec(name) is None for name in ("mavsdk", "pymavlink")),
    reason="mavsdk or pymavlink isn't installed",
)
def test_mavsdk_imports_the_plan_as_it_was_meant(tmp_path: Path) -> None:
    file = tmp_path / "path.plan"
    done = export(planned(), file, origin=ORIGIN)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    heard = subprocess.run(
        [sys.executable, "-c", HEARD, str(port), str(file)],
        capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip
    told = [line for line in heard.stdout.splitlines() if line.startswith("ITEMS ")]
    assert told, heard.stderr
    items, fences = json.loads(told[0].removeprefix("ITEMS "))
    assert fences == 1
    home, *ways = [item for item in items if item[0] == 16]
    assert home[1] in (0, 5)  # above sea level
    assert len(ways) == done.points
    own = [i["params"] for i in json.loads(file.read_text())["mission"]["items"]
           if i["command"] == 16]  # fmt: skip
    for item, params in zip(ways, own, strict=True):
        assert item[2:4] == pytest.approx(params[:2], abs=1e-6)
        here = FRAME.to_local(item[4] * 1e-7, item[5] * 1e-7)
        assert np.hypot(*(here - FRAME.to_local(*params[4:6]))) < 0.01  # a vehicle's last digit


def test_gpxpy_reads_route_and_via_points(tmp_path: Path) -> None:
    gpxpy = pytest.importorskip("gpxpy", reason="gpxpy isn't installed")
    file = tmp_path / "path.gpx"
    export(planned(), file, origin=ORIGIN)
    read = gpxpy.parse(file.read_text())
    assert [mark.name for mark in read.waypoints] == ["start", "quay & <pier>", "goal"]
    assert read.waypoints[1].description == "dwell 3 s"
    assert "not carried: speeds" in read.description
    degrees = np.array([[point.latitude, point.longitude] for point in read.routes[0].points])
    assert FRAME.to_local(*degrees.T) == pytest.approx(lines_of(file), abs=1e-4)


def test_an_xml_parser_reads_line_and_placemarks(tmp_path: Path) -> None:
    file = tmp_path / "path.kml"
    export(planned(), file, origin=ORIGIN, name="round\x00 <1>")
    space = {"k": "http://www.opengis.net/kml/2.2"}
    root = ET.parse(file).getroot()
    assert root.findtext("k:Document/k:name", namespaces=space) == "round <1>"
    text = root.findtext(".//k:LineString/k:coordinates", namespaces=space) or ""
    degrees = np.array([pair.split(",") for pair in text.split()], float)
    assert FRAME.to_local(degrees[:, 1], degrees[:, 0]) == pytest.approx(lines_of(file), abs=1e-4)
    names = [mark.text for mark in root.findall(".//k:Placemark/k:name", space)]
    assert names == ["round <1>", "start", "quay & <pier>", "goal"]


def test_geojson_keeps_to_its_standard(tmp_path: Path) -> None:
    file = tmp_path / "path.geojson"
    export(planned(), file, origin=ORIGIN)
    data = json.loads(file.read_text())
    line, *marks = data["features"]
    assert (data["type"], line["geometry"]["type"]) == ("FeatureCollection", "LineString")
    assert all(len(place) == 2 for place in line["geometry"]["coordinates"])
    lengths = {len(line["properties"][key]) for key in ("speed_mps", "time_s", "heading_rad")}
    assert lengths == {len(line["geometry"]["coordinates"])}
    assert [mark["properties"]["dwell_s"] for mark in marks] == [0, 3, 0]


def test_a_yaml_parser_reads_a_path_whose_poses_look_along_it(tmp_path: Path) -> None:
    file = tmp_path / "path.path.yaml"
    export(planned(), file)
    assert file.read_text().startswith("# path: ")
    read = YAML(typ="safe").load(file.read_text())
    poses = read["poses"]
    assert read["header"]["frame_id"] == "map"
    at = np.array([[pose["pose"]["position"][axis] for axis in "xyz"] for pose in poses])
    assert np.linalg.norm(np.diff(at, axis=0), axis=1).max() <= 0.1 + 1e-6
    turned = [pose["pose"]["orientation"] for pose in poses]
    headings = np.array([2 * np.arctan2(one["z"], one["w"]) for one in turned])
    steps = np.diff(at[:, :2], axis=0)
    along = np.arctan2(steps[:, 1], steps[:, 0])
    apart = np.abs(np.remainder(headings[:-1] - along + np.pi, 2 * np.pi) - np.pi)
    assert apart.max() < 0.05
    times = [one["header"]["stamp"]["sec"] + 1e-9 * one["header"]["stamp"]["nanosec"]
             for one in poses]  # fmt: skip
    assert all(a <= b for a, b in pairwise(times))
    assert times[-1] == pytest.approx(planned().trajectory.duration, abs=1e-6)


def test_stamps_are_by_the_clock_of_the_mission(tmp_path: Path) -> None:
    file = tmp_path / "path.path.yaml"
    route = {"start": [0, 0], "goal": [9, 0], "depart_s": 40}
    motion = {"from": [4, 9], "velocity_mps": [0, 0.2]}
    cart = {"circle": {"center": [0, 0], "radius": 1}, "motion": motion}
    late = plan(Mission.model_validate({"world": {"known": [cart]}, "route": route}))
    export(late, file)
    poses = YAML(typ="safe").load(file.read_text())["poses"]
    assert poses[0]["header"]["stamp"] == {"sec": 40, "nanosec": 0}
    last = poses[-1]["header"]["stamp"]
    assert last["sec"] + 1e-9 * last["nanosec"] == pytest.approx(late.trajectory.end_time)


def test_mcap_reads_one_message_that_holds_what_the_yaml_has(tmp_path: Path) -> None:
    reading = pytest.importorskip("mcap.reader", reason="mcap isn't installed")
    file, text = tmp_path / "path.mcap", tmp_path / "path.path.yaml"
    export(planned(), file)
    export(planned(), text)
    with file.open("rb") as stream:
        found = list(reading.make_reader(stream).iter_messages())
    assert len(found) == 1
    schema, channel, message = found[0]
    assert (schema.name, schema.encoding) == ("nav_msgs/msg/Path", "ros2msg")
    assert (channel.topic, channel.message_encoding) == ("/plan", "cdr")
    poses = YAML(typ="safe").load(text.read_text())["poses"]
    read = _decoded(message.data)
    assert len(read) == len(poses)
    for (stamp, numbers), pose in zip(read, poses, strict=True):
        assert stamp == (pose["header"]["stamp"]["sec"], pose["header"]["stamp"]["nanosec"])
        place, turned = pose["pose"]["position"], pose["pose"]["orientation"]
        told = [*(place[axis] for axis in "xyz"), *(turned[axis] for axis in "xyzw")]
        assert numbers == pytest.approx(told, abs=1e-7)


def _decoded(data: bytes) -> list[tuple[tuple[int, int], list[float]]]:
    """Stamps and numbers of a path in CDR, by the rules of the encoding."""
    assert data[:4] == b"\x00\x01\x00\x00"
    body, at = data[4:], 0

    def take(form: str, size: int) -> tuple[Any, ...]:
        nonlocal at
        at += -at % size
        values = struct.unpack_from(f"<{form}", body, at)
        at += struct.calcsize(f"<{form}")
        return values

    def header() -> tuple[int, int]:
        nonlocal at
        seconds, nanoseconds, length = *take("i", 4), *take("I", 4), *take("I", 4)
        assert body[at : at + length] == b"map\x00"
        at += length
        return seconds, nanoseconds

    header()
    (count,) = take("I", 4)
    found = [(header(), list(take("7d", 8))) for _ in range(count)]
    assert at == len(body)
    return found


def test_names_with_breaks_of_any_kind_come_back(tmp_path: Path) -> None:
    name = "a\rb\r\nc\nd"
    goal = {"at": [9, 0], "name": name}
    made = plan(Mission.model_validate({"route": {"start": [0, 0], "goal": goal}}))
    for ending in ("csv", "kml", "gpx"):
        export(made, tmp_path / f"path.{ending}", origin=ORIGIN)
    with (tmp_path / "path.csv").open(newline="") as table:
        assert list(csv.DictReader(table))[-1]["via"] == name
    for ending in ("kml", "gpx"):
        texts = [each.text for each in ET.parse(tmp_path / f"path.{ending}").getroot().iter()]
        assert name in texts
