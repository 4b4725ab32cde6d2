"""Worlds of other kinds than the planar one, certified by the same kernel."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.kernels.arrays import Floats
from viaspline.kernels.clearance.disc import STILL, conflicts, tightest
from viaspline.kernels.clearance.world_protocol import (
    answers,
    chord_distance,
    dimension,
    distance_at,
    pace,
)

TOLERANCE = 1e-3


class Balls(NamedTuple):
    """Balls in space: x, y, z, radius [m], (n, 4)."""

    balls: Floats


@answers(dimension, Balls)
def _balls_dimension(world: Balls) -> int:
    return 3


@answers(pace, Balls)
def _balls_pace(world: Balls) -> float:
    return 0.0


@answers(distance_at, Balls)
def _balls_distance(world: Balls, place: Floats, instant: float, limit: float) -> tuple[float, int]:
    best = limit
    index = -1
    for k in range(world.balls.shape[0]):
        dx = place[0] - world.balls[k, 0]
        dy = place[1] - world.balls[k, 1]
        dz = place[2] - world.balls[k, 2]
        distance = math.sqrt(dx * dx + dy * dy + dz * dz) - world.balls[k, 3]
        if distance < best:
            best = distance
            index = k
    return best, index


@answers(chord_distance, Balls)
def _balls_chord(
    world: Balls, first: Floats, last: Floats, instant: float, limit: float
) -> tuple[float, int]:
    return 0.0, -1  # allowed: it says nothing


class MovingDiscs(NamedTuple):
    """Discs that move evenly: x, y [m], velocity [m/s], radius [m], (n, 5)."""

    discs: Floats


@answers(dimension, MovingDiscs)
def _moving_dimension(world: MovingDiscs) -> int:
    return 2


@answers(pace, MovingDiscs)
def _moving_pace(world: MovingDiscs) -> float:
    fastest = 0.0
    for k in range(world.discs.shape[0]):
        fastest = max(fastest, math.hypot(world.discs[k, 2], world.discs[k, 3]))
    return fastest


@answers(distance_at, MovingDiscs)
def _moving_distance(
    world: MovingDiscs, place: Floats, instant: float, limit: float
) -> tuple[float, int]:
    best = limit
    index = -1
    for k in range(world.discs.shape[0]):
        dx = place[0] - world.discs[k, 0] - instant * world.discs[k, 2]
        dy = place[1] - world.discs[k, 1] - instant * world.discs[k, 3]
        distance = math.sqrt(dx * dx + dy * dy) - world.discs[k, 4]
        if distance < best:
            best = distance
            index = k
    return best, index


@answers(chord_distance, MovingDiscs)
def _moving_chord(
    world: MovingDiscs, first: Floats, last: Floats, instant: float, limit: float
) -> tuple[float, int]:
    return 0.0, -1


def spans_through(rng: np.random.Generator, dimensions: int) -> Floats:
    return np.array(CardinalSpline(rng.uniform(-10, 10, (5, dimensions))).spans)


def places(spans: Floats, count: int) -> tuple[Floats, Floats]:
    """Points of the curve by de Casteljau, and their parameters."""
    w = np.linspace(0, 1, count)[:, None, None]
    a, b, c, d = np.moveaxis(spans, 1, 0)
    at = (1 - w) ** 3 * a + 3 * w * (1 - w) ** 2 * b + 3 * w**2 * (1 - w) * c + w**3 * d
    u = np.linspace(0, 1, count)[:, None] + np.arange(len(spans))
    return at.reshape(-1, spans.shape[2]), u.ravel()


@given(st.integers(0, 10_000))
def test_a_curve_among_balls_in_space_is_bounded_from_both_sides(seed: int) -> None:
    rng = np.random.default_rng(seed)
    balls = np.column_stack((rng.uniform(-10, 10, (6, 3)), rng.uniform(0.1, 2, 6)))
    spans = spans_through(rng, 3)
    lower, upper, _, _, index = tightest(Balls(balls), spans, STILL, TOLERANCE)
    at, _ = places(spans, 400)
    gaps = np.linalg.norm(at[:, None] - balls[:, :3], axis=2) - balls[:, 3]
    assert lower <= gaps.min() + 1e-9
    assert lower >= upper - TOLERANCE - 1e-12
    assert upper <= gaps.min() + 0.05
    assert index == np.unravel_index(gaps.argmin(), gaps.shape)[1] or upper - gaps.min() < 0.05
    found, _ = conflicts(Balls(balls), spans, max(upper, 0.0) + 0.1)
    assert (found >= 0).any()


@given(st.integers(0, 10_000))
def test_a_robot_among_moving_discs_is_bounded_over_continuous_time(seed: int) -> None:
    rng = np.random.default_rng(seed)
    discs = np.column_stack((rng.uniform(-10, 10, (6, 2)), rng.uniform(-2, 2, (6, 2)),
                             rng.uniform(0.1, 1, 6)))  # fmt: skip
    spans = spans_through(rng, 2)
    instants = np.cumsum(rng.uniform(0.5, 5, len(spans) + 1))
    lower, upper, _, _, _ = tightest(MovingDiscs(discs), spans, instants, 0.01)
    at, u = places(spans, 2000)
    span = np.minimum(u.astype(int), len(spans) - 1)
    t = instants[span] + (u - span) * np.diff(instants)[span]
    centres = discs[:, :2] + t[:, None, None] * discs[:, 2:4]
    sampled = (np.linalg.norm(at[:, None] - centres, axis=2) - discs[:, 4]).min()
    assert lower <= sampled + 1e-9
    assert upper - 0.01 - 1e-12 <= lower
    assert upper >= sampled - 0.05


def test_something_that_moves_is_not_taken_for_standing() -> None:
    # it is far away when the robot sets off, and on its way when the robot comes
    disc = MovingDiscs(np.array([[5.0, 20.0, 0.0, -2.0, 0.5]]))
    spans = np.array([[[0, 0], [10 / 3, 0], [20 / 3, 0], [10, 0]]], np.float64)
    still, *_ = tightest(disc, spans, STILL, TOLERANCE)
    moving, *_ = tightest(disc, spans, np.array([0.0, 20.0]), TOLERANCE)
    assert still == pytest.approx(19.5, abs=TOLERANCE)
    assert moving == pytest.approx(-0.5, abs=2 * TOLERANCE)


def test_what_is_no_world_is_named() -> None:
    question: Any = dimension
    with pytest.raises(TypeError, match="int is no world for a certificate"):
        question(3)
