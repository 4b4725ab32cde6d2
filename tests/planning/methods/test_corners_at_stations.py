"""A robot that stands at a station turns while it dwells, and goes there and away as if alone."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.machine.turns_on_spot import corners, seam_corner
from viaspline.mission.spot_turning import foreseen_turning
from viaspline.planning.alternatives.cleared_spline import ClearedSpline
from viaspline.planning.checking.driving_time import driving_time
from viaspline.planning.plan_path import lay_path
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import via_sequence_of
from viaspline.planning.routing.router import Router
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.parts_at_corners import PartsAtCorners

DRIVES: tuple[dict[str, Any], ...] = (
    {},
    {"max_yaw_rate_degps": 90},
    {"drive": {"differential": {"track_m": 0.5}}, "tracking_error_m": 0.0},
    {"drive": {"omnidirectional": {"max_speed_along_mps": 2, "max_speed_across_mps": 2,
                                   "hold_heading_deg": 0}}, "tracking_error_m": 0.0},
)  # fmt: skip
DIFFERENTIAL = DRIVES[2]
LATER = 1.004
"""Of the time: searches are no exact ones, and a part may be bent less for 2e-3 of its own."""


def mission(robot: dict[str, Any], **route: Any) -> vs.Mission:
    world = {"known": route.pop("known", [])}
    spline = route.pop("spline", {})
    body = {"radius_m": 0.3, "clearance_m": 0.2, "max_speed_mps": 2, "max_accel_mps2": 1}
    return vs.Mission.model_validate(
        {"world": world, "robot": body | robot, "route": route, "spline": spline}
    )


def random_mission(seed: int) -> vs.Mission:
    """Some places, half of them stations, among discs or in the open, back to the start or not."""
    rng = np.random.default_rng((31, seed))
    size = float(rng.choice([12.0, 40.0]))
    known = [
        {"circle": {"center": rng.uniform(0, size, 2).tolist(), "radius": float(radius)}}
        for radius in rng.uniform(0.02, 0.07, int(rng.choice([0, 8]))) * size
    ]
    places: list[list[float]] = []
    while len(places) < 5:
        at = rng.uniform(0, size, 2)
        gaps = [math.dist(at, one["circle"]["center"]) - one["circle"]["radius"] for one in known]
        if min(gaps, default=1.0) > 0.6 and all(math.dist(at, place) > 1.0 for place in places):
            places.append(at.tolist())
    vias = [{"at": at, "dwell_s": float(rng.choice([0.0, 2.0, 6.0]))} for at in places[1:]]
    start = {"at": places[0], "dwell_s": float(rng.choice([0.0, 5.0]))}
    ends = {"closed": True} if seed % 2 else {"goal": vias.pop()["at"]}
    return mission(DRIVES[seed // 2 % len(DRIVES)], start=start, via=vias, known=known, **ends)


@cache
def planned(seed: int) -> vs.Plan:
    return vs.plan(random_mission(seed))


SEEDS = pytest.mark.parametrize("seed", range(24))


def around(plan: vs.Plan) -> list[tuple[float, float]]:
    """Where a path has corners [m], and by how much [rad]; its seam among them."""
    found = list(zip(*(each.tolist() for each in corners(plan.path)), strict=True))
    seam = seam_corner(plan.path) if plan.mission.route.closed else 0.0
    return [*found, *([(0.0, seam)] if seam else [])]


@SEEDS
def test_corners_are_at_stations_where_the_turn_takes_no_longer_than_the_stay(seed: int) -> None:
    plan = planned(seed)
    turning = foreseen_turning(plan.mission.robot)
    stays = {round(float(at), 6): via.dwell for via, at in plan.path.stops}
    for at, angle in around(plan):
        assert turning.time(angle) <= stays[round(at, 6)] + 1e-9
    asked = [turn.asked for turn in plan.drivability.turns_on_spot]
    assert len(asked) == len(around(plan))
    assert all(asked)


@SEEDS
def test_the_path_is_clear_and_leads_exactly_through_every_via_point(seed: int) -> None:
    plan = planned(seed)
    assert plan.certificate.holds
    users = [via for via in plan.path.vias if via.kind == "user"]
    spans = plan.path.spans
    ends = np.concatenate((spans[:, 0], spans[-1:, 3]))
    for via, point in zip(users, plan.mission.route.points(), strict=False):
        assert ends[round(via.u)].tolist() == list(point[1].at)
    assert (spans[1:, 0] == spans[:-1, 3]).all()


@SEEDS
def test_it_is_driven_no_later_than_in_one_curve(seed: int) -> None:
    asked = random_mission(seed)
    robot = asked.robot.model_copy(update={"turn_on_spot": "never"})
    curve = vs.plan(asked.model_copy(update={"robot": robot}))
    assert not around(curve)
    assert planned(seed).trajectory.duration <= LATER * curve.trajectory.duration


def test_stations_are_reached_sooner_in_most_missions() -> None:
    with_corners = [seed for seed in range(24) if around(planned(seed))]
    assert len(with_corners) >= 12


@pytest.mark.parametrize("robot", DRIVES)
@pytest.mark.parametrize("angle", [0.6, 1.6, -2.6])
def test_in_the_open_it_takes_what_straight_lines_do(robot: dict[str, Any], angle: float) -> None:
    goal = [10 + 9 * math.cos(angle), 9 * math.sin(angle)]
    plan = vs.plan(mission(robot, start=[0, 0], via=[{"at": [10, 0], "dwell_s": 6}], goal=goal))
    speed, accel = 2.0, 1.0
    straight = sum(length / speed + speed / accel for length in (10.0, 9.0))
    assert plan.trajectory.end_time == pytest.approx(straight + 6.0, abs=1e-3)
    assert plan.path.length == pytest.approx(19.0, abs=1e-9)
    assert plan.drivability.verdict == "good"


@pytest.mark.parametrize("change", [
    {"robot": {"turn_on_spot": "never"}},
    {"optimise": "length"},
    {"spline": {"tangents": "cardinal"}},
    {"spline": {"tension": 0.2}},
    {"robot": {"drive": {"ackermann": {"wheelbase_m": 0.5, "max_steer_deg": 35}}}},
    {"robot": DIFFERENTIAL, "dwell": 2.0},
    {"dwell": 1.0},
    {"goal": [18, 1]},
])  # fmt: skip
def test_there_is_no_corner_where_the_robot_may_not_or_has_no_time_to_turn(change: Any) -> None:
    keys = {"goal": [10, 9], "dwell": 6.0, "robot": {}} | change
    via = [{"at": [10, 0], "dwell_s": keys.pop("dwell")}]
    plan = vs.plan(mission(keys.pop("robot"), start=[0, 0], via=via, **keys))
    assert not around(plan)


def test_a_round_has_its_seam_only_where_the_start_is_a_station() -> None:
    vias = [{"at": [10, 0], "dwell_s": 6}, [10, 10], {"at": [0, 10], "dwell_s": 6}]
    plain = vs.plan(mission({}, start=[0, 0], via=vias, closed=True))
    assert [round(at, 3) for at, _ in around(plain)] == [
        round(float(at), 3) for via, at in plain.path.stops if via.dwell
    ]
    assert plain.drivability.verdict == "good"
    docked = vs.plan(mission({}, start={"at": [0, 0], "dwell_s": 6}, via=vias, closed=True, laps=2))
    assert abs(seam_corner(docked.path)) == pytest.approx(math.pi / 2, abs=1e-6)
    assert len(around(docked)) == 6  # in two laps, the seam between them and that of the last
    once = vs.plan(mission({}, start=[0, 0], via=[{"at": [10, 0], "dwell_s": 6}], closed=True))
    assert [abs(angle) for _, angle in around(once)] == [pytest.approx(math.pi, abs=0.5)]


def test_the_ledger_tells_of_legs_as_they_lie_between_corners() -> None:
    post = {"circle": {"center": [5, 0.4], "radius": 1.0}}
    route = {"start": [0, 0], "via": [{"at": [10, 0], "dwell_s": 6}], "goal": [10, 12]}
    plan = vs.plan(mission({}, known=[post], **route))
    alone = vs.plan(mission({}, known=[post], start=[0, 0], goal=[10, 0]))
    assert len(around(plan)) == 1
    for mine, its in zip(plan.ledger[0].candidates, alone.ledger[0].candidates, strict=True):
        assert (mine.side, mine.chosen) == (its.side, its.chosen)
        assert mine.duration == pytest.approx(its.duration, rel=1e-6)


def test_a_path_is_put_together_from_its_parts_as_it_was_cut() -> None:
    for closed in (False, True):
        vias = [{"at": [10, 0], "dwell_s": 6}, [12, 10], {"at": [0, 10], "dwell_s": 6}, [-9, 5]]
        posts = [{"circle": {"center": at, "radius": 0.5}} for at in ([5, 0], [6, 10.5], [-4, 3])]
        ends = {"closed": True} if closed else {"goal": [-9, -9]}
        asked = mission({}, start=[0, 0], via=vias, known=posts, **ends)
        world, needs = vs.World.known(asked), Requirements.of(asked)
        whole, account = lay_path(via_sequence_of(asked), world, needs)
        problem = DrivenProblem(
            via_sequence_of(asked), world, needs, Router(world, needs.required, np.zeros((0, 2))),
            cleared=ClearedSpline(whole, (), account.passed),
        )  # fmt: skip
        parts = PartsAtCorners.of(problem, whole)
        assert parts.corners == (1, 3)
        assert [parts.place(leg) for leg in range(4 + closed)] == (
            [(1, 2), (0, 0), (0, 1), (1, 0), (1, 1)] if closed
            else [(0, 0), (1, 0), (1, 1), (2, 0)]
        )  # fmt: skip
        again = parts.joined([parts.cut(whole, k) for k in range(len(parts.ends))])
        assert again.spans.tobytes() == whole.spans.tobytes()
        assert again.joints.tolist() == whole.joints.tolist()
        assert again.vias == whole.vias


@pytest.mark.parametrize("dwell", [0.5, 3.0, 9.0])
def test_a_turn_on_the_spot_costs_what_it_takes_beyond_the_stay(dwell: float) -> None:
    via = [{"at": [10, 0], "dwell_s": dwell}]
    asked = mission(DIFFERENTIAL, start=[0, 0], via=via, goal=[10, 9])
    sequence, needs = via_sequence_of(asked), Requirements.of(asked)
    lines = np.array([[[0, 0], [10, 0]], [[10, 0], [10, 9]]], np.float64)
    spans = lines[:, :1] + np.linspace(0, 1, 4)[:, None] * (lines[:, 1:] - lines[:, :1])
    laid = SplinePath.through(sequence, spans, np.array([0, 1, 2]), ())
    problem = DrivenProblem(
        sequence, vs.World(), needs, Router(vs.World(), needs.required, np.zeros((0, 2))),
        cleared=ClearedSpline(laid, ()),
    )  # fmt: skip
    drives = driving_time(spans, needs.objective.pace, np.ones(3, np.bool_))
    stands = max(needs.turning.time(math.pi / 2) - dwell, 0.0)
    assert problem.cost(laid) - drives == pytest.approx(stands, abs=1e-12)
    assert (stands == 0.0) == (dwell > 5.0)
