"""Closed routes: seamless, and driven as often as asked."""

from __future__ import annotations

import numpy as np
import pytest

import viaspline as vs
from viaspline.planning.alternatives.kept_account import KeptAccount
from viaspline.planning.alternatives.record import Account

SQUARE = {"start": [0, 0], "via": [[40, 0], [40, 30], [0, 30]], "closed": True}
ROCK = {"name": "rock", "circle": {"center": [2, 5], "radius": 2}}


def planned(
    laps: int = 1, known: list | None = None, tangents: str = "continuous", **more
) -> vs.Plan:
    return vs.plan(
        vs.Mission.model_validate({
            "world": {"known": known or []},
            "robot": {"max_lateral_accel_mps2": 1.0} | more.pop("robot", {}),
            "route": SQUARE | {"laps": laps} | more,
            "spline": {"tangents": tangents},
        })
    )  # fmt: skip


@pytest.mark.parametrize(
    "known", [[], [ROCK], [ROCK, {"circle": {"center": [-1, 9], "radius": 1.5}}]]
)
def test_a_closed_course_has_no_seam_even_with_a_detour_next_to_it(known: list) -> None:
    plan = planned(known=known)
    assert plan.certificate.holds
    loop = vs.PiecewiseCubic(plan.path.spans, closed=True)
    assert loop.curvature_jumps()[0] < 1e-9
    end = plan.path.domain[1]
    np.testing.assert_array_equal(plan.path.evaluate(0.0), plan.path.evaluate(end))
    assert plan.path.heading(0.0) == pytest.approx(float(plan.path.heading(end)), abs=1e-9)


def test_a_plan_keeps_what_was_searched_only_where_something_was_met() -> None:
    rock = {"circle": {"center": [25, 0.5], "radius": 4}}
    free, led = (
        vs.plan(
            vs.Mission.model_validate(
                {"world": {"known": known}, "route": {"start": [0, 0], "goal": [50, 0]}}
            )
        )
        for known in ([], [rock])
    )
    assert isinstance(free.account, KeptAccount)
    assert free.ledger == ()
    assert isinstance(led.account, Account)
    assert len(led.ledger) == 1


def test_laps_are_the_same_curve_over_and_over() -> None:
    one, three = planned(1, [ROCK]), planned(3, [ROCK])
    assert three.path.length == pytest.approx(3 * one.path.length)
    np.testing.assert_array_equal(three.path.spans, np.tile(one.path.spans, (3, 1, 1)))
    assert three.certificate.clearance == pytest.approx(one.certificate.clearance, abs=1e-9)
    assert three.path.curvature_jumps().max() < 1e-9
    seams = [via for via in three.path.vias if via.name == "start"]
    assert [via.index for via in seams] == [0, 4, 8, 12]


@pytest.mark.parametrize("robot", [{}, {"min_turn_radius_m": 2.0}])
@pytest.mark.parametrize("tangents", ["cardinal", "continuous"])
def test_a_round_with_a_heading_at_its_start_leaves_and_comes_back_with_it(
    robot: dict, tangents: str
) -> None:
    start = {"at": [0, 0], "heading_deg": 80}
    plan = planned(2, [ROCK], tangents, start=start, robot=robot)
    seams = [via.u for via in plan.path.vias if via.name == "start"]
    assert len(seams) == 3
    for u in seams:
        for aside in (-1e-9, 1e-9):
            heading = float(plan.path.heading(min(max(u + aside, 0.0), plan.path.domain[1])))
            assert np.degrees(heading) == pytest.approx(80.0, abs=1e-4)
    assert [via.index for via in plan.path.vias if via.index is not None] == list(range(9))


def test_a_tension_is_advised_for_each_span_of_a_round_with_a_heading() -> None:
    start = {"at": [2, 2], "heading_deg": 30}
    route = {"start": start, "via": [[10, 15]], "closed": True}
    advice = vs.advise_tension(vs.Mission.model_validate({"route": route}))
    assert len(advice.spans) == 2


@pytest.mark.parametrize("apart", [2e-3, 6e-4, 1e-5])
@pytest.mark.parametrize("on_spot", ["never", "vias"])
def test_via_points_within_a_millimetre_are_both_served_exactly(apart: float, on_spot: str) -> None:
    plan = planned(
        start=[0, 0], via=[[0, apart], [4, 4], [4, 4 + apart]], goal=[1, 0], closed=False,
        robot={"radius_m": 0.1, "min_turn_radius_m": 0.1, "turn_on_spot": on_spot},
    )  # fmt: skip
    users = [via for via in plan.path.vias if via.kind == "user"]
    assert [via.name for via in users] == ["start", "via 1", "via 2", "via 3", "goal"]
    for via in users:
        np.testing.assert_allclose(plan.path.evaluate(via.u), via.at, atol=1e-9)


def test_the_robot_does_not_slow_down_at_the_seam() -> None:
    plan = planned(3)
    lap = plan.path.length / 3
    law = plan.trajectory
    at_seams = np.interp([lap, 2 * lap], law.distances, law.speeds)
    assert at_seams[0] == pytest.approx(at_seams[1], rel=1e-6)
    assert at_seams.min() > 0.5
    assert law.speeds[0] == law.speeds[-1] == 0.0
    # the middle lap is the one that is driven again and again
    times = np.interp([lap, 2 * lap], law.distances, law.times)
    again = vs.retime_lap(
        vs.PiecewiseCubic(planned(1).path.spans, closed=True),
        vs.Limits(max_speed=2, max_accel=1, max_lateral_accel=1.0),
    )
    assert times[1] - times[0] == pytest.approx(again.duration, rel=1e-3)


def test_every_lap_visits_every_point_and_stops_at_its_stations() -> None:
    mission = vs.Mission.model_validate({
        "route": {"start": [0, 0], "via": [{"at": [40, 0], "name": "pump", "dwell_s": 3}, [40, 30]],
                  "closed": True, "laps": 2},
    })  # fmt: skip
    run = vs.simulate(mission)
    assert run.reached
    assert [visit.status for visit in run.visits] == ["served"] * 7
    assert [visit.name for visit in run.visits].count("pump") == 2
    assert [event.kind for event in run.events].count("dwell") + [
        event.kind for event in run.events
    ].count("arrived") >= 2
    assert run.duration == pytest.approx(run.plan.trajectory.duration, abs=0.1)


def test_what_is_seen_in_a_later_lap_is_gone_round_and_the_drive_goes_on() -> None:
    mission = vs.Mission.model_validate({
        "world": {"unseen": [{"name": "crate", "circle": {"center": [41, 16], "radius": 1}}]},
        "robot": {"sensor": {"range_m": 8}},
        "route": SQUARE | {"laps": 3},
        "spline": {"tension": [0.0, 0.1, 0.2, 0.0]},
    })  # fmt: skip
    run = vs.simulate(mission)
    assert run.reached
    assert run.certificate.holds
    assert run.replans
    assert [visit.status for visit in run.visits] == ["served"] * 13


def test_laps_along_a_corridor_share_its_line() -> None:
    angle = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    line = np.column_stack((30 * np.cos(angle), 20 * np.sin(angle), *np.full((2, 60), 3.0)))
    route = {"start": [30, 0], "closed": True, "laps": 2, "corridor": {"line": line.tolist()}}
    run = vs.simulate(vs.Mission.model_validate({"route": route}))
    assert run.reached
    assert run.certificate.holds
    assert [visit.name for visit in run.visits] == ["start"] * 3


@pytest.mark.parametrize("crate", [[-31.9, 2], [0.5, 21], [28, -9]])
def test_what_is_seen_in_a_corridor_is_gone_round_without_cutting_the_lap(crate: list) -> None:
    angle = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    line = np.column_stack((30 * np.cos(angle), 20 * np.sin(angle), *np.full((2, 60), 3.0)))
    mission = vs.Mission.model_validate({
        "world": {"unseen": [{"name": "crate", "circle": {"center": crate, "radius": 0.8}}]},
        "robot": {"sensor": {"range_m": 8}, "radius_m": 0.4, "clearance_m": 0.2},
        "route": {"start": [30, 0], "closed": True, "laps": 2, "corridor": {"line": line.tolist()}},
    })  # fmt: skip
    run = vs.simulate(mission)
    assert run.reached
    assert run.certificate.holds
    assert run.path.length == pytest.approx(run.plan.path.length, rel=0.03)
    turned = np.unwrap(np.arctan2(run.positions[:, 1], run.positions[:, 0]))
    assert turned[-1] == pytest.approx(4 * np.pi, abs=1e-3)
    assert (np.diff(turned) > -1e-3).all()
