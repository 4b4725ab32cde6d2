"""The proof that what moves cuts a robot off from its route, whatever path and law it takes.

The plane is cut into squares. A robot may be in a square for a while if somewhere in that it may be
far enough from what stands and, at some instant of the while, from what moves; and from while to
while it gets no farther than into the squares next to where it was. That takes too much for
possible, never too little. Where no such row of squares leads past all points of the route there is
no drive: proven, for robots of every kind of drive.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.motion.packed_motion import (
    BEGINS,
    GROWTH,
    PRESENT,
    SPEED_X,
    SPEED_Y,
    TURNING,
    PackedMotion,
)
from viaspline.spacetime.timed_problem import TimedProblem
from viaspline.spacetime.world_squares import TOUCHING_M, WorldSquares

SQUARES = (900, 2_500)
"""About how many squares there are, one number after the other."""
MOST_LOOKS = 2_000_000
"""At squares, each in a while, beside each thing that moves: no more is proven with finer ones."""
WHILES_AT_ONCE = 64
"""In so many it is looked at together where the robot may be."""
SHORTEST_S = 1e-3
"""Of a while."""


def is_cut_off(problem: TimedProblem) -> bool:
    """Whether it is proven that no drive leads from the start past all points of the route.

    Nothing is proven in a world without bounds, nor among what goes on and on.

    Args:
        problem: What is asked.
    """
    motion, begin = problem.moving.packed, problem.mission.route.depart_s
    still = max(_still_from(motion), begin + SHORTEST_S)
    if still == math.inf:
        return False
    for count in SQUARES:
        squares = WorldSquares.over(problem.world, count, problem.least)
        if squares is None:
            return False
        # In a while a robot gets no farther than a square is wide.
        number = max(math.ceil((still - begin) * problem.limits.max_speed / squares.side), 1)
        if len(squares.places) * number * len(problem.moving) > MOST_LOOKS:
            return False
        if not _may_arrive(problem, squares, np.linspace(begin, still, number + 1)):
            return True
    return False


def _still_from(motion: PackedMotion) -> float:
    """From when on nothing moves any more [s]; inf: never."""
    last = motion.pieces[motion.first_piece[1:] - 1]
    moves = np.abs(last[:, [SPEED_X, SPEED_Y, TURNING]]).max(axis=1, initial=0.0) > 0.0
    grows = motion.errors[:, GROWTH] > 0.0
    if (motion.rounds[:, 1] > 0.0).any() or ((moves | grows) & (last[:, PRESENT] > 0.0)).any():
        return math.inf
    return float(last[:, BEGINS].max(initial=-math.inf))


def _open(problem: TimedProblem, squares: WorldSquares, begins: Floats, ends: Floats) -> Flags:
    """Where a robot may be in each while, beside what stands and moves, (k, rows, columns)."""
    lasts, many = float((ends - begins).max(initial=0.0)), len(squares.places)
    times = np.repeat(0.5 * (begins + ends), many)
    gaps = problem.moving.distance(np.tile(squares.places, (len(begins), 1)), times)
    motion = problem.moving.packed
    fastest = float((motion.speeds + motion.errors[:, GROWTH]).max(initial=0.0))
    least = squares.least - TOUCHING_M - squares.half - 0.5 * lasts * fastest
    found = np.zeros((len(begins), *squares.free.shape), np.bool_)
    found[:, squares.free] = gaps.reshape(len(begins), many) >= least
    changes = _changes(motion)
    for k in range(len(begins)):  # who comes or goes meanwhile is in nobody's way
        if ((changes >= begins[k]) & (changes <= ends[k])).any():
            found[k] = squares.free
    return found


def _changes(motion: PackedMotion) -> Floats:
    """When something comes or goes [s]."""
    found = [
        motion.pieces[k, BEGINS]
        for begin, end in pairwise(motion.first_piece.tolist())
        for k in range(begin + 1, end)
        if motion.pieces[k, PRESENT] != motion.pieces[k - 1, PRESENT]
    ]
    return np.array(found, np.float64)


def _may_arrive(problem: TimedProblem, squares: WorldSquares, whiles: Floats) -> bool:
    """Whether squares lead past all points of the route, to where the robot holds its goal."""
    route = problem.mission.route
    points = [squares.of(point.at) for _, point in route.points()]
    if route.closed:
        points.append(points[0])
    there = np.zeros((len(points), *squares.free.shape), np.bool_)
    there[0][points[0]] = True
    begins, ends = whiles[:-1], whiles[1:]
    stay = math.floor(route.hold_s / float(ends[0] - begins[0]))
    holds = 0  # so many whiles in a row the goal could have been held by now
    for first in range(0, len(begins), WHILES_AT_ONCE):
        part = slice(first, first + WHILES_AT_ONCE)
        for is_open in _open(problem, squares, begins[part], ends[part]):
            there = _go_on(there, is_open, points)
            holds = holds + 1 if there[-1][points[-1]] else 0
            if holds > stay:
                return True
            if not there.any():
                return False
    at_last = _open(problem, squares, ends[-1:], ends[-1:])[0]
    while True:
        then = _go_on(there, at_last, points)
        if (then == there).all():
            return bool(there[-1][points[-1]])
        there = then


def _go_on(there: Flags, is_open: Flags, points: Sequence[tuple[int, int]]) -> Flags:
    """Where the robot may be after a while, by the last point that it has come to.

    Args:
        there: Where it may be before, (points, rows, columns).
        is_open: Where it may be meanwhile, (rows, columns).
        points: The squares of the points of the route.
    """
    found = there.copy()
    for k in range(len(points)):
        if k > 0 and found[k - 1][points[k]]:
            found[k][points[k]] = True
        found[k] = _with_neighbours(found[k] & is_open) & is_open
    return found


def _with_neighbours(squares: Flags) -> Flags:
    """Squares and the eight about each, (rows, columns)."""
    tall = squares.copy()
    tall[1:] |= squares[:-1]
    tall[:-1] |= squares[1:]
    wide = tall.copy()
    wide[:, 1:] |= tall[:, :-1]
    wide[:, :-1] |= tall[:, 1:]
    return wide
