"""Robots with a turning circle and long bodies: what is promised of their paths."""

from __future__ import annotations

import math
from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.curve.bending import curvature_bound

SEEDS = settings(max_examples=25, deadline=None, derandomize=True)
LONG = [[-0.5, -0.6], [3.0, -0.6], [3.0, 0.6], [-0.5, 0.6]]


def mission(*route: Any, radius: float | None = 3.0, **parts: Any) -> vs.Mission:
    """From the first place to the last, with a turning circle."""
    robot = {"radius_m": 0.5, "clearance_m": 0.5, "min_turn_radius_m": radius}
    if "footprint" in parts.get("robot", {}):
        del robot["radius_m"]
    closed = parts.pop("closed", False)
    ends: dict[str, Any] = {"start": route[0], "closed": closed}
    ends |= {"via": route[1:]} if closed else {"via": route[1:-1], "goal": route[-1]}
    data = {"route": ends, "robot": robot | parts.pop("robot", {}), **parts}
    return vs.Mission.model_validate(data)


def disc(x: float, y: float, radius: float) -> dict[str, Any]:
    return {"circle": {"center": [x, y], "radius": radius}}


def random_mission(seed: int) -> vs.Mission | None:
    rng = np.random.default_rng(seed)
    size, radius = float(rng.choice([25.0, 70.0])), float(rng.choice([1.0, 3.0]))
    known = [disc(*rng.uniform(0, size, 2), size * rng.uniform(0.02, 0.08)) for _ in range(4)]
    places = rng.uniform(0, size, (30, 2))
    room = vs.World([vs.Obstacle(**shape) for shape in known]).distance(places)
    free = places[room > 1.05][: int(rng.integers(2, 6))].tolist()
    if len(free) < 2:
        return None
    closed = bool(rng.integers(2)) and len(free) > 2
    start: dict[str, Any] = {"at": free[0]}
    if not closed and rng.random() < 0.5:
        start["heading_deg"] = float(rng.uniform(-180, 180))
    return mission(start, *free[1:], radius=radius, closed=closed, world={"known": known})


def check_refusal(error: vs.PlanningError) -> None:
    assert error.remedy
    assert error.via is not None or error.obstacles


def drives(path: vs.Path, radius: float) -> None:
    """Curvature is continuous, and bounded by proof and at dense samples."""
    assert curvature_bound(path)[0] * radius <= 1.0
    u = np.linspace(*path.domain, int(path.length / 0.01))
    assert np.abs(path.curvature(u)).max() * radius <= 1.0
    assert max(path.curvature_jumps(), default=0.0) < 1e-6


def swept_gap(path: vs.Path, footprint: Any, world: vs.World) -> float:
    """Distance between a body and the circles and polygons at poses every few centimetres [m]."""
    u = np.linspace(*path.domain, int(path.length / 0.03))
    heading, at = np.asarray(path.heading(u)), np.asarray(path.evaluate(u))[:, :2]
    c, s = np.cos(heading), np.sin(heading)
    turn = np.stack([np.stack([c, -s], -1), np.stack([s, c], -1)], -2)
    bodies = shapely.polygons(np.einsum("nij,kj->nki", turn, np.array(footprint)) + at[:, None])
    shapes = [
        shapely.Point(o.circle.center).buffer(o.circle.radius, 256)
        if o.circle
        else shapely.Polygon(o.polygon)
        for o in world.obstacles
    ]
    return float(min(shapely.distance(bodies, shape).min() for shape in shapes))


@SEEDS
@given(st.integers(0, 10_000))
@example(145)  # a single leg, laid between headings of its ends
def test_a_path_keeps_turning_circle_clearance_and_via_points(seed: int) -> None:
    asked = random_mission(seed)
    if asked is None:
        return
    try:
        found = vs.plan(asked)
    except vs.PlanningError as error:
        check_refusal(error)
        return
    radius = asked.robot.turn_radius
    assert radius is not None
    drives(found.path, radius)
    assert found.certificate.holds
    users = [via for via in found.path.vias if via.kind == "user"]
    asked_for = [via.at for _, via in asked.route.points()]
    assert [via.at for via in users][: len(asked_for)] == asked_for
    for via in found.path.vias:
        np.testing.assert_array_equal(found.path.evaluate(via.u), via.at)
    if asked.route.start.heading_deg is not None:
        off = float(found.path.heading(0.0)) - math.radians(asked.route.start.heading_deg)
        assert abs(math.remainder(off, math.tau)) < 1e-9


def test_turns_that_are_pushed_until_the_last_round_are_served_or_refused() -> None:
    """The last swing was judged by what the one before came too close to."""
    discs = [
        (19.2207, 19.1667, 0.9833), (15.8342, 11.7292, 0.4423), (5.9112, 3.4936, 1.5895),
        (9.982, 16.8014, 0.4322), (7.6727, 12.9556, 1.443), (14.0511, 14.0629, 0.8597),
        (3.3829, 0.0338, 1.2644),
    ]  # fmt: skip
    known = {"known": [disc(*one) for one in discs]}
    places = [[17.5172, 5.4034], [11.3516, 13.4867], [7.5767, 17.6411], [14.9296, 2.0388]]
    drives(vs.plan(mission(*places, closed=True, radius=6.0, world=known)).path, 6.0)


def test_a_seam_that_a_detour_leads_to_and_from_is_no_turning_back() -> None:
    """Both neighbours of the start were the same detour: no tangent, and a cusp at the seam."""
    places = [
        [112.8176, 58.4268], [117.8875, 195.083], [28.0557, 101.6296], [119.0324, 95.2107],
        [172.5393, 14.1445], [189.5222, 73.9461], [127.9912, 173.0816],
    ]  # fmt: skip
    discs = [
        (111.0557, 103.9862, 6.7551), (69.3462, 100.049, 7.1024), (23.6174, 23.08, 5.8111),
        (73.2222, 140.6451, 4.5415),
    ]  # fmt: skip
    known = [disc(*one) for one in discs]
    found = vs.plan(mission(*places, closed=True, radius=3.0, world={"known": known}))
    path, end = found.path, found.path.domain[1]
    drives(path, 3.0)
    assert abs(math.remainder(float(path.heading(end) - path.heading(0.0)), math.tau)) < 1e-9


def test_a_closed_route_has_a_seam_that_is_none() -> None:
    found = vs.plan(mission([0, 0], [40, 0], [40, 5], [0, 25], closed=True, radius=4.0))
    path, end = found.path, found.path.domain[1]
    drives(path, 4.0)
    np.testing.assert_array_equal(path.evaluate(end), path.evaluate(0.0))
    turn = float(path.heading(end)) - float(path.heading(0.0))
    assert abs(math.remainder(turn, math.tau)) < 1e-8
    assert float(path.curvature(end)) == pytest.approx(float(path.curvature(0.0)), abs=1e-8)


def test_via_points_closer_than_the_turning_circle_are_served_by_a_loop() -> None:
    found = vs.plan(mission([0, 0], [10, 0], [10.5, 1.5], [9, 2], [30, 20], radius=3.0))
    drives(found.path, 3.0)
    assert found.path.length > 45


def test_a_round_enough_spline_stays_the_spline() -> None:
    places = [[0, 0], [40, 10], [80, 0]]
    free = mission(*places, radius=None, spline={"tension": 0})
    bound = mission(*places, spline={"tension": 0})
    assert vs.plan(bound).path.spans.tolist() == vs.plan(free).path.spans.tolist()


@settings(deadline=None, derandomize=True)
@given(
    st.lists(st.tuples(st.floats(0, 36), st.floats(0, 36)), min_size=3, max_size=5),
    st.booleans(),
    st.sampled_from([{"radius_m": 0.4}, {"footprint": [[-0.4, -0.3], [0.5, 0.0], [-0.4, 0.3]]}]),
)
@example([(0, 0), (20, 0), (0, 1)], False, {"radius_m": 0.4})
def test_where_there_is_room_no_turn_is_sharper_than_the_robot(
    places: list[tuple[float, float]], closed: bool, body: dict[str, Any]
) -> None:
    """A spline that hardly turns at all but nearly in place was the faster one for a point."""
    assume(min(math.dist(a, b) for a, b in combinations(places, 2)) > 7)
    path = vs.plan(mission(*places, radius=None, closed=closed, robot=body)).path
    u = np.linspace(*path.domain, int(path.length / 0.002))
    assert np.abs(path.curvature(u)).max() * 0.4 <= 1.0


def test_heights_are_kept_by_lines_and_turns() -> None:
    found = vs.plan(mission([0, 0, 0], [30, 0, 10], [30, 30, 10], [0, 30, 0], radius=11.0))
    assert curvature_bound(vs.PiecewiseCubic(found.path.spans[:, :, :2]))[0] * 11.0 <= 1.0
    heights = found.path.evaluate(np.linspace(*found.path.domain, 500))[:, 2]
    assert heights.min() >= 0.0
    assert heights.max() <= 10.0 + 1e-9


def test_a_long_vehicle_passes_a_door_that_the_circle_round_it_does_not() -> None:
    walls = [
        {"polygon": [[20, -30], [21, -30], [21, -0.95], [20, -0.95]]},
        {"polygon": [[20, 0.95], [21, 0.95], [21, 30], [20, 30]]},
    ]
    asked = mission(
        [0, -6], [40, 8], radius=2.5, robot={"footprint": LONG, "clearance_m": 0.1},
        world={"known": walls, "bounds": [-10, -30, 60, 30]},
    )  # fmt: skip
    found = vs.plan(asked)
    drives(found.path, 2.5)
    assert found.certificate.holds
    assert swept_gap(found.path, LONG, found.world) >= 0.1 - 1e-3
    assert asked.robot.outer_radius > 0.95


def test_a_start_that_is_shut_in_is_refused_by_name_with_a_remedy() -> None:
    pen = [[[-2, -2], [8, -2], [8, -1.6], [-2, -1.6]], [[-2, 1.6], [8, 1.6], [8, 2], [-2, 2]],
           [[8, -2], [8.4, -2], [8.4, 2], [8, 2]]]  # fmt: skip
    asked = mission(
        {"at": [4, 0], "heading_deg": 0}, [-30, 0], radius=3.0,
        world={"known": [{"polygon": ring} for ring in pen]},
    )  # fmt: skip
    with pytest.raises(vs.NoPathError, match=r"turning circle.*'start'") as caught:
        vs.plan(asked)
    assert caught.value.via == "start"
    assert "turn" in caught.value.remedy


def test_a_robot_that_turns_on_the_spot_does_so_at_its_station() -> None:
    walls = [{"polygon": [[-5, 1.6], [30, 1.6], [30, 3], [-5, 3]]},
             {"polygon": [[-5, -3], [30, -3], [30, -1.6], [-5, -1.6]]},
             {"polygon": [[30, -3], [31, -3], [31, 3], [30, 3]]}]  # fmt: skip
    there_and_back = ([0, 0], {"at": [25, 0], "dwell_s": 5}, [-20, 0])
    found = vs.plan(mission(*there_and_back, radius=4.0, world={"known": walls}))
    assert found.path.length == pytest.approx(70.0, abs=0.5)
    with pytest.raises(vs.GaveUpError):  # there may be an arrival that was not followed on
        vs.plan(
            mission(
                *there_and_back, radius=4.0, world={"known": walls},
                robot={"turn_on_spot": "never"},
            )
        )  # fmt: skip


@pytest.mark.parametrize("seed", [4, 6, 7])
def test_what_is_driven_past_unseen_obstacles_keeps_the_turning_circle(seed: int) -> None:
    rng = np.random.default_rng(seed)
    unseen = [disc(*rng.uniform(25, 175, 2), rng.uniform(2, 7)) for _ in range(6)]
    stops = [[10, 10], *rng.uniform(20, 180, (2, 2)).tolist(), [190, 190]]
    run = vs.simulate(
        mission(
            *stops, radius=4.0, world={"unseen": unseen, "bounds": [0, 0, 200, 200]},
            robot={"radius_m": 1, "turn_on_spot": "never", "sensor": {"range_m": 25}},
        )
    )  # fmt: skip
    assert run.reached
    assert run.replans
    assert run.certificate.holds
    drives(run.path, 4.0)
    assert max(replan.curvature_jump for replan in run.replans) < 1e-6


def test_a_start_that_cannot_be_come_back_to_is_refused_with_the_reason():
    """A round in the open whose start, between discs, can be left but not come back to."""
    known = [
        disc(7.331, 10.371, 0.468), disc(9.087, 7.228, 0.487), disc(13.641, 19.665, 1.331),
        disc(18.305, 9.141, 1.371), disc(9.241, 2.392, 1.551), disc(6.876, 5.384, 0.408),
        disc(13.509, 5.064, 1.34),
    ]  # fmt: skip
    route = ({"at": [9.477, 5.189]}, [17.266, 6.231], [10.851, 18.015])
    with pytest.raises(vs.NoPathError, match="come to the goal from anywhere") as raised:
        vs.plan(mission(*route, radius=6.0, closed=True, world={"known": known}))
    check_refusal(raised.value)
    assert raised.value.via == "start"


@pytest.mark.parametrize("radius", [1.6, 2.0, 4.0, 8.0])
def test_a_turn_back_at_the_end_of_a_thin_wall_goes_round_both_of_its_corners(
    radius: float,
) -> None:
    wall = {"name": "wall", "polygon": [[8, -40], [9, -40], [9, 40], [8, 40]]}
    found = vs.plan(
        vs.Mission.model_validate({
            "world": {"known": [wall], "bounds": [-20, -80, 40, 45]},
            "robot": {"radius_m": 0.5, "clearance_m": 0.5, "min_turn_radius_m": radius},
            "route": {"start": [0, 0], "goal": [17, 0]},
        })
    )  # fmt: skip
    assert found.certificate.holds
    assert found.path.max_curvature()[0] * radius <= 1.0 + 1e-9
    assert found.path.length < 85.0 + 3.0 * radius  # 2 · √(17/2)² + 40², and the turn


def test_a_robot_under_way_that_can_not_turn_away_is_told_to_be_driven_on() -> None:
    drive = {"ackermann": {"wheelbase_m": 1, "max_steer_deg": 32}, "delay_s": 0.1, "lag_s": 0.1}
    boxed = mission(
        [2.3, 1.5], [-9.5, -0.4], radius=None, robot={"clearance_m": 0.1, "drive": drive,
        "sensor": {"range_m": 2.4}}, world={"unseen": [disc(0, 2.2, 0.9), disc(0, 0, 1.2)]},
    )  # fmt: skip
    run = vs.simulate(boxed)
    assert not run.reached
    assert run.reason is not None
    assert "no way on from where the robot is" in run.reason
    assert "plan anew from there" in run.reason
    assert "'the robot'" not in run.reason


@pytest.mark.parametrize(("robot", "most_s"), [
    ({"turn_on_spot": "never"}, 0.3), ({"turn_on_spot": "never", "max_yaw_rate_degps": 20}, 2.2),
    ({"min_turn_radius_m": 1.0, "turn_on_spot": "never"}, 0.7),
])  # fmt: skip
def test_a_turn_at_a_station_is_as_sharp_as_the_robot_that_stands_there(
    robot: dict[str, Any], most_s: float
) -> None:
    places = ((5.7, 37.9), (55.1, 26.5), (23.4, 6.8))
    body = {"radius_m": 0.3, "clearance_m": 0.2, "max_speed_mps": 2.0, "max_accel_mps2": 1.0}
    plan = vs.plan(vs.Mission.model_validate({
        "robot": body | robot,
        "route": {"start": places[0], "via": [{"at": places[1], "dwell_s": 2}], "goal": places[2]},
    }))  # fmt: skip
    straight = sum(math.dist(*ends) / 2.0 + 2.0 for ends in pairwise(places))
    assert plan.trajectory.end_time - 2.0 - straight < most_s
    assert plan.drivability.verdict == "good"
    assert plan.path.curvature_jumps().max() < 1e-6


TURNED_INTO_DISCS: list[tuple[dict[str, Any], dict[str, Any], list[list[float]]]] = [
    (
        {"footprint": [[-0.3, -0.3], [0.9, -0.3], [0.9, 0.3], [-0.3, 0.3]]},
        {"start": [11.491, 13.948], "via": [{"at": [6.57, 9.641], "dwell_s": 10}],
         "goal": [7.152, 11.793]},
        [[8.019, 6.712, 0.406], [8.591, 10.077, 0.625], [3.258, 12.016, 0.631],
         [8.324, 0.007, 0.328], [3.738, 2.036, 0.486], [0.346, 5.068, 1.2],
         [10.271, 9.976, 1.012], [1.499, 10.874, 0.712], [12.795, 11.066, 0.504],
         [1.694, 11.711, 0.442], [5.63, 10.954, 0.962], [11.74, 6.001, 1.087]],
    ),
]  # fmt: skip


@pytest.mark.parametrize(("robot", "route", "discs"), TURNED_INTO_DISCS)
def test_a_body_turns_at_a_station_only_where_it_has_room_to(
    robot: dict[str, Any], route: dict[str, Any], discs: list[list[float]]
) -> None:
    limits = {"clearance_m": 0.2, "max_speed_mps": 2.0, "max_accel_mps2": 1.0}
    plan = vs.plan(vs.Mission.model_validate({
        "world": {"bounds": [-2, -2, 17, 17], "known": [disc(*one) for one in discs]},
        "robot": limits | robot, "route": route,
    }))  # fmt: skip
    assert plan.certificate.holds
