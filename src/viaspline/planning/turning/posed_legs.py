"""The cheapest row of headings at the via points between which all legs are clear.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.turning.heading_costs import cheapest
from viaspline.planning.turning.bend_row import Bends
from viaspline.planning.turning.headings import HEADING_COUNT, HeadingLeg
from viaspline.planning.turning.turn_path import TurnPath

Lay = Callable[[Bends], TurnPath | None]  # of a leg with headings at its ends
Key = tuple[int, int, int]  # a leg, the headings at its start and goal by number
End = tuple[int, bool, int]  # a leg, whether its goal is meant, the heading there by number

FINER_TURNS = (0.5, 0.25, 0.12, 0.06)  # of the step between headings, by which they are turned then


@dataclass(frozen=True)
class Poses:
    """Legs that follow each other with the same heading at every via point between them.

    Attributes:
        headings: At every via point [rad], (v,); NaN where the robot turns on the spot.
        turn_paths: One for each leg.
    """

    headings: Floats
    turn_paths: tuple[TurnPath, ...]

    @cached_property
    def length(self) -> float:
        """[m]."""
        return sum(turn_path.length for turn_path in self.turn_paths)


def posed(
    legs: Sequence[HeadingLeg],
    costs: Floats,
    closed: bool,
    lay: Lay,
    max_rows: int,
    max_pairs: int,
    bound: float = math.inf,
) -> Poses | None:
    """The shortest row of clear legs, None where there is none among the headings that are tried.

    Where as many rows are tried as may be it is the shortest of what was laid by then.

    Args:
        legs: The legs.
        costs: What they cost between their headings, see ``costs_between``.
        closed: Whether the last heading is the first.
        lay: Lays a clear turn path round the bends of a leg, if it can.
        max_rows: Rows of headings that are tried.
        max_pairs: Pairs of headings of a leg that are tried until one of them is clear.
        bound: Only shorter rows are of use [m].
    """
    counts = np.array([*(len(leg.starts) for leg in legs), len(legs[-1].goals)])
    costs, known = costs.copy(), np.full_like(costs, math.inf)
    laid: dict[Key, TurnPath] = {}
    judged = set[End]()
    failed, is_hopeful = np.zeros(len(legs), np.int64), np.zeros(len(legs), np.bool_)
    for left in reversed(range(max_rows + 1)):
        row, cost = cheapest(costs if left > 0 else known, counts, closed)
        if not cost < bound:  # what is not laid yet costs no less than it says
            return None
        keys = [(k, int(row[k]), int(row[k + 1])) for k in range(len(legs))]
        new = [key for key in keys if key not in laid]
        if not new:
            headings = [leg.starts[key[1]] for leg, key in zip(legs, keys, strict=True)]
            ends = np.array([*headings, legs[-1].goals[row[-1]]])
            return _finer(Poses(ends, tuple(laid[key] for key in keys)), legs, closed, lay)
        for key in new:
            leg = legs[key[0]]
            turn_path = lay(leg.between(leg.starts[key[1]], leg.goals[key[2]]))
            costs[key] = known[key] = math.inf if turn_path is None else turn_path.length
            if turn_path is not None:
                laid[key] = turn_path
                is_hopeful[key[0]] = True
                judged.update(_ends(key))
            else:
                _without_blocked(costs[key[0]], leg, key, judged, lay)
            failed[key[0]] += 1
        if ((failed >= max_pairs) & ~is_hopeful).any():
            return None
    return None


def _without_blocked(costs: Floats, leg: HeadingLeg, key: Key, judged: set[End], lay: Lay) -> None:
    """Take off those headings of a pair that failed which fail whatever the other end has.

    Else all pairs with them would be tried in turn: they cost little more than this one.

    Args:
        costs: What the leg costs between its headings [m], (k, l); infinite then.
        leg: The leg.
        key: The pair.
        judged: Headings that were looked at before; these are added.
        lay: Lays a clear turn path round the bends of a leg, if it can.
    """
    if min(len(leg.starts), len(leg.goals)) < 2:
        return  # the other end has one heading alone, with which it failed
    _, start, goal = key
    tries = (leg.starts[start], math.nan), (math.nan, leg.goals[goal])
    with_it = costs[start], costs[:, goal]
    for end, headings, pairs in zip(_ends(key), tries, with_it, strict=True):
        if end not in judged:
            judged.add(end)
            if lay(leg.between(*headings)) is None:
                pairs[:] = math.inf


def _ends(key: Key) -> tuple[End, End]:
    """The headings of a pair."""
    leg, start, goal = key
    return (leg, False, start), (leg, True, goal)


def _finer(poses: Poses, legs: Sequence[HeadingLeg], closed: bool, lay: Lay) -> Poses:
    """Poses with headings turned a little, each as long as that makes it shorter."""
    free = [k for k in range(len(legs)) if len(legs[k].starts) > 1]
    for part in FINER_TURNS:
        step = part * math.tau / HEADING_COUNT
        for k in free:
            for turn in (step, -step):
                turned = _turned(poses, legs, closed, lay, k, turn)
                if turned is not None and turned.length < poses.length - 1e-9:
                    poses = turned
                    break
    return poses


def _turned(
    poses: Poses, legs: Sequence[HeadingLeg], closed: bool, lay: Lay, k: int, turn: float
) -> Poses | None:
    """Poses with another heading at via point k."""
    headings = poses.headings.copy()
    headings[k] += turn
    if closed and k == 0:
        headings[-1] = headings[0]
    turn_paths = list(poses.turn_paths)
    for leg in {k, (k - 1) % len(legs) if closed else max(k - 1, 0)}:
        turn_path = lay(legs[leg].between(headings[leg], headings[leg + 1]))
        if turn_path is None:
            return None
        turn_paths[leg] = turn_path
    return Poses(headings, tuple(turn_paths))
