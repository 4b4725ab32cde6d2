"""Bends that one turn goes round, beside shapely's circles and random rows."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely

import viaspline as vs
from viaspline.kernels.turning.gentle_lengths import gentle_lengths
from viaspline.planning.turning.bend_row import DETOUR, KEPT, Bends, bend
from viaspline.planning.turning.joined_bends import (
    Join,
    TurnWishes,
    joins_worth_it,
    loosened,
    rest_of,
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


def wishes(turns: tuple[float, ...], gaps: tuple[float, ...]) -> TurnWishes:
    """Of turns between a start and a goal, with as much to spend as they can use."""
    angles, ways = np.array([0.0, *turns, 0.0]), np.array(gaps)
    lengths = gentle_lengths(angles, 2.0 * ways, False, 10.0)
    return TurnWishes(
        angles, ways, lengths, np.full(len(angles), 4.0), 10.0, np.full(len(angles), 4.0)
    )


def row(places: list[tuple[float, float]], side: float = 1.0) -> Bends:
    """Bends at places between two via points, all to one side."""
    inner = [bend(x, y, 0.7, side) for x, y in places[1:-1]]
    rows = [bend(*places[0]), *inner, bend(*places[-1])]
    return Bends.free(np.array(rows), np.array([0, *[DETOUR] * len(inner), 1]))


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("seed", range(10))
def test_the_circle_of_a_join_goes_round_both_and_touches_both(seed: int, side: float) -> None:
    random = np.random.default_rng(seed)
    kept = (float(random.uniform(0.1, 2.0)), float(random.uniform(0.1, 2.0)))
    bends = pair(float(random.uniform(3, 8)), kept, side, float(random.uniform(-3, 3)))
    radius = float(random.uniform(8.0, 20.0))
    row = with_joins(bends, [Join(1, 2, radius, 0.0)]).rows[1]
    assert row[KEPT] == radius
    edge = shapely.Point(row[:2]).buffer(radius, quad_segs=4096).exterior
    for x, y, its in bends.rows[1:3, :3].tolist():
        assert math.hypot(row[0] - x, row[1] - y) < radius
        assert edge.distance(shapely.Point(x, y)) == pytest.approx(its, abs=1e-5)


@pytest.mark.parametrize("side", SIDES)
def test_what_is_gone_round_lies_on_the_inside_of_the_turn(side: float) -> None:
    bends = pair(4.0, (0.5, 0.5), side, 0.0)
    row = with_joins(bends, [Join(1, 2, 9.0, 0.0)]).rows[1]
    assert math.copysign(1.0, row[1]) == side  # to the left of a way along x, where it turns left


def test_corners_close_together_on_one_side_are_joined() -> None:
    bends = pair(1.5, (0.7, 0.7), 1.0, 0.0)
    (join,) = joins_worth_it(bends, wishes((0.5, 0.7), (20.0, 1.5, 20.0)), 1.0)
    assert (join.first, join.last) == (1, 2)
    assert join.radius > 4.0 / 2.0


@pytest.mark.parametrize(
    "unlike",
    [
        pytest.param("side", id="on two sides"),
        pytest.param("via", id="one of them a via point"),
        pytest.param("swing", id="one may not swing out"),
    ],
)
def test_bends_that_are_unlike_in_one_of_these_ways_are_not_joined(unlike: str) -> None:
    bends = pair(1.5, (0.7, 0.7), 1.0, 0.0)
    if unlike == "side":
        rows = bends.rows.copy()
        rows[2, 3] = -1.0
        bends = replace(bends, rows=rows)
    elif unlike == "via":
        bends = replace(bends, vias=np.array([0, DETOUR, 1, 2]))
    else:
        bends = replace(bends, swings=np.array([math.inf, math.inf, 0.1, math.inf]))
    assert joins_worth_it(bends, wishes((0.5, 0.7), (20.0, 1.5, 20.0)), 1.0) == ()


def test_corners_with_room_for_a_turn_each_are_not_joined() -> None:
    bends = pair(60.0, (0.7, 0.7), 1.0, 0.0)
    assert joins_worth_it(bends, wishes((0.2, 0.2), (5.0, 60.0, 5.0)), 1.0) == ()


def test_three_corners_close_together_are_one_turn_and_the_nearest_two_its_inner_one() -> None:
    bends = row([(0, 0), (20, 0), (21, 0.3), (23, 1.8), (40, 20)])
    (join,) = joins_worth_it(bends, wishes((0.3, 0.4, 0.3), (20.0, 1.1, 2.5, 25.0)), 1.0)
    assert (join.first, join.last) == (1, 3)
    assert join.inner is not None
    assert (join.inner.first, join.inner.last) == (1, 2)
    assert with_joins(bends, [join]).vias.tolist() == [0, DETOUR, 1]
    assert rest_of([join]).tolist() == [2, 3]


def test_in_a_long_row_pairs_are_joined_as_each_by_itself_would_be() -> None:
    """A row of more bends than a join is weighed with."""
    pairs = 40
    turns, gaps = (0.5, 0.7) * pairs, (20.0, *(1.5, 20.0) * pairs)
    along = np.concatenate(([0.0], np.cumsum(gaps))).tolist()
    asked = replace(wishes(turns, gaps), spent=10.0 * pairs)
    joins = joins_worth_it(row([(x, 0.0) for x in along]), asked, 1.0)
    assert [(join.first, join.last) for join in joins] == [
        (k, k + 1) for k in range(1, 2 * pairs, 2)
    ]
    (alone,) = joins_worth_it(
        pair(1.5, (0.7, 0.7), 1.0, 0.0), wishes((0.5, 0.7), (20.0, 1.5, 20.0)), 1.0
    )
    assert joins[pairs // 2].radius == pytest.approx(alone.radius, rel=0.05)


@pytest.mark.parametrize("count", [6, 26, 60])
@pytest.mark.parametrize("seed", range(4))
def test_joins_of_closed_rows_of_any_length_are_in_order(seed: int, count: int) -> None:
    """The last two of a part of a closed row were once looked for a turn behind its end."""
    random = np.random.default_rng(seed)
    turns, gaps = random.uniform(0.05, 0.6, count), random.uniform(0.5, 15.0, count)
    rows = np.array([bend(x, 0.0, 0.7, 1.0) for x in np.cumsum(gaps).tolist()])
    vias = np.where(np.arange(count) == 0, 0, DETOUR)
    bends = Bends(rows, vias, np.full(count, math.inf), closed=True)
    lengths = gentle_lengths(turns, 2.0 * gaps, True, 5.0)
    asked = TurnWishes(turns, gaps, lengths, np.full(count, 4.0), 5.0, np.full(count, 4.0))
    joins = joins_worth_it(bends, asked, 1.0)
    ends = [k for join in joins for k in (join.first, join.last)]
    assert ends == sorted(set(ends))


def test_a_corner_that_hardly_turns_is_not_joined_by_a_small_circle() -> None:
    bends = pair(4.0, (0.7, 0.7), 1.0, 0.0)
    assert joins_worth_it(bends, wishes((0.8, 0.003), (7.0, 4.0, 7.0)), 1.0) == ()


@pytest.mark.parametrize("seed", range(10))
def test_joins_bend_less_than_what_they_join(seed: int) -> None:
    random = np.random.default_rng(seed)
    count = int(random.integers(2, 7))
    turns, gaps = random.uniform(0.05, 0.6, count), random.uniform(0.5, 15.0, count + 1)
    along = np.concatenate(([0.0], np.cumsum(gaps)))
    asked = wishes(tuple(turns.tolist()), tuple(gaps.tolist()))
    apart = 4.0 / 3.0 * asked.turns**2 / np.maximum(asked.lengths, 1e-9)
    joins = joins_worth_it(row([(x, 0.0) for x in along.tolist()]), asked, 1.0)
    ends = [k for join in joins for k in (join.first, join.last)]
    assert ends == sorted(set(ends))
    for join in joins:
        turn, way = turns[join.first - 1 : join.last].sum(), along[join.last] - along[join.first]
        assert join.radius >= join.least >= way / turn * (1.0 - 1e-9)
        length = 2.0 * join.radius * turn - way
        bending = (length + 2.0 * way) / (3.0 * join.radius**2)
        assert bending < apart[join.first : join.last + 1].sum()


def test_a_join_without_room_gets_smaller_until_it_is_not_worth_it() -> None:
    joins = [Join(1, 2, 4.0, 2.0), Join(3, 4, 4.0, 2.0)]
    once = list(loosened(joins, {1}))
    assert [join.radius for join in once] == pytest.approx([2.8, 4.0])
    assert [join.first for join in loosened(once, {1})] == [3]


def test_of_a_join_that_gets_too_small_those_stay_that_were_joined_first() -> None:
    inner = Join(1, 2, 6.0, 2.0)
    assert list(loosened([Join(1, 3, 4.0, 3.9, inner)], {1})) == [inner]


def test_a_path_round_the_end_of_a_wall_is_one_turn_as_fast_as_two() -> None:
    wall = {"polygon": [[20.0, -40.0], [21.0, -40.0], [21.0, 0.0], [20.0, 0.0]]}
    mission = vs.Mission.model_validate({
        "world": {"known": [wall]},
        "robot": {"radius_m": 0.4, "clearance_m": 0.3, "max_speed_mps": 2.0,
                  "max_accel_mps2": 1.0, "max_lateral_accel_mps2": 1.0},
        "route": {"start": [0.0, -12.0], "goal": [41.0, -12.0]},
    })  # fmt: skip
    path = vs.plan(mission).path
    first, last = [via.u for via in path.vias if via.kind == "detour"]  # it touches both corners
    between = [path.curvature(u) for u in np.linspace(first, last, 21)]
    curvature = np.array([path.curvature(u) for u in np.linspace(0.0, len(path.spans), 2001)])
    assert np.abs(between).min() > 0.5 * np.abs(curvature).max()
    assert np.abs(curvature).max() < 1.0 / 3.9  # at full speed: 2² / 1 = 4 m


def test_no_path_winds_round_a_circle_that_its_ends_are_close_to() -> None:
    discs = [
        {"circle": {"center": [x, y], "radius": radius}}
        for x, y, radius in ((25, 1, 6), (50, -2, 7), (75, 3, 5), (50, 40, 6))
    ]
    data = {"world": {"known": discs}, "route": {"start": [0, 0], "goal": [100, 0]}}
    plan = vs.plan(vs.Mission.model_validate(data))
    at = plan.path.evaluate(np.linspace(*plan.path.domain, 500))
    assert plan.path.length < 102.5
    assert at[:, 1].max() < 1.0
