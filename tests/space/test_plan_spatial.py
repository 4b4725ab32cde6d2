"""Missions in space as wholes, against exact distances of the test's own."""

from __future__ import annotations

import math
import pickle
from copy import deepcopy
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import viaspline as vs
from cities import CLEARANCE, HALF, RADIUS, city
from viaspline.curve.certificate import Certificate
from viaspline.errors import GaveUpError, NoPathError
from viaspline.mission.model import Mission
from viaspline.planning.problem.ledger import Candidate
from viaspline.space.leg_check import LegCheck
from viaspline.space.weighed_ways import (
    NO_CHEAPER,
    SHARP,
    TautWay,
    WeighedWay,
    by_cost,
    told,
)

Floats = NDArray[np.float64]


def distances(known: list[dict[str, dict[str, object]]], places: Floats) -> Floats:
    """From an upright cylinder at places to boxes and balls, by formulas of its own."""
    least = np.full(len(places), math.inf)
    for one in known:
        if "box" in one:
            low, high = np.array(one["box"]["min"]), np.array(one["box"]["max"])
            apart = np.maximum(np.maximum(low - places, places - high), 0.0)
            level = np.maximum(np.hypot(apart[:, 0], apart[:, 1]) - RADIUS, 0.0)
            upright = np.maximum(apart[:, 2] - HALF, 0.0)
            least = np.minimum(least, np.hypot(level, upright))
        else:
            center = np.array(one["ball"]["center"])
            off = places - center
            level = np.maximum(np.hypot(off[:, 0], off[:, 1]) - RADIUS, 0.0)
            upright = np.maximum(np.abs(off[:, 2]) - HALF, 0.0)
            least = np.minimum(least, np.hypot(level, upright) - float(one["ball"]["radius"]))  # type: ignore[arg-type]
    return least


@settings(max_examples=12)
@given(seed=st.integers(0, 100_000))
def test_a_path_keeps_its_clearance_its_altitude_and_its_limits_everywhere(seed: int) -> None:
    data = city(seed)
    plan = vs.plan(Mission.model_validate(data))
    assert isinstance(plan, vs.SpatialPlan)
    places = plan.path.at_distance(np.linspace(0, plan.path.length, int(plan.path.length / 0.02)))
    kept = distances(data["world"]["known"], places)  # type: ignore[index]
    assert kept.min() >= CLEARANCE - 1e-6
    assert plan.certificate.holds
    assert plan.certificate.clearance <= kept.min() + 1e-6
    assert plan.heights.holds
    assert places[:, 2].min() >= 2 - 1e-6
    assert places[:, 2].max() <= 60 + 1e-6
    times = np.linspace(0, plan.trajectory.duration, 3000)
    at, speed, _ = plan.trajectory.state_at(times)
    climb = speed * plan.path.tangent(plan.path.parameter(np.clip(at, 0, plan.path.length)))[:, 2]
    assert climb.max() <= 3 + 1e-6
    assert climb.min() >= -2 - 1e-6


def test_the_same_mission_gives_the_same_bytes() -> None:
    one, other = (vs.plan(Mission.model_validate(city(11))) for _ in range(2))
    assert one.path.spans.tobytes() == other.path.spans.tobytes()
    assert one.trajectory.times.tobytes() == other.trajectory.times.tobytes()


@pytest.mark.parametrize("side", ["left", "right", "over", "under"])
def test_a_side_that_is_asked_for_is_the_side_that_is_taken(side: str) -> None:
    data = city(0)
    lamp = {"ball": {"center": [80, 80, 20], "radius": 4}, "pass_on": side}
    data["world"]["known"] = [lamp]  # type: ignore[index]
    data["route"] = {"start": [8, 8, 20], "goal": [152, 152, 20]}
    plan = vs.plan(Mission.model_validate(data))
    places = plan.path.at_distance(np.linspace(0, plan.path.length, 4000))
    middle = places[int(np.argmin(np.abs(places[:, 0] + places[:, 1] - 160)))]
    left = (middle[1] - 80) * math.sqrt(0.5) - (middle[0] - 80) * math.sqrt(0.5)
    taken = {
        "left": left > 4, "right": left < -4, "over": abs(left) <= 4 < middle[2] - 20,
        "under": abs(left) <= 4 < 20 - middle[2],
    }  # fmt: skip
    assert taken[side]


def test_a_place_that_is_walled_in_is_refused_and_the_wall_is_named() -> None:
    walls = [
        {"name": "shell", "box": {"min": [140, 140, 0], "max": [160, 141, 60]}},
        {"box": {"min": [140, 140, 0], "max": [141, 160, 60]}},
    ]
    data = city(0)
    data["world"]["known"] = walls  # type: ignore[index]
    with pytest.raises((NoPathError, GaveUpError)):
        vs.plan(Mission.model_validate(data))


def test_a_gate_is_flown_through_square_to_it() -> None:
    data = city(0)
    data["world"]["known"] = []  # type: ignore[index]
    gate = {"at": [80, 60, 12], "facing_deg": 90, "width_m": 5, "height_m": 5}
    data["route"] = {"start": [8, 8, 10], "via": [{"gate": gate}], "goal": [152, 152, 10]}
    plan = vs.plan(Mission.model_validate(data))
    via = next(via for via in plan.path.vias if via.index == 1)
    assert np.allclose(plan.path.tangent(via.u), (0, 1, 0), atol=1e-9)


def test_a_ball_flies_through_voxels_as_well() -> None:
    blocked = np.zeros((40, 40, 20), bool)
    blocked[18:22, :, :12] = True
    data = city(0)
    data["world"]["known"] = [  # type: ignore[index]
        {"name": "wall", "voxels": vs.Voxels(blocked, 2.0, (40.0, 40.0, 0.0))}
    ]
    data["robot"] = {"radius_m": 0.5, "clearance_m": 0.5, "max_climb_mps": 2}
    plan = vs.plan(Mission.model_validate(data))
    places = plan.path.at_distance(np.linspace(0, plan.path.length, 4000))
    low, high = np.array([76.0, 40, 0]), np.array([84.0, 120, 24])
    apart = np.linalg.norm(np.maximum(np.maximum(low - places, places - high), 0), axis=1)
    assert apart.min() >= 1.0 - 1e-6
    assert plan.certificate.holds


def flight_past_cubes(optimise: str) -> vs.SpatialPlan:
    """From one side of a floating block to the other, a little nearer to its roof."""
    blocked = np.zeros((40, 40, 20), bool)
    blocked[18:22, 17:23, 7:13] = True
    mission = Mission.model_validate({
        "world": {"bounds": [0, 0, 40, 40], "altitude": {"min_m": 0.45, "max_m": 19.5},
                  "known": [{"name": "block", "voxels": vs.Voxels(blocked, 1.0)}]},
        "robot": {"radius_m": 0.45, "clearance_m": 0.0},
        "route": {"start": [4.5, 20.5, 10.2], "goal": [35.5, 20.5, 10.2], "optimise": optimise},
    })  # fmt: skip
    plan = vs.plan(mission)
    assert isinstance(plan, vs.SpatialPlan)
    return plan


def test_other_sides_of_cubes_are_looked_for_when_the_ledger_of_a_short_flight_is_read() -> None:
    plan = flight_past_cubes("length")
    assert "ledger" not in vars(plan.account)
    again = pickle.loads(pickle.dumps(plan))
    assert again == plan
    (entry,) = plan.ledger
    assert entry.chosen is not None
    assert {one.side for one in entry.candidates} == {"over", "under"}
    assert [one.length for one in again.ledger[0].candidates] == [
        one.length for one in entry.candidates
    ]
    assert entry.chosen.duration == pytest.approx(plan.trajectory.duration)
    for one in entry.candidates:
        assert one.length is not None
        assert one.duration is not None
        if one.length < entry.chosen.length:  # type: ignore[operator]
            assert one.passed_over is not None


def test_where_time_counts_other_sides_of_cubes_are_weighed_at_once() -> None:
    plan = flight_past_cubes("time")
    assert plan.account.others is None
    durations = [one.duration for one in plan.ledger[0].candidates if one.duration is not None]
    assert plan.ledger[0].chosen is not None
    assert len(durations) > 1
    assert plan.ledger[0].chosen.duration == min(durations)


def test_a_plan_in_space_and_its_flight_show_themselves_in_a_line() -> None:
    data = city(0)
    data["world"]["known"] = []  # type: ignore[index]
    plan = vs.plan(Mission.model_validate(data))
    assert isinstance(plan, vs.SpatialPlan)
    for value, word in ((plan, "m clear"), (vs.fly(plan), "reached")):
        assert word in repr(value)
        assert len(repr(value)) < 120


def test_a_wall_from_bound_to_bound_up_to_the_ceiling_is_refused_not_given_up() -> None:
    data = city(0)
    data["world"]["known"] = [{"box": {"min": [70, 0, 0], "max": [90, 160, 70]}}]  # type: ignore[index]
    with pytest.raises(NoPathError):
        vs.plan(Mission.model_validate(data))


def test_a_flight_that_is_not_proven_as_a_whole_is_no_blocked_descent(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    proof = LegCheck.proof

    def of_one_leg(check: LegCheck, spans: Floats) -> Certificate:
        found = proof(check, spans)
        return found if len(spans) == 1 else replace(found, clearance=0.1)

    monkeypatch.setattr(LegCheck, "proof", of_one_leg)
    route = {"start": [0, 0, 9], "via": [[10, 0, 9]], "land": {"at": [20, 0]}}
    known = [{"ball": {"center": [10, 30, 9], "radius": 1}, "name": "balloon"}]
    with pytest.raises(GaveUpError, match=r"the best curve .* within 0\.1 m of 'balloon'"):
        vs.plan(Mission.model_validate({"world": {"known": known}, "route": route}))


WALL_AND_POST = {
    "world": {
        "ground": {"flat_m": 0},
        "known": [
            {"polygon": [[37, -5], [42, -5], [42, 60], [37, 60]], "height_m": [0, 90]},
            {"circle": {"center": [58, -16], "radius": 5}, "height_m": [0, 90]},
        ],
    },
    "robot": {"radius_m": 0.5, "clearance_m": 1, "max_speed_mps": 10, "max_accel_mps2": 3},
    "route": {"start": [0, 10, 20], "goal": [80, 10, 20]},
}


@pytest.mark.parametrize("beside", [(38, -9), (40, -8), (40, -10), (42, -8), (44, -9)])
def test_no_via_point_that_nobody_needs_makes_a_flight_sooner(beside: tuple[int, int]) -> None:
    """The taut way bends at both edges of the wall: 13.7 s, and 12.3 by a via point between."""
    alone = vs.plan(vs.Mission.model_validate(WALL_AND_POST))
    led = deepcopy(WALL_AND_POST)
    led["route"]["via"] = [[*beside, 20]]
    by_hand = vs.plan(vs.Mission.model_validate(led))
    assert alone.trajectory.duration <= by_hand.trajectory.duration * (1 + 2e-3)


def test_a_way_that_turns_more_sharply_than_the_robot_counts_for_what_it_becomes() -> None:
    """Its turns are laid anew, for up to a fifth more: of two ways that is the one not taken."""
    way = TautWay("left", np.zeros((1, 3)), 30.0)
    nothing = np.empty((0, 4, 3))
    sharp = WeighedWay(way, Candidate("left", way.inner, nothing, duration=39.4), 1.2 * 39.4)
    gentle = WeighedWay(way, Candidate("right", way.inner, nothing, duration=39.7), 39.7)
    slow = WeighedWay(way, Candidate("over", way.inner, nothing, duration=54.0), 54.0)
    found = [sharp, gentle, slow]
    assert by_cost(found) == [gentle, sharp, slow]
    candidates = told(found, gentle)
    assert [one.chosen for one in candidates] == [False, True, False]
    assert [one.passed_over for one in candidates] == [SHARP, None, None]
    assert [one.passed_over for one in told(found, slow)] == [NO_CHEAPER, NO_CHEAPER, None]


def test_where_a_zone_is_slow_the_way_beside_it_is_flown() -> None:
    tower = {"name": "tower", "circle": {"center": [50, 1], "radius": 8}, "height_m": [0, 30]}
    zone = {"polygon": [[20, -40], [80, -40], [80, 0], [20, 0]], "max_speed_mps": 0.3}
    world = {
        "altitude": {"min_m": 2, "max_m": 30, "above": "home"},
        "ground": {"flat_m": 0},
        "known": [tower],
        "speed_zones": [zone],
    }
    robot = {"radius_m": 0.5, "max_speed_mps": 2}
    route = {"start": [0, 0, 10], "goal": [100, 0, 10]}
    plan = vs.plan(Mission.model_validate({"world": world, "robot": robot, "route": route}))
    assert plan.trajectory.duration < 56.0
    (entry,) = plan.ledger
    assert entry.chosen is not None
    assert entry.chosen.side == "left"
    right = [one.duration for one in entry.candidates if one.side.startswith("right")]
    assert min(one for one in right if one is not None) > 100.0


def test_a_spline_beside_a_led_leg_is_left_where_it_swings_out() -> None:
    """It was clear behind the way past one post, and took 7 % longer than the shortest path."""
    posts = [
        {"circle": {"center": [37.443, 2.351], "radius": 0.667}, "height_m": [-3, 17.699]},
        {"circle": {"center": [43.757, 17.337], "radius": 4.525}, "height_m": [2.4, 6.355]},
    ]
    robot = {
        "radius_m": 0.424, "clearance_m": 0.332, "max_speed_mps": 5.11, "max_accel_mps2": 3.774,
        "max_climb_mps": 3.542, "max_descent_mps": 1.993, "max_vertical_accel_mps2": 1.68,
    }  # fmt: skip
    taken = []
    for optimise in ("time", "length"):
        route = {
            "start": [19.86, 10.85, 23.07],
            "via": [[9.05, 4.08, 23.09], [48.32, 4.64, 11.8]],
            "goal": [5.95, 17.78, 11.78],
            "optimise": optimise,
        }
        asked = {"world": {"known": posts}, "robot": robot, "route": route}
        plan = vs.plan(vs.Mission.model_validate(asked))
        taken.append(plan.trajectory.duration)
    assert taken[0] <= taken[1] * (1 + 1e-3)


def test_the_shortest_route_has_no_loops_of_the_spline_between_legs_that_are_led() -> None:
    """Through a hole in a ceiling, to a far corner and back: the spline swung out by 26 m."""
    ceiling = [
        {"box": {"min": [-10, -10, 14], "max": [36.3, 60, 14.3]}},
        {"box": {"min": [38.9, -10, 14], "max": [60, 60, 14.3]}},
        {"box": {"min": [36.3, -10, 14], "max": [38.9, 16, 14.3]}},
        {"box": {"min": [36.3, 19.7, 14], "max": [38.9, 60, 14.3]}},
    ]
    places = [[16.25, 24.71, 7.59], [0.25, 13.63, 20.18], [48.29, 47.07, 20.78], [12, 12, 12.35]]
    asked = {
        "world": {"bounds": [-10, -10, 60, 60], "known": ceiling},
        "robot": {"radius_m": 0.195, "clearance_m": 0.227, "half_height_m": 0.381},
        "route": {"start": places[0], "via": places[1:3], "goal": places[3], "optimise": "length"},
    }
    plan = vs.plan(vs.Mission.model_validate(asked))
    taut = [np.linalg.norm(np.diff([places[0], [37.6, 17.8, 14], places[1]], axis=0), axis=1)]
    taut += [np.linalg.norm(np.diff(places[1:3], axis=0), axis=1)]
    taut += [np.linalg.norm(np.diff([places[2], [37.6, 17.8, 14], places[3]], axis=0), axis=1)]
    assert plan.path.length < 1.02 * sum(float(one.sum()) for one in taut)
