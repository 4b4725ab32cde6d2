"""What a robot keeps for its tracking error where no path keeps what another one needs.

A path that keeps less is another path, which may need less.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

from viaspline.errors import GeometryError, PlanningError

ERRORS_BETWEEN = 12
"""Parts of what lies between two errors, at the ends of which a plan is looked for."""

Planned = TypeVar("Planned")


def planned_between(
    kept: float,
    refused: float,
    plan_with: Callable[[float], Planned],
    gets_beside: Callable[[Planned], float],
) -> Planned | None:
    """The plan that keeps the least error that is enough for its own path.

    Args:
        kept: With which there is a path that needs more [m].
        refused: With which there is none, or none was found [m].
        plan_with: The plan that keeps an error [m].
        gets_beside: How far the robot gets beside the path of a plan [m].

    Returns:
        None where none of those that are tried is enough.

    Example:
        >>> planned_between(0.0, 0.12, lambda error: error, lambda error: 0.055 - 0.5 * error)
        0.04
    """
    for part in range(1, ERRORS_BETWEEN):
        error = kept + part * (refused - kept) / ERRORS_BETWEEN
        with suppress(GeometryError):
            try:
                plan = plan_with(error)
            except PlanningError:  # nor is there a path that keeps more
                return None
            if gets_beside(plan) <= error:
                return plan
    return None
