"""Which headings have room at the ends of long legs, before such legs are pushed clear.

A leg through many via points takes long to be pushed away from what is near it. Whether a heading
has room at its end is told by what lies between that and the next via point.

Tested through ``planning/methods/test_nearby_headings``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planning.turning.bend_row import DETOUR
from viaspline.planning.turning.headings import HeadingLeg
from viaspline.planning.turning.posed_legs import Lay

FREE = np.array([math.nan])


def with_clear_ends(legs: Sequence[HeadingLeg], costs: Floats, lay: Lay) -> Floats:
    """What legs cost, infinite between headings of which one has no room.

    Args:
        legs: The legs; those without via points inside stay as they are.
        costs: What they cost between their headings [m], see ``headings.costs_between``.
        lay: Lays a clear turn path round the bends of a leg, if it can.
    """
    costs = costs.copy()
    for leg, its_costs in zip(legs, costs, strict=True):
        if not leg.inner_vias:
            continue
        first, last = _ends(leg)
        for k, heading in enumerate(leg.starts.tolist()):
            if _is_in_doubt(heading, its_costs[k]) and not lay(first.between(heading, math.nan)):
                its_costs[k] = math.inf
        for k, heading in enumerate(leg.goals.tolist()):
            if _is_in_doubt(heading, its_costs[:, k]) and not lay(last.between(math.nan, heading)):
                its_costs[:, k] = math.inf
    return costs


def _is_in_doubt(heading: float, costs: Floats) -> bool:
    """Whether a heading is given that may have room."""
    return math.isfinite(heading) and bool(np.isfinite(costs).any())


def _ends(leg: HeadingLeg) -> tuple[HeadingLeg, HeadingLeg]:
    """A leg up to its first via point, and from its last one on."""
    bends, vias = leg.bends, np.flatnonzero(leg.bends.vias != DETOUR)
    first, last = np.arange(vias[1] + 1), np.arange(vias[-2], len(bends.rows))
    return (
        HeadingLeg(bends.only(first), leg.starts, FREE),
        HeadingLeg(bends.only(last), FREE, leg.goals),
    )
