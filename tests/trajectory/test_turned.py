"""Limits along axes that are turned: what is driven is turned back, and the times stay."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.errors import GeometryError
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.retime import retime
from viaspline.trajectory.turned import TurnedCurve, turned

POINTS = np.array([(0, 0), (4, 3), (9, -2), (15, 5)], float)


def rotation(angle: float) -> np.ndarray:
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])


def test_points_in_turned_axes_are_points_that_are_turned_back() -> None:
    assert turned(POINTS, 0.7) == pytest.approx(POINTS @ rotation(0.7))
    assert turned(POINTS, 0.0) is POINTS
    in_space = np.array([[1.0, 0.0, 5.0]])
    assert turned(in_space, math.pi / 2) == pytest.approx(np.array([[0.0, -1.0, 5.0]]))


def test_there_is_no_plane_in_one_axis() -> None:
    with pytest.raises(GeometryError, match="axis_heading"):
        turned(np.ones((3, 1)), 0.1)


@given(st.floats(-7.0, 7.0), st.integers(0, 2**32 - 1))
@settings(max_examples=15, deadline=None)
def test_the_speed_along_and_across_a_held_heading_is_never_above_its_limit(
    heading: float, seed: int
) -> None:
    """The oracle knows the path's derivative and the trajectory's speed, and no cells."""
    points = POINTS + np.random.default_rng(seed).normal(0.0, 1.0, POINTS.shape)
    path = CardinalSpline(points, tangents="continuous")
    limits = Limits(
        max_speed=3.0, max_accel=1.0, axis_speed=(1.2, 0.4), axis_heading=heading,
        max_lateral_accel=1.0,
    )  # fmt: skip
    trajectory = retime(path, limits)
    distances = np.linspace(0.0, path.length, 4001)
    tangents = np.asarray(path.evaluate(path.parameter(distances), 1))
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    velocity = np.asarray(trajectory.speed_at(distances))[:, None] * tangents
    body = np.abs(velocity @ rotation(heading))
    assert body[:, 0].max() <= 1.2 + 1e-9
    assert body[:, 1].max() <= 0.4 + 1e-9
    assert max(body[:, 0].max() / 1.2, body[:, 1].max() / 0.4) > 0.98  # and no slower than need be


def test_turning_path_and_axes_alike_changes_no_time() -> None:
    limits = Limits(max_speed=3.0, max_accel=1.0, axis_speed=(1.2, 0.4), axis_accel=(0.8, 0.5))
    plain = retime(CardinalSpline(POINTS), limits).duration
    for angle in (0.4, -2.0):
        path = CardinalSpline(POINTS @ rotation(angle).T)
        along = Limits(
            max_speed=3.0, max_accel=1.0, axis_speed=(1.2, 0.4), axis_accel=(0.8, 0.5),
            axis_heading=angle,
        )  # fmt: skip
        assert retime(path, along).duration == pytest.approx(plain, rel=1e-3)


def test_any_curve_can_be_evaluated_in_turned_axes() -> None:
    spline = CardinalSpline(POINTS)
    curve = TurnedCurve(spline, 0.5)
    u = np.linspace(*curve.domain, 20)
    for order in range(3):
        expected = np.asarray(spline.evaluate(u, order)) @ rotation(0.5)
        assert curve.evaluate(u, order) == pytest.approx(expected)


def test_an_angle_is_a_finite_number() -> None:
    with pytest.raises(GeometryError, match="axis_heading is nan"):
        Limits(max_speed=1.0, max_accel=1.0, axis_heading=math.nan)
