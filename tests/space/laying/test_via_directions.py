import numpy as np

from viaspline.curve.cardinal import CardinalSpline
from viaspline.space.laying.via_directions import via_directions

FREE = np.full((4, 3), np.nan)


def test_the_direction_at_a_via_point_is_that_of_the_cardinal_spline_through_its_neighbours() -> (
    None
):
    vias = np.random.default_rng(3).normal(0, 10, (4, 3))
    ways = via_directions(vias, [None, np.empty((0, 3)), None], FREE)
    spline = CardinalSpline(vias, knots="chordal")
    assert np.isnan(ways[[0, 3]]).all()
    assert np.allclose(ways[1:3], spline.tangent([1.0, 2.0]))


def test_detours_are_neighbours_and_a_direction_that_is_given_stays() -> None:
    vias = np.array([[0.0, 0, 0], [10, 0, 0], [20, 0, 0], [30, 0, 0]])
    fixed = FREE.copy()
    fixed[2] = (0.0, 0.0, 1.0)
    ways = via_directions(vias, [None, np.array([[10.0, 10, 0], [15, 0, 0]]), None], fixed)
    assert np.allclose(ways[1], np.sqrt(0.5) * np.array([1, 1, 0]))
    assert np.array_equal(ways[2], fixed[2])


def test_where_the_way_turns_right_back_the_direction_is_free() -> None:
    vias = np.array([[0.0, 0, 0], [10, 0, 0], [0, 0, 0], [30, 0, 0]])
    ways = via_directions(vias, [np.empty((0, 3))] * 3, FREE)
    assert np.isnan(ways[1]).all()
