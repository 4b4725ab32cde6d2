"""How far vehicles get beside their lines, against vehicles that are driven."""

import numpy as np
import shapely
from hypothesis import given
from hypothesis import strategies as st

from viaspline.exports.corner_cut import corner_strays

numbers = st.floats(-5, 5).map(lambda x: round(x, 2))


@given(
    st.lists(st.tuples(numbers, numbers), min_size=3, max_size=6, unique=True),
    st.sampled_from([0.1, 0.5, 2.0]),
    st.lists(st.floats(0, 1), min_size=6, max_size=6),
)
def test_a_vehicle_that_turns_anywhere_within_the_radius_stays_within_the_bound(
    corners: list[tuple[float, float]], radius: float, late: list[float]
) -> None:
    points = np.array(corners)
    strays = corner_strays(points, radius)
    at = points[0]
    for k, point in enumerate(points[1:]):
        way = point - at
        length = float(np.linalg.norm(way))
        ahead = min(late[k] * radius, length)  # it turns so far before the point
        end = point - (way / length * ahead if length > 0 else 0.0)
        if k == len(points) - 2:
            end = point
        drive = shapely.points(at + np.linspace(0, 1, 101)[:, None] * (end - at))
        near = shapely.LineString(points[max(k - 1, 0) : k + 2])
        assert shapely.distance(drive, near).max() <= strays[k] + 1e-9
        at = end


def test_gentle_corners_cost_little_and_none_costs_nothing() -> None:
    bend = np.array([[0, 0], [10, 0], [20, 1]], float)
    assert 0.09 < corner_strays(bend, 1.0).max() < 0.11
    assert not corner_strays(np.array([[0, 0], [10, 0], [20, 0]], float), 1.0).any()


def test_a_body_that_turns_beside_its_line_needs_more() -> None:
    bend = np.array([[0, 0], [10, 0], [20, 1]], float)
    assert corner_strays(bend, 1.0, 3.0).max() > corner_strays(bend, 1.0).max() + 0.2
