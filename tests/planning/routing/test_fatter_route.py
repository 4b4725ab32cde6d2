"""Routes for robots that cells are wide beside."""

from __future__ import annotations

import numpy as np
import pytest

import viaspline as vs
from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.routing.fatter_route import FatterRoute
from viaspline.planning.routing.lattice_route import LatticeRoute
from viaspline.planning.routing.route_problem import NO_BARRIERS, RouteProblem, SearchSpace
from viaspline.world.world import World

SIDE = 30.0
SLIM = 0.01  # cells of a lattice of this world are 5.2 mm wide at least


def through_a_gap(gap: float, required: float = SLIM) -> RouteProblem:
    """Across a wall with a gap, from one side of a square to the other."""
    low, high = 0.5 * (SIDE - gap), 0.5 * (SIDE + gap)
    walls = [
        vs.Obstacle(polygon=[(14.0, a), (15.0, a), (15.0, b), (14.0, b)])
        for a, b in ((-1.0, low), (high, SIDE + 1.0))
    ]
    ends = np.array([(1.0, 15.0), (29.0, 15.0)])
    world = World(walls, bounds=(0.0, 0.0, SIDE, SIDE))
    space = SearchSpace(world, required, ends)
    return RouteProblem(space, *ends, NO_BARRIERS, np.zeros(2, np.bool_))


def test_a_slim_robot_finds_the_gap_that_one_a_little_fatter_finds() -> None:
    problem = through_a_gap(0.022)
    assert isinstance(LatticeRoute().lay(problem), GaveUp)  # cells take two of it at either side
    found = FatterRoute().lay(problem)
    assert isinstance(found, Found)
    assert found.value.length == pytest.approx(28.0)


def test_what_is_too_narrow_for_the_fatter_one_is_not_ruled_out() -> None:
    assert isinstance(FatterRoute().lay(through_a_gap(0.0204)), GaveUp)


def test_one_that_cells_are_small_beside_has_nobody_to_follow() -> None:
    problem = through_a_gap(0.3, 0.1)
    assert problem.space.of_fatter is None
    assert FatterRoute().lay(problem) == GaveUp(())
