"""Poses of a body that stands and turns."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.machine.turned_in_place import turned_in_place


@given(st.integers(0, 2**32 - 1), st.floats(0.01, 0.5))
@settings(deadline=None, max_examples=30)
def test_every_pose_of_a_turn_on_the_spot_has_one_near_to_it(seed: int, spacing: float) -> None:
    rng = np.random.default_rng(seed)
    moves = np.repeat(rng.integers(0, 2, 12), rng.integers(1, 9, 12))
    places = np.column_stack(
        (np.concatenate(([0.0], np.cumsum(0.1 * moves))), 0.0 * np.ones(len(moves) + 1))
    )
    turns = np.where(moves, 0.0, rng.normal(0.0, 0.6, len(moves)))
    headings = np.concatenate(([0.0], np.cumsum(turns)))
    rows, facing, off = turned_in_place(places, headings, spacing)
    for k in np.flatnonzero(moves == 0):
        for share in np.linspace(0.0, 1.0, 5):
            heading = headings[k] + share * (headings[k + 1] - headings[k])
            there = np.linalg.norm(places[rows] - places[k], axis=1) <= off + 1e-12
            assert np.abs(facing[there] - heading).min() <= 0.5 * spacing + 1e-12


def test_who_never_stands_has_no_such_poses() -> None:
    places = np.column_stack((np.arange(5.0), np.zeros(5)))
    rows, facing, off = turned_in_place(places, np.zeros(5), 0.1)
    assert (len(rows), len(facing), off) == (0, 0, 0.0)
