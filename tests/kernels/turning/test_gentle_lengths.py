"""Lengths of turns beside what scipy's optimiser finds."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import LinearConstraint, minimize

from viaspline.kernels.turning.gentle_lengths import gentle_lengths

Floats = NDArray[np.float64]

SEEDS = range(20)


def lines_of(count: int, closed: bool) -> Floats:
    """Which turns each line lies between, (m, n)."""
    ends = np.eye(count) + np.roll(np.eye(count), -1, axis=0)
    return ends if closed else ends[:-1]


def random_turns(seed: int, closed: bool) -> tuple[Floats, Floats]:
    random = np.random.default_rng(seed)
    count = int(random.integers(3, 9))
    turns = random.uniform(0.05, 1.5, count)
    return turns, random.uniform(2.0, 60.0, count if closed else count - 1)


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("seed", SEEDS)
def test_no_other_lengths_bend_less(seed: int, closed: bool) -> None:
    turns, rooms = random_turns(seed, closed)
    spent = 0.02 * float(rooms.sum())
    lengths = gentle_lengths(turns, rooms, closed, spent)
    best = minimize(
        lambda inverse: float((turns**2 / inverse).sum()),
        x0=np.full(len(turns), 0.4 * rooms.min()),
        jac=lambda inverse: -(turns**2) / inverse**2,
        constraints=[
            LinearConstraint(lines_of(len(turns), closed), ub=rooms),
            LinearConstraint(turns**2 / 40.0, ub=float((turns**2 * lengths).sum()) / 40.0),
        ],
        bounds=[(1e-3, None)] * len(turns),
        options={"maxiter": 500, "ftol": 1e-12},
    )
    assert (turns**2 / lengths).sum() <= best.fun * (1.0 + 1e-4)


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("seed", SEEDS)
def test_turns_leave_each_other_room_and_spend_no_more_than_they_may(
    seed: int, closed: bool
) -> None:
    turns, rooms = random_turns(seed, closed)
    spent = 0.01 * float(rooms.sum())
    lengths = gentle_lengths(turns, rooms, closed, spent)
    assert (lines_of(len(turns), closed) @ lengths <= rooms * (1.0 + 1e-5)).all()
    assert (turns**2 * lengths).sum() / 40.0 <= spent * (1.0 + 1e-9)


def test_turns_with_all_the_room_are_equally_long_and_spend_what_they_may() -> None:
    turns = np.array([0.0, 0.5, 0.2, 0.0])
    lengths = gentle_lengths(turns, np.full(3, 1e4), False, 1.5)
    assert lengths[[0, 3]].tolist() == [0.0, 0.0]
    assert lengths[1] == pytest.approx(lengths[2])
    assert (turns**2 * lengths).sum() / 40.0 == pytest.approx(1.5)


def test_two_turns_share_a_line_as_they_turn() -> None:
    turns = np.array([0.9, 0.3])
    lengths = gentle_lengths(turns, np.array([8.0]), False, 100.0)
    assert lengths == pytest.approx([6.0, 2.0], rel=1e-2)


@pytest.mark.parametrize("turns", [np.zeros(3), np.zeros(1)])
def test_what_does_not_turn_has_no_length(turns: Floats) -> None:
    assert not gentle_lengths(turns, np.ones(len(turns) - 1), False, 1.0).any()
