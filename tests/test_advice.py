"""What is advised about tension, beside what anybody would try by hand."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import HealthCheck, assume, example, given, settings
from hypothesis import strategies as st
from rich.console import Console
from scipy.integrate import quad

import viaspline as vs
from viaspline.cli import cli
from viaspline.compared_tensions import TRIED_TENSIONS
from viaspline.report.advice_words import advice_words
from viaspline.report.tension_picture import tension_picture
from viaspline.report.terminal.advice_tables import advice_tables
from viaspline.report.units import seconds

VIAS = [[30, 5], [45, 30], [20, 45], [-10, 30]]
SAME = 2e-6  # part of a time or a curvature by which two plans that are the same may differ
BY_HAND = (None, -0.5, 0.0, 0.5)  # None: none is stated


def mission(tension: object = "auto", robot: dict | None = None, known: list | None = None,
            **route: object) -> vs.Mission:  # fmt: skip
    return vs.Mission.model_validate({
        "world": {"known": known or []},
        "robot": {"max_lateral_accel_mps2": 0.6} | (robot or {}),
        "route": {"start": [0, 0], "via": VIAS, "goal": [-30, 0]} | route,
        "spline": {"tension": tension},
    })  # fmt: skip


def with_spline(asked: vs.Mission, **spline: Any) -> vs.Mission:
    return vs.Mission.model_validate(asked.model_dump() | {"spline": spline})


def outcome(asked: vs.Mission) -> tuple[float, float]:
    """The time and the peak curvature of a mission's plan, infinite if there is none."""
    try:
        plan = vs.plan(asked)
    except (vs.PlanningError, vs.GeometryError):
        return math.inf, math.inf
    return plan.trajectory.duration, plan.path.max_curvature()[0]


def is_worse(one: tuple[float, float], other: tuple[float, float]) -> bool:
    """Whether one is slower, or as fast and sharper."""
    (time, peak), (other_time, other_peak) = one, other
    if time > other_time * (1.0 + SAME):
        return True
    return time >= other_time * (1.0 - SAME) and peak > other_peak * (1.0 + SAME) + SAME


PLACES = st.tuples(st.integers(-30, 30), st.integers(-30, 30))
STATED = st.sampled_from([-0.8, -0.5, 0.0, 0.25, 0.7, 1.0])
TAUT = st.floats(-0.5, 0.95)  # a looser straight spline turns back, at -0.8 it stands still


@st.composite
def missions(draw: st.DrawFn) -> vs.Mission:
    """Random routes, straight ones among them, some with obstacles and turning circles."""
    if draw(st.booleans()):
        vias = draw(st.lists(PLACES, min_size=2, max_size=5, unique=True))
    else:
        direction = draw(PLACES.filter(any))
        steps = sorted(draw(st.sets(st.integers(-4, 4), min_size=2, max_size=4)))
        vias = [(direction[0] * k, direction[1] * k) for k in steps]
    discs = draw(st.lists(st.tuples(PLACES, st.integers(1, 6)), max_size=3))
    free = all(math.dist(at, via) > radius + 2.5 for at, radius in discs for via in vias)
    assume(free)
    closed = len(vias) > 2 and draw(st.booleans())
    spans = len(vias) - (not closed)
    stated = draw(
        st.one_of(st.none(), STATED, st.lists(STATED, min_size=spans, max_size=spans).map(tuple))
    )
    route: dict[str, Any] = {"start": vias[0], "via": vias[1:], "closed": closed}
    return vs.Mission.model_validate({
        "world": {"known": [{"circle": {"center": at, "radius": r}} for at, r in discs]},
        "robot": {
            "max_lateral_accel_mps2": draw(st.sampled_from([0.3, 1.0])),
            "min_turn_radius_m": draw(st.sampled_from([None, None, 0.5, 2.0])),
        },
        "route": route | {"optimise": draw(st.sampled_from(["time", "length"]))},
        "spline": {
            "tension": stated, "tangents": draw(st.sampled_from([None, "cardinal"])),
        },
    })  # fmt: skip


@settings(max_examples=20, deadline=None, suppress_health_check=list(HealthCheck))
@example(mission(0.1))
@example(mission(None, known=[{"circle": {"center": [38, 16], "radius": 3}}]))
@example(mission(0.3, robot={"min_turn_radius_m": 8.0}))
@given(missions())
def test_advice_is_never_worse_than_what_is_tried_by_hand_or_stands(asked: vs.Mission) -> None:
    tangents = asked.spline.tangents
    by_hand = [outcome(with_spline(asked, tension=t, tangents=tangents)) for t in BY_HAND]
    stands = outcome(asked)
    if not any(map(math.isfinite, (time for time, _ in (*by_hand, stands)))):
        with pytest.raises((vs.PlanningError, vs.GeometryError)):
            vs.advise_tension(asked)
        return
    advice = vs.advise_tension(asked)
    taken = outcome(with_spline(asked, tension=advice.suggested, tangents=tangents))
    assert taken == pytest.approx(advice.chosen.cost, rel=1e-9, abs=1e-9)
    assert not any(is_worse(taken, other) for other in (*by_hand, stands))
    same = [other == pytest.approx(taken, rel=SAME, abs=SAME) for other in (*by_hand, stands)]
    if not advice.matters:
        assert all(same)
    auto = outcome(with_spline(asked, tension="auto", tangents=tangents))
    assert not any(is_worse(auto, other) for other in by_hand)


@settings(max_examples=30, deadline=None, suppress_health_check=list(HealthCheck))
@given(missions())
def test_what_is_advised_keeps_clear_and_to_the_turning_circle(asked: vs.Mission) -> None:
    try:
        plan = vs.plan(with_spline(asked, tension="auto"))
    except (vs.PlanningError, vs.GeometryError):
        return
    for disc in asked.world.known:
        points = plan.path.evaluate(np.linspace(0.0, len(plan.path.spans), 4001))
        gap = np.hypot(*(points - disc.circle.center).T).min() - disc.circle.radius
        assert gap >= asked.robot.radius_m + asked.robot.clearance_m - 1e-6
    circle = asked.robot.min_turn_radius_m
    if circle is not None:
        u = np.linspace(1e-6, len(plan.path.spans) - 1e-6, 4001)
        assert np.abs(plan.path.curvature(u)).max() <= (1.0 + 1e-6) / circle


@settings(max_examples=40, deadline=None)
@given(PLACES.filter(any), st.sets(st.integers(1, 9), min_size=1, max_size=4), TAUT)
def test_along_a_straight_line_it_makes_no_difference(
    direction: tuple[int, int], steps: set[int], stated: float
) -> None:
    vias = [[direction[0] * k, direction[1] * k] for k in sorted(steps)]
    asked = mission(stated, via=vias[:-1], goal=vias[-1])
    advice = vs.advise_tension(asked)
    assert not advice.matters
    assert advice.suggested == stated
    assert advice_words(advice).startswith("There is nothing to choose: the path is straight")


def test_what_stands_in_the_mission_stays_where_nothing_is_better() -> None:
    tank = {"circle": {"center": [38, 16], "radius": 3}}  # wide turns go round it
    stated = mission((0.1, 0.2, 0.3, 0.4, 0.5), known=[tank])
    advice = vs.advise_tension(stated)
    assert advice.chosen is advice.stands or not advice.chosen.is_same_as(advice.stands)


def test_what_cannot_be_planned_is_not_advised_and_says_why() -> None:
    asked = mission(0.5, robot={"min_turn_radius_m": 8.0})
    advice = vs.advise_tension(asked)
    assert advice.plan.path.max_curvature()[0] <= 1 / 8.0
    text = _printed(advice)
    for trial in advice.trials:
        assert (trial.plan is None) == (trial.error is not None)
        assert trial.plan is not None or "no plan" in text


def test_another_tension_than_by_hand_is_taken_only_if_its_path_drives_well() -> None:
    advice = vs.advise_tension(mission(robot={"radius_m": 4.0}))
    assert advice.suggested in BY_HAND or advice.chosen.drives_well


def test_lengths_clearances_and_curvatures_of_spans_are_those_of_the_spline() -> None:
    tank = {"name": "tank", "circle": {"center": [36, 22], "radius": 1}}
    effects = vs.advise_tension(mission(known=[tank])).effects
    assert effects is not None
    j = TRIED_TENSIONS.index(0.3)
    spline = vs.CardinalSpline(
        [[0, 0], *VIAS, [-30, 0]], tension=0.3, knots="chordal", tangents="continuous"
    )
    for k in range(5):
        length = sum(
            quad(lambda u: np.linalg.norm(spline.evaluate(u, 1)), 3 * k + i, 3 * k + i + 1)[0]
            for i in range(3)
        )
        at = np.linspace(3 * k, 3 * k + 3, 4001)
        points = spline.evaluate(at)
        gap = np.hypot(*(points - (36, 22)).T).min() - 1 - 0.5
        assert effects.lengths[k, j] == pytest.approx(length, rel=1e-6)
        assert gap - 2e-3 <= effects.clearances[k, j] <= gap + 1e-6
        inside = np.clip(at, 3 * k + 1e-9, 3 * k + 3 - 1e-9)
        assert effects.curvatures[k, j] == pytest.approx(
            np.abs(spline.curvature(inside)).max(), rel=1e-3
        )


def test_a_span_costs_what_the_whole_drive_is_slower_with_it() -> None:
    asked = mission(0.0)
    effects = vs.advise_tension(asked).effects
    assert effects is not None
    base, k = TRIED_TENSIONS.index(0.0), 2
    lost = effects.lost(np.full(5, base))[k]
    for t in (-0.5, 0.7):
        row = [0.0] * 5
        row[k] = t
        slower = outcome(with_spline(asked, tension=row))[0] - outcome(asked)[0]
        by_shape = lost[TRIED_TENSIONS.index(t)] - lost[base]
        assert by_shape == pytest.approx(slower, abs=0.05)


@pytest.mark.parametrize("closed", [False, True])
def test_auto_plans_with_what_is_suggested(closed: bool) -> None:
    asked = mission(closed=True, goal=None) if closed else mission()
    advice, plan = vs.advise_tension(asked), vs.plan(asked)
    assert plan.mission.spline.tension == advice.suggested
    assert plan.trajectory.duration == advice.chosen.cost[0]
    assert len(advice.spans) == 5


def test_past_what_moves_it_is_no_later_than_with_a_tension_by_hand() -> None:
    cart = {
        "circle": {"center": [0, 0], "radius": 2},
        "motion": {"from": [44, 0], "velocity_mps": [0, 1.6]},
    }
    asked = mission(known=[cart])
    soonest = vs.plan(asked).trajectory.duration
    by_hand = [vs.plan(with_spline(asked, tension=t)).trajectory.duration for t in BY_HAND]
    assert soonest <= min(by_hand) * (1.0 + 1e-6)


TANK = {"circle": {"center": [38, 16], "radius": 3}}  # with which none stated is the best


@pytest.mark.parametrize("stated", ["auto", 0.5])
def test_that_none_stated_is_the_best_is_said(stated: object) -> None:
    advice = vs.advise_tension(mission(stated, known=[TANK]))
    assert advice.suggested is None
    assert advice.chosen.cost == outcome(mission(None, known=[TANK]))
    assert advice_words(advice).startswith("Suggested: state no tension, so that lines and turns")
    of_stated = min(trial.cost[0] for trial in advice.trials if trial.tension is not None)
    gained = (of_stated if stated == "auto" else advice.stands.cost[0]) - advice.chosen.cost[0]
    assert f"; {seconds(gained)} faster than" in advice_words(advice)
    assert tension_picture(advice, "m")[:4] == b"\x89PNG"


def test_a_plan_by_advice_that_states_none_says_so_in_its_file_and_is_read_again(
    tmp_path: Path,
) -> None:
    plan = vs.plan(mission(known=[TANK]))
    assert plan.mission.spline.tension is None
    plan.save(tmp_path)
    assert json.loads((tmp_path / "plan.json").read_text())["mission"]["tension"] is None
    again = vs.load_plan(tmp_path)
    assert again.mission.spline.tension is None
    assert again.trajectory.duration == pytest.approx(plan.trajectory.duration, rel=1e-9)


def test_spans_have_tensions_of_their_own_where_that_is_faster() -> None:
    asked = mission(via=[[60, 0], [60, 8], [0, 8], [0, 60]], goal=[50, 60])
    advice = vs.advise_tension(asked)
    by_span = [trial.cost[0] for trial in advice.trials if isinstance(trial.tension, tuple)]
    assert min(by_span) < min(trial.cost[0] for trial in advice.common)


def test_via_points_are_put_in_order_before_tensions_are_tried() -> None:
    asked = mission(via=VIAS[::-1], order="shortest")
    assert vs.advise_tension(asked).suggested == vs.plan(asked).mission.spline.tension


def test_the_same_mission_gives_the_same_advice() -> None:
    first, again = vs.advise_tension(mission()), vs.advise_tension(mission())
    assert first.suggested == again.suggested
    assert tension_picture(first, "m") == tension_picture(again, "m")
    assert _printed(first) == _printed(again)


def test_auto_is_driven_with_replans() -> None:
    asked = mission(robot={"sensor": {"range_m": 10}})
    world = {"unseen": [{"circle": {"center": [41, 18], "radius": 1}}]}
    asked = vs.Mission.model_validate({**asked.model_dump(), "world": world})
    run = vs.simulate(asked)
    assert run.reached
    assert run.replans


def test_auto_says_why_when_there_is_no_path() -> None:
    asked = mission().model_dump()
    wall = {"name": "wall", "polygon": [[10, -60], [12, -60], [12, 60], [10, 60]]}
    asked["world"] = {"known": [wall], "bounds": [-60, -60, 60, 60]}
    with pytest.raises(vs.NoPathError):
        vs.plan(vs.Mission.model_validate(asked))


def test_along_the_line_of_a_corridor_auto_is_taken_and_plays_no_part() -> None:
    lane = {"line": [[0, 0, 3, 3], [50, 0, 3, 3]]}
    asked = vs.Mission.model_validate({
        "route": {"start": [0, 0], "goal": [50, 0], "corridor": lane},
        "spline": {"tension": "auto"},
    })  # fmt: skip
    assert vs.plan(asked).mission.spline.tension == 0.0
    advice = vs.advise_tension(asked)
    assert not advice.matters
    assert "corridor" in advice_words(advice)
    assert tension_picture(advice, "lane")[:4] == b"\x89PNG"


@pytest.mark.parametrize("tensions", [[], [2.0], [-500.0], [float("nan")]])
def test_tensions_that_are_none_are_refused(tensions: list[float]) -> None:
    with pytest.raises(vs.GeometryError, match="tensions"):
        vs.advise_tension(mission(), tensions)


def test_tables_and_picture_say_what_is_suggested_and_what_stands() -> None:
    for stated in (None, 0.1, (0.1, 0.2, 0.3, 0.4, 0.5), "auto"):
        advice = vs.advise_tension(mission(stated))
        text = _printed(advice)
        assert "suggested" in text
        assert ("stands in the mission" in text) == (stated != "auto")
        assert tension_picture(advice, "m")[:4] == b"\x89PNG"


def test_the_command_prints_and_draws(tmp_path: Path) -> None:
    file = tmp_path / "m.yaml"
    file.write_text(
        "route: {start: [0, 0], via: [[9, 9]], goal: [20, 0]}\nspline: {tension: auto}\n"
    )
    done = CliRunner().invoke(cli, ["tension", str(file), "--out", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    assert "Suggested: state no tension" in done.output
    assert (tmp_path / "out" / "tension.png").read_bytes()[:4] == b"\x89PNG"
    assert CliRunner().invoke(cli, ["check", str(file)]).exit_code == 0


def _printed(advice: vs.TensionAdvice) -> str:
    console = Console(width=160, file=None, record=True, quiet=False)
    with console.capture() as capture:
        console.print(advice_tables(advice, "m"))
    return capture.get()


def test_where_no_tension_matters_but_none_is_faster_that_is_suggested() -> None:
    robot = {
        "radius_m": 0.3, "max_speed_mps": 4, "max_accel_mps2": 0.5, "max_lateral_accel_mps2": 0.5,
    }  # fmt: skip
    asked = vs.Mission.model_validate({
        "world": {"known": [{"circle": {"center": [15, 0.2], "radius": 3}}]},
        "robot": robot, "route": {"start": [0, 0], "goal": [30, 0]}, "spline": {"tension": 0.5},
    })  # fmt: skip
    advice = vs.advise_tension(asked)
    gained = advice.stands.cost[0] - vs.plan(with_spline(asked)).trajectory.duration
    assert advice.matters
    assert advice.suggested is None
    assert gained > 0.1
    assert f"{seconds(gained)} faster than as it stands" in advice_words(advice)
