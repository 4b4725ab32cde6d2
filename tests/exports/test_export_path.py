"""Paths in files: proven as the file has them, refused in words, told what isn't in them."""

import csv
import json
import math
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from viaspline.curve.path import Path as ProvenPath
from viaspline.errors import GeometryError, OutputError, PlanningError
from viaspline.exports.export_options import ExportOptions
from viaspline.exports.export_path import export, export_fleet
from viaspline.exports.path_format import path_formats
from viaspline.fleet.plan_fleet import plan_fleet
from viaspline.formats.local_frame import LocalFrame
from viaspline.mission.fleet.fleet import Fleet
from viaspline.mission.model import Mission
from viaspline.plan_mission import plan
from viaspline.whole_plan import Plan

ORIGIN = (47.3977, 8.5456)
ENDINGS = [ending for each in path_formats() for ending in each.endings]


def mission(**keys: Any) -> Mission:
    known = [{"name": "tank", "circle": {"center": [25, 0.5], "radius": 4}}]
    via = [{"at": [60, 20], "name": "quay & <pier>", "dwell_s": 2.5}]
    route = {"start": [0, 0], "via": via, "goal": [90, 0]}
    return Mission.model_validate({"world": {"known": known}, "route": route, **keys})


@cache
def planned_yard() -> Plan:
    return plan(mission())


@pytest.mark.parametrize("ending", ENDINGS)
def test_every_format_gives_the_same_bytes_and_says_what_is_proven(
    ending: str, tmp_path: Path
) -> None:
    first, second = tmp_path / f"a{ending}", tmp_path / "b" / f"a{ending}"
    second.parent.mkdir()
    done = [export(planned_yard(), file, origin=ORIGIN) for file in (first, second)]
    assert first.read_bytes() == second.read_bytes()
    assert done[0].proof.clearance >= 0.5 - 2e-5
    assert done[0].proof.chord_error <= 0.05
    assert "m clear" in done[0].words
    if ending != ".json":
        assert any("exact curve" in words for words in done[0].lost)
    if ending in (".geojson", ".kml", ".gpx", ".plan", ".path.yaml"):
        assert "exact curve" in first.read_text()  # said in the file as well


@settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    disc=st.tuples(st.floats(10, 50), st.floats(-8, 8), st.floats(1, 5)),
    chord_error=st.sampled_from([0.02, 0.1]),
    origin=st.tuples(st.floats(-75, 75), st.floats(-180, 180)),
)
def test_points_read_from_the_file_are_clear_anywhere_on_earth(
    disc: tuple[float, float, float], chord_error: float, origin: tuple[float, float],
    tmp_path: Path,
) -> None:  # fmt: skip
    x, y, r = disc
    ends = ((0, 0), (30, 14), (60, 0))
    assume(all(math.dist((x, y), end) > r + 1.1 for end in ends) and origin != (0, 0))
    known = [{"circle": {"center": [x, y], "radius": r}}]
    route = {"start": ends[0], "via": [ends[1]], "goal": ends[2]}
    try:
        planned = plan(Mission.model_validate({"world": {"known": known}, "route": route}))
    except PlanningError:
        return
    file = tmp_path / "path.geojson"
    done = export(planned, file, origin=origin, chord_error=chord_error)
    line = json.loads(file.read_text())["features"][0]["geometry"]["coordinates"]
    degrees = np.array(line)
    points = LocalFrame(*origin).to_local(degrees[:, 1], degrees[:, 0])
    drawn = shapely.LineString(points)
    away = drawn.distance(shapely.Point(x, y)) - r - 0.5
    assert away >= 0.5 - 2e-5
    assert away >= done.proof.clearance - 1e-6
    u = np.linspace(0, planned.path.domain[1], 5001)
    sampled = shapely.points(planned.path.evaluate(u))
    assert shapely.distance(sampled, drawn).max() <= done.proof.chord_error + 1e-6
    back = np.stack(LocalFrame(*origin).to_geodetic(points), axis=1)
    again = LocalFrame(*origin).to_local(back[:, 0], back[:, 1])
    assert np.abs(again - points).max() < 0.01
    rounded = LocalFrame(*origin).to_local(*np.round(back, 7).T)  # as an autopilot has them
    assert np.hypot(*(rounded - points).T).max() < 0.01


def test_dwells_speeds_and_names_go_along_where_there_is_a_place_for_them(tmp_path: Path) -> None:
    file = tmp_path / "path.csv"
    export(planned_yard(), file)
    rows = list(csv.DictReader(file.read_text().splitlines()))
    quay = next(row for row in rows if row["via"] == "quay & <pier>")
    assert (float(quay["x_m"]), float(quay["y_m"]), float(quay["dwell_s"])) == (60, 20, 2.5)
    assert float(quay["speed_mps"]) == 0.0
    assert float(rows[-1]["time_s"]) == pytest.approx(planned_yard().trajectory.duration, abs=1e-6)
    assert "latitude" not in rows[0]
    export(planned_yard(), file, origin=ORIGIN)
    first = next(csv.DictReader(file.read_text().splitlines()))
    assert (float(first["latitude"]), float(first["longitude"])) == ORIGIN


def test_a_longest_line_is_kept(tmp_path: Path) -> None:
    file = tmp_path / "path.csv"
    export(planned_yard(), file, spacing=3.0)
    rows = list(csv.DictReader(file.read_text().splitlines()))
    assert np.diff([float(row["distance_m"]) for row in rows]).max() <= 3.0 + 1e-6


def test_json_holds_the_exact_curve(tmp_path: Path) -> None:
    done = export(planned_yard(), tmp_path / "path.json")
    data = json.loads((tmp_path / "path.json").read_text())
    assert np.array_equal(np.array(data["spans"]), planned_yard().path.spans)
    assert data["not_carried"] == list(done.lost) == []
    assert data["points"]["via"][0] == "start"


def test_without_an_origin_a_format_in_degrees_is_refused_with_the_remedy(tmp_path: Path) -> None:
    for ending in (".plan", ".waypoints", ".geojson", ".kml", ".gpx"):
        with pytest.raises(OutputError, match="--origin LAT,LON"):
            export(planned_yard(), tmp_path / f"x{ending}")
    assert not list(tmp_path.iterdir())


def test_a_path_far_from_its_origin_is_refused(tmp_path: Path) -> None:
    far = plan(Mission.model_validate({"route": {"start": [4e5, 0], "goal": [4e5, 50]}}))
    with pytest.raises(OutputError, match="300 km"):
        export(far, tmp_path / "x.kml", origin=ORIGIN)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"chord_error": 0.0}, "chord_error is 0.0"),
        ({"chord_error": "x"}, "chord_error is 'x'"),
        ({"acceptance": -1}, "acceptance is -1"),
        ({"spacing": float("nan")}, "spacing is nan"),
        ({"origin": (91, 0)}, "can't be the origin"),
        ({"origin": (0, 0)}, "can't be the origin"),
        ({"origin": 5}, "give .latitude, longitude"),
        ({"name": 5}, "name is of the class int"),
    ],
)
def test_what_can_not_be_meant_is_refused_by_name(
    options: dict[str, Any], words: str, tmp_path: Path
) -> None:
    with pytest.raises(GeometryError, match=words):
        export(planned_yard(), tmp_path / "x.csv", **options)
    with pytest.raises(OutputError, match="the endings are"):
        export(planned_yard(), tmp_path / "x.dxf")
    with pytest.raises(OutputError, match="can't be written"):
        export(planned_yard(), tmp_path / "no" / "x.csv")


def test_a_path_whose_corners_may_not_be_cut_says_what_autopilots_make_of_no_radius(
    tmp_path: Path,
) -> None:
    done = export(planned_yard(), tmp_path / "x.plan", origin=ORIGIN, acceptance=0.0)
    assert done.proof.acceptance == 0.0
    assert any("PX4 NAV_ACC_RAD" in note for note in done.notes)
    done = export(planned_yard(), tmp_path / "x.plan", origin=ORIGIN)
    assert not any("PX4 NAV_ACC_RAD" in note for note in done.notes)


@pytest.mark.parametrize("has_heights", [False, True])
def test_who_flies_is_told_of_heights_that_nobody_has_said(
    has_heights: bool, tmp_path: Path
) -> None:
    end = [9, 0, 20] if has_heights else [9, 0]
    asked = {"route": {"start": [0, 0, 20][: len(end)], "goal": end}}
    done = export(plan(Mission.model_validate(asked)), tmp_path / "x.plan", origin=ORIGIN)
    assert any("has no heights" in note for note in done.notes) is not has_heights


def test_an_acceptance_radius_that_is_not_clear_is_refused_with_the_place(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"at \(.*beside tank; give a smaller acceptance radius"):
        export(planned_yard(), tmp_path / "x.plan", origin=ORIGIN, acceptance=200.0)
    assert export(planned_yard(), tmp_path / "x.plan", origin=ORIGIN).proof.acceptance is not None


def test_a_path_that_is_not_clear_is_never_written(tmp_path: Path) -> None:
    spans = np.array([[[0, 0], [30, 0], [60, 0], [90, 0]]], float)  # through the tank
    broken = replace(planned_yard(), path=ProvenPath(spans, []))
    with pytest.raises(OutputError, match="no straight lines near the path"):
        export(broken, tmp_path / "x.csv")
    assert not list(tmp_path.iterdir())


def test_each_robot_of_a_fleet_has_a_file_and_its_order_is_told_as_lost(tmp_path: Path) -> None:
    members = [
        {"name": "a", "route": {"start": [0, 0], "goal": [20, 0]}},
        {"name": "b/2", "route": {"start": [10, -10], "goal": [10, 10]}},
    ]
    planned = plan_fleet(Fleet.model_validate({"fleet": members}))
    done = export_fleet(planned, tmp_path / "round.path.yaml", ExportOptions())
    assert sorted(file.name for file in tmp_path.iterdir()) == [
        "round-a.path.yaml", "round-b_2.path.yaml",
    ]  # fmt: skip
    assert all("who waits for whom" in one.lost[0] for one in done.values())


def test_what_moves_and_turning_circles_are_told_as_lost(tmp_path: Path) -> None:
    cart = {
        "circle": {"center": [0, 0], "radius": 1},
        "motion": {"from": [45, 30], "velocity_mps": [0, -1]},
    }
    moving = plan(mission(world={"known": [cart]}))
    assert any("what moves" in words for words in export(moving, tmp_path / "m.csv").lost)
    circling = plan(mission(robot={"min_turn_radius_m": 5}))
    assert any(
        "turning circle of 5 m" in words for words in export(circling, tmp_path / "t.csv").lost
    )


def test_what_moves_beside_a_flight_is_told_as_lost(tmp_path: Path) -> None:
    ball = {"ball": {"center": [0, 0, 0], "radius": 2},
            "motion": {"from": [30, -25, 6], "velocity_mps": [0, 1.5, 0]}}  # fmt: skip
    route = {"start": [0, 0, 5], "goal": [60, 0, 5]}
    flight = Mission.model_validate({"world": {"known": [ball]}, "route": route})
    assert any("what moves" in words for words in export(plan(flight), tmp_path / "f.csv").lost)


def test_a_flight_keeps_its_heights_and_ends_of_upright_legs(tmp_path: Path) -> None:
    asked = {
        "world": {"ground": {"flat_m": 400}, "altitude": {"above": "ground", "max_m": 60},
                  "known": [{"circle": {"center": [50, 0], "radius": 6}, "height_m": [400, 480]}]},
        "robot": {"radius_m": 0.5, "clearance_m": 2},
        "route": {"start": [0, 0], "takeoff": {"to_agl_m": 20}, "land": {"at": [100, 0]},
                  "via": [{"at": [30, 20], "agl_m": 40}]},
    }  # fmt: skip
    flight = plan(Mission.model_validate(asked))
    done = export(flight, tmp_path / "f.csv", chord_error=0.1)
    rows = list(csv.DictReader((tmp_path / "f.csv").read_text().splitlines()))
    points = np.array([[float(row[f"{axis}_m"]) for axis in "xyz"] for row in rows])
    assert points[:2].tolist() == [[0, 0, 400.5], [0, 0, 420]]
    assert points[-1].tolist() == [100, 0, 400.5]
    assert points[:, 2].max() <= 460 + 1e-6
    drawn = shapely.LineString(points[:, :2])
    assert drawn.distance(shapely.Point(50, 0)) - 6 - 0.5 >= 2 - 2e-5
    assert done.proof.clearance >= 2 - 2e-5
