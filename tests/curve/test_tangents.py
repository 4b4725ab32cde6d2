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
    assert np.array_equal(polygons[:, 0], polygons[:, 1])
    assert np.array_equal(polygons[:, 2], polygons[:, 3])


@pytest.mark.parametrize("rule", RULES)
def test_every_rule_ends_in_a_straight_line_between_two_points(rule):
    polygon = spans(rule, [(0, 0), (3, 6)])[0]
    assert polygon[1] == pytest.approx(polygon[1, 0] * np.array([1, 2]))
    assert polygon[1, 0] > 0.0


@pytest.mark.parametrize("slack", [0.05, 0.5, 1.0, 4.0])
@pytest.mark.parametrize("closed", [False, True])
def test_the_continuous_rule_solves_the_system_of_its_derivation(slack, closed):
    points = np.random.default_rng(3).normal(size=(6, 2))
    polygons = spans("continuous", points, 1.0, slack, closed)
    following = np.roll(points, -1, axis=0)[: len(polygons)]
    h = np.linalg.norm(following - points[: len(polygons)], axis=1)
    slope = (following - points[: len(polygons)]) / h[:, None]
    velocity = 3 * (polygons[:, 1] - polygons[:, 0]) / h[:, None]
    ahead = 3 * (polygons[:, 3] - polygons[:, 2]) / h[:, None]
    tension = 1 - 2 * slack
    factor = (2 - tension) / (1 - tension)
    for i in range(0 if closed else 1, len(polygons)):
        a = h[i] / (h[i - 1] + h[i])
        left = a * velocity[i - 1] + factor * velocity[i] + (1 - a) * ahead[i]
        assert left == pytest.approx(3 * (a * slope[i - 1] + (1 - a) * slope[i]))
