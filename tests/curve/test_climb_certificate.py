import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.climb_certificate import CLIMB_TOLERANCE_RAD, certify_climb
from viaspline.errors import GeometryError

seeds = st.integers(0, 100_000)


@given(seeds)
def test_angles_are_proven_and_within_a_tenth_of_a_milliradian(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.uniform(0, 50, (rng.integers(2, 7), 3)) * (1, 1, rng.choice([0.02, 0.3, 2]))
    curve = CardinalSpline(points, slack=float(rng.choice([0.0, 0.2, 0.5])))
    found = certify_climb(curve)
    u = np.linspace(0, len(curve.spans), 40_001)
    velocity = np.asarray(curve.evaluate(u, 1))
    moves = np.linalg.norm(velocity, axis=1) > 1e-9
    angle = np.arctan2(velocity[:, 2], np.hypot(velocity[:, 0], velocity[:, 1]))[moves]
    for bound, at, sign in ((found.climb, found.climb_u, 1), (found.descent, found.descent_u, -1)):
        steepest = max((sign * angle).max(), 0.0)
        assert steepest - 1e-9 <= bound
        there = sign * np.asarray(curve.evaluate(at, 1))
        reached = math.atan2(there[2], math.hypot(there[0], there[1])) if there.any() else 0.0
        assert bound <= max(reached, steepest, 0.0) + CLIMB_TOLERANCE_RAD + 1e-9


def test_a_straight_climb_has_its_own_angle_though_it_begins_and_ends_at_rest() -> None:
    found = certify_climb(CardinalSpline([(0, 0, 0), (30, 40, 50)], tension=1.0))
    assert found.climb == pytest.approx(math.pi / 4, abs=1e-12)
    assert found.descent == 0.0
    assert found.keeps(math.pi / 4 + 1e-9, 0.0)
    assert not found.keeps(0.7, 0.0)


def test_an_upright_curve_climbs_uprightly() -> None:
    found = certify_climb(CardinalSpline([(3, 4, 0), (3, 4, 10)]))
    assert found.climb == math.pi / 2
    assert found.descent == 0.0


def test_a_level_curve_climbs_nowhere() -> None:
    found = certify_climb(CardinalSpline([(0, 0, 7), (5, 9, 7), (10, 0, 7)]))
    assert found.climb == 0.0
    assert found.descent == 0.0


def test_a_curve_that_turns_back_in_plan_while_it_climbs_is_upright_there() -> None:
    found = certify_climb(CardinalSpline([(0, 0, 0), (10, 0, 5), (0, 0, 10)]))
    assert found.climb == pytest.approx(math.pi / 2)
    assert found.climb_u == pytest.approx(1.0, abs=1e-3)


def test_a_curve_in_the_plane_climbs_nowhere_and_says_so() -> None:
    with pytest.raises(GeometryError, match="dimension 2"):
        certify_climb(CardinalSpline([(0, 0), (1, 0)]))
