"""A search among poses as a method: what it finds, what it proves, and when it gives up."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.curve.bending import curvature_bound
from viaspline.planning.methods.clear_spline import ClearSpline
from viaspline.planning.methods.hybrid_astar_search import HybridAStar
from viaspline.planning.problem.method import Found, GaveUp, Refusal
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import via_sequence_of
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.routing.path_problem import PathProblem
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.hybrid_astar.pose_search import SEARCH_EFFORTS
from viaspline.planning.turning.turn_path import OVERSHOOT
from viaspline.planning.turning.turn_problem import TurnProblem

PEN = [[[-2, -2], [8, -2], [8, -1.6], [-2, -1.6]], [[-2, 1.6], [8, 1.6], [8, 2], [-2, 2]],
       [[8, -2], [8.4, -2], [8.4, 2], [8, 2]]]  # fmt: skip
SLIGHT = (replace(SEARCH_EFFORTS[0], room=40),)


def problem(known: Any, start: Any, goal: Any, **robot: Any) -> TurnProblem:
    robot = {"clearance_m": 0.5, "min_turn_radius_m": 3.0} | robot
    if "footprint" not in robot:
        robot["radius_m"] = 0.5
    mission = vs.Mission.model_validate({
        "world": {"known": known, "bounds": [-40, -40, 40, 40]},
        "robot": robot,
        "route": {"start": start, "goal": goal},
    })  # fmt: skip
    sequence = replace(via_sequence_of(mission), tangents="continuous")
    asked = PathProblem.of(sequence, vs.World.known(mission), Requirements.of(mission))
    path = DrivenProblem(
        sequence, asked.world, asked.requirements, asked.router, cleared=ClearSpline().lay(asked)
    )
    return TurnProblem(path, path.least_radii[-1], path.spots)


def pen(**robot: Any) -> TurnProblem:
    """A start that faces the closed end of a pen."""
    known = [{"polygon": ring} for ring in PEN]
    return problem(known, {"at": [4, 0], "heading_deg": 0}, [-30, 0], **robot)


def test_searches_that_share_what_they_may_spend_give_up_once_that_is_spent() -> None:
    asked = problem([], {"at": [0, 0], "heading_deg": 0}, [-3, 1])
    poses = WorkBudget(12.0)
    path = asked.path
    limited = replace(path, requirements=replace(path.requirements, poses=poses))
    first = HybridAStar().lay(replace(asked, path=limited))
    assert isinstance(first, Found)
    np.testing.assert_array_equal(first.value.spans, HybridAStar().lay(asked).value.spans)
    assert poses.spent > 0.0
    poses.spent = poses.limit
    assert isinstance(HybridAStar().lay(replace(asked, path=limited)), GaveUp)


def test_a_loop_round_the_turning_circle_is_found() -> None:
    asked = problem([], {"at": [0, 0], "heading_deg": 0}, [-3, 1])
    found = HybridAStar().lay(asked)
    assert isinstance(found, Found)
    assert asked.rho == OVERSHOOT * 3.0
    assert curvature_bound(vs.PiecewiseCubic(found.value.spans))[0] * 3.0 <= 1.0
    np.testing.assert_allclose(found.value.spans[-1, 3], (-3, 1), atol=1e-12)


def test_a_start_that_is_shut_in_is_proven_so() -> None:
    told = HybridAStar().lay(pen())
    assert isinstance(told, Refusal)
    assert told.via == 0
    assert "far from the start" in told.reason


def test_a_search_that_ran_out_of_room_proves_nothing() -> None:
    disc = {"circle": {"center": [0, 0], "radius": 9}}
    far = problem([disc], {"at": [-25, 0], "heading_deg": 180}, [25, 0])
    assert isinstance(HybridAStar().lay(far), Found)
    told = HybridAStar(SLIGHT).lay(far)
    assert isinstance(told, GaveUp)
    assert told.via == 1
    assert "poses" in told.tried[0]


def test_a_cheaper_path_than_one_that_is_there_is_looked_for_less_long() -> None:
    disc = {"circle": {"center": [0, 0], "radius": 9}}
    far = problem([disc], {"at": [-25, 0], "heading_deg": 180}, [25, 0])
    hasty = HybridAStar(max_gain_s=0.001)
    assert isinstance(hasty.lay(far), Found)
    assert isinstance(hasty.lay(far, bound=100.0), GaveUp)
    assert isinstance(HybridAStar().lay(far, bound=100.0), Found)


def test_a_body_without_a_turning_circle_is_refused_for_its_place_alone() -> None:
    """It may turn more sharply than the search does."""
    footprint = [[-0.4, -0.3], [0.9, -0.3], [0.9, 0.3], [-0.4, 0.3]]
    narrow = [{"polygon": [[-9, 0.55], [9, 0.55], [9, 2], [-9, 2]]},
              {"polygon": [[-9, -2], [9, -2], [9, -0.55], [-9, -0.55]]},
              {"polygon": [[9, -2], [10, -2], [10, 2], [9, 2]]}]  # fmt: skip
    asked = problem(
        narrow, {"at": [0, 0], "heading_deg": 0}, [-30, 0],
        footprint=footprint, clearance_m=0.1, min_turn_radius_m=None,
    )  # fmt: skip
    told = HybridAStar(SEARCH_EFFORTS[:1]).lay(asked)
    assert isinstance(told, GaveUp)
    assert "far from the start" in told.reason


def test_a_search_whose_budget_is_spent_proves_nothing() -> None:
    asked = pen()
    told = HybridAStar(max_poses_s=0.001).lay(asked)
    assert isinstance(told, GaveUp)
    assert isinstance(HybridAStar().lay(asked), Refusal)


def lane(angle: float) -> list[Any]:
    """A lane out of the origin, a tenth of a metre wider to either side than the robot needs."""
    c, s = math.cos(angle), math.sin(angle)
    boxes = [(-1.5, 9, 1.1, 1.5), (-1.5, 9, -1.5, -1.1), (-1.6, -1.2, -1.5, 1.5)]
    return [
        {"polygon": [[c * x - s * y, s * x + c * y]
                     for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]}
        for x0, x1, y0, y1 in boxes
    ]  # fmt: skip


@pytest.mark.parametrize("degrees", [22.5, 67.0, -31.0])
def test_a_free_start_finds_the_lane_that_leads_out_whichever_way_it_runs(degrees: float) -> None:
    asked = problem(lane(math.radians(degrees)), [0, 0], [-30, 0])
    found = HybridAStar().lay(asked)
    assert isinstance(found, Found)
    leaves = found.value.spans[0, 1] - found.value.spans[0, 0]
    away = math.degrees(math.atan2(leaves[1], leaves[0])) - degrees
    assert abs(away) < 15.0
