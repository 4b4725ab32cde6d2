"""A path as points for a controller: close together, with headings that run on."""

from __future__ import annotations

import numpy as np
import pytest

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.machine.reference import reference_path_of
from viaspline.machine.turns_on_spot import corners


def test_points_lie_on_the_path_and_close_together() -> None:
    path = CardinalSpline([(0, 0), (3, 5), (9, 4), (4, -6)])
    reference = reference_path_of(path)
    places = np.asarray(path.at_distance(reference.distance))
    assert np.hypot(reference.x - places[:, 0], reference.y - places[:, 1]).max() < 1e-6
    assert np.diff(reference.distance).max() < 0.3


def test_headings_run_on_over_whole_turns() -> None:
    angle = np.linspace(0.0, 4.0 * np.pi, 41)
    spiral = CardinalSpline(
        np.column_stack(((1 + angle) * np.cos(angle), (1 + angle) * np.sin(angle)))
    )
    headings = reference_path_of(spiral).heading
    assert np.abs(np.diff(headings)).max() < 0.2
    assert headings[-1] - headings[0] > 3.5 * np.pi


@pytest.mark.parametrize("beyond", [0.002, 0.1, 1.0, 5.0])
def test_a_cusp_inside_of_a_span_has_two_points_with_opposite_headings(beyond: float) -> None:
    there_and_back = CardinalSpline([(0, 0), (10, 0), (beyond, 0)])
    reference = reference_path_of(there_and_back)
    at, angle = corners(there_and_back)
    assert angle.tolist() == [np.pi]
    after = int(np.searchsorted(reference.distance, float(at[0]) + 1e-10))
    assert reference.distance[after - 2] == reference.distance[after - 1] == pytest.approx(at[0])
    assert np.cos(reference.heading[: after - 1]) == pytest.approx(1.0)
    assert np.cos(reference.heading[after - 1 :]) == pytest.approx(-1.0)


def test_a_path_in_space_is_refused() -> None:
    with pytest.raises(GeometryError, match="in the plane"):
        reference_path_of(PiecewiseCubic([[[0, 0, 0], [1, 0, 0], [2, 0, 1], [3, 0, 1]]]))
