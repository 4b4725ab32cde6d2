"""The exact search, its budget, and what it finds beside the lattice."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.routing.exact_route import ExactRoute
from viaspline.planning.routing.lattice_route import LatticeRoute
from viaspline.planning.routing.route_problem import NO_BARRIERS, RouteProblem, on_the_line
from viaspline.planning.routing.router import MAX_EXACT_AGAIN, Router
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


def test_maps_have_no_tangents() -> None:
    world = World([Obstacle(grid=Grid(np.zeros((9, 9), bool), 1.0, (0.0, 0.0, 0.0)))])
    assert isinstance(ExactRoute().lay(problem(world, (1, 1), (8, 8))), GaveUp)


def test_what_gains_too_little_is_left(row: World) -> None:
    asked = problem(row, (0, 0), (60, 0))
    length = ExactRoute().lay(asked).cost
    assert isinstance(ExactRoute(least_gain=0.01).lay(asked, 1.009 * length), GaveUp)
    assert isinstance(ExactRoute(least_gain=0.01).lay(asked, 1.011 * length), Found)


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
