"""The tension advisor, beside what each tension really does."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.integrate import quad

import viaspline as vs
from viaspline.advice import TRIED_TENSIONS
from viaspline.cli import cli
from viaspline.report.tension_picture import tension_picture

VIAS = [[30, 5], [45, 30], [20, 45], [-10, 30]]


def mission(tension: object = "auto", robot: dict | None = None, known: list | None = None,
            **route: object) -> vs.Mission:  # fmt: skip
    return vs.Mission.model_validate({
        "world": {"known": known or []},
        "robot": {"max_lateral_accel_mps2": 0.6} | (robot or {}),
        "route": {"start": [0, 0], "via": VIAS, "goal": [-30, 0]} | route,
        "spline": {"tension": tension},
    })  # fmt: skip


def test_lengths_clearances_and_curvatures_are_those_of_the_spline() -> None:
    tank = {"name": "tank", "circle": {"center": [36, 22], "radius": 1}}
    advice = vs.advise_tension(mission(known=[tank]))
    j = TRIED_TENSIONS.index(0.3)
    spline = vs.CardinalSpline([[0, 0], *VIAS, [-30, 0]], tension=0.3, knots="chordal")
    for k in range(5):
        length = quad(lambda u: np.linalg.norm(spline.evaluate(u, 1)), k, k + 1)[0]
        at = np.linspace(k, k + 1, 4001)
        points = spline.evaluate(at)
        gap = np.hypot(*(points - (36, 22)).T).min() - 1 - 0.5
        inside = np.clip(at, k + 1e-9, k + 1 - 1e-9)
        assert advice.lengths[k, j] == pytest.approx(length, rel=1e-6)
        assert gap - 2e-3 <= advice.clearances[k, j] <= gap + 1e-6
        assert advice.curvatures[k, j] == pytest.approx(
            np.abs(spline.curvature(inside)).max(), rel=1e-3
        )


@pytest.mark.parametrize("tangents", ["cardinal", "continuous"])
def test_durations_are_those_of_the_drive_with_one_span_changed(tangents: str) -> None:
    asked = mission()
    spline = asked.spline.model_copy(update={"tangents": tangents})
    asked = asked.model_copy(update={"spline": spline})
    advice = vs.advise_tension(asked)
    k, j = 2, TRIED_TENSIONS.index(0.7)
    each = [advice.best] * 5
    each[k] = 0.7
    numbers = asked.model_copy(
        update={"spline": spline.model_copy(update={"tension": tuple(each)})}
    )
    assert advice.durations[k, j] == pytest.approx(vs.plan(numbers).trajectory.duration, rel=1e-9)


@pytest.mark.parametrize("closed", [False, True])
def test_auto_plans_with_what_is_suggested(closed: bool) -> None:
    asked = mission(closed=True, goal=None) if closed else mission()
    advice, plan = vs.advise_tension(asked), vs.plan(asked)
    assert plan.mission.spline.tension == tuple(advice.suggested.tolist())
    assert plan.trajectory.duration == pytest.approx(advice.duration, rel=1e-9)
    assert len(advice.spans) == 5


def test_a_suggestion_is_nearly_as_fast_as_any_tension_and_rounder_than_the_fastest() -> None:
    advice = vs.advise_tension(mission())
    assert advice.duration <= 1.05 * advice.common[3].min()
    j = np.abs(advice.tensions[:, None] - advice.suggested).argmin(axis=0)
    span = np.arange(len(j))
    fastest = advice.durations.argmin(axis=1)
    assert (advice.curvatures[span, j] <= advice.curvatures[span, fastest] + 1e-12).all()


def test_clearance_comes_before_speed() -> None:
    tank = {"name": "tank", "circle": {"center": [40, 15], "radius": 2.0}}
    advice = vs.advise_tension(mission(known=[tank]))
    holds = advice.clearances >= advice.required
    assert not holds[1].all()
    j = np.abs(advice.tensions[:, None] - advice.suggested).argmin(axis=0)
    for k in range(5):
        assert holds[k, j[k]] or not holds[k].any()


def test_the_same_mission_gives_the_same_advice() -> None:
    first, again = vs.advise_tension(mission()), vs.advise_tension(mission())
    np.testing.assert_array_equal(first.suggested, again.suggested)
    assert tension_picture(first, "m") == tension_picture(again, "m")


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


def test_the_command_prints_and_draws(tmp_path: Path) -> None:
    file = tmp_path / "m.yaml"
    file.write_text(
        "route: {start: [0, 0], via: [[9, 9]], goal: [20, 0]}\nspline: {tension: auto}\n"
    )
    done = CliRunner().invoke(cli, ["tension", str(file), "--out", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    assert "suggested" in done.output
    assert (tmp_path / "out" / "tension.png").read_bytes()[:4] == b"\x89PNG"
    assert CliRunner().invoke(cli, ["check", str(file)]).exit_code == 0
