"""What wheels on two sides leave for turning."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from viaspline.mission.drives.drive_limits import DriveLimits, limits_of_sides

SIZE = st.floats(0.01, 100.0)


@given(SIZE, SIZE, st.floats(0.05, 1.0), SIZE)
def test_at_full_speed_and_full_yaw_rate_the_outer_wheel_is_at_its_limit(
    max_speed: float, track: float, grip: float, wheel: float
) -> None:
    limits = limits_of_sides(max_speed, track, grip, wheel)
    assert limits.max_speed is not None
    assert limits.max_yaw_rate is not None
    assert limits.max_speed <= max_speed
    assert limits.max_speed <= 0.8 * wheel
    outer = limits.max_speed + 0.5 * track * limits.max_yaw_rate / grip
    assert abs(outer - wheel) <= 1e-9 * wheel


def test_wheels_without_a_limit_ask_for_nothing() -> None:
    assert limits_of_sides(2.0, 0.5, 1.0, None) == DriveLimits()
