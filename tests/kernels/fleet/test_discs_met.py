from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.kernels.fleet.discs_met import discs_met

places = st.tuples(st.floats(-20, 20), st.floats(-20, 20))
curves = st.lists(st.tuples(places, places, places, places), min_size=1, max_size=3)


def least_distance(spans: np.ndarray, place: np.ndarray) -> float:
    u = np.linspace(0.0, 1.0, 4001)[:, None]
    v = 1.0 - u
    lines = (v**3 * p + 3 * v * v * u * q + 3 * v * u * u * r + u**3 * s for p, q, r, s in spans)
    return min(float(np.hypot(*(line - place).T).min()) for line in lines)


@given(curves, st.lists(places, min_size=1, max_size=4), st.floats(0.1, 6.0))
def test_a_disc_is_met_where_the_curve_comes_into_it(
    curve: list[tuple[tuple[float, float], ...]], middles: list[tuple[float, float]], grown: float
) -> None:
    spans = np.array(curve)
    discs = np.array([(*middle, 0.5) for middle in middles])
    found = discs_met(spans, discs, grown)
    for disc, is_met in zip(discs, found, strict=True):
        spare = least_distance(spans, disc[:2]) - 0.5 - grown
        if abs(spare) > 0.02:  # nearer than that samples don't decide
            assert is_met == (spare < 0.0)


def test_a_nanometre_decides() -> None:
    line = np.array([[[0.0, 0.0], [3.0, 0.0], [6.0, 0.0], [9.0, 0.0]]])
    discs = np.array([[4.5, 2.0 + 1e-9, 1.0], [4.5, -2.0 + 1e-9, 1.0]])
    assert discs_met(line, discs, 1.0).tolist() == [False, True]


def test_the_ground_track_of_a_curve_in_space_counts() -> None:
    climb = np.array([[[0.0, 0.0, 0.0], [3.0, 0.0, 9.0], [6.0, 0.0, 9.0], [9.0, 0.0, 9.0]]])
    assert discs_met(climb, np.array([[4.0, 0.5, 1.0]]), 0.0).tolist() == [True]
