"""The turns of a row of bends, of which some become one with the next.

Tested through ``planning/turning/test_joined_bends``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner

NO_JOIN = -1


class TurnRuns(NamedTuple):
    """The turns of a row of bends, some of them joined: those that are left come first.

    Attributes:
        ends: The first and the last bend of each turn, (n, 2).
        joins: For each that is joined which join it is, else ``NO_JOIN``, (n,).
        turns: [rad], (n,).
        ways: From the first bend of each to its last [m], (n,).
        gaps: From the last bend of each to the first of the next [m], (n,).
        lengths: [m], (n,).
    """

    ends: Ints
    joins: Ints
    turns: Floats
    ways: Floats
    gaps: Floats
    lengths: Floats


@inner
def all_apart(turns: Floats, gaps: Floats, lengths: Floats) -> TurnRuns:
    """A turn at each bend."""
    count = turns.size
    runs = TurnRuns(
        np.empty((count, 2), np.int64), np.full(count, NO_JOIN), turns.copy(), np.zeros(count),
        np.zeros(count), lengths.copy(),
    )  # fmt: skip
    for k in range(count):
        runs.ends[k, 0] = runs.ends[k, 1] = k
    runs.gaps[: gaps.size] = gaps
    return runs


@inner
def merge(runs: TurnRuns, low: int, high: int, k: int, merged: TurnRuns) -> None:
    """The turns from ``low`` to before ``high`` with k and k + 1 as one; lengths are left out."""
    row = 0
    for i in range(low, high):
        if i == k + 1:
            continue
        merged.turns[row], merged.ways[row], merged.gaps[row] = (
            runs.turns[i], runs.ways[i], runs.gaps[i],
        )  # fmt: skip
        if i == k:
            merged.turns[row] += runs.turns[k + 1]
            merged.ways[row] += runs.gaps[k] + runs.ways[k + 1]
            merged.gaps[row] = runs.gaps[k + 1]
        row += 1


@inner
def take(runs: TurnRuns, count: int, k: int, join: int, merged: TurnRuns) -> None:
    """Let the row be the merged one, whose turn k is a join."""
    runs.ends[k, 1] = runs.ends[k + 1, 1]
    runs.joins[k] = join
    for i in range(k + 1, count - 1):
        runs.ends[i, 0], runs.ends[i, 1] = runs.ends[i + 1, 0], runs.ends[i + 1, 1]
        runs.joins[i] = runs.joins[i + 1]
    for i in range(count - 1):
        runs.turns[i], runs.ways[i] = merged.turns[i], merged.ways[i]
        runs.gaps[i], runs.lengths[i] = merged.gaps[i], merged.lengths[i]
