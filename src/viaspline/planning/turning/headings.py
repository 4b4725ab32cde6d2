"""Headings at the via points, chosen together: for via points too close for the turning circle.

Between two via points with given headings there is always a way for a car in the open: it drives
on and comes round again. So every via point gets a row of headings, and the cheapest row of legs
between them is found by dynamic programming; legs that can't be laid are left
out, one after the other, until a row is clear.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.turning.heading_costs import cheapest, leg_lengths
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import HEADING_PAIR_BEND_S, HEADING_PAIR_BENDS_S
from viaspline.planning.turning.bend_row import DETOUR, HEADING, SIDE, Bends
from viaspline.planning.turning.turn_path import RAMP, TurnPath

Lay = Callable[[Bends], TurnPath | None]  # of a leg with headings at its ends

HEADING_COUNT = 36  # that are tried at a via point
STARTS_AT_ONCE = 6  # of the headings of a leg, of which a search is stopped no sooner than after
APART_BENDS = 4  # of a leg, ends among them, from which on its ends know nothing of each other
THIN = 0.02  # off the line of others, that bends may be left out where there is no room; required
FINER_TURNS = (0.5, 0.25, 0.12, 0.06)  # of the step between headings, by which they are turned then


@dataclass(frozen=True)
class HeadingLeg:
    """What lies between two via points of a row of bends, one or more legs.

    Attributes:
        bends: Its bends, the via points at its ends among them.
        starts: The headings at its start [rad], (k,); a NaN is free.
        goals: The headings at its goal [rad], (l,).
    """

    bends: Bends
    starts: Floats
    goals: Floats

    @property
    def inner_vias(self) -> frozenset[int]:
        """The via points between its ends, whose headings are left as they come to be."""
        inner = self.bends.vias[1:-1]
        return frozenset(inner[inner != DETOUR].tolist())

    def lengths(self) -> Floats:
        """See ``kernels.turning.heading_costs.leg_lengths``."""
        found: Floats = leg_lengths(self.bends.rows, self.starts, self.goals, RAMP)
        return found

    def between(self, start: float, goal: float) -> Bends:
        """Its bends with headings at both ends [rad]."""
        rows = self.bends.rows.copy()
        rows[[0, -1], HEADING] = start, goal
        rows[[0, -1], SIDE] = 0.0
        return replace(self.bends, rows=rows)


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


def legs_of(
    bends: Bends,
    spots: Collection[int],
    sought: Collection[int],
    count: int,
    walls: Mapping[int, float],
) -> tuple[HeadingLeg, ...]:
    """The legs of a row of bends; of a closed one the first begins where the last one ends.

    Args:
        bends: The row.
        spots: Via points at which the robot may turn on the spot.
        sought: The other via points whose headings are chosen, which part the legs; at the rest a
            turn is as it comes to be. A round has one at least.
        count: Headings that are tried at a via point.
        walls: The headings of walls that via points lie close beside, which are among those [rad].
    """
    vias = int(bends.vias.max()) + 1
    ends = set() if bends.closed else {0, vias - 1}
    cut = sorted(ends | set(spots) | set(sought))
    if bends.closed:
        cut.append(cut[0])
    headings = [_headings(bends, via, vias, spots, count, walls) for via in cut]
    return tuple(
        HeadingLeg(bends.between(first, last), headings[k], headings[k + 1])
        for k, (first, last) in enumerate(pairwise(cut))
    )


def _headings(
    bends: Bends, via: int, vias: int, spots: Collection[int], count: int,
    walls: Mapping[int, float],
) -> Floats:  # fmt: skip
    """The headings that a via point may have [rad].

    That which halves its turn is among them, so that they are the same in whichever frame.
    """
    is_end = not bends.closed and via in (0, vias - 1)
    if is_end:
        return bends.rows[[bends.places(via)], HEADING]
    if via in spots:
        return np.array([math.nan])
    first = walls[via] if via in walls else bends.heading_through(bends.places(via))
    return first + np.arange(count, dtype=np.float64) * (math.tau / count)


def costs_between(legs: Sequence[HeadingLeg], requirements: Requirements) -> Floats:
    """What every leg costs from each heading at its start to each at its goal.

    Args:
        legs: The legs.
        requirements: With what may be spent.

    Returns:
        [m], (legs, k, k); inf where there is nothing, or no such heading.
    """
    most = max(len(ends) for leg in legs for ends in (leg.starts, leg.goals))
    costs = np.full((len(legs), most, most), np.inf)
    for k, leg in enumerate(legs):
        between = _end_by_end if len(leg.bends.rows) >= APART_BENDS else _pair_by_pair
        costs[k, : len(leg.starts), : len(leg.goals)] = between(leg, requirements)
    return costs


def with_room(
    legs: Sequence[HeadingLeg], costs: Floats, requirements: Requirements
) -> tuple[tuple[HeadingLeg, ...], Floats]:
    """The legs without bends that others nearly make needless, where there is no room between.

    Turns at corners of cells that lie a few centimetres apart leave each other none. What comes too
    near to a wall without them is pushed away.

    Args:
        legs: The legs.
        costs: What they cost between their headings, see ``costs_between``.
        requirements: With what may be spent.

    Returns:
        The legs, and what they cost.
    """
    none = [not np.isfinite(its).any() for its in costs]
    if not any(none):
        return tuple(legs), costs
    off = THIN * requirements.required
    thinned = [
        replace(leg, bends=leg.bends.thinned(off)) if is_none else leg
        for leg, is_none in zip(legs, none, strict=True)
    ]
    return tuple(thinned), costs_between(thinned, requirements)


def _pair_by_pair(leg: HeadingLeg, requirements: Requirements) -> Floats:
    """How long a leg is from each heading to each other one [m], (k, l)."""
    starts = leg.starts
    parts = [starts[k : k + STARTS_AT_ONCE] for k in range(0, len(starts), STARTS_AT_ONCE)]
    return np.vstack([_lengths(replace(leg, starts=some), requirements) for some in parts])


def _end_by_end(leg: HeadingLeg, requirements: Requirements) -> Floats:
    """How long a leg is whose ends know nothing of each other's heading [m], (k, l).

    That is so of a leg with much between them, but for a loop now and then; what is laid tells it.
    """
    free = np.array([math.nan])
    least = _lengths(replace(leg, starts=free, goals=free), requirements)
    if not np.isfinite(least).all():  # there is no room between what lies inside
        return np.full((len(leg.starts), len(leg.goals)), math.inf)
    begun = _lengths(replace(leg, goals=free), requirements)
    ended = _lengths(replace(leg, starts=free), requirements)
    return begun + ended - least


def _lengths(leg: HeadingLeg, requirements: Requirements) -> Floats:
    """How long a leg is, to the better sides, from each heading to each other one [m], (k, l)."""
    found = requirements.recalled(
        ("lengths", leg.bends.rows.tobytes(), leg.starts.tobytes(), leg.goals.tobytes()),
        partial(_paid_lengths, leg, requirements),
    )
    least: Floats = found.min(axis=(2, 3))
    return least


def _paid_lengths(leg: HeadingLeg, requirements: Requirements) -> Floats:
    """The lengths of a leg, when what they cost has been taken off."""
    pairs, bends = len(leg.starts) * len(leg.goals), len(leg.bends.rows)
    cost = HEADING_PAIR_BEND_S + HEADING_PAIR_BENDS_S * bends
    requirements.spend(cost * pairs * bends)
    return leg.lengths()


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
    laid: dict[tuple[int, int, int], TurnPath] = {}
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
            failed[key[0]] += 1
        if ((failed >= max_pairs) & ~is_hopeful).any():
            return None
    return None


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
