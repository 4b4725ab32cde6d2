import numpy as np
import pytest

from viaspline.kernels.curve import frenet


def answer(kernel, spans, u, *flags, shape=()):
    out = np.full((len(u), *shape), np.nan)
    assert kernel(np.array(spans, float), np.array(u, float), *flags, out) == -1
    return out


LEFT = [[0, 0], [1, 0], [2, 0], [2, 1]]
BACK = [[2, 1], [2, 2], [2, 3], [2, 4]]


def test_both_sides_of_a_joint_can_be_asked_for():
    spans = [LEFT, BACK]
    right = answer(frenet.curvature, spans, [0, 1, 2], False, False)
    left = answer(frenet.curvature, spans, [0, 1, 2], False, True)
    assert right == pytest.approx([0, 0, 0])
    assert left == pytest.approx([0, 2 / 3, 0])


def test_the_seam_of_a_closed_curve_has_two_sides():
    spans = [LEFT, [[2, 1], [2, 2], [-1, 0], [0, 0]]]
    at_seam = [
        answer(frenet.curvature, spans, [u], True, left)[0]
        for left in (False, True)
        for u in (0, 2)
    ]
    assert at_seam[0] == at_seam[1]
    assert at_seam[2] == at_seam[3]
    assert at_seam[0] != at_seam[2]


def test_the_first_parameter_outside_is_told():
    spans = np.array([LEFT], float)
    u = np.array([0.5, 1.5])
    assert frenet.curvature(spans, u, False, False, np.empty(2)) == 1
    assert frenet.direction(spans, u, False, np.empty((2, 2))) == 1


def test_directions_are_of_length_one_and_limits_where_the_speed_vanishes():
    spans = [[[0, 0], [0, 0], [3, 4], [3, 4]]]
    found = answer(frenet.direction, spans, [0, 0.5, 1], False, shape=(2,))
    assert found == pytest.approx(np.array([[0.6, 0.8]] * 3))


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_a_point_has_neither_direction_nor_curvature(dimension):
    spans = np.ones((1, 4, dimension))
    assert np.array_equal(
        answer(frenet.direction, spans, [0.5], False, shape=(dimension,)), np.zeros((1, dimension))
    )
    assert answer(frenet.curvature, spans, [0.5], False, False)[0] == 0.0


def test_curvature_at_rest_is_zero_or_infinite():
    cusp = np.array([[[0.0, 0], [0, 0], [1, 0], [2, 1]]])
    assert frenet.curvature_at(cusp, 0, 0.0) == np.inf
    assert frenet.curvature_at(cusp * [1.0, -1.0], 0, 0.0) == -np.inf
    straight = np.array([[[0.0, 0, 0], [0, 0, 0], [1, 1, 1], [1, 1, 1]]])
    assert frenet.curvature_at(straight, 0, 0.0) == 0.0
    assert frenet.curvature_at(straight, 0, 1.0) == 0.0
