"""Smooth paths along searched drives: against scipy's splines and by their own curvature."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.spacetime.smoothed_drive import NEAR_M, places_along, smooth_spans

speeds = st.tuples(st.integers(-3, 3), st.integers(-3, 3))


def states(moves: list[tuple[int, int]]) -> Floats:
    """A drive of thrusts of a second each from rest to rest, with these speeds between them."""
    v = np.array([(0, 0), *moves, (0, 0)], float) * 0.4
    places = np.concatenate([[[0.0, 0.0]], np.cumsum(0.5 * (v[1:] + v[:-1]), axis=0)])
    return np.column_stack([np.arange(len(v)), places, v])


def sampled(drive: Floats) -> Floats:
    """Places on the parabolas of its thrusts, by numpy alone."""
    found = []
    for (t0, x0, y0, u0, w0), (t1, _, _, u1, w1) in pairwise(drive):
        t = np.linspace(0.0, t1 - t0, 50)
        found.append(np.column_stack([
            x0 + u0 * t + 0.5 * (u1 - u0) / (t1 - t0) * t**2,
            y0 + w0 * t + 0.5 * (w1 - w0) / (t1 - t0) * t**2,
        ]))  # fmt: skip
    return np.concatenate(found)


@given(st.lists(speeds, min_size=1, max_size=8), st.sampled_from([2, 6]))
@example([(3, 0), (3, 2), (1, 3), (-1, 3), (-3, 1)], 2)
@example([(2, 0), (-2, 0), (-2, 1)], 2)  # it turns back on a line
@example([(2, 0), (-2, 1), (0, 2)], 6)  # and beside one
@example([(1, 0), (0, 0), (0, 1)], 2)  # it waits
def test_the_path_of_a_drive_stays_by_it_and_bends_evenly_or_turns_where_it_stands(
    moves: list[tuple[int, int]], pieces: int
) -> None:
    drive = states(moves)
    places = places_along([drive], pieces)
    if np.abs(drive[-1, 1:3]).max() <= NEAR_M:
        return
    assert [place.via for place in places if place.via is not None] == [0, 1]
    path = Path(smooth_spans(np.array([place.at for place in places])), vias=[])
    u = np.linspace(0.0, len(path.spans), 40 * len(path.spans) + 1)
    apart = np.hypot(*(np.asarray(path.evaluate(u))[:, None] - sampled(drive)[None]).T).min(axis=0)
    assert apart.max() <= 0.25 / pieces
    out, into = path.spans[1:, 1] - path.spans[1:, 0], path.spans[:-1, 3] - path.spans[:-1, 2]
    across = into[:, 0] * out[:, 1] - into[:, 1] * out[:, 0]
    turns = np.abs(np.arctan2(across, (into * out).sum(axis=1)))
    assert np.all((turns < 1e-6) | (turns > np.pi / 4))
    bends = path.curvature_jumps()[turns < 1e-6]
    assert bends.max(initial=0.0) <= 1e-6 * (1.0 + np.abs(path.curvature(u)).max())


@given(
    st.lists(st.tuples(st.floats(-1.2, 1.2), st.floats(0.05, 2.0)), min_size=1, max_size=12),
)
def test_places_that_lead_on_are_joined_by_the_natural_spline(
    turns: list[tuple[float, float]],
) -> None:
    headings = np.cumsum([turn for turn, _ in turns])
    steps = np.array([step for _, step in turns])
    moves = steps[:, None] * np.column_stack([np.cos(headings), np.sin(headings)])
    places = np.concatenate([[[0.0, 0.0]], np.cumsum(moves, axis=0)])
    spans = smooth_spans(places)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    oracle = CubicSpline(along, places, bc_type="natural")
    wide = np.diff(along)[:, None]
    assert np.allclose(spans[:, 0], oracle(along[:-1]))
    assert np.allclose(3.0 * (spans[:, 1] - spans[:, 0]) / wide, oracle(along[:-1], 1))
    assert np.allclose(3.0 * (spans[:, 3] - spans[:, 2]) / wide, oracle(along[1:], 1))


def test_places_that_are_one_are_left_out_and_via_points_stay() -> None:
    there = states([(2, 0), (2, 0)])
    wait = there[-1:] + np.array([[1.0, 0.3 * NEAR_M, 0.0, 0.0, 0.0]])
    places = places_along([np.vstack([there, wait])], 2)
    assert places[-1].at.tolist() == wait[0, 1:3].tolist()
    gaps = [np.abs(a.at - b.at).max() for a, b in pairwise(places)]
    assert min(gaps) > NEAR_M
