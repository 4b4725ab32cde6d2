"""The shortest way between two places that passes obstacles on the sides that are asked for.

Tested through ``planning/routing/test_visit_order``.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.planning.problem.method import Outcome
from viaspline.planning.routing.asked_sides import AskedSides
from viaspline.planning.routing.route_problem import NO_BARRIERS
from viaspline.planning.routing.taut_path import TautPath


def route_on_sides(
    find: Callable[[Floats, Flags], tuple[Outcome[TautPath], Flags]],
    sides: AskedSides,
    active: Flags,
    closed: Floats,
) -> tuple[Outcome[TautPath], Floats]:
    """The shortest taut path that passes what it meets on the sides that the mission allows.

    It can meet obstacles with a side of their own that were not met before, or go round one
    that the leg's straight line passes as it should; each such round adds at least one barrier,
    so there are no more rounds than obstacles.

    Args:
        find: The shortest taut path past segments, (b, 4), where some obstacles are met already,
            (n,), and all that are met then, (n,).
        sides: Those that are asked for, as the leg sees them.
        active: (n,): obstacles to begin with; those met are added in place.
        closed: Further segments not to cross, (b, 4).

    Returns:
        What came of it, and the barriers that forbid sides, (f, 4).
    """
    if not sides.indices.size:
        outcome, met = find(closed, active)
        active |= met
        return outcome, NO_BARRIERS
    barriers = sides.closed_among(active)
    while True:
        outcome, met = find(np.vstack((closed, barriers)), active)
        active |= met
        if outcome.value is not None:
            corners = outcome.value.corners[:, X : Y + 1]
            active[sides.gone_round(corners)] = True
        needed = sides.closed_among(active)
        if len(needed) == len(barriers):
            return outcome, barriers
        barriers = needed
