"""Two bends that one turn goes round, beside shapely's circles and random rows."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely

import viaspline as vs
from viaspline.planning.turning.bend_row import DETOUR, KEPT, Bends, bend
from viaspline.planning.turning.joined_bends import (
    Join,
    TurnWishes,
    joins_worth_it,
    loosened,
    with_joins,
)

SIDES = (1.0, -1.0)


def pair(way: float, kept: tuple[float, float], side: float, angle: float) -> Bends:
    """Two bends between two via points, the way from the first to the second in a direction."""
    along = np.array([math.cos(angle), math.sin(angle)])
    first, second = 10.0 * along, (10.0 + way) * along
    rows = [
        bend(0.0, 0.0),
        bend(*first.tolist(), kept[0], side),
        bend(*second.tolist(), kept[1], side),
        bend(*(40.0 * along).tolist()),
    ]
    return Bends.free(np.array(rows), np.array([0, DETOUR, DETOUR, 1]))


def wishes(turns: tuple[float, float], gaps: tuple[float, float, float]) -> TurnWishes:
    return TurnWishes(
        np.array([0.0, *turns, 0.0]), np.array(gaps), np.array([0.0, gaps[1], gaps[1], 0.0]),
        np.full(4, 4.0), spent=10.0,
    )  # fmt: skip


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("seed", range(10))
def test_the_circle_of_a_join_goes_round_both_and_touches_both(seed: int, side: float) -> None:
    random = np.random.default_rng(seed)
    kept = (float(random.uniform(0.1, 2.0)), float(random.uniform(0.1, 2.0)))
    bends = pair(float(random.uniform(3, 8)), kept, side, float(random.uniform(-3, 3)))
    radius = float(random.uniform(8.0, 20.0))
    row = with_joins(bends, [Join(1, radius, 0.0, 0.5)]).rows[1]
    assert row[KEPT] == radius
    edge = shapely.Point(row[:2]).buffer(radius, quad_segs=4096).exterior
    for x, y, its in bends.rows[1:3, :3].tolist():
        assert math.hypot(row[0] - x, row[1] - y) < radius
        assert edge.distance(shapely.Point(x, y)) == pytest.approx(its, abs=1e-5)


@pytest.mark.parametrize("side", SIDES)
def test_what_is_gone_round_lies_on_the_inside_of_the_turn(side: float) -> None:
    bends = pair(4.0, (0.5, 0.5), side, 0.0)
    row = with_joins(bends, [Join(1, 9.0, 0.0, 0.5)]).rows[1]
    assert math.copysign(1.0, row[1]) == side  # to the left of a way along x, where it turns left


def test_corners_close_together_on_one_side_are_joined() -> None:
    bends = pair(1.5, (0.7, 0.7), 1.0, 0.0)
    (join,) = joins_worth_it(bends, wishes((0.5, 0.7), (20.0, 1.5, 20.0)))
    assert join.first == 1
    assert join.radius > 4.0 / 2.0


@pytest.mark.parametrize(
    "unlike",
    [
        pytest.param("side", id="on two sides"),
        pytest.param("via", id="one of them a via point"),
        pytest.param("swing", id="one may not swing out"),
    ],
)
def test_others_are_not(unlike: str) -> None:
    bends = pair(1.5, (0.7, 0.7), 1.0, 0.0)
    if unlike == "side":
        rows = bends.rows.copy()
        rows[2, 3] = -1.0
        bends = replace(bends, rows=rows)
    elif unlike == "via":
        bends = replace(bends, vias=np.array([0, DETOUR, 1, 2]))
    else:
        bends = replace(bends, swings=np.array([math.inf, math.inf, 0.1, math.inf]))
    assert joins_worth_it(bends, wishes((0.5, 0.7), (20.0, 1.5, 20.0))) == ()


def test_corners_with_room_for_a_turn_each_are_not_joined() -> None:
    bends = pair(20.0, (0.7, 0.7), 1.0, 0.0)
    assert joins_worth_it(bends, wishes((0.2, 0.2), (5.0, 20.0, 5.0))) == ()


def test_a_join_without_room_gets_smaller_until_it_is_not_worth_it() -> None:
    joins = [Join(1, 4.0, 2.0, 0.5), Join(3, 4.0, 2.0, 0.5)]
    once = list(loosened(joins, {1}))
    assert [join.radius for join in once] == pytest.approx([2.8, 4.0])
    assert [join.first for join in loosened(once, {1})] == [3]


def test_a_path_round_the_end_of_a_wall_is_one_turn_as_fast_as_two() -> None:
    wall = {"polygon": [[20.0, -40.0], [21.0, -40.0], [21.0, 0.0], [20.0, 0.0]]}
    mission = vs.Mission.model_validate({
        "world": {"known": [wall]},
        "robot": {"radius_m": 0.4, "clearance_m": 0.3, "max_speed_mps": 2.0,
                  "max_accel_mps2": 1.0, "max_lateral_accel_mps2": 1.0},
        "route": {"start": [0.0, -12.0], "goal": [41.0, -12.0]},
    })  # fmt: skip
    path = vs.plan(mission).path
    assert len([via for via in path.vias if via.kind == "detour"]) == 1
    curvature = np.array([path.curvature(u) for u in np.linspace(0.0, len(path.spans), 2001)])
    assert np.abs(curvature).max() < 1.0 / 3.9  # at full speed: 2² / 1 = 4 m
