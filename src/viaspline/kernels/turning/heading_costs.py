"""The heading at every via point: what each leg costs from each heading to each other one."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import kernel
from viaspline.kernels.turning.needed_turns import needed_turns
from viaspline.kernels.turning.settled_lines import FINE, HEADING, KEPT, SIDE, X, Y
from viaspline.kernels.turning.turn_spans import turn_sequence_length


@kernel
def lesser_side(bends: Floats, at_start: bool) -> float:
    """The side to which the turn at an end is the lesser one, if the next bend is as it is.

    Args:
        bends: A row with a heading given there, see ``kernels.turning.settled_lines``, (n, 6).
        at_start: Whether it is the start, not the goal.
    """
    first = 0 if at_start else bends.shape[0] - 2
    last = first + 1
    dx, dy = bends[last, X] - bends[first, X], bends[last, Y] - bends[first, Y]
    across = bends[last, SIDE] * bends[last, KEPT] - bends[first, SIDE] * bends[first, KEPT]
    gap, line = math.hypot(dx, dy), math.atan2(dy, dx)
    if gap > abs(across):
        line -= math.asin(across / gap)
    turn = line - bends[first, HEADING] if at_start else bends[last, HEADING] - line
    return math.copysign(1.0, turn - math.tau * round(turn / math.tau))


@kernel
def leg_lengths(bends: Floats, starts: Floats, goals: Floats, ramp: float) -> Floats:
    """Lengths of a leg from every heading at its start to every heading at its goal.

    Bends that the others make needless are left out, as they are where the leg is laid, and given
    headings are left to the same sides: by the lesser turn, to whichever side it comes to be, and
    by that to the other side. A set side that is nearly that of its line may settle as a loop.

    Args:
        bends: The leg's row of bends, see ``kernels.turning.settled_lines``, (n, 6).
        starts: Headings at its start [rad], (k,); NaN: it is free.
        goals: Headings at its goal [rad], (l,); NaN: it is free.
        ramp: Length of the ramps, in least radii.

    Returns:
        (k, l, 2, 2) [m]: leaving by the lesser turn or by the other one, arriving by the lesser one
        or by the other one; infinite where there are no such turns.
    """
    row = bends.copy()
    last = bends.shape[0] - 1
    lengths = np.full((starts.shape[0], goals.shape[0], 2, 2), np.inf)
    for i in range(starts.shape[0]):
        for j in range(goals.shape[0]):
            row[0, HEADING], row[last, HEADING] = starts[i], goals[j]
            row[0, SIDE], row[last, SIDE] = 0.0, 0.0
            leaving = 0.0 if math.isnan(starts[i]) else -lesser_side(row, True)
            arriving = 0.0 if math.isnan(goals[j]) else -lesser_side(row, False)
            for a in range(2):
                if a == 1 and math.isnan(starts[i]):
                    continue
                for b in range(2):
                    if b == 1 and math.isnan(goals[j]):
                        continue
                    row[0, SIDE], row[last, SIDE] = a * leaving, b * arriving
                    left, lines, turns, apexes, ramps, state, _ = needed_turns(row, False, ramp)
                    if state == FINE:
                        lengths[i, j, a, b] = turn_sequence_length(
                            row[left], False, lines, turns, apexes, ramps
                        )
    return lengths


@kernel
def cheapest(costs: Floats, counts: Ints, closed: bool) -> tuple[Ints, float]:
    """The cheapest row of headings.

    Args:
        costs: From heading i at via point m to heading j at the next, (legs, k, k).
        counts: Headings of every via point, (legs + 1,); when closed the last is the first again.
        closed: Whether the last heading has to be the first.

    Returns:
        The index of the heading at each via point, (legs + 1,), and what they cost together;
        infinite where there is no row.
    """
    legs = costs.shape[0]
    best = np.inf
    row = np.zeros(legs + 1, np.int64)
    came = np.zeros((legs + 1, costs.shape[1]), np.int64)
    for first in range(counts[0] if closed else 1):
        reach = np.full(costs.shape[1], np.inf)
        for i in range(counts[0]):
            if not closed or i == first:
                reach[i] = 0.0
        for leg in range(legs):
            further = np.full(costs.shape[1], np.inf)
            for j in range(counts[leg + 1]):
                for i in range(counts[leg]):
                    cost = reach[i] + costs[leg, i, j]
                    if cost < further[j]:
                        further[j] = cost
                        came[leg + 1, j] = i
            reach = further
        for j in range(counts[legs]):
            if (not closed or j == first) and reach[j] < best:
                best = reach[j]
                row[legs] = j
                for leg in range(legs, 0, -1):
                    row[leg - 1] = came[leg, row[leg]]
    return row, best
