"""Lattices of worlds with maps: what they must not leave out."""

from typing import Any

import numpy as np
import pytest

from viaspline.detour.route import NO_BARRIERS, Router, Way
from viaspline.maps.grid import Grid
from viaspline.mission.parts import Obstacle
from viaspline.world.world import World

WALL = np.ones((1, 4), bool)


def way(world: World, start: Any, goal: Any, required: float = 0.2) -> Way | None:
    places = np.array([start, goal], float)
    active = np.zeros(len(world), np.bool_)
    return Router(world, required, places).find(*places, NO_BARRIERS, active)


def wall(yaw: float = 0.0) -> Obstacle:
    """Four blocked cells of 1 m in a row from (0, 0) on."""
    return Obstacle(grid=Grid(WALL, 1.0, (0.0, 0.0, yaw)))


@pytest.mark.parametrize("bounds", [None, (-3, -3, 6, 6), (-3.5, -3.25, 6.1, 6.7)])
@pytest.mark.parametrize("yaw", [0.0, 0.1])
def test_a_map_may_be_left_and_gone_round(bounds: Any, yaw: float) -> None:
    found = way(World([wall(yaw)], bounds=bounds), (2, -2), (2, 3))
    assert found is not None
    assert 5.0 < found.length < 9.0


@pytest.mark.parametrize("bounds", [(0, -3, 4, 6), (-0.3, -3, 4.3, 6)])
def test_nothing_leads_round_a_map_where_the_bounds_are_too_near(bounds: Any) -> None:
    assert way(World([wall()], bounds=bounds), (2, -2), (2, 3)) is None


def test_a_fence_on_a_map_is_kept_to() -> None:
    room = Obstacle(grid=Grid(np.zeros((9, 9), bool), 1.0, (0.0, 0.0, 0.0)))
    fence = [(0, 0), (9, 0), (9, 9), (6, 9), (6, 3), (3, 3), (3, 9), (0, 9)]
    found = way(World([room], fences=[fence]), (1.5, 8), (7.5, 8))
    assert found is not None
    assert found.length > 12.0
    assert way(World([room], fences=[fence]), (1.5, 8), (4.5, 8)) is None


def test_a_way_to_where_one_is_has_no_length() -> None:
    found = way(World([wall()]), (2, -2), (2, -2))
    assert found is not None
    assert found.length == 0.0
