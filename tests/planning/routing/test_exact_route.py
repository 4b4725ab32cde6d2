"""The exact search, its budget, and what it finds beside the lattice."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.routing.exact_route import ExactRoute
from viaspline.planning.routing.lattice_route import LatticeRoute
from viaspline.planning.routing.route_problem import NO_BARRIERS, RouteProblem, on_the_line
from viaspline.planning.routing.router import MAX_EXACT_AGAIN, Router
from viaspline.planning.routing.taut_path import TautPath
from viaspline.world.world import World

REQUIRED = 0.5


def disc(x: float, y: float, radius: float) -> Obstacle:
    return Obstacle(circle={"center": (float(x), float(y)), "radius": float(radius)})


def problem(world: World, start: Any, goal: Any) -> RouteProblem:
    places = np.array([start, goal], float)
    active = on_the_line(world, *places, REQUIRED)
    return RouteProblem(Router(world, REQUIRED, places), *places, NO_BARRIERS, active)


@pytest.fixture(scope="module")
def row() -> World:
    return World([disc(10.0 * k, 0.1, 2.0) for k in range(1, 6)])


def test_a_row_of_discs_is_passed_as_the_tangents_say(row: World) -> None:
    found = ExactRoute().lay(problem(row, (0, 0), (60, 0)))
    assert isinstance(found, Found)
    leaves = np.arccos(2.5 / np.hypot(10, 0.1))  # between the foot of a tangent and the start
    low = 2 * 10.0 * np.sin(leaves) + 40.0
    assert low < found.cost < low + 2 * 2.5 * 0.5


def test_more_obstacles_than_allowed_prove_nothing(row: World) -> None:
    told = ExactRoute(max_met=4).lay(problem(row, (0, 0), (60, 0)))
    assert told == GaveUp(("the tangents of 5 obstacles, of at most 4",))


def test_few_obstacles_are_left_to_the_others_where_that_is_said(row: World) -> None:
    assert isinstance(ExactRoute(more_than=5).lay(problem(row, (0, 0), (60, 0))), GaveUp)
    assert isinstance(ExactRoute(more_than=4).lay(problem(row, (0, 0), (60, 0))), Found)


@pytest.mark.parametrize("way", [(10, 0), (-10, 0), (0, 10), (0, -10), (8, 6), (-6, 8)])
@pytest.mark.parametrize("end", [-1.0, 1.0])
def test_a_wall_is_gone_round_at_its_nearer_end_however_it_lies(way: Any, end: float) -> None:
    along = np.array(way) / 10.0
    across = np.array([-along[1], along[0]])
    wall = Obstacle(capsule={"from": tuple(-5.0 * along), "to": tuple(5.0 * along), "radius": 0.5})
    sides = [3.0 * end * along + away * across for away in (-3.0, 3.0)]
    found = ExactRoute().lay(problem(World([wall]), *sides))
    leaves = np.hypot(2.0, 3.0)  # from the end of the wall
    turned = np.pi - 2.0 * (np.arccos(1.0 / leaves) - np.arctan2(2.0, 3.0))
    assert found.cost == pytest.approx(2.0 * np.sqrt(leaves**2 - 1.0) + turned, abs=0.01)


@given(st.integers(0, 100_000))
@example(9)
@example(46)
def test_far_from_the_origin_the_same_route_is_found(seed: int) -> None:
    """As in UTM: what is a millionth of a millimetre there mustn't decide on a corner."""
    rng = np.random.default_rng(seed)
    places, radii = rng.uniform(2, 18, (10, 2)), rng.uniform(0.1, 2.0, 10)
    ends = np.array([(0.0, 0.0), (20.0, 20.0)])
    lengths = []
    for origin in ((0.0, 0.0), (5e5, 5.2e6)):
        at = places + origin
        world = World([disc(*middle, radius) for middle, radius in zip(at, radii, strict=True)])
        found = ExactRoute().lay(problem(world, *(ends + origin)))
        lengths.append(found.cost if isinstance(found, Found) else np.inf)
    assert lengths[0] == pytest.approx(lengths[1], abs=1e-6)


def test_maps_have_no_tangents() -> None:
    world = World([Obstacle(grid=Grid(np.zeros((9, 9), bool), 1.0, (0.0, 0.0, 0.0)))])
    assert isinstance(ExactRoute().lay(problem(world, (1, 1), (8, 8))), GaveUp)


def test_what_gains_too_little_is_left(row: World) -> None:
    asked = problem(row, (0, 0), (60, 0))
    length = ExactRoute().lay(asked).cost
    assert isinstance(ExactRoute(least_gain=0.01).lay(asked, 1.009 * length), GaveUp)
    assert isinstance(ExactRoute(least_gain=0.01).lay(asked, 1.011 * length), Found)


def test_an_end_within_what_corners_stand_out_proves_no_route_the_shortest() -> None:
    """It has no tangent to them there, and the route leads away from it first."""
    world = World([disc(0.0, 0.0, 2.0)])
    far, near = (problem(world, (x, 0.0), (-9.0, 1.0)) for x in (2.6, 2.51))
    found = [ExactRoute().lay(asked) for asked in (far, near)]
    assert all(isinstance(one, Found) for one in found)
    assert [one.is_settled for one in found if isinstance(one, Found)] == [True, False]


def test_bends_that_are_longer_than_their_corners_are_wound() -> None:
    corners = np.zeros((4, 8))
    corners[:, :2] = (0, 0), (1, 0.1), (2, 0.1), (3, 0)  # 3.00998 m
    bends = np.zeros((2, 6))
    assert not TautPath(corners, bends, 3.009).is_wound
    assert TautPath(corners, bends, 3.03).is_wound


@settings(max_examples=25)
@given(st.integers(0, 100_000))
def test_the_router_takes_the_better_of_both_searches(seed: int) -> None:
    rng = np.random.default_rng(seed)
    places, radii = rng.uniform(0, 100, (250, 2)), rng.uniform(0.5, 3.0, 250)
    world = World([disc(*at, radius) for at, radius in zip(places, radii, strict=True)])
    ends = rng.uniform(2, 98, (400, 2))
    ends = ends[world.distance(ends) > REQUIRED + 0.01][[0, -1]]
    asked = problem(world, *ends)
    found = Router(world, REQUIRED, ends).find(*ends, NO_BARRIERS, asked.active.copy())
    lengths = [
        method.lay(problem(world, *ends))
        for method in (LatticeRoute(), ExactRoute(max_met=MAX_EXACT_AGAIN))
    ]
    known = [one.cost for one in lengths if isinstance(one, Found)]
    if known:
        assert isinstance(found, Found)
        assert found.cost <= min(known) * (1.0 + 1e-3)
