"""A tension stated in a mission, whatever it said itself, and which of some to state.

Tested through ``test_advice``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, TypeAlias

from viaspline.mission.model import Mission

StatedTension: TypeAlias = float | tuple[float, ...] | None
"""One for all spans, or one for each; None: none is stated."""

REFERENCES: Final[tuple[StatedTension, ...]] = (None, 0.0, -0.5, 0.5)
"""What anybody would state by hand, or nothing: what is taken is never worse than any of them."""
SPARE_SHARE: Final = 1e-3
"""Part of the time that may be spent on a gentler path."""
SAME_SHARE: Final = 1e-6
"""Part of a time or a curvature by which two plans that are the same may differ."""


def with_tension(mission: Mission, tension: StatedTension) -> Mission:
    """A mission with another tension.

    >>> slack = Mission.model_validate({"route": {"goal": [9, 0], "start": [0, 0]},
    ...                                 "spline": {"slack": 0.45}})
    >>> spline = with_tension(slack, 0.2).spline
    >>> spline.tension, spline.slack
    (0.2, None)
    """
    spline = mission.spline.model_copy(update={"tension": tension, "slack": None})
    return mission.model_copy(update={"spline": spline})


def best_stated(costs: Sequence[tuple[float, float]], bar: float) -> int:
    """Which of some plans to take: the gentlest of those that are nearly the soonest.

    Args:
        costs: What each of them costs, a time [s] say, and its peak curvature [1/m].
        bar: What the best of those costs than which it must not be worse.

    Returns:
        The place of the first of equals.

    >>> best_stated([(9.0, 2.0), (10.0, 1.0)], 10.0)  # much sooner
    0
    >>> best_stated([(9.999, 2.0), (10.0, 1.0)], 10.0)  # hardly sooner, and sharper
    1
    >>> best_stated([(9.999, 2.0), (10.0, 1.0)], 9.999)  # that other one is worse than the bar
    0
    """
    soonest = min(cost for cost, _ in costs)
    limit = min(bar * (1.0 + SAME_SHARE), soonest * (1.0 + SPARE_SHARE))
    near = [k for k, (cost, _) in enumerate(costs) if cost <= limit]
    peak = min(costs[k][1] for k in near)
    return next(k for k in near if costs[k][1] <= peak * (1.0 + SAME_SHARE) + SAME_SHARE)
