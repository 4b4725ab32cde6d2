from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.methods import ordered
from viaspline.planning.methods.bent_gently import BentGently
from viaspline.planning.methods.ordered import NEARBY_HEADINGS
from viaspline.planning.methods.rounder_turns import RounderTurns
from viaspline.planning.methods.turns_on_shortest import TurnsOnShortest
from viaspline.planning.turning import gentle_strip
from viaspline.planning.turning.turning_problem import MOST_LONGER, TurningProblem

RADIUS_M, REQUIRED_M = 0.35, 0.5
ROBOT = {"radius_m": RADIUS_M, "clearance_m": REQUIRED_M - RADIUS_M, "max_speed_mps": 1.5,
         "max_accel_mps2": 0.8, "max_lateral_accel_mps2": 0.6}  # fmt: skip


def beside_a_wall(gap: float, back: float, turned: float, dwell: float = 0.0) -> vs.Mission:
    """Along a wall to a via point that is so far from it, and back so far beside that way."""
    turn = np.array([[math.cos(turned), math.sin(turned)], [-math.sin(turned), math.cos(turned)]])

    def at(*places: tuple[float, float]) -> Any:
        return (np.array(places) @ turn).round(6).tolist()

    start, via, goal = at((-9, gap), (0, gap), (-9, gap + back))
    return vs.Mission.model_validate({
        "world": {"known": [{"polygon": at((-12, -2), (12, -2), (12, 0), (-12, 0))}]},
        "robot": ROBOT,
        "route": {"start": start, "via": [{"at": via, "dwell_s": dwell}], "goal": goal},
    })  # fmt: skip


def among_discs(seed: int) -> vs.Mission:
    """Two via points among eight discs that stand close to each other."""
    random = np.random.default_rng((78, seed))
    discs = [
        {"circle": {"center": random.uniform((0, -6), (16, 6)).round(2).tolist(), "radius": radius}}
        for radius in random.uniform(0.3, 1.5, 8).round(2).tolist()
    ]
    places: list[Any] = []
    while len(places) < 4:
        place = random.uniform((-1, -7), (17, 7)).round(2).tolist()
        gaps = [math.dist(place, d["circle"]["center"]) - d["circle"]["radius"] for d in discs]
        if min(gaps) > REQUIRED_M + 0.02:
            places.append(place)
    return vs.Mission.model_validate({
        "world": {"known": discs}, "robot": ROBOT,
        "route": {"start": places[0], "via": places[1:-1], "goal": places[-1]},
    })  # fmt: skip


def sharpest(path: vs.Path) -> float:
    """The least radius in dense samples [m]."""
    u = np.linspace(*path.domain, 40_000)
    return 1.0 / float(np.abs(path.curvature(u)).max())


@settings(max_examples=30, deadline=None)
@given(st.floats(0.51, 1.2), st.floats(0.0, 3.0), st.floats(0.0, 6.28))
@example(0.52, 0.5, 0.0)
@example(0.7, 0.0, 1.0)
def test_a_robot_that_turns_back_beside_a_wall_turns_as_round_as_its_body(
    gap: float, back: float, turned: float
) -> None:
    found = vs.plan(beside_a_wall(gap, back, turned))
    assert found.certificate.holds
    assert found.drivability.verdict == "good"
    assert sharpest(found.path) >= 0.999 * RADIUS_M


def test_without_other_headings_it_would_be_sharper(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = beside_a_wall(0.8, 0.5, 0.0)
    rounder = vs.plan(asked)
    alone = (*ordered.DISC_METHODS[:1], BentGently(TurnsOnShortest()))
    monkeypatch.setattr(ordered, "DISC_METHODS", alone)
    sharp = vs.plan(asked)
    assert sharpest(sharp.path) < RADIUS_M <= 1.001 * sharpest(rounder.path)
    assert rounder.trajectory.duration < 1.1 * sharp.trajectory.duration


@settings(max_examples=15, deadline=None)
@given(st.floats(0.51, 1.2), st.floats(0.0, 1.5), st.floats(0.0, 6.28))
@example(0.8, 0.5, 0.0)
def test_where_lanes_are_kept_it_turns_as_round_and_is_back_on_its_lane(
    gap: float, back: float, turned: float
) -> None:
    route = {"detours": "local"}
    asked = beside_a_wall(gap, back, turned)
    mission = asked.model_copy(update={"route": asked.route.model_copy(update=route)})
    found = vs.plan(mission)
    assert found.drivability.verdict == "good"
    assert sharpest(found.path) >= 0.999 * RADIUS_M
    assert mission.route.goal is not None
    lanes = np.array([mission.route.start.at, mission.route.via[0].at, mission.route.goal.at])
    places = found.path.evaluate(np.linspace(*found.path.domain, 4001))
    for start, end in pairwise(lanes):
        along = (end - start) / np.hypot(*(end - start))
        off = np.abs((places - start) @ np.array((-along[1], along[0])))
        near = (places[off < 1.0] - start) @ along
        kept = np.unique(np.floor(np.clip(near, 0, math.dist(start, end) - 1e-9) / 0.1))
        assert len(kept) > 0.9 * math.dist(start, end) / 0.1


def test_a_way_that_is_round_is_taken_before_one_that_is_a_little_sooner() -> None:
    asked = among_discs(91)
    found = vs.plan(asked)
    assert found.drivability.verdict == "good"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(TurningProblem, "price", TurningProblem.cost)
        sharp = vs.plan(asked)
    assert sharp.drivability.verdict == "rough"
    assert sharp.trajectory.duration < found.trajectory.duration
    assert found.trajectory.duration < MOST_LONGER * sharp.trajectory.duration


def test_what_is_bent_too_sharply_is_bent_as_round_as_the_robot_and_sooner_than_lines_and_turns(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked = among_discs(241)
    found = vs.plan(asked)
    monkeypatch.setattr(gentle_strip, "LIMIT_PARTS", ())
    as_laid = vs.plan(asked)
    assert sharpest(found.path) >= 0.999 * RADIUS_M
    assert found.trajectory.duration < 0.96 * as_laid.trajectory.duration


def test_what_is_round_is_left_as_it_is() -> None:
    class Never:
        def lay(self, problem: object, bound: float = math.inf) -> Any:
            raise AssertionError("nothing is sharp")

    assert (
        RounderTurns(TurnsOnShortest(), NEARBY_HEADINGS) in ordered.DISC_METHODS[1].method.methods
    )
    open_way = beside_a_wall(3.0, 4.0, 0.0)
    method = RounderTurns(TurnsOnShortest(), Never())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ordered, "DISC_METHODS", (*ordered.DISC_METHODS[:1], BentGently(method)))
        assert vs.plan(open_way).drivability.verdict == "good"
