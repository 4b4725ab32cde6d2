"""The greatest speed under passive safety, beside the laws that are proven piece by piece."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.passive_safety import PassivePremises, passive_law
from viaspline.trajectory.passive_speed import passive_speed, room_for
from viaspline.trajectory.retime import retime
from viaspline.world.moving_obstacles import MovingObstacles

BODY_M = 0.25


@pytest.mark.parametrize("reach", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("brake", [0.5, 2.0])
def test_braking_is_proven_up_to_that_speed_and_not_above(reach: float, brake: float) -> None:
    look = PassivePremises(MovingObstacles(), 0.0, 1.5, (0.0, 0.0), reach)
    line = Path([[(x, 0.0) for x in (0, 10, 20, 30)]], [])
    greatest = passive_speed(reach - BODY_M, 1.5, brake)

    def is_proven(speed: float) -> bool:
        limits = Limits(max_speed=10.0, max_accel=brake)
        law = retime(line, limits, start_speed=speed)
        return passive_law(line, law, look, BODY_M, (brake, brake), 0.0)[1]

    assert is_proven(greatest - 0.01)
    assert not is_proven(greatest + 0.01)


@given(*(st.floats(0.1, 10.0) for _ in range(3)))
def test_the_room_for_a_speed_without_a_pause_allows_just_that_speed(
    speed: float, top: float, brake: float
) -> None:
    room = room_for(speed, top, brake, reaction=0.0)
    assert passive_speed(room, top, brake) == pytest.approx(speed)
    assert room_for(speed, top, brake, reaction=0.1) > room


def test_without_room_there_is_no_speed() -> None:
    assert passive_speed(0.0, 2.0, 1.0) == passive_speed(-1.0, 2.0, 1.0) == 0.0
