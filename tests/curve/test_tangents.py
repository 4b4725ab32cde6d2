from itertools import pairwise

import numpy as np
import pytest

from viaspline.curve.tangents import ALPHA, RULES

NOWHERE = np.zeros(2)


def spans(rule, points, alpha=1.0, slack=0.5, closed=False):
    points = np.array(points, float)
    count = len(points) if closed else len(points) - 1
    return RULES[rule](points, alpha, np.full(count, slack), NOWHERE, NOWHERE, False, False, closed)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("alpha", ALPHA.values())
@pytest.mark.parametrize("closed", [False, True])
def test_every_rule_reduces_to_the_polyline_at_slack_zero(rule, alpha, closed):
    polygons = spans(rule, [(0, 0), (3, 1), (4, 5)], alpha, 0.0, closed)
    points = np.array([(0, 0), (3, 1), (4, 5), (0, 0)], float)
    legs = polygons.reshape(3 if closed else 2, -1, 2)
    for leg, (a, b) in zip(legs, pairwise(points), strict=False):
        along = (leg - a) @ (b - a) / np.dot(b - a, b - a)
        assert np.abs(leg - a - along[:, None] * (b - a)).max() < 1e-12
        assert (np.diff(along) > -1e-12).all()


@pytest.mark.parametrize("rule", RULES)
def test_every_rule_ends_in_a_straight_line_between_two_points(rule):
    polygon = spans(rule, [(0, 0), (3, 6)])[0]
    assert polygon[1] == pytest.approx(polygon[1, 0] * np.array([1, 2]))
    assert polygon[1, 0] > 0.0
