"""A fleet as data: what is taken, what each robot's mission then is, and every fault at once."""

from __future__ import annotations

import math
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.errors import Fault, MissionError
from viaspline.mission.fleet.fleet import Fleet

ASIDE = [[1, 1], [2, 1], [2, 2]]
CART = {"radius_m": 0.5, "clearance_m": 0.1}


def robot(name: str, start: list[float], goal: list[float], **more: Any) -> dict[str, Any]:
    return {"name": name, "robot": "cart", "route": {"start": start, "goal": goal}, **more}


def fleet(*robots: dict[str, Any], **more: Any) -> dict[str, Any]:
    return {"separation_m": 1, "robots": {"cart": CART}, "fleet": list(robots), **more}


TWO = fleet(robot("r1", [0, 0], [9, 0]), robot("r2", [0, 5], [9, 5]))


def faults_of(data: Any) -> tuple[Fault, ...]:
    with pytest.raises(MissionError) as refused:
        Fleet.model_validate(data)
    return refused.value.faults


def only_fault_of(data: Any) -> Fault:
    (fault,) = faults_of(data)
    return fault


def test_a_robot_has_a_whole_mission_over_the_world_of_the_fleet() -> None:
    found = Fleet.model_validate(
        fleet(
            robot("r1", [0, 0], [9, 0], priority=2, depart_s=4, rest="leave"),
            robot("r2", [0, 5], [9, 5], spline={"tension": 0.5}),
            world={"bounds": [-5, -5, 20, 20]},
            spline={"tension": 0.25},
        )
    )
    first, second = found.members
    assert (first.name, first.priority, first.rest) == ("r1", 2.0, "leave")
    assert (second.name, second.priority, second.rest) == ("r2", 0.0, "stay")
    assert first.mission.route.depart_s == 4.0
    assert first.mission.robot.radius_m == 0.5
    assert first.mission.world is second.mission.world is found.world
    assert (first.mission.spline.tension, second.mission.spline.tension) == (0.25, 0.5)
    alone = vs.Mission.model_validate(
        {
            "world": {"bounds": [-5, -5, 20, 20]},
            "robot": CART,
            "route": {"start": [0, 5], "goal": [9, 5]},
            "spline": {"tension": 0.5},
        }
    )
    assert second.mission == alone


def test_a_fleet_of_one_and_one_without_kinds_are_fine() -> None:
    found = Fleet.model_validate(
        {"fleet": [{"name": "a", "route": {"start": [0, 0], "goal": [5, 0]}}]}
    )
    assert (
        found.members[0].mission.robot
        == vs.Mission.model_validate({"route": {"start": [0, 0], "goal": [5, 0]}}).robot
    )


def test_the_only_kind_need_not_be_named() -> None:
    data = fleet(robot("r1", [0, 0], [9, 0]))
    del data["fleet"][0]["robot"]
    assert Fleet.model_validate(data).members[0].mission.robot.clearance_m == 0.1
    data["robots"]["lift"] = {}
    fault = only_fault_of(data)
    assert (fault.key, fault.remedy) == ("fleet[0]", "give robot: cart or lift")


@pytest.mark.parametrize(
    ("data", "key", "words"),
    [
        ({"fleet": []}, "fleet", "an empty list"),
        ({}, "fleet", "is missing"),
        ({"fleet": [{"name": "a"}]}, "fleet[0]", "none of route and mission"),
        (fleet(robot("r1", [0, 0], [9, 0], prio=3)), "fleet[0].prio", "did you mean 'priority'?"),
        (fleet(robot("r1", [0, 0], [9, 0], rest="go")), "fleet[0].rest", "stay or leave"),
        (fleet(robot("r1", [0, 0], [9, 0]), separation=2), "separation", "'separation_m'?"),
        (fleet(robot("r1", [0, 0], [9, 0]), separation_m=-1), "separation_m", "negative"),
        (fleet(robot("r1", [0, 0], [9, 0]), robots={"cart": {"radius": 1}}),
         "robots.cart.radius", "unknown key"),
        (fleet(robot("r1", [0, 0], [9, 0]), robots={"cart": {"footprint": ASIDE}}),
         "robots.cart.footprint", "reference point"),
        (fleet(robot("r1", [0, 0], [9, 0]) | {"robot": "crat"}), "fleet[0].robot", "'cart'?"),
        (fleet(robot("r1", [0, 0], [9, 0]) | {"robot": "zeppelin"}), "fleet[0].robot",
         "the kinds under robots are cart"),
        (fleet(robot("r1", [0, 0], [0, 0])), "fleet[0].route.goal.at", "the same place"),
        (fleet(robot("r1", [0, 0], [9, 0], mission="x.yaml")), "fleet[0].mission", "exclude"),
        (fleet({"name": "r1", "mission": "x.yaml"}), "fleet[0].mission", "x.yaml: there is no"),
        (fleet({"name": "r1", "robot": "cart", "depart_s": 1,
                "route": {"start": [0, 0], "goal": [9, 0], "depart_s": 2}}),
         "fleet[0].depart_s", "its route says depart_s already"),
        (fleet(robot("r1", [0, 0], [9, 0]),
               world={"unseen": [{"circle": {"center": [4, 4], "radius": 1}}]}),
         "world.unseen", "proven apart"),
        (fleet(robot("r1", [0, 0], [9, 0]), robot("r1", [0, 5], [9, 5])), "fleet[1].name", "taken"),
        (fleet(robot("r1", [0, 0], [9, 0]), robot("r2", [0, 1.9], [9, 5])),
         "fleet[1].route.start.at", "at most 0.9"),
        (fleet(robot("r1", [0, 0], [9, 0]), robot("r2", [0, 5], [9, 1.9])),
         "fleet[1].route.goal.at", "rest: leave"),
    ],
)  # fmt: skip
def test_a_fault_has_its_key_and_says_what_would_be_right(
    data: dict[str, Any], key: str, words: str
) -> None:
    fault = only_fault_of(data)
    assert fault.key == key
    assert words in f"{fault.problem}; {fault.remedy}"


def test_all_faults_come_at_once_in_the_order_of_the_data() -> None:
    data = fleet(
        robot("r1", [20, 20], [9, 0]),
        robot("r1", [0, 5], [9, 5], depart_s=-1),
        robot("r3", [0, 10], [9, 10]) | {"robot": "crt"},
        world={"known": [{"circle": {"center": [20, 20], "radius": 2}}], "bound": 3},
        separation_m="1",
    )
    assert [fault.key for fault in faults_of(data)] == [
        "separation_m",
        "fleet[0].route.start.at",
        "fleet[1].name",
        "fleet[1].depart_s",
        "fleet[2].robot",
        "world.bound",
    ]


def test_what_is_wrong_with_the_world_or_a_kind_is_said_once_for_a_hundred_robots() -> None:
    robots = [robot(f"r{i}", [0, 9 * i], [50, 9 * i]) for i in range(100)]
    data = fleet(
        *robots,
        world={"known": [{"polygon": [[90, -9], [91, -8], [91, -9], [90, -8]]}]},
        robots={"cart": {"footprint": ASIDE}},
    )
    keys = [fault.key for fault in faults_of(data)]
    assert keys == ["robots.cart.footprint", "world.known[0].polygon"]


def test_a_point_too_near_is_said_with_the_key_of_its_kind() -> None:
    tight = fleet(
        robot("r1", [0, 0], [9, 0]),
        world={"known": [{"circle": {"center": [9, 1.55], "radius": 1}}]},
    )
    fault = only_fault_of(tight)
    assert fault.key == "fleet[0].route.goal.at"
    assert "set robots.cart.clearance_m to at most 0.049" in fault.remedy
    eased = {**tight, "robots": {"cart": {**CART, "clearance_m": 0.049}}}
    assert Fleet.model_validate(eased).members


def test_a_robot_in_a_corridor_has_a_room_of_its_own() -> None:
    inside = robot("r1", [0, 0], [9, 0])
    inside["route"]["corridor"] = {"left_m": 0.3, "right_m": 2}
    faults = faults_of(fleet(inside, robot("r2", [0, 8], [9, 8])))
    assert {fault.key for fault in faults} == {"fleet[0].route.start.at", "fleet[0].route.goal.at"}
    assert all("the corridor" in fault.problem for fault in faults)


def test_a_start_on_another_goal_and_goals_that_are_left_are_fine() -> None:
    ring = [robot("a", [0, 0], [9, 0]), robot("b", [9, 0], [9, 9]), robot("c", [9, 9], [0, 0])]
    assert len(Fleet.model_validate(fleet(*ring)).members) == 3
    shared = [robot("a", [0, 0], [9, 0]), robot("b", [0, 5], [9, 0], rest="leave")]
    assert len(Fleet.model_validate(fleet(*shared)).members) == 2


def test_a_closed_round_ends_where_another_robot_may_not_rest() -> None:
    closed = {"name": "a", "robot": "cart",
              "route": {"start": [0, 0], "via": [[5, 5]], "closed": True}}  # fmt: skip
    fault = only_fault_of(fleet(closed, robot("b", [20, 0], [1, 0])))
    assert fault.key == "fleet[1].route.goal.at"
    assert "'b' stays for good 1 m from where 'a' does" in fault.problem
    again = {**closed, "name": "b", "route": {**closed["route"], "start": [1, 0]}}
    assert only_fault_of(fleet(closed, again)).key == "fleet[1].route.start.at"


def test_a_body_counts_as_the_circle_about_its_reference_point() -> None:
    long = {"footprint": [[-0.5, -0.5], [3, -0.5], [3, 0.5], [-0.5, 0.5]], "clearance_m": 0.1}
    data = fleet(robot("a", [0, 0], [0, 30]), robot("b", [7, 0], [7, 30]), robots={"cart": long})
    needed = 2 * math.hypot(3, 0.5) + 1
    assert all(f"{needed:.3f} m apart" in fault.problem for fault in faults_of(data))
    assert Fleet.model_validate({**data, "separation_m": 0.9})


PLACES = st.lists(st.tuples(st.integers(0, 12), st.integers(0, 12)), min_size=2, max_size=8).map(
    lambda places: [[float(x), float(y)] for x, y in places]
)


@settings(max_examples=60, deadline=None)
@given(starts=PLACES, separation=st.floats(0, 3), radius=st.floats(0.1, 1.5))
def test_starts_are_refused_exactly_where_two_are_too_near(
    starts: list[list[float]], separation: float, radius: float
) -> None:
    robots = [robot(f"r{i}", at, [100.0, 10.0 * i]) for i, at in enumerate(starts)]
    data = fleet(*robots, separation_m=separation, robots={"cart": {"radius_m": radius}})
    needed = 2 * radius + separation
    gaps = [[math.dist(a, b) for b in starts[:j]] for j, a in enumerate(starts)]
    near = {f"fleet[{j}].route.start.at" for j, row in enumerate(gaps)
            if any(gap < needed - 1e-6 for gap in row)}  # fmt: skip
    doubtful = any(abs(gap - needed) < 1e-6 for row in gaps for gap in row)
    if doubtful:
        return
    if near:
        assert {fault.key for fault in faults_of(data)} == near
    else:
        assert len(Fleet.model_validate(data).members) == len(starts)


def test_thousands_of_robots_at_one_place_are_refused_without_ado() -> None:
    robots = [robot(f"r{i}", [0, 0], [9, 0], rest="leave") for i in range(3000)]
    began = time.process_time()
    assert len(faults_of(fleet(*robots))) == 2999
    assert time.process_time() - began < 10.0


def test_a_mission_from_python_is_taken_with_the_world_of_the_fleet_or_none() -> None:
    world = {"bounds": [-5, -5, 20, 20]}
    route = {"start": [0, 0], "goal": [9, 0]}
    for given_world in ({}, {"world": world}):
        mission = vs.Mission.model_validate({**given_world, "robot": CART, "route": route})
        found = Fleet.model_validate({"world": world, "fleet": [{"name": "a", "mission": mission}]})
        assert found.members[0].mission.route == mission.route
        assert found.members[0].mission.world is found.world
    elsewhere = vs.Mission.model_validate({"world": {"bounds": [-9, -9, 20, 20]}, "route": route})
    data = {"world": world, "fleet": [{"name": "a", "mission": elsewhere}]}
    assert "isn't that of the fleet" in only_fault_of(data).problem


def test_numbers_of_numpy_are_numbers() -> None:
    data = fleet(robot("r1", [0, 0], [9, 0], priority=np.float64(2)), separation_m=np.float64(0.5))
    assert Fleet.model_validate(data).members[0].priority == 2.0


def test_a_fleet_is_a_value() -> None:
    found = Fleet.model_validate(TWO)
    assert found == Fleet.model_validate(TWO)
    assert Fleet.model_validate(found) is found
    assert Fleet.model_validate(found.model_dump()) == found
    with pytest.raises(Exception, match="frozen"):
        found.separation_m = 3.0  # type: ignore[misc]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "fleet.yaml").write_text(
        "world: {bounds: [-5, -5, 20, 20]}\n"
        "separation_m: 1\n"
        "fleet:\n"
        "  - {name: a, mission: sub/a.yaml, depart_s: 3}\n"
        "  - {name: b, route: {start: [0, 5], goal: [9, 5]}}\n"
    )
    (tmp_path / "sub").mkdir()
    return tmp_path


def faults_in(folder: Path) -> list[str]:
    with pytest.raises(MissionError) as refused:
        vs.load(folder / "fleet.yaml")
    return [str(fault).replace(f"{folder}/", "") for fault in refused.value.faults]


def test_a_mission_is_read_beside_the_fleet_with_its_world_or_without(folder: Path) -> None:
    route = "route: {start: [0, 0], goal: [9, 0], depart_s: 1}\nrobot: {radius_m: 0.25}\n"
    for world in ("", "world: {bounds: [-5, -5, 20, 20.0]}\n"):
        (folder / "sub" / "a.yaml").write_text(world + route)
        found = vs.load(folder / "fleet.yaml")
        assert isinstance(found, Fleet)
        first = found.members[0].mission
        assert (first.robot.radius_m, first.route.depart_s) == (0.25, 3.0)
        assert first.world is found.world


def test_what_is_wrong_in_a_mission_is_told_in_its_own_file(folder: Path) -> None:
    (folder / "sub" / "a.yaml").write_text(
        "world: {bounds: [-5, -5, 20, 21]}\n"
        "robot: {radius: 0.25}\n"
        "route: {start: [0, 0], goal: [9, x]}\n"
    )
    faults = faults_in(folder)
    assert [fault.partition(" ")[0] for fault in faults] == [
        "sub/a.yaml:1:1:", "sub/a.yaml:2:9:", "sub/a.yaml:3:34:",
    ]  # fmt: skip
    assert "isn't that of the fleet" in faults[0]


def test_what_a_mission_means_in_the_fleet_is_told_in_its_own_file(folder: Path) -> None:
    (folder / "sub" / "a.yaml").write_text("route: {start: [-4.9, 0], goal: [9, 5.5]}\n")
    faults = faults_in(folder)
    assert "fleet.yaml:5:44: fleet[1].route.goal.at: 'b' stays for good 0.5 m" in faults[0]
    assert "sub/a.yaml:1:16: route.start.at: start lies" in faults[1]
    assert "set robot.clearance_m to at most" not in faults[1]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("fleet: [{name: c, route: {start: [0, 0], goal: [1, 1]}}]", "is a fleet, not the mission"),
        ("route: {start: [0, 0], goal: [9, 0}", "a.yaml:1:35: is not YAML"),
        (
            "route: {start: [0, 0], corridor: {csv: no.csv}, goal: [9, 0]}",
            "no.csv: there is no such",
        ),
    ],
)
def test_a_file_that_is_no_mission_is_said(folder: Path, text: str, words: str) -> None:
    (folder / "sub" / "a.yaml").write_text(text + "\n")
    assert words in "\n".join(faults_in(folder))


def test_a_round_that_ends_where_another_stays_is_told_as_that(tmp_path: Path) -> None:
    file = tmp_path / "fleet.yaml"
    file.write_text(
        "robots: {r: {radius_m: 0.5}}\n"
        "fleet:\n"
        "  - {name: a, route: {start: [0, 9], goal: [0.5, 0]}}\n"
        "  - {name: b, route: {start: [0, 0], via: [[9, 0], [9, 3]], closed: true, laps: 1}}\n"
    )
    with pytest.raises(MissionError) as error:
        vs.load(file)
    (fault,) = str(error.value).splitlines()
    assert "'b' stays for good 0.5 m from where 'a' does" in fault
    assert "set rest: leave for 'a'" in fault


def test_a_robot_keeps_the_names_that_its_mission_has_for_its_topics() -> None:
    there = {"route": {"start": [0, 0], "goal": [9, 0]}}
    named = vs.Mission.model_validate({**there, "ros": {"cmd_vel_topic": "/cart/cmd_vel"}})
    found = Fleet.of([vs.FleetMember("cart", named)])
    assert found.members[0].mission.ros == named.ros
