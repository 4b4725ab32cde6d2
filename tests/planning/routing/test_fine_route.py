"""Gaps that are hardly wider than a robot that is tiny beside what it goes round."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.routing.fine_route import FineRoute
from viaspline.planning.routing.route_problem import NO_BARRIERS, RouteProblem, on_the_line
from viaspline.planning.routing.router import Router
from viaspline.world.world import World

SIDE = 20.0
ENDS = np.array([(19.8, 16.6), (0.3, 1.9)])


def asked(gap: float, required: float, at: float = 0.2) -> RouteProblem:
    """A wall across a square with a gap whose ends are round."""
    rows = [((0.0, 8.0), (at, 8.0)), ((at + 2.0 + gap, 8.0), (SIDE, 8.0))]
    walls = [Obstacle(capsule={"from": a, "to": b, "radius": 1.0}) for a, b in rows]
    world = World(walls, bounds=(0.0, 0.0, SIDE, SIDE))
    active = on_the_line(world, *ENDS, required)
    return RouteProblem(Router(world, required, ENDS), *ENDS, NO_BARRIERS, active)


@given(st.floats(0.5e-3, 0.1), st.floats(5e-4, 0.1), st.floats(0.1, 15.0))
@example(required=0.004, spare=0.002, at=0.2)
def test_a_way_is_found_that_is_half_a_millimetre_wider_than_is_needed(
    required: float, spare: float, at: float
) -> None:
    problem = asked(2.0 * required + spare, required, at)
    found = FineRoute(max_met=9).lay(problem)
    assert isinstance(found, Found)
    places = found.value.corners[:, :2]
    parts = np.linspace(places[:-1], places[1:], 200).reshape(-1, 2)
    assert problem.space.world.distance(parts).min() > required - 1e-6
    assert found.cost < np.hypot(*np.diff(places, axis=0).T).sum() + 1e-9


def test_the_router_asks_for_it_where_cells_are_too_wide() -> None:
    problem = asked(0.0085, 0.004)
    router = problem.space
    assert isinstance(router, Router)
    blunt = Router(router.world, router.required, ENDS, methods=router.methods[:-2])
    assert isinstance(blunt.find(*ENDS, NO_BARRIERS, problem.active.copy()), GaveUp)
    found = router.find(*ENDS, NO_BARRIERS, problem.active)
    assert isinstance(found, Found)
    assert found.cost == pytest.approx(26.895, abs=0.01)


def test_what_is_found_already_is_left_as_it_is() -> None:
    assert isinstance(FineRoute(max_met=9).lay(asked(0.1, 0.004), 30.0), GaveUp)


def test_too_narrow_a_gap_is_given_up() -> None:
    assert isinstance(FineRoute(max_met=9).lay(asked(0.010, 0.0051)), GaveUp)
