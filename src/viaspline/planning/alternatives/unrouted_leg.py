"""What is said of a leg for which no route was found on the sides that are asked for.

Tested through ``planning/methods/test_clear_spline``.
"""

from __future__ import annotations

from viaspline.errors import PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.problem.method import GaveUp, Refusal
from viaspline.planning.routing.leg_errors import BlockedLegError, UnfinishedLegError
from viaspline.planning.routing.leg_refusals import (
    explain_blocked_leg,
    explain_unfinished_leg,
    is_blocked,
)


def unrouted(leg: LegSearch, outcome: Refusal | GaveUp, barriers: Floats) -> PlanningError:
    """The error of a leg for which nothing was found.

    Args:
        leg: The leg.
        outcome: Why.
        barriers: What forbids sides, (f, 4) [m].
    """
    via = leg.sequence.ends(leg.index)[1].name
    asked = (leg.sequence, leg.index, leg.world, leg.requirements, barriers)
    if isinstance(outcome, Refusal) or is_blocked(*asked[:4]):
        return BlockedLegError(via, lambda: explain_blocked_leg(*asked))
    return UnfinishedLegError(via, lambda: explain_unfinished_leg(*asked, outcome), outcome.tried)
