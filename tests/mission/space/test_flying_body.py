"""The gap of two bodies in space, against points sampled on both."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.space.flying_body import FlyingBody

sizes = st.tuples(st.floats(0.1, 2), st.floats(0.05, 1), st.floats(0, 0.5))
balls = st.builds(lambda radius: (0.0, 0.0, radius), st.floats(0.1, 2))
coordinates = st.floats(-8, 8)


def nearest(body: FlyingBody, at: np.ndarray, there: np.ndarray) -> np.ndarray:
    """The place of a cylinder, without its margin, that is nearest to a place."""
    off = there - at
    level = float(np.hypot(off[0], off[1]))
    share = min(1.0, body.radius / level) if level > 0.0 else 0.0
    up = float(np.clip(off[2], -body.half_height, body.half_height))
    return np.array([at[0] + share * off[0], at[1] + share * off[1], at[2] + up])


@given(one=sizes | balls, other=sizes | balls,
       offset=st.tuples(coordinates, coordinates, coordinates))  # fmt: skip
def test_the_gap_is_the_distance_of_the_nearest_places_of_both_bodies(
    one: tuple[float, float, float], other: tuple[float, float, float],
    offset: tuple[float, float, float],
) -> None:  # fmt: skip
    a, b = FlyingBody(*one), FlyingBody(*other)
    here, there = np.zeros(3), np.array(offset)
    first, second = here, there
    for _ in range(400):  # projections onto two convex sets in turn
        first = nearest(a, here, second)
        second = nearest(b, there, first)
    apart = float(np.linalg.norm(first - second)) - a.margin - b.margin
    gap = float(a.gaps(b, there[None])[0])
    assert gap == pytest.approx(apart, abs=2e-2)
    assert gap <= apart + 1e-9
    assert gap == pytest.approx(float(b.gaps(a, -there[None])[0]))


def test_the_ball_about_a_body_holds_it() -> None:
    body = FlyingBody.of(RobotSpec(radius_m=0.3, half_height_m=0.4, tracking_error_m=0.1))
    assert body.outermost == pytest.approx(0.6)
    assert body.beside == pytest.approx(0.4)
