"""Headings at the via points, chosen together: for via points too close for the turning circle.

Between two via points with given headings there is always a way for a car in the open: it drives
on and comes round again. So every via point gets a row of headings, and the cheapest row of legs
between them is found by dynamic programming; legs that can't be laid are left
out, one after the other, until a row is clear.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.turning.heading_costs import leg_lengths
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import HEADING_PAIR_BEND_S, HEADING_PAIR_BENDS_S
from viaspline.planning.turning.bend_row import DETOUR, HEADING, SIDE, Bends
from viaspline.planning.turning.turn_path import RAMP

HEADING_COUNT = 36  # that are tried at a via point
STARTS_AT_ONCE = 6  # of the headings of a leg, of which a search is stopped no sooner than after
APART_BENDS = 4  # of a leg, ends among them, from which on its ends know nothing of each other
THIN = 0.02  # off the line of others, that bends may be left out where there is no room; required


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
