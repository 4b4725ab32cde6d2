"""Altitudes above home, above sea level and above terrain, and what is flown with a ground."""

import json
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import GeometryError, MissionError, MissionWarning
from viaspline.formats.load import load
from viaspline.formats.mission_format import Whereabouts
from viaspline.formats.qgc_plan import QgcPlan
from viaspline.formats.qgc_wpl import QgcWpl
from viaspline.mission.model import Mission
from viaspline.mission.space.flight_places import flight_places

HERE = (47.0, 8.0)
NORTH = 47.001
"""A latitude some 111 m north of here."""


def item(latitude: float | None, frame: int, altitude: float | None, **more: Any) -> dict[str, Any]:
    command = more.pop("command", 16)
    longitude = None if latitude is None else 8.0
    params = [0, 0, 0, None, latitude, longitude, altitude]
    return {"type": "SimpleItem", "command": command, "frame": frame, "params": params} | more


def over_terrain(latitude: float, height: float, amsl: float | None) -> dict[str, Any]:
    """As QGroundControl writes AltitudeMode 3."""
    more = {"AltitudeMode": 3, "Altitude": height, "AMSLAltAboveTerrain": amsl}
    return item(latitude, 0, amsl, **more)


def plan(folder: Path, *items: dict[str, Any], home: Any = (*HERE, 400), **own: Any) -> Path:
    mission = {"version": 2, "plannedHomePosition": home, "items": list(items)}
    data = {"fileType": "Plan", "version": 1, "mission": mission, "viaspline": own}
    file = folder / "x.plan"
    file.write_text(json.dumps(data))
    return file


def quietly(file: Path, **options: Any) -> Mission:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MissionWarning)
        mission = load(file, **options)
    assert isinstance(mission, Mission)
    return mission


@pytest.fixture
def dem(tmp_path: Path) -> Path:
    rows = "\n".join(" ".join([str(row)] * 31) for row in range(460, 429, -1))
    header = "ncols 31\nnrows 31\nxllcenter -375\nyllcenter -375\ncellsize 25\n"
    (tmp_path / "dem.asc").write_text(header + rows)
    return tmp_path


# Without a ground.


def test_an_altitude_above_terrain_is_never_taken_as_above_home(tmp_path: Path) -> None:
    file = plan(tmp_path, item(NORTH, 10, 20), item(NORTH + 0.001, 3, 20))
    with pytest.warns(MissionWarning, match="item 1: altitude above terrain, and no terrain"):
        mission = load(file)
    assert isinstance(mission, Mission)
    assert not mission.is_spatial
    assert [len(point.at) for _, point in mission.route.points()] == [2, 2, 2]


@pytest.mark.parametrize("mode", ["3", "AboveTerrain", True, 3.5, [3], -1, 6, float("nan")])
def test_an_altitude_mode_that_there_is_not_is_refused(tmp_path: Path, mode: Any) -> None:
    """What is above terrain would be taken as above sea level without a word."""
    file = plan(tmp_path, item(NORTH, 0, 450, AltitudeMode=mode, Altitude=20))
    with pytest.raises(MissionError, match=r"mission.items\[0\].AltitudeMode: .*it should be"):
        quietly(file)


@pytest.mark.parametrize("mode", [None, 0, 1, 2, 4, 5])
def test_other_altitude_modes_say_no_more_than_the_frame(tmp_path: Path, mode: Any) -> None:
    here, there = (item(at, 3, 20, AltitudeMode=mode, Altitude=9) for at in (NORTH, NORTH + 1e-3))
    assert quietly(plan(tmp_path, here, there)).route.goal == (
        quietly(plan(tmp_path, item(NORTH, 3, 20), item(NORTH + 1e-3, 3, 20))).route.goal
    )


def test_the_altitude_above_sea_level_of_a_terrain_altitude_is_enough(tmp_path: Path) -> None:
    file = plan(tmp_path, over_terrain(NORTH, 20, 431.5), item(NORTH + 0.001, 3, 20))
    with pytest.warns(MissionWarning, match="item 1: altitude above terrain, taken by the alt"):
        mission = load(file)
    assert isinstance(mission, Mission)
    assert [point.at[2] for _, point in mission.route.points()] == [0, 31.5, 20]


def test_where_it_is_null_nothing_is_known_of_the_height(tmp_path: Path) -> None:
    file = plan(tmp_path, over_terrain(NORTH, 20, None), item(NORTH + 0.001, 3, 20))
    assert [len(point.at) for _, point in quietly(file).route.points()] == [2, 2, 2]


# With a ground.


def test_each_frame_is_what_it_is(dem: Path) -> None:
    file = plan(
        dem,
        item(NORTH, 3, 20),
        item(NORTH + 0.0002, 0, 480),
        item(NORTH + 0.0004, 10, 30),
        over_terrain(NORTH + 0.0006, 35, None),
        over_terrain(NORTH + 0.0008, 40, 489),
    )
    mission = quietly(file, ground={"terrain": str(dem / "dem.asc")})
    places = flight_places(mission)
    told = [mission.route.start, *mission.route.via]
    assert [point.agl_m for point in told] == [None, None, 30, 35]
    assert mission.route.goal is not None
    assert mission.route.goal.agl_m == 40
    north = [0, 111.2, 133.4, 155.7, 177.9, 200.1]
    ground = np.interp(north, np.arange(-375, 376, 25), np.arange(430, 461))
    heights = [place[2] for place in (places.start, *places.via, places.goal or ())]
    # Above home is above the ground there, whatever altitude the file gives it.
    expected = [445 + 20, 480, ground[3] + 30, ground[4] + 35, ground[5] + 40]
    assert heights == pytest.approx(expected, abs=0.05)


def test_take_off_climb_landing_and_what_is_looked_at_are_flown(dem: Path) -> None:
    look = item(NORTH, 3, 5, command=195)
    file = plan(
        dem,
        item(None, 3, 12, command=22),
        look,
        item(NORTH + 0.001, 3, 30),
        item(NORTH + 0.001, 3, 60),
        item(None, 2, 0, command=197),
        item(NORTH + 0.002, 3, 30),
        item(NORTH + 0.002, 3, 0, command=21),
    )
    mission = quietly(file, ground={"flat_m": 400})
    route = mission.route
    assert route.takeoff is not None
    assert (route.takeoff.to_agl_m, route.start.at, route.goal) == (12, (0, 0), None)
    assert [via.at[2] for via in route.via] == [430, 460, 430]
    looked_at = [via.look_at for via in route.via]
    assert looked_at[0] == looked_at[1] == pytest.approx((0, 111.17, 405), abs=0.1)
    assert looked_at[2] is None
    assert route.land is not None
    assert route.land.at == route.via[-1].at[:2]


def test_a_return_to_launch_lands_where_it_began(tmp_path: Path) -> None:
    items = [item(None, 3, 12, command=22), item(NORTH, 3, 30), item(None, 2, 0, command=20)]
    route = quietly(plan(tmp_path, *items), ground={"flat_m": 0}).route
    assert route.land is not None
    assert route.land.at == (0, 0)


def test_items_that_stay_where_the_vehicle_is_are_no_points_of_their_own(tmp_path: Path) -> None:
    """A survey that begins above its take-off, and way points that go 'here', are legal."""
    off, here = item(HERE[0], 3, 20, command=22), item(None, 3, 20)
    there = item(NORTH, 3, 20)
    there["params"][0] = 3
    again = [item(HERE[0], 3, 20), there, here, {**there, "params": [4, *there["params"][1:]]}]
    file = plan(tmp_path, off, *again, item(NORTH, 3, 30), item(47.002, 3, 20))
    mission = quietly(file, ground={"flat_m": 400})
    assert [(via.at[2], via.dwell_s) for via in mission.route.via] == [(420, 7), (430, 0)]
    assert mission.route.takeoff is not None
    assert mission.route.takeoff.to_agl_m == 20


def test_a_take_off_stays_as_long_as_what_is_asked_for_where_it_ends(tmp_path: Path) -> None:
    hold = item(None, 3, 12)
    hold["params"][0] = 4
    delay = item(None, 2, 0, command=93)
    delay["params"][0] = 5
    off = [item(None, 3, 12, command=22), delay, hold]
    file = plan(tmp_path, *off, item(NORTH, 3, 30), item(NORTH + 0.001, 3, 30))
    route = quietly(file, ground={"flat_m": 0}).route
    assert (route.start.dwell_s, len(route.via)) == (9, 1)


@pytest.mark.parametrize(
    ("items", "told"),
    [
        ([item(None, 2, 0, command=93, params=[5, 0, 0, 0, 0, 0, 0])], "delay before it flies"),
        (
            [
                item(NORTH, 3, 5, command=195),
                item(47.003, 3, 20),
                item(47.002, 3, 5, command=195),
                item(47.003, 3, 20),
            ],
            "looks elsewhere from the same place",
        ),
        ([item(None, 3, 0, command=195)], "without a place on earth"),
    ],
)
def test_what_a_flight_cannot_have_is_told(
    tmp_path: Path, items: list[dict[str, Any]], told: str
) -> None:
    file = plan(tmp_path, *items, item(NORTH, 3, 30), item(NORTH + 0.001, 3, 30))
    with pytest.warns(MissionWarning, match=told):
        load(file, ground={"flat_m": 0})


def test_without_take_off_it_begins_in_the_air(tmp_path: Path) -> None:
    file = plan(tmp_path, item(NORTH, 3, 30), item(NORTH + 0.001, 3, 30))
    route = quietly(file, ground={"flat_m": 0}).route
    assert route.start.at == pytest.approx((0, 111.17, 30), abs=0.1)
    assert route.goal is not None


def test_a_fault_of_a_flown_point_is_told_by_its_item(tmp_path: Path) -> None:
    file = plan(tmp_path, item(NORTH, 3, 30), item(NORTH + 0.001, 10, -5), item(NORTH, 3, 50))
    with pytest.raises(MissionError, match=r"x.plan: mission.items\[1\]: .* under the ground"):
        quietly(file, ground={"flat_m": 0})


def test_a_ground_that_cannot_be_had_is_an_error(tmp_path: Path) -> None:
    file = plan(tmp_path, item(NORTH, 3, 30), item(NORTH + 0.001, 10, 5))
    with pytest.raises(MissionError, match=r"no.asc: there is no such file"):
        quietly(file, ground={"terrain": "no.asc"})
    with pytest.raises(MissionError, match=r"x.plan: ground: found"):
        quietly(file, ground={"flat_m": "low"})
    with pytest.raises(GeometryError, match="ground is of the class"):
        quietly(file, ground=5)
    own = tmp_path / "m.yaml"
    own.write_text("route: {start: [0, 0], goal: [9, 0]}\n")
    with pytest.raises(GeometryError, match="says its own ground"):
        quietly(own, ground={"flat_m": 0})


# There and back.


def flown(seed: int) -> Mission:
    """A mission in space that files of way points can carry."""
    rng = np.random.default_rng(seed)
    ground: Any = {"flat_m": float(rng.integers(-3, 400))}
    via: list[dict[str, Any]] = []
    for x in range(40, 40 + 30 * int(rng.integers(1, 6)), 30):
        at = [float(x), float(rng.integers(-20, 20))]
        over = float(rng.integers(10, 60))
        is_agl = rng.random() < 0.5
        point = {"at": at, "agl_m": over} if is_agl else {"at": [*at, ground["flat_m"] + over]}
        if rng.random() < 0.4:
            point["look_at"] = [*rng.integers(-50, 50, 2).tolist(), ground["flat_m"] + 3]
        if rng.random() < 0.3:
            point["dwell_s"] = 5
        via.append(point)
    route: dict[str, Any] = {"via": via}
    if rng.random() < 0.6:
        stays = {"dwell_s": 4} if rng.random() < 0.5 else {}
        looks = {"look_at": [20, 30, ground["flat_m"]]} if rng.random() < 0.5 else {}
        route |= {"start": {"at": [0, 0], **stays, **looks}, "takeoff": {"to_agl_m": 15}}
    else:
        route["start"] = [0, 0, ground["flat_m"] + 12.5]
    if rng.random() < 0.6:
        route["land"] = {"at": [0, 60]}
    else:
        route["goal"] = {"at": [0, 60], "agl_m": 20}
    return Mission.model_validate({"world": {"ground": ground}, "route": route})


def same(one: Mission, other: Mission) -> None:
    """Two missions are one, places to a millimetre."""
    a, b = flight_places(one), flight_places(other)
    for first, second in ((a.start, b.start), (a.takeoff, b.takeoff), (a.goal, b.goal)):
        assert (first is None) == (second is None)
        if first is not None:
            assert second == pytest.approx(first, abs=1e-3)
    assert (a.landing is None) == (b.landing is None)
    assert len(a.via) == len(b.via)
    for (_, here), (_, there) in zip(one.route.points(), other.route.points(), strict=True):
        assert there.at == pytest.approx(here.at, abs=1e-3)
        assert (there.agl_m, there.dwell_s) == (here.agl_m, here.dwell_s)
        if here.look_at is None:
            assert there.look_at is None
        else:
            assert there.look_at == pytest.approx(here.look_at, abs=1e-3)


@settings(deadline=None, max_examples=60)
@given(seed=st.integers(0, 9999))
def test_a_plan_says_where_its_flight_is(seed: int) -> None:
    mission = flown(seed)
    text, lost = QgcPlan().write(mission, Whereabouts(origin=HERE))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MissionWarning)
        same(mission, QgcPlan().read(text, "x.plan"))
    assert lost == ()


@settings(deadline=None, max_examples=60)
@given(seed=st.integers(0, 9999))
def test_a_table_says_where_its_flight_is_once_its_ground_is_given(seed: int) -> None:
    mission = flown(seed)
    text, lost = QgcWpl().write(mission, Whereabouts(origin=HERE))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MissionWarning)
        same(mission, QgcWpl().read_over(text, "x.waypoints", mission.world.ground))
    assert lost == ("world: ground",)


def test_a_plan_names_its_terrain_beside_itself(dem: Path) -> None:
    data = {
        "world": {"ground": {"terrain": str(dem / "dem.asc")}},
        "route": {
            "start": [0, 0],
            "takeoff": {"to_agl_m": 30},
            "goal": {"at": [90, 0], "agl_m": 40},
        },
    }
    mission = Mission.model_validate(data)
    text, lost = QgcPlan().write(mission, Whereabouts(dem, HERE))
    (dem / "y.plan").write_text(text)
    there = quietly(dem / "y.plan")
    assert there.world.ground == mission.world.ground
    same(mission, there)
    assert lost == ()
    modes = [item["AltitudeMode"] for item in json.loads(text)["mission"]["items"]]
    assert modes == [1, 4]


def test_what_files_of_way_points_cannot_say_of_a_flight_is_named() -> None:
    gate = {"at": [50, 0, 9], "facing_deg": 0, "width_m": 5, "height_m": 5}
    mission = Mission.model_validate(
        {
            "world": {
                "altitude": {"max_m": 100},
                "known": [
                    {"ball": {"center": [50, 40, 9], "radius": 3}},
                    {"capsule": {"from": [50, 80, 9], "to": [90, 80, 9], "radius": 1}},
                    {"circle": {"center": [50, 120], "radius": 3}, "height_m": [0, 9]},
                ],
            },
            "route": {
                "start": [0, 0, 9],
                "via": [{"gate": gate}],
                "goal": [90, 0, 9],
                "yaw": "along",
            },
        }
    )
    _, lost = QgcPlan().write(mission, Whereabouts(origin=HERE))
    assert set(lost) == {
        "gate: route.via[0]",
        "route: yaw",
        "world: altitude",
        "ball: world.known[0]",
        "capsule in space: world.known[1]",
        "height_m: world.known[2]",
    }


@pytest.mark.parametrize("frame", [0, 3, 5, 6, 10])
def test_an_altitude_reckoned_above_terrain_is_one_above_the_sea_in_every_frame(
    tmp_path: Path, frame: int
) -> None:
    reckoned = over_terrain(NORTH, 20, 425) | {"frame": frame}
    mission = quietly(plan(tmp_path, item(HERE[0], 3, 10), reckoned, item(47.002, 3, 10)))
    assert mission.route.via[0].at[2] == 25.0  # it was 425 m above home in frame 3
    above = quietly(tmp_path / "x.plan", ground={"flat_m": 405})
    assert above.route.via[0].agl_m == 20.0


@pytest.mark.parametrize(("frame", "mode"), [(3, 2), (0, 1), (10, 1), (3, 4), (10, 2), (5, 4)])
def test_an_altitude_mode_that_is_not_that_of_its_frame_is_told(
    tmp_path: Path, frame: int, mode: int
) -> None:
    odd = item(NORTH, frame, 420, AltitudeMode=mode)
    with pytest.warns(MissionWarning) as told:
        load(plan(tmp_path, item(HERE[0], 3, 10), odd, item(47.002, 3, 10)))
    said = [str(one.message) for one in told]
    assert any("items[1]" in one and f"frame {frame}, which counts" in one for one in said)


@pytest.mark.parametrize(("frame", "mode"), [(3, 1), (6, 1), (0, 2), (10, 4), (3, 0), (0, 0)])
def test_an_altitude_mode_of_its_frame_is_nothing_to_tell_of(
    tmp_path: Path, frame: int, mode: int
) -> None:
    usual = item(NORTH, frame, 420, AltitudeMode=mode)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        load(plan(tmp_path, item(HERE[0], 3, 10), usual, item(47.002, 3, 10)))
    assert not any("which counts" in str(one.message) for one in told)


def test_heights_that_are_left_out_for_one_that_is_missing_are_told(tmp_path: Path) -> None:
    heights = (item(HERE[0], 3, 10), item(NORTH, 3, None), item(47.002, 3, 10))
    with pytest.warns(MissionWarning) as told:
        mission = load(plan(tmp_path, *heights))
    assert any("items[1]: no altitude" in str(one.message) for one in told)
    assert isinstance(mission, Mission)
    assert {len(point.at) for point in (mission.route.start, *mission.route.via)} == {2}
