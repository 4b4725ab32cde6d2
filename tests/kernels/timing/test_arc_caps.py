"""What bends allow, arc by arc, against a dense sampling of the curve."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.kernels.timing.arc_caps import bend_caps

seeds = st.integers(0, 2**32 - 1)


def bezier(span: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First and second derivative, from the polynomial's monomials."""
    a = -span[0] + 3 * span[1] - 3 * span[2] + span[3]
    b = 3 * span[0] - 6 * span[1] + 3 * span[2]
    c = 3 * (span[1] - span[0])
    u = u[:, None]
    return 3 * a * u**2 + 2 * b * u + c, 6 * a * u + 2 * b


def curvature(span: np.ndarray, u: np.ndarray) -> np.ndarray:
    d1, d2 = bezier(span, u)
    gram = (d1**2).sum(1) * (d2**2).sum(1) - (d1 * d2).sum(1) ** 2
    return np.sqrt(np.maximum(gram, 0)) / (d1**2).sum(1) ** 1.5


@pytest.mark.parametrize("dimension", [2, 3])
@given(seed=seeds)
@example(seed=6362369)
@example(seed=2692)
@settings(deadline=None, max_examples=25)
def test_the_cap_of_an_arc_is_below_what_its_curvature_allows(dimension: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    span = rng.normal(0.0, 5.0, (4, dimension))
    u = np.linspace(0.0, 1.0, 20001)
    d1, _ = bezier(span, u)
    speed = np.linalg.norm(d1, axis=1)
    along = np.concatenate(([0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(u))))
    distances, caps, rests = bend_caps(span[None], along[[0, -1]], 0.5, np.inf, 1.0, 4.0, 1.1)
    assert np.all(np.diff(distances) > 0)
    turned = np.zeros(len(along), bool)
    for rest in distances[rests]:  # it turns by more than a right angle within 3 mm
        turned |= np.abs(along - rest) < 1.5e-3
        before, after = np.searchsorted(along, (rest - 1.5e-3, rest + 1.5e-3)).tolist()
        assert d1[before - 1] @ d1[after] < 0.0
    arc = np.clip(np.searchsorted(distances, along) - 1, 0, len(caps) - 1)
    edge = np.abs(along - distances[arc]) < 1e-4
    edge |= turned | (np.abs(along - distances[arc + 1]) < 1e-4)
    allowed = np.minimum(4.0, 0.5 / np.maximum(curvature(span, u), 1e-300))
    assert np.all(caps[arc][~edge] <= allowed[~edge] * (1 + 1e-6))


def test_a_straight_span_is_one_arc_however_far_away() -> None:
    start, end = np.array([1e6, 1e6]), np.array([1e6 + 7.3, 1e6 + 3.1])
    span = start + np.linspace(0, 1, 4)[:, None] * (end - start)
    distances, caps, rests = bend_caps(span[None], np.array([0.0, 8.0]), 0.5, np.inf, 1.0, 4.0, 1.1)
    assert distances.tolist() == [0.0, 8.0]
    assert caps.tolist() == [4.0]
    assert not rests.any()


def test_a_corner_and_a_cusp_are_places_to_rest() -> None:
    line = np.linspace(0, 1, 4)[:, None]
    corner = np.array([line * [3.0, 0.0], [3.0, 0.0] + line * [0.0, 3.0]])
    distances, _, rests = bend_caps(corner, np.array([0.0, 3.0, 6.0]), 0.5, np.inf, 1.0, 4.0, 1.1)
    assert distances[rests].tolist() == [3.0]
    cusp = np.array([[[0.0, 0.0], [2.0, 2.0], [0.0, 2.0], [2.0, 0.0]]])  # P'(1/2) = 0
    distances, caps, rests = bend_caps(cusp, np.array([0.0, 3.0]), 0.5, np.inf, 1.0, 4.0, 1.1)
    assert rests.any()
    assert abs(distances[rests].mean() - 1.5) < 1e-6
    assert np.all(caps > 0)


def test_where_a_straight_span_turns_back_is_a_place_to_rest() -> None:
    back = np.array([[[0.0, 0.0], [10.0, 5.0], [-5.0, -2.5], [5.0, 2.5]]])
    _, _, rests = bend_caps(back, np.array([0.0, 10.6]), 0.5, np.inf, 1.0, 4.0, 1.1)
    places = np.flatnonzero(rests)
    assert np.count_nonzero(np.diff(places) > 2) == 1, "two turns, each at a very short arc"


@pytest.mark.long_without_jit
def test_many_arcs_outgrow_the_first_room_that_is_made_for_them() -> None:
    rng = np.random.default_rng(1)
    points = np.cumsum(rng.normal(0, 5, (4, 2)), axis=0)
    ends = np.array([0.0, 9.0])
    distances, caps, _ = bend_caps(points[None], ends, 1e-3, np.inf, 1.0, 4.0, 1.001)
    assert len(caps) > 300
    assert len(distances) == len(caps) + 1
    assert distances[-1] == 9.0


@given(size=st.floats(1e-6, 1.0), turn=st.floats(1e-3, 2.0))
@example(size=0.02, turn=1.7e-4)
def test_a_short_spiral_allows_nearly_what_its_sharpest_place_does(
    size: float, turn: float
) -> None:
    # However short, it slows down what is before and behind it.
    ahead, aside = np.array([1.0, 0.0]), np.array([np.cos(turn), np.sin(turn)])
    span = size * np.cumsum([0 * ahead, ahead, ahead, aside], axis=0)
    most = curvature(span, np.linspace(0.0, 1.0, 2001)).max()
    lateral = 2.0 * most  # a speed of 1.41 m/s there
    joints = np.array([0.0, size * 3.0])
    _, caps, _ = bend_caps(span[None], joints, lateral, np.inf, 1e-3, 100.0, 1.1)
    assert caps.min() >= 2.0 / 1.11
