"""Motions that roll back a little, and stand there instead."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.machine.rolling_back import without_rolling_back


@given(st.floats(-np.pi, np.pi), st.floats(1e-7, 1e-2), st.booleans())
def test_a_robot_that_rolled_back_and_turned_on_the_spot_goes_on(
    turn: float, back: float, turns_as_it_rolls: bool
) -> None:
    there = np.linspace(0.0, 3.0, 31)[:, None] * [1.0, 0.0]
    stays = there[-1] - np.linspace(0.0, back, 21)[1:, None] * [1.0, 0.0]
    on = stays[-1] + np.linspace(0.1, 3.0, 30)[:, None] * [np.cos(turn), np.sin(turn)]
    rolled = np.linspace(0.0, turn, 20) if turns_as_it_rolls and abs(turn) < 1.0 else np.zeros(20)
    headings = np.concatenate(
        (np.zeros(31), rolled, np.linspace(rolled[-1], turn, 10), [turn] * 30)
    )
    waits = np.repeat(stays[-1:], 10, axis=0)
    places, off = without_rolling_back(np.concatenate((there, stays, waits, on)), headings)
    assert off == pytest.approx(back, abs=1e-9)
    assert places[-30:] == pytest.approx(on)
    assert (places[31:51] == there[-1]).all()


def test_a_robot_that_rolls_back_at_the_end_stands_there() -> None:
    places = np.array([[0.0, 0.0], [1.0, 0.0], [0.99, 0.0]])
    stood, off = without_rolling_back(places, np.zeros(3))
    assert stood[:, 0].tolist() == [0.0, 1.0, 1.0]
    assert off == pytest.approx(0.01)
