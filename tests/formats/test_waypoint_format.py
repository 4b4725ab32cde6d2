"""Missions written for QGroundControl and read again: the same metres, and nothing in silence."""

from __future__ import annotations

import json
import math
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import MissionError, OutputError
from viaspline.formats.interpret import mission_of, origin_in
from viaspline.formats.items import LatLon
from viaspline.formats.load import load, origin_of
from viaspline.formats.local_frame import LocalFrame
from viaspline.formats.mission_format import Whereabouts, Written
from viaspline.formats.qgc_plan import QgcPlan
from viaspline.formats.qgc_wpl import QgcWpl
from viaspline.mission.model import Mission
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.shapes.rounded_ring import RoundedRing

DATA = Path(__file__).parent / "data"
EXAMPLES = Path(__file__).parents[2] / "examples"
ORIGIN = (47.3977418, 8.545594)
YARD: dict[str, Any] = {
    "world": {
        "bounds": [-20, -20, 120, 60],
        "fences": [[[-15, -15], [110, -15], [110, 55], [-15, 55]]],
        "known": [
            {"polygon": [[30, 10], [40, 10], [40, 20], [30, 20]]},
            {"circle": {"center": [60, 5], "radius": 4}},
        ],
    },
    "robot": {"max_speed_mps": 1.5},
    "route": {"start": [0, 0], "via": [{"at": [50, 25], "dwell_s": 12}], "goal": [100, 0]},
}


def plan_text(mission: Mission, origin: LatLon | None) -> Written:
    return QgcPlan().write(mission, Whereabouts(origin=origin))


def wpl_text(mission: Mission, origin: LatLon | None) -> Written:
    return QgcWpl().write(mission, Whereabouts(origin=origin))


coordinate = st.floats(-2000, 2000)
origins = st.tuples(st.floats(-80, 80), st.floats(-180, 180)).filter(
    lambda at: abs(at[0]) > 0.1 or abs(at[1]) > 0.1
)


@st.composite
def missions(draw: st.DrawFn, start: list[float] | None = None) -> Mission:
    """Random routes, obstacles and fences; heights or none."""
    n = draw(st.integers(2, 8))
    flat = draw(st.booleans())
    xs = draw(st.lists(st.integers(-400, 400), min_size=n, max_size=n, unique=True))
    at = [[5.0 * x + 0.123, draw(coordinate)] for x in xs]
    if start is not None:
        at = [start, *(p for p in at if math.dist(p, start) > 1)]
        at += [[2500.0, 0.0]] if len(at) < 2 else []
    if not flat:
        at = [[*p, 0.0 if i == 0 else draw(st.floats(0, 100))] for i, p in enumerate(at)]
    dwell = [draw(st.sampled_from([0, 2.5, 30])) for _ in at]
    points = [{"at": p, "dwell_s": s} for p, s in zip(at, dwell, strict=True)]
    known = []
    for i in range(draw(st.integers(0, 4))):
        # Far north of the route, so that the mission is sound.
        x, y, r = draw(coordinate), 6000.0 + 100 * i, draw(st.floats(0.5, 40))
        ring = [[x - r, y - r], [x + r, y], [x, y + r]]
        is_disc = draw(st.booleans())
        known.append({"circle": {"center": [x, y], "radius": r}} if is_disc else {"polygon": ring})
    world: dict[str, Any] = {"known": known}
    if draw(st.booleans()):
        world["fences"] = [[[-9e3, -9e3], [9e3, -9.5e3], [9e3, 9e3], [-9e3, 9e3]]]
    if draw(st.booleans()):
        world["bounds"] = [-9900, -9800, 9900, 9800]
    route = {"start": points[0], "via": points[1:-1], "goal": points[-1]}
    speed = draw(st.floats(0.1, 20))
    return Mission.model_validate(
        {"world": world, "route": route, "robot": {"max_speed_mps": speed}}
    )


def near(a: Any, b: Any) -> None:
    np.testing.assert_allclose(np.array(a, float), np.array(b, float), rtol=0, atol=1e-3)


def check_same(read: Mission, written: Mission) -> None:
    """Equal to a millimetre, polygons before circles, bounds as a fence."""
    pairs = list(zip(read.route.points(), written.route.points(), strict=True))
    for (_, a), (_, b) in pairs:
        near(a.at, b.at)
        assert a.dwell_s == b.dwell_s
    rings = [list(ring) for ring in written.world.fences]
    if written.world.bounds is not None:
        x, y, right, top = written.world.bounds
        rings.append([(x, y), (right, y), (right, top), (x, top)])
    assert len(read.world.fences) == len(rings)
    for ring, other in zip(read.world.fences, rings, strict=True):
        near(ring, other)
    known = sorted(written.world.known, key=lambda item: item.circle is not None)
    for a, b in zip(read.world.known, known, strict=True):
        if a.circle is None or b.circle is None:
            near(a.polygon, b.polygon)
        else:
            near(a.circle.center, b.circle.center)
            assert a.circle.radius == b.circle.radius


@settings(deadline=None, max_examples=60)
@given(mission=missions(), origin=origins)
def test_any_plan_is_read_again_in_the_same_metres(
    mission: Mission, origin: tuple[float, float]
) -> None:
    itinerary = QgcPlan().parse(plan_text(mission, origin).text, "x.plan")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read = mission_of(itinerary)
    check_same(read, mission)
    assert origin_in(itinerary) == origin
    assert read.robot.max_speed_mps == mission.robot.max_speed_mps


@settings(deadline=None, max_examples=60)
@given(mission=missions(start=[0.0, 0.0]), origin=origins)
def test_any_table_of_way_points_is_read_again_in_the_same_metres(
    mission: Mission, origin: tuple[float, float]
) -> None:
    itinerary = QgcWpl().parse(wpl_text(mission, origin).text, "x.txt")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read = mission_of(itinerary)
    if len(mission.route.start.at) == 2:  # the table has heights for all
        mission = lifted(mission)
    check_same(read, mission)
    near(origin_in(itinerary), origin)


def lifted(mission: Mission) -> Mission:
    data = mission.model_dump(exclude_defaults=True)
    for point in (data["route"]["start"], *data["route"].get("via", ()), data["route"]["goal"]):
        point["at"] = [*point["at"], 0.0]
    return Mission.model_validate(data)


@settings(deadline=None, max_examples=30)
@given(mission=missions(), origin=origins)
def test_a_table_whose_start_is_not_the_origin_has_the_same_places_on_earth(
    mission: Mission, origin: tuple[float, float]
) -> None:
    text, lost = wpl_text(mission, origin)
    assert any(line.startswith("place of the origin") for line in lost)
    frame = LocalFrame(*origin)
    items = [i for i in QgcWpl().parse(text, "x.txt").items if i.command == 16]
    for (_, point), item in zip(mission.route.points(), items, strict=True):
        near(frame.to_local(item.latitude, item.longitude), point.at[:2])


def test_a_plan_has_every_key_that_qgroundcontrol_requires() -> None:
    plan = json.loads(plan_text(Mission.model_validate(YARD), ORIGIN).text)
    assert {"fileType", "version", "groundStation", "mission", "geoFence", "rallyPoints"} <= set(
        plan
    )
    assert set(plan["mission"]) >= {
        "cruiseSpeed", "firmwareType", "hoverSpeed", "items", "plannedHomePosition",
        "vehicleType", "version",
    }  # fmt: skip
    assert (plan["fileType"], plan["version"], plan["mission"]["version"]) == ("Plan", 1, 2)
    assert [item["command"] for item in plan["mission"]["items"]] == [16, 16, 16]
    assert [item["params"][0] for item in plan["mission"]["items"]] == [0, 12, 0]
    assert [area["inclusion"] for area in plan["geoFence"]["polygons"]] == [True, True, False]
    assert len(plan["geoFence"]["circles"]) == 1
    assert set(plan["rallyPoints"]) == {"points", "version"}


@pytest.mark.parametrize(
    ("name", "write"), [("yard.plan", plan_text), ("yard.waypoints", wpl_text)]
)
def test_the_formats_stay_as_they_are(name: str, write: Any) -> None:
    assert write(Mission.model_validate(YARD), ORIGIN).text == (DATA / name).read_text()
    assert origin_of(DATA / name) == pytest.approx(ORIGIN, abs=1e-9)
    assert len(load(DATA / name).world.known) == 2


@pytest.mark.filterwarnings("ignore::viaspline.errors.MissionWarning")
def test_a_mission_of_others_is_written_about_the_origin_that_it_was_read_with() -> None:
    source = EXAMPLES / "fence-survey.plan"
    mission = load(source)
    text, _ = plan_text(mission, origin_of(source))
    check_same(mission_of(QgcPlan().parse(text, "x.plan")), mission)


def test_what_can_not_be_written_is_named() -> None:
    mission = Mission.model_validate(
        {
            "world": {
                "known": [
                    {
                        "name": "shed",
                        "polygon": [[30, 10], [40, 10], [40, 20], [30, 20]],
                        "holes": [[[32, 12], [34, 12], [34, 14]]],
                        "pass_on": "left",
                    }
                ],
                "unseen": [{"name": "crate", "circle": {"center": [70, 0], "radius": 1}}],
                "speed_zones": [
                    {"polygon": [[0, 30], [9, 30], [9, 39]], "max_speed_mps": 0.5},
                ],
                "bounds": [-50, -50, 150, 50],
            },
            "robot": {"radius_m": 0.3, "max_speed_mps": 1, "sensor": {"range_m": 10}},
            "route": {
                "start": {"at": [1, 0], "heading_deg": 90},
                "via": [{"at": [50, 5], "name": "gate"}],
                "closed": True,
                "laps": 3,
            },
            "spline": {"tension": 0.5},
        }
    )
    common = {
        "heading_deg: route.start",
        "name: route.via[0], world.known[0]",
        "closed route, written as a way that ends at its start",
        "route: laps",
        "bounds, written as a fence: world.bounds",
        "holes: world.known[0]",
        "pass_on: world.known[0]",
        "unseen obstacle: crate",
        "speed zone: world.speed_zones[0]",
        "spline: tension",
    }
    written = plan_text(mission, ORIGIN)
    assert set(written.lost) == common | {"robot: radius_m, sensor"}
    table = wpl_text(mission, ORIGIN)
    assert set(table.lost) > common
    assert "robot: max_speed_mps" in table.lost
    read = mission_of(QgcPlan().parse(written.text, "x.plan"))
    assert read.route.goal is not None
    near(read.route.goal.at, [1, 0])


@pytest.mark.parametrize("write", [plan_text, wpl_text])
@pytest.mark.parametrize("origin", [None, (0.0, 0.0), (91.0, 8.0), (47.0, 181.0), (math.nan, 8.0)])
def test_without_an_origin_that_can_be_meant_nothing_is_written(write: Any, origin: Any) -> None:
    with pytest.raises(OutputError, match="origin"):
        write(Mission.model_validate(YARD), origin)


@pytest.mark.parametrize("write", [plan_text, wpl_text])
def test_a_mission_too_large_for_a_flat_frame_is_refused(write: Any) -> None:
    mission = Mission.model_validate({"route": {"start": [0, 0], "goal": [480e3, 0]}})
    with pytest.raises(OutputError, match="km from its origin"):
        write(mission, ORIGIN)


def test_points_that_may_be_read_as_one_are_named() -> None:
    route = {"start": [0, 0], "via": [[50, 0], [50.01, 0]], "goal": [90, 0]}
    _, lost = plan_text(Mission.model_validate({"route": route}), ORIGIN)
    assert lost == ("points so near to the one before that they may be read as one: route.via[1]",)


def test_a_map_of_squares_is_named_and_its_edge_is_a_fence() -> None:
    mission = load(EXAMPLES / "depot-round.yaml")
    text, lost = plan_text(mission, ORIGIN)
    assert any(line.startswith("map of squares: world.known[0]") for line in lost)
    assert any(area["inclusion"] for area in json.loads(text)["geoFence"]["polygons"])


@pytest.mark.parametrize(
    "origin", ["here", [47.0], [91, 8], [47, None], ["47", "8"], [47.0, 181], {"lat": 47}]
)
def test_an_origin_that_can_not_be_meant_is_a_fault_of_the_plan(origin: Any) -> None:
    plan = json.loads(plan_text(Mission.model_validate(YARD), ORIGIN).text)
    plan["viaspline"]["origin"] = origin
    with pytest.raises(MissionError, match=r"viaspline\.origin"):
        QgcPlan().parse(json.dumps(plan), "x.plan")


@pytest.mark.parametrize("beside", [None, "text", 3, [], {}, {"origin": None}])
def test_without_an_origin_of_its_own_a_plan_begins_at_its_home(beside: Any) -> None:
    plan = json.loads(plan_text(Mission.model_validate(YARD), ORIGIN).text)
    plan["viaspline"] = beside
    assert origin_in(QgcPlan().parse(json.dumps(plan), "x.plan")) == pytest.approx(ORIGIN)


class Hedge(Obstacle):
    """An obstacle that is round without being a disc."""

    @property
    def ring(self) -> RoundedRing:
        return RoundedRing([[(30.0, 10.0), (40.0, 20.0)]], 2.0)


def test_what_is_round_without_being_a_disc_is_written_as_a_polygon_around_it() -> None:
    hedge = Hedge(circle=Circle(center=(35.0, 15.0), radius=1.0))
    world = {**YARD["world"], "known": [hedge]}
    written = plan_text(Mission.model_validate({**YARD, "world": world}), ORIGIN)
    [obstacle] = mission_of(QgcPlan().parse(written.text, "x.plan")).world.known
    assert obstacle.ring is not None
    drawn, meant = obstacle.ring.outline(), hedge.ring.outline(200)
    assert drawn.buffer(1e-3).covers(meant)
    assert meant.buffer(0.022 + 1e-3).covers(drawn)
    kind = "rounded outline, written as a larger polygon around it"
    assert f"{kind}: world.known[0] (by up to 0.022 m)" in written.lost
