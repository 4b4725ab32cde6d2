"""What is wrong with polygons, each told at its place."""

from __future__ import annotations

from typing import Any

import pytest

from viaspline.mission.shapes.polygon import Polygon

TRIANGLE = ((1, 1), (5, 1), (1, 5))
SQUARE = ((0, 0), (9, 0), (9, 9), (0, 9))


@pytest.mark.parametrize(
    ("outer", "holes", "problem"),
    [
        (((0, 0), (2, 2), (2, 0), (0, 2)), (), "the polygon crosses itself at (1, 1)"),
        (((0, 0), (1, 1), (5, 5)), (), "the polygon has no area: its corners lie on one line"),
        (SQUARE, (((12, 8), (14, 8), (12, 7)),), "the polygon has a hole that reaches outside it"),
        (
            SQUARE,
            (((1, 1), (5, 1), (1, 5)), ((2, 2), (3, 2), (2, 2.5))),
            "has a hole inside a hole",
        ),
    ],
)
def test_a_polygon_that_covers_no_area_of_sense_is_told(
    outer: Any, holes: Any, problem: str
) -> None:
    [fault] = Polygon.faults([(("a",), Polygon(SQUARE)), (("b",), Polygon(outer, holes))])
    assert fault.path == ("b",)
    assert problem in fault.problem


def test_sound_polygons_have_no_faults() -> None:
    pierced = Polygon(SQUARE, (TRIANGLE,))
    assert Polygon.faults([(("a",), Polygon(SQUARE)), (("b",), pierced)]) == []
    assert Polygon.faults([]) == []
