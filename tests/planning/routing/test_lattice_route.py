"""Routes through lattices: found, refused or given up."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.method import Found, GaveUp, Refusal
from viaspline.planning.routing.lattice_route import LatticeRoute
from viaspline.planning.routing.pulled_guides import MOST_KEPT, PulledGuide, PulledGuides
from viaspline.planning.routing.route_problem import NO_BARRIERS, RouteProblem, SearchSpace
from viaspline.world.world import World

BOUNDS = (0.0, 0.0, 40.0, 40.0)
REQUIRED = 1.0


def rectangle(x0: float, y0: float, x1: float, y1: float) -> Obstacle:
    return Obstacle(polygon=[(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def slotted(*widths: float) -> World:
    """A wall across everything, with slots of these widths."""
    middles = np.linspace(4.0, 36.0, len(widths))
    edges = [0.0]
    for middle, width in zip(middles.tolist(), widths, strict=True):
        edges += [middle - 0.5 * width, middle + 0.5 * width]
    edges.append(40.0)
    pieces = zip(edges[::2], edges[1::2], strict=True)
    return World([rectangle(19, low, 21, high) for low, high in pieces], bounds=BOUNDS)


def problem(world: World) -> RouteProblem:
    start, goal = np.array([5.0, 20.0]), np.array([35.0, 20.0])
    space = SearchSpace(world, REQUIRED, np.array([start, goal]))
    return RouteProblem(space, start, goal, NO_BARRIERS, np.zeros(len(world), np.bool_))


def outcome(world: World, **budget: Any) -> Any:
    return LatticeRoute(**budget).lay(problem(world))


def test_a_slot_that_is_wide_enough_is_found_behind_those_that_are_not() -> None:
    found = outcome(slotted(1.9, 1.95, 1.98, 1.9, 2.05))
    assert isinstance(found, Found)
    places = found.value.corners[:, :2]
    at_wall = np.interp(20.0, places[:, 0], places[:, 1])
    assert at_wall == pytest.approx(36.0, abs=0.1)


def test_slots_that_are_all_too_narrow_are_a_refusal() -> None:
    assert isinstance(outcome(slotted(1.9, 1.95, 1.98)), Refusal)


def test_a_wall_without_a_slot_is_a_refusal() -> None:
    assert isinstance(outcome(slotted()), Refusal)


@pytest.mark.parametrize("last", [1.999, 2.05])
def test_a_budget_that_runs_out_proves_nothing(last: float) -> None:
    told = outcome(slotted(*[1.999] * 9, last), max_gaps=1)
    assert isinstance(told, GaveUp)
    assert "1 gaps" in told.tried[0]
    assert told.would_help


def test_cells_that_are_wider_than_the_robot_prove_nothing() -> None:
    wall = rectangle(50_000.0, 0.0, 50_001.0, 99_999.9)
    world = World([wall], bounds=(0.0, 0.0, 1e5, 1e5))
    start, goal = np.array([1e4, 5e4]), np.array([9e4, 5e4])
    space = SearchSpace(world, 0.01, np.array([start, goal]))
    told = LatticeRoute().lay(RouteProblem(space, start, goal, NO_BARRIERS, np.zeros(1, np.bool_)))
    assert isinstance(told, GaveUp)
    assert "too wide" in told.tried[0]


def test_what_is_not_shorter_than_asked_for_is_left() -> None:
    world = World([], bounds=BOUNDS)
    assert LatticeRoute().lay(problem(world), 29.0).value is None
    found = LatticeRoute().lay(problem(world), 31.0)
    assert isinstance(found, Found)
    assert found.cost == pytest.approx(30.0)


def test_what_a_route_goes_round_is_marked_as_met() -> None:
    world = World([rectangle(19, 15, 21, 25), rectangle(1, 1, 2, 2)], bounds=BOUNDS)
    asked = problem(world)
    assert LatticeRoute().lay(asked).value is not None
    assert asked.active.tolist() == [True, False]


def at_wall(route: Any) -> float:
    """Where a route passes the wall in the middle [m]."""
    places = route.value.corners[:, :2]
    return float(np.interp(20.0, places[:, 0], places[:, 1]))


def test_gaps_that_one_route_found_too_narrow_are_closed_for_the_next_one() -> None:
    asked = problem(slotted(1.9, 2.05, 1.98, 1.95, 2.05))
    first = LatticeRoute().lay(asked)
    gaps = asked.space.pulled.known_gaps
    assert at_wall(first) == pytest.approx(12.0, abs=0.1)
    assert len(gaps)
    assert (np.hypot(*(gaps[:, 2:] - gaps[:, :2]).T) < 2.0 * REQUIRED).all()
    again = LatticeRoute().lay(asked)
    np.testing.assert_array_equal(again.value.corners, first.value.corners)
    shut = np.array([[20.0, 10.0, 20.0, 14.0]])
    other = LatticeRoute().lay(replace(asked, barriers=shut))
    alone = LatticeRoute().lay(replace(problem(asked.space.world), barriers=shut))
    assert at_wall(other) == pytest.approx(36.0, abs=0.1)
    assert other.cost == pytest.approx(alone.cost)


def test_known_gaps_prove_nothing_more_than_all_gaps_do() -> None:
    asked = problem(slotted(1.9, 1.95, 1.98))
    assert isinstance(LatticeRoute().lay(asked), Refusal)
    assert len(asked.space.pulled.known_gaps)
    assert isinstance(LatticeRoute().lay(asked), Refusal)


def test_among_made_lattices_no_other_is_made() -> None:
    asked, made = problem(slotted(2.05)), LatticeRoute(lattices=SearchSpace.made_lattices)
    assert isinstance(made.lay(asked), GaveUp)
    assert not asked.space.has_lattice
    found = LatticeRoute().lay(asked)
    assert isinstance(found, Found)
    assert made.lay(asked).value is found.value


def test_what_came_of_guides_is_let_go_when_there_are_many() -> None:
    guides, nothing = PulledGuides(), PulledGuide(None, NO_BARRIERS)
    asked: list[int] = []
    for k in (*range(MOST_KEPT), 0, MOST_KEPT, 0):
        guides.once(np.full((2, 2), float(k)), 1.0, lambda k=k: asked.append(k) or nothing)
    assert asked == [*range(MOST_KEPT), MOST_KEPT, 0]
