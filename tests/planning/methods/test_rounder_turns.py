from __future__ import annotations

import math
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

RADIUS_M, REQUIRED_M = 0.35, 0.5


def beside_a_wall(gap: float, back: float, turned: float, dwell: float = 0.0) -> vs.Mission:
    """Along a wall to a via point that is so far from it, and back so far beside that way."""
    turn = np.array([[math.cos(turned), math.sin(turned)], [-math.sin(turned), math.cos(turned)]])

    def at(*places: tuple[float, float]) -> Any:
        return (np.array(places) @ turn).round(6).tolist()

    start, via, goal = at((-9, gap), (0, gap), (-9, gap + back))
    return vs.Mission.model_validate({
        "world": {"known": [{"polygon": at((-12, -2), (12, -2), (12, 0), (-12, 0))}]},
        "robot": {"radius_m": RADIUS_M, "clearance_m": REQUIRED_M - RADIUS_M,
                  "max_speed_mps": 1.5, "max_accel_mps2": 0.8, "max_lateral_accel_mps2": 0.6},
        "route": {"start": start, "via": [{"at": via, "dwell_s": dwell}], "goal": goal},
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


def test_what_is_round_or_on_its_lane_is_left_as_it_is() -> None:
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
