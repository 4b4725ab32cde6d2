"""QGroundControl's plans of paths: their schema, our own reader, what each item says."""

import json
import math
import warnings
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

from viaspline.errors import MissionWarning
from viaspline.exports.export_path import export
from viaspline.exports.line_speeds import SPEED_STEP
from viaspline.formats.load import load, origin_of
from viaspline.formats.local_frame import LocalFrame
from viaspline.mission.model import Mission
from viaspline.plan_mission import plan

ORIGIN = (47.3977, 8.5456)
KNOWN = [{"name": "tank", "circle": {"center": [25, 0.5], "radius": 4}}]
ROUTE = {"start": [0, 0], "via": [{"at": [60, 20], "dwell_s": 3}], "goal": [90, 0]}
NUMBER = {"type": "number"}
POSITION = {"type": "array", "items": NUMBER, "minItems": 3, "maxItems": 3}
ITEM = {
    "type": "object",
    "properties": {
        "type": {"const": "SimpleItem"},
        "AMSLAltAboveTerrain": {"type": ["number", "null"]},
        "Altitude": NUMBER,
        "AltitudeMode": {"enum": [0, 1, 2, 3, 4]},
        "autoContinue": {"type": "boolean"},
        "command": {"type": "integer"},
        "doJumpId": {"type": "integer", "minimum": 1},
        "frame": {"type": "integer"},
        "params": {"type": "array", "items": {"type": ["number", "null"]},
                   "minItems": 7, "maxItems": 7},
    },
    "required": ["type", "autoContinue", "command", "doJumpId", "frame", "params"],
}  # fmt: skip
SCHEMA = {  # the keys that QGroundControl's developer guide names, with their types
    "type": "object",
    "properties": {
        "fileType": {"const": "Plan"},
        "version": {"const": 1},
        "groundStation": {"type": "string"},
        "mission": {
            "type": "object",
            "properties": {
                "version": {"const": 2},
                "firmwareType": {"type": "integer"},
                "vehicleType": {"type": "integer"},
                "cruiseSpeed": NUMBER,
                "hoverSpeed": NUMBER,
                "plannedHomePosition": POSITION,
                "items": {"type": "array", "items": ITEM},
            },
            "required": ["version", "firmwareType", "plannedHomePosition", "items"],
        },
        "geoFence": {"type": "object", "required": ["version", "polygons", "circles"]},
        "rallyPoints": {"type": "object", "required": ["version", "points"]},
    },
    "required": ["fileType", "version", "groundStation", "mission", "geoFence", "rallyPoints"],
}


def exported(asked: dict[str, Any], file: Path, **options: Any) -> dict[str, Any]:
    planned = plan(Mission.model_validate(asked))
    export(planned, file, origin=ORIGIN, **options)
    data: dict[str, Any] = json.loads(file.read_text())
    jsonschema.validate(data, SCHEMA)
    return data


def test_the_way_the_stay_and_the_radius_stand_in_the_items(tmp_path: Path) -> None:
    data = exported({"world": {"known": KNOWN}, "route": ROUTE}, tmp_path / "x.plan")
    items = data["mission"]["items"]
    assert [item["doJumpId"] for item in items] == list(range(1, len(items) + 1))
    ways = [item for item in items if item["command"] == 16]
    held = [item for item in ways if item["params"][0]]
    assert [item["params"][0] for item in held] == [3]
    xy = LocalFrame(*ORIGIN).to_local(*held[0]["params"][4:6])
    assert xy == pytest.approx([60, 20], abs=1e-4)
    radius = data["viaspline"]["path"]["acceptance_radius_m"]
    assert {item["params"][1] for item in ways} == {radius}
    assert data["geoFence"]["circles"][0]["circle"]["radius"] == 4


def test_speeds_change_before_the_line_that_they_are_for(tmp_path: Path) -> None:
    asked = {
        "world": {"speed_zones": [{"polygon": [[30, -90], [60, -90], [60, 90], [30, 90]],
                                   "max_speed_mps": 0.5}]},
        "route": {"start": [0, 0], "goal": [90, 0]},
    }  # fmt: skip
    items = exported(asked, tmp_path / "x.plan")["mission"]["items"]
    frame, at, speed, told = LocalFrame(*ORIGIN), None, None, []
    for item in items:
        if item["command"] == 178:
            assert (item["params"][0], item["params"][2]) == (1, -1)
            speed = item["params"][1]
            continue
        to = frame.to_local(*item["params"][4:6])
        if at is not None:
            told.append((float(at[0]), float(to[0]), speed))
        at = to
    assert 1.9 <= told[0][2] <= 2.0
    assert all(speed <= 0.5 * SPEED_STEP for a, b, speed in told if b > 31 and a < 59)
    assert told[-1][2] == 2.0  # it speeds up by itself
    assert len([item for item in items if item["command"] == 178]) <= 12


def test_our_own_reader_gets_the_way_back(tmp_path: Path) -> None:
    file = tmp_path / "x.plan"
    exported({"world": {"known": KNOWN}, "route": ROUTE}, file)
    with warnings.catch_warnings():
        warnings.simplefilter("error", MissionWarning)  # its one change of speed is the mission's
        back = load(file)
    assert isinstance(back, Mission)
    assert back.robot.max_speed_mps == 2.0
    assert origin_of(file) == ORIGIN
    dwells = {tuple(np.round(p.at, 3)): p.dwell_s for _, p in back.route.points() if p.dwell_s}
    assert dwells == {(60.0, 20.0): 3.0}
    assert back.world.known[0].circle is not None
    assert plan(back).certificate.holds


def test_a_flight_takes_off_flies_and_lands(tmp_path: Path) -> None:
    asked = {
        "world": {"ground": {"flat_m": 400}},
        "robot": {"radius_m": 0.5, "clearance_m": 2, "max_speed_mps": 5},
        "route": {"start": [0, 0], "takeoff": {"to_agl_m": 20}, "yaw": {"fixed_deg": 90},
                  "via": [{"at": [50, 20], "agl_m": 40}], "land": {"at": [100, 0]}},
    }  # fmt: skip
    data = exported(asked, tmp_path / "x.plan")
    mission = data["mission"]
    assert mission["vehicleType"] == 2
    assert mission["plannedHomePosition"] == [*ORIGIN, 400]
    moves = [item for item in mission["items"] if item["command"] != 178]
    assert [moves[0]["command"], moves[-1]["command"]] == [22, 21]
    assert {item["command"] for item in moves[1:-1]} == {16}
    assert {item["frame"] for item in moves} == {3}
    assert moves[0]["params"][6] == 20
    assert moves[-1]["params"][6] == 0
    assert max(item["params"][6] for item in moves) >= 40 - 1e-6
    assert {item["params"][3] for item in moves[1:-1]} == {0}  # to the north, as a compass has it
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MissionWarning)
        back = load(tmp_path / "x.plan", ground={"flat_m": 400})
    assert isinstance(back, Mission)
    assert back.route.takeoff is not None
    assert math.isclose(back.route.takeoff.to_agl_m, 20)
    assert back.route.land is not None


@pytest.mark.parametrize("ending", [".plan", ".waypoints"])
def test_take_off_and_landing_are_one_item_each(tmp_path: Path, ending: str) -> None:
    asked = {
        "world": {"ground": {"flat_m": 400}},
        "robot": {"radius_m": 0.5, "clearance_m": 1, "max_speed_mps": 6, "max_jerk_mps3": 2},
        "route": {"start": [0, 0], "takeoff": {"to_agl_m": 20}, "land": {"at": [60, 0]},
                  "via": [{"at": [30, 5], "agl_m": 30}]},
    }  # fmt: skip
    flown, file = plan(Mission.model_validate(asked)), tmp_path / f"x{ending}"
    done = export(flown, file, origin=ORIGIN, spacing=4.0)  # cuts the upright legs, too
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MissionWarning)
        back = load(file, ground={"flat_m": 400})
    assert isinstance(back, Mission)
    places = np.array([point.at for point in back.route.via])
    assert np.linalg.norm(np.diff(places, axis=0), axis=1).min() > 0.5
    assert done.points > len(places) + 8
    assert export(flown, file, origin=ORIGIN).points < done.points - 8


def test_what_a_flight_passes_over_is_no_fence_and_is_named(tmp_path: Path) -> None:
    known = [
        {"name": "hall", "circle": {"center": [50, 0], "radius": 5}, "height_m": [0, 10]},
        {"name": "mast", "circle": {"center": [30, 2], "radius": 2}},
        {"circle": {"center": [80, 0], "radius": 3}, "height_m": [30, 60]},
    ]
    asked = {
        "world": {"known": known},
        "robot": {"radius_m": 0.5, "clearance_m": 1},
        "route": {"start": [0, 0, 20], "via": [[50, 0, 20], [80, 0, 20]], "goal": [100, 0, 20]},
    }
    data = exported(asked, tmp_path / "x.plan")
    assert [one["circle"]["radius"] for one in data["geoFence"]["circles"]] == [2]
    lost = data["viaspline"]["path"]["not_carried"]
    assert any(words.endswith("no top: hall, obstacle 3") for words in lost), lost
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MissionWarning)
        back = load(tmp_path / "x.plan")
    assert isinstance(back, Mission)
    assert plan(back).certificate.holds  # past its own fences
