"""Steered wheels: a circle that is their tightest, and no turn on the spot."""

from __future__ import annotations

import math

import pytest

from viaspline.mission.drives.ackermann import Ackermann


@pytest.mark.parametrize(("wheelbase", "steer"), [(1.0, 30.0), (2.7, 35.0), (0.3, 80.0)])
def test_at_full_lock_a_bicycle_drives_its_tightest_circle(wheelbase: float, steer: float) -> None:
    kind = Ackermann(wheelbase_m=wheelbase, max_steer_deg=steer)
    front = complex(wheelbase, 0.0)  # the front axle moves square to its line to the centre
    centre = complex(0.0, kind.turn_radius)
    heading = math.radians(steer)
    way = complex(math.cos(heading), math.sin(heading))
    assert ((centre - front) * way.conjugate()).real == pytest.approx(0.0, abs=1e-12)
    assert not kind.can_turn_on_spot


def test_a_steering_rate_is_asked_of_the_time_law_with_its_wheelbase() -> None:
    kind = Ackermann(wheelbase_m=1.5, max_steer_deg=30, max_steer_rate_degps=90)
    limits = kind.limits(2.0, 1.0)
    assert limits.max_steer_rate == pytest.approx(math.pi / 2)
    assert limits.wheelbase == 1.5
    assert Ackermann(wheelbase_m=1.5, max_steer_deg=30).limits(2.0, 1.0).wheelbase is None
