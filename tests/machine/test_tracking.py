"""Errors of a drive, in figures."""

from __future__ import annotations

import numpy as np
import pytest

from viaspline.machine.tracking import Tracking


def tracking(cross: list[float], heading: list[float], moving: list[bool]) -> Tracking:
    n = len(cross)
    return Tracking(
        np.arange(n, dtype=float), np.zeros(n), np.array(cross), np.array(heading), np.zeros(n),
        np.array(moving),
    )  # fmt: skip


def test_what_it_was_off_at_rest_is_not_counted_again() -> None:
    errors = tracking([0.1, -0.3, 9.0], [0.0, 0.0, 0.0], [True, True, False]).cross
    assert errors.max == 0.3
    assert errors.p50 == pytest.approx(0.2)


def test_a_corner_is_off_by_the_place_and_by_the_heading() -> None:
    one = tracking([0.1], [np.pi], [True])
    assert one.body_deviation(0.0) == pytest.approx(0.1)
    assert one.body_deviation(2.0) == pytest.approx(4.1)  # to the other side of the point


def test_a_drive_that_never_moved_has_no_error_to_speak_of() -> None:
    still = tracking([0.5], [1.0], [False])
    assert still.cross.max == 0.0
