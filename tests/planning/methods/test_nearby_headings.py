"""Headings at the via points about what is tight, and the rest of the path as it comes to be."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.curve.bending import is_round
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.planning.methods.clear_spline import ClearSpline
from viaspline.planning.methods.ordered import FEW_HEADINGS, NEARBY_HEADINGS
from viaspline.planning.problem.method import Found
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import via_sequence_of
from viaspline.planning.routing.path_problem import PathProblem
from viaspline.planning.turning.bend_row import DETOUR, SIDE, Bends, bend
from viaspline.planning.turning.clear_ends import with_clear_ends
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.headings import HeadingLeg, costs_between, legs_of, with_room
from viaspline.planning.turning.repair import clear_turn_path
from viaspline.planning.turning.turn_path import TurnPath, turn_path_round
from viaspline.planning.turning.turn_problem import TurnProblem

RADIUS_M = 0.35
ROUND = [(-9.0, 3.0), (0.0, 0.7), (-9.0, 0.75), (-14.0, 5.0), (-10.0, 9.0)]
WALL = {"polygon": [[-12, -2], [12, -2], [12, 0], [-12, 0]]}


def turns(places: list[Any], closed: bool, known: list[Any], rho: float) -> TurnProblem:
    """Turns of at least a radius through places."""
    ends = {"closed": True, "via": places[1:]}
    if not closed:
        ends = {"via": places[1:-1], "goal": places[-1]}
    mission = vs.Mission.model_validate({
        "world": {"known": known},
        "robot": {"radius_m": RADIUS_M, "clearance_m": 0.15, "max_speed_mps": 1.5,
                  "max_accel_mps2": 0.8, "max_lateral_accel_mps2": 0.6},
        "route": {"start": places[0], **ends},
    })  # fmt: skip
    needs, world = Requirements.of(mission), vs.World.known(mission)
    asked = PathProblem.of(via_sequence_of(mission), world, needs)
    path = DrivenProblem(
        asked.sequence, world, needs, asked.router, cleared=ClearSpline().lay(asked)
    )
    return TurnProblem(path, rho, path.spots)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 4), st.booleans(), st.booleans())
@example(2, True, False)
def test_wherever_a_round_begins_one_heading_is_sought_where_it_turns_back_beside_a_wall(
    first: int, closed: bool, backwards: bool
) -> None:
    places = [*ROUND[first:], *ROUND[:first]]
    tight = places.index(ROUND[1])
    if not closed and tight in (0, 4):  # it ends there
        return
    if backwards:
        places, tight = places[::-1], 4 - tight
    problem = turns(places, closed, [WALL], 1.0035 * RADIUS_M)
    assert problem.tight_vias == {tight}
    found, among_all = (each.lay(problem) for each in (NEARBY_HEADINGS, FEW_HEADINGS))
    assert isinstance(found, Found)
    assert isinstance(among_all, Found)
    laid = found.value
    assert laid.length <= 1.02 * among_all.value.length
    ends = [*places, places[0]] if closed else places
    vias = [(round(via.u), via.at) for via in laid.vias if via.kind == "user"]
    assert [at for _, at in vias] == ends
    for u, at in vias:
        assert tuple(laid.spans[u, 0] if u < len(laid.spans) else laid.spans[-1, 3]) == at
    assert is_round(PiecewiseCubic(laid.spans, closed=closed), RADIUS_M)
    assert vs.certify(PiecewiseCubic(laid.spans), problem.path.world, 0.5).holds


def test_where_no_turn_is_tight_no_heading_is_sought() -> None:
    problem = turns([[0, 3], [9, 3], [9, 9]], False, [WALL], 0.5)
    assert problem.tight_vias == set()
    assert not isinstance(NEARBY_HEADINGS.lay(problem), Found)


def test_headings_are_sought_as_well_where_others_leave_no_turns() -> None:
    """Between places nearer to each other than turns through them are long there is none."""
    close = [[0.0, 0.0], [9.0, 0.0], [9.3, 0.2], [9.0, 0.4], [0.0, 3.0]]
    problem = turns(close, False, [], 2.0)
    legs = problem.heading_legs({1}, FEW_HEADINGS.headings)
    costs = costs_between(legs, problem.path.requirements)
    assert np.isinf(costs[1]).all()
    assert legs[1].inner_vias == {2, 3}
    found = NEARBY_HEADINGS.lay(problem)
    assert isinstance(found, Found)
    assert is_round(PiecewiseCubic(found.value.spans), RADIUS_M)


@pytest.mark.parametrize("gap", [4.0, 8.0])
def test_ends_of_a_leg_with_much_between_know_nothing_of_each_other(gap: float) -> None:
    """What a leg costs is told by its ends; pair by pair it is the same."""
    rng = np.random.default_rng(7)
    places = np.cumsum(np.vstack(([0, 0], rng.uniform((gap, -2), (2 * gap, 2), (4, 2)))), axis=0)
    problem = turns(places.tolist(), False, [], 0.5)
    ((leg, _),) = [problem.heading_legs({3}, 16)]
    needs = problem.path.requirements
    told = costs_between([leg], needs)[0, : len(leg.starts), : len(leg.goals)]
    assert len(leg.bends.rows) == 4
    assert np.allclose(told, leg.lengths().min(axis=(2, 3)), atol=1e-6)


def test_where_corners_of_cells_leave_turns_no_room_those_in_line_are_left_out() -> None:
    """Some corners of a wall of cells lie 5 and 20 cm apart, hardly off the line of others."""
    wall = [[20.45, 2.45], [21.0, 2.4], [21.2, 2.4], [21.25, 2.4], [24.25, 2.45], [24.4, 2.5]]
    bent = [*(bend(*at, 0.5, 1.0) for at in wall), bend(25.75, 6.15, 0.5, -1.0)]
    rows = np.array([bend(19.79, 2.74), *bent, bend(25.5, 7.85, 0.5, 1.0), bend(26.41, 13.12)])
    bends = Bends.free(rows, np.array([0, *[DETOUR] * 8, 1])).turning(0.5)
    free = np.array([np.nan])
    leg, needs = HeadingLeg(bends, free, free), Requirements(radius=0.35, clearance=0.15)
    costs = costs_between([leg], needs)
    assert np.isinf(costs).all()
    ((thin,), known) = with_room([leg], costs, needs)
    left = thin.bends.rows[1:-1, :2].tolist()
    assert [at for at in wall if at not in left] == [[21.2, 2.4], [21.25, 2.4]]
    assert 16.0 < known.item() < 17.0
    (same, kept) = with_room([thin], known, needs)
    assert same == (thin,)
    assert kept is known


def test_headings_into_a_wall_are_left_out_before_a_long_leg_is_pushed_clear() -> None:
    problem = turns(ROUND, True, [WALL], 1.0035 * RADIUS_M)
    legs = problem.heading_legs({1}, 16)
    costs = costs_between(legs, problem.path.requirements)
    assert np.isfinite(costs).all()
    kept = with_clear_ends(legs, costs, problem.on_sides(clear_turn_path))
    leaves = np.isfinite(kept[0]).any(axis=1)
    arrives = np.isfinite(kept[0]).any(axis=0)
    headings = np.degrees(legs[0].starts)
    assert not leaves[np.isclose(headings, 270.0)].any()  # straight down to the wall
    assert not arrives[np.isclose(headings, 90.0)].any()  # as from within it
    for along in (0.0, 180.0):
        assert leaves[np.isclose(headings, along)].all()
        assert arrives[np.isclose(headings, along)].all()
    assert (kept[np.isfinite(kept)] == costs[np.isfinite(kept)]).all()


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000), st.floats(-math.pi, math.pi), st.booleans())
@example(0, 0.3, False)
def test_the_headings_that_are_tried_turn_with_the_world_and_one_halves_the_turn(
    seed: int, angle: float, mirrored: bool
) -> None:
    rng = np.random.default_rng(seed)
    rows = np.array([bend(*at, kept, side) for at, kept, side in (
        ((0, 0), 0.0, 0.0), (rng.uniform(-9, -5, 2), rng.uniform(0, 2), rng.choice((-1.0, 1.0))),
        (rng.uniform(5, 9, 2), 0.0, 0.0),
        (rng.uniform(14, 18, 2), rng.uniform(0, 2), rng.choice((-1.0, 1.0))), ((9, 25), 0.0, 0.0),
    )])  # fmt: skip
    vias = np.array([0, DETOUR, 1, DETOUR, 2])

    def tried(rows: Floats) -> Floats:
        first, _ = legs_of(Bends.free(rows, vias), (), {1}, 16, {})
        return first.goals

    image, side = rows.copy(), -1.0 if mirrored else 1.0
    image[:, 1] *= side
    image[:, SIDE] *= side
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    image[:, :2] = image[:, :2] @ turn
    found, expected = (np.exp(1j * h) for h in (tried(image), side * tried(rows) + angle))
    assert np.abs(found[:, None] - expected).min(axis=1).max() < 1e-9
    laid = turn_path_round(Bends.free(rows, vias).turning(1e-5))
    if not isinstance(laid, TurnPath) or len(laid.left) < len(rows):  # it goes round other sides
        return
    along = laid.spans[laid.begins[2], 1] - laid.spans[laid.begins[2], 0]
    halved = math.atan2(along[1], along[0])
    assert math.remainder(tried(rows)[0] - halved, math.tau) == pytest.approx(0.0, abs=1e-3)


def test_headings_with_room_are_found_where_the_cheapest_have_none_at_one_end() -> None:
    """The cheapest pairs of a leg all had one heading that is blocked: nothing else was tried."""
    boxes = ((13.9, 3.3211, 14.1, 7), (13.9, 10.7649, 14.1, 14), (0, 6.9, 3.1404, 7.1))
    mission = {
        "world": {"known": [
            {"polygon": [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]} for x0, y0, x1, y1 in boxes
        ]},
        "robot": {"radius_m": 0.3, "clearance_m": 0.2, "max_speed_mps": 0.4,
                  "max_accel_mps2": 0.3, "max_lateral_accel_mps2": 0.6},
        "route": {"start": [10.536, 6.34], "via": [[14.66, 12.177], [0.65, 7.66]],
                  "goal": [14.659, 3.287]},
    }  # fmt: skip
    plan = vs.plan(vs.Mission.model_validate(mission))
    assert plan.drivability.verdict == "good"
    assert plan.drivability.sharpest_radius >= 0.3
