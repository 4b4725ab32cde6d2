"""What is handed in for a world, or asked of one, and makes no sense."""

import math
from typing import Any

import pytest

from viaspline.errors import GeometryError
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.world import World

DISC = Obstacle(circle=Circle(center=(0.0, 0.0), radius=1.0))


@pytest.mark.parametrize(
    ("points", "words"),
    [
        (5.0, "shape"),
        ([1.0, 2.0, 3.0, 4.0], "shape"),
        ([[1.0], [2.0]], "shape"),
        ([(0.0, math.nan)], "NaN"),
        ([(math.inf, 0.0)], "infinity"),
    ],
)
def test_points_that_make_no_sense_are_refused(points: Any, words: str) -> None:
    with pytest.raises(GeometryError, match=words):
        World([DISC]).distance(points)


@pytest.mark.parametrize(
    "bounds", [(0, 0, 0, 5), (5, 0, 0, 5), (0, 0, math.nan, 5), (0, 0, math.inf, 5), (0, 0, 5)]
)
def test_bounds_that_enclose_nothing_are_refused(bounds: Any) -> None:
    with pytest.raises(GeometryError, match="bounds"):
        World(bounds=bounds)


@pytest.mark.parametrize("index", [-2, -1, 1, 10_000_000])
def test_an_obstacle_that_is_not_there_has_no_distance(index: int) -> None:
    with pytest.raises(GeometryError, match="no obstacle"):
        World([DISC]).distances_to(index, [(0, 0)])


def test_an_obstacle_without_a_shape_is_refused() -> None:
    with pytest.raises(GeometryError, match="no shape"):
        World([Obstacle()])
