"""New worlds like BARN's: clutter grown by a cellular automaton, behind a start that is walled in.

After Perille, Truong, Xiao and Stone, "Benchmarking Metric Ground Navigation" (SSRR 2020), and the
program that made the dataset, github.com/dperille/jackal-map-creation (``gen_world_ca.py``,
``generator.py``, ``world_writer.py``), whose rules are written anew here: 30 x 30 cells, each
filled with a chance of 0.15, 0.20, 0.25 or 0.30, smoothed two to four times (here to five). A
smoothing fills a cell with more than four filled neighbours and clears one with fewer than two;
beyond the walls on either side all counts as filled. A filled cell is a post, unless all round it
is filled.

Nothing is cleared to make a way, and worlds without one are not left out: ``oracle`` tells them.
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray
from oracle import distances_to, verdict
from scipy.ndimage import convolve

CELLS, CELL_M, RADIUS_M = 30, 0.15, 0.075
FILLS, SMOOTHINGS = (0.15, 0.20, 0.25, 0.30), (2, 3, 4, 5)
START, GOAL = (-2.25, 3.0), (-2.25, 13.0)
BOX = (-4.7, -0.3, 0.2, 13.6)
STEPS_M = (0.01, 0.0025)
FULL, EMPTY = 4, 2
"""More filled neighbours than this fill a cell, fewer than that clear it."""

RING = np.array([[1, 1, 1], [1, 0, 1], [1, 1, 1]])


def posts(seed: int) -> NDArray[np.float64]:
    """Middles of the posts of one world [m], (n, 2); seeds go through all sets of parameters."""
    sets = list(itertools.product(FILLS, SMOOTHINGS))
    fill, smoothings = sets[seed % len(sets)]
    filled = clutter(np.random.default_rng(seed), fill, smoothings)
    shown = filled & (convolve(np.pad(filled.astype(int), 1), np.ones((3, 3)))[1:-1, 1:-1] < 9)
    across, along = np.nonzero(shown)
    middles = np.column_stack((across - 0.5 * (CELLS - 1), along + 0.5)) * CELL_M + (-2.25, 5.1)
    return np.vstack((middles, pen()))


def clutter(rng: np.random.Generator, fill: float, smoothings: int) -> NDArray[np.bool_]:
    """Which cells are filled: across, and along the way from the start to the goal, (30, 30)."""
    filled = rng.random((CELLS, CELLS)) < fill
    filled[[0, -1]] = True
    for _ in range(smoothings):
        padded = np.pad(filled.astype(int), 1)
        padded[[0, -1]] = 1
        neighbours = convolve(padded, RING)[1:-1, 1:-1]
        filled = (filled | (neighbours > FULL)) & (neighbours >= EMPTY)
    return filled


def pen() -> NDArray[np.float64]:
    """The posts round the start, open towards the clutter [m], (n, 2)."""
    x = CELL_M * (np.arange(CELLS) - 0.5 * (CELLS - 1)) - 2.25
    y = np.arange(RADIUS_M, 5.1, CELL_M)
    sides = [(side, at) for side in (x[0], x[-1]) for at in y]
    return np.array(sides + [(at, y[0]) for at in x[1:-1]])


def is_there_a_way(middles: NDArray[np.float64], kept: float) -> str:
    """``open``, ``closed`` or ``unsure`` for a disc whose middle keeps this from all posts [m]."""
    told = "unsure"
    for step in STEPS_M:
        if told == "unsure":
            discs = [(x, y, RADIUS_M) for x, y in middles.tolist()]
            gaps = distances_to(discs, kept + 0.1, BOX, step)
            told = verdict(gaps, BOX, step, START, GOAL, kept)
    return told
