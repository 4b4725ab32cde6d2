import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.space.laying.via_directions import via_directions

FREE = np.full((4, 3), np.nan)


def test_the_direction_at_a_via_point_is_that_of_the_cardinal_spline_through_its_neighbours() -> (
    None
):
    vias = (
        np.random.default_rng(3).normal(0, 10, (4, 3)) + 30 * np.eye(3)[0] * np.arange(4)[:, None]
    )
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


@given(
    turn=st.floats(0.0, 3.1), up=st.floats(-1.0, 1.0),
    back=st.floats(0.1, 100.0), on=st.floats(0.1, 100.0),
)  # fmt: skip
def test_the_direction_is_never_against_the_way_there_or_on(
    turn: float, up: float, back: float, on: float
) -> None:
    """Where 45 m came and 44 m went on nearly back, a curve ran 14 m past the via point."""
    to = np.array([np.cos(turn), np.sin(turn), up]) / np.hypot(1.0, up)
    vias = np.array([[-back, 0, 0], [0, 0, 0], on * to])
    way = via_directions(vias, [np.empty((0, 3)), None], FREE[:3])[1]
    assert way[0] >= -1e-9
    assert way @ to >= -1e-9
