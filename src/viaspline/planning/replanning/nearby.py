"""A path that is sought in what is near first: what stands elsewhere costs it nothing.

Tested through ``planning/replanning/test_replan`` and ``robot/navigation/test_rounds``.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from viaspline.errors import PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.record import Account
from viaspline.planning.checking.conflicts import is_clear
from viaspline.planning.plan_path import lay_path
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.world.world import World

NEAR_SIZES, NEAR_WIDTHS = 0.5, 10.0
"""A path round something is sought so near to the spans that it replaces at first: parts of their
size, and required distances beside them."""


def lay_nearby(
    sequence: ViaSequence, old: Floats, world: World, requirements: Requirements
) -> tuple[SplinePath, Account]:
    """Lay a sequence in what is near to the spans that it replaces, or else in the whole world."""
    places = old.reshape(-1, old.shape[2])[:, :2]
    low, high = places.min(axis=0), places.max(axis=0)
    margin = NEAR_SIZES * float(np.max(high - low)) + NEAR_WIDTHS * requirements.required
    (x0, y0), (x1, y1) = (low - margin).tolist(), (high + margin).tolist()
    box = (x0, y0, x1, y1)
    near = requirements.once(("near", world, box), partial(world.near, box))
    if len(near) < len(world):
        try:
            laid = lay_path(sequence, near, requirements)
            if is_clear(world, laid[0].spans, requirements):
                return laid
        except SpentBudgetError:
            raise
        except PlanningError:
            pass  # there may be a way farther round
    return lay_path(sequence, world, requirements)
