import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.space.corner_polygon import C4, CUT
from viaspline.space.laying.corner_rounding import rounded

seeds = st.integers(0, 10_000)


def zigzag(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """A random polyline in space, and reaches that don't overlap."""
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(0, 1, (int(rng.integers(3, 8)), 3)), axis=0)
    sides = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return points, rng.uniform(0.1, 0.5, len(points) - 2) * np.minimum(sides[1:], sides[:-1])


def turning(points: np.ndarray) -> np.ndarray:
    """By how much a polyline turns at each of its inner corners [rad]."""
    ways = np.diff(points, axis=0)
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    across = np.linalg.norm(ways[1:] - ways[:-1], axis=1)
    along = np.linalg.norm(ways[1:] + ways[:-1], axis=1)
    return np.asarray(2.0 * np.arctan2(across, along))


def sharpest_radius(reach: float, turn: float) -> float:
    """The radius in the middle of a corner [m]."""
    return reach * math.cos(0.5 * turn) ** 2 / (C4 * math.sin(0.5 * turn))


def reach_of_radius(radius: float, turn: float) -> float:
    """How far before a corner its rounding begins to be no sharper than a radius [m]."""
    return radius * C4 * math.sin(0.5 * turn) / math.cos(0.5 * turn) ** 2


def cut(reach: float, turn: float) -> float:
    """How near the rounding comes to the corner that it cuts [m]."""
    return CUT * math.sin(0.5 * turn) * reach


@given(seed=seeds)
def test_a_rounded_polyline_has_no_jump_of_its_direction_or_its_curvature(seed: int) -> None:
    points, reaches = zigzag(seed)
    curve = PiecewiseCubic(rounded(points, reaches))
    joints = np.arange(1, len(curve.spans))
    for before, after in zip(curve.spans[:-1], curve.spans[1:], strict=True):
        first, last = before[3] - before[2], after[1] - after[0]
        cosine = first @ last / np.linalg.norm(first) / np.linalg.norm(last)
        assert math.isclose(cosine, 1.0, abs_tol=1e-9)
    before, after = curve.curvature(joints - 1e-9), curve.curvature(joints + 1e-9)
    assert np.allclose(before, after, rtol=1e-5, atol=1e-5)


@given(seed=seeds)
def test_a_rounding_stays_in_its_corner_and_passes_the_corner_as_near_as_is_said(seed: int) -> None:
    points, reaches = zigzag(seed)
    curve = PiecewiseCubic(rounded(points, reaches))
    places = curve.evaluate(np.linspace(0, len(curve.spans), 4000))
    assert np.array_equal(curve.spans[0, 0], points[0])
    assert np.array_equal(curve.spans[-1, 3], points[-1])
    for k, (turn, reach) in enumerate(zip(turning(points), reaches, strict=True)):
        ends = np.linalg.norm(places - points[k + 1], axis=1)
        own = places[ends <= reach + 1e-9]
        nearest = np.linalg.norm(own - points[k + 1], axis=1).min()
        assert nearest <= cut(reach, turn) + 2e-3 * reach


@pytest.mark.parametrize("degrees", [5, 30, 60, 90, 120, 160])
def test_the_sharpest_place_of_a_corner_has_the_radius_that_is_said(degrees: float) -> None:
    turn = math.radians(degrees)
    points = np.array([[-9.0, 0, 1], [0, 0, 1], [9 * math.cos(turn), 9 * math.sin(turn), 1]])
    curve = PiecewiseCubic(rounded(points, np.array([3.0])))
    sharpest = curve.curvature(np.linspace(0, len(curve.spans), 5001)).max()
    assert math.isclose(1.0 / sharpest, sharpest_radius(3.0, turn), rel_tol=1e-4)
    assert math.isclose(reach_of_radius(sharpest_radius(3.0, turn), turn), 3.0)
    assert math.isclose(np.linalg.norm(curve.spans[1, 3] - points[1]), cut(3.0, turn), rel_tol=1e-9)


def test_corners_that_are_none_and_corners_that_are_left_are_kept() -> None:
    line = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 2, 0]])
    assert len(rounded(line, np.array([0.2, 0.5]))) == 4
    assert len(rounded(line, np.zeros(2))) == 2
    assert len(rounded(line[:2], np.zeros(0))) == 1
