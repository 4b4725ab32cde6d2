"""What may be wrong with a fleet in space, each fault with its place and words."""

from __future__ import annotations

from typing import Any

import pytest

from viaspline.errors import MissionError
from viaspline.mission.fleet.fleet import Fleet
from viaspline.mission.model import Mission

DRONE = {"radius_m": 0.4, "half_height_m": 0.2, "clearance_m": 0.5}


def fleet(*robots: dict[str, Any], **more: Any) -> dict[str, Any]:
    world = {"ground": {"flat_m": 0}, "altitude": {"max_m": 60}}
    return {"world": world, "robots": {"drone": DRONE}, "fleet": list(robots), **more}


def drone(name: str, start: list[float], goal: list[float], **more: Any) -> dict[str, Any]:
    return {"name": name, "route": {"start": start, "goal": goal, **more.pop("route", {})}, **more}


def faults(data: dict[str, Any]) -> str:
    with pytest.raises(MissionError) as caught:
        Fleet.model_validate(data)
    return str(caught.value)


def test_a_sound_fleet_in_space_is_one() -> None:
    asked = Fleet.model_validate(fleet(drone("a", [0, 0, 9], [9, 0, 9]),
                                       drone("b", [0, 5, 9], [9, 5, 19])))  # fmt: skip
    assert asked.is_spatial
    assert all(one.mission.is_spatial for one in asked.members)


def test_points_of_three_numbers_alone_make_no_fleet_in_space() -> None:
    asked = Fleet.model_validate({"fleet": [drone("a", [0, 0, 9], [9, 0, 9])]})
    assert not asked.is_spatial


def test_robots_one_above_the_other_are_apart() -> None:
    Fleet.model_validate(
        fleet(drone("a", [0, 0, 9], [9, 0, 9]), drone("b", [0, 0, 12], [9, 0, 12]))
    )


def test_robots_too_near_above_each_other_are_told_with_the_separation_that_would_do() -> None:
    told = faults(fleet(drone("a", [0, 0, 9], [9, 0, 9]), drone("b", [0, 0, 9.8], [9, 9, 9])))
    assert "fleet[1].route.start.at: 'b' starts with 0.4 m of free space between it" in told
    assert "set separation_m to at most 0.4" in told


def test_bodies_that_overlap_have_no_free_space() -> None:
    told = faults(fleet(drone("a", [0, 0, 9], [9, 0, 9]), drone("b", [0, 0.2, 9], [9, 9, 9])))
    assert "no free space" in told


def test_two_that_stay_at_one_place_are_told_unless_one_of_them_leaves() -> None:
    robots = [drone("a", [0, 0, 9], [9, 0, 9]), drone("b", [0, 5, 9], [9, 0, 9])]
    told = faults(fleet(*robots))
    assert "fleet[1].route.goal.at: 'b' stays for good" in told
    assert "set rest: leave for one of them" in told
    Fleet.model_validate(fleet(robots[0], {**robots[1], "rest": "leave"}))


def test_two_that_land_at_one_place_are_told() -> None:
    land = {"land": {"at": [20, 20]}}
    robots = [{"name": name, "route": {"start": [0, y], "takeoff": {"to_agl_m": 9}, **land}}
              for name, y in (("a", 0), ("b", 6))]  # fmt: skip
    assert "fleet[1].route.land.at: 'b' stays for good" in faults(fleet(*robots))


def test_a_robot_on_the_ground_among_ones_in_the_air_is_refused_in_words() -> None:
    cart = {"name": "cart", "robot": "cart", "route": {"start": [0, 30], "goal": [9, 30]}}
    data = fleet(drone("a", [0, 0, 9], [9, 0, 9], robot="drone"), cart)
    data["robots"]["cart"] = {"radius_m": 0.5}
    told = faults(data)
    assert "fleet[1]: has no heights" in told
    assert "aren't planned together" in told


def test_a_point_without_a_height_is_told_where_it_stands() -> None:
    told = faults(fleet(drone("a", [0, 0, 9], [9, 0])))
    assert "fleet[0].route.goal.at: has no height, in a mission in space" in told


def test_what_is_wrong_with_the_world_is_told_once() -> None:
    data = fleet(drone("a", [0, 0, 9], [9, 0, 9]), drone("b", [0, 5, 9], [9, 5, 9]))
    data["world"]["altitude"] = {"min_m": 50, "max_m": 20}
    assert faults(data).count("min_m") <= 2
    assert faults(data).count("world.altitude") == 1


def test_places_outside_of_the_band_are_told_for_each_robot() -> None:
    told = faults(fleet(drone("a", [0, 0, 90], [9, 0, 9]), drone("b", [0, 5, 9], [9, 5, 70])))
    assert "fleet[0].route.start" in told
    assert "fleet[1].route.goal" in told


def test_keys_of_the_plane_are_told_at_the_kind_of_robot() -> None:
    data = fleet(drone("a", [0, 0, 9], [9, 0, 9]))
    data["robots"]["drone"] = {**DRONE, "footprint": [[-1, -1], [1, -1], [1, 1], [-1, 1]]}
    del data["robots"]["drone"]["radius_m"]
    assert "robots.drone.footprint: is for missions in the plane" in faults(data)


def test_keys_of_the_plane_are_told_at_a_route() -> None:
    start = {"at": [0, 0, 9], "heading_deg": 90}
    told = faults(fleet({"name": "a", "route": {"start": start, "goal": [9, 0, 9]}}))
    assert "fleet[0].route.start.heading_deg: is for missions in the plane" in told


def test_a_patrol_takes_off_or_begins_in_the_air_and_never_lands() -> None:
    route = {"start": [0, 0], "takeoff": {"to_agl_m": 9}, "via": [[9, 0, 9], [9, 9, 9]],
             "closed": True}  # fmt: skip
    for rounds in (route, {**route, "laps": 2}, {"start": [0, 0, 9], "via": [[9, 0, 9], [9, 9, 9]],
                                                 "closed": True}):  # fmt: skip
        Fleet.model_validate(fleet({"name": "a", "route": rounds}))
    told = faults(fleet({"name": "a", "route": {**route, "land": [0, 0]}}))
    assert "land" in told


def test_things_may_move_in_the_world_of_a_fleet() -> None:
    data = fleet(drone("a", [0, 0, 9], [9, 0, 9]))
    crane = {"circle": {"center": [50, 50], "radius": 2},
             "motion": {"keyframes": [[0, 50, 50], [9, 60, 50]], "after": "stay"}}  # fmt: skip
    data["world"]["known"] = [crane]
    assert Fleet.model_validate(data).world.moving


def test_a_mission_in_space_may_be_a_robots() -> None:
    world = {"ground": {"flat_m": 0}}
    mission = Mission.model_validate({
        "world": world, "robot": DRONE, "route": {"start": [0, 0, 9], "goal": [9, 0, 9]},
    })  # fmt: skip
    asked = Fleet.model_validate({"world": world, "fleet": [{"name": "a", "mission": mission}]})
    assert asked.is_spatial
