"""What is told of a robot of a fleet that has no plan.

Tested through ``fleet/test_unserved_fleets``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from viaspline.errors import GaveUpError, GeometryError, PlanningError

Outcome: TypeAlias = Literal["refused", "gave up"]


@dataclass(frozen=True)
class NotServed:
    """A robot that has no plan.

    Attributes:
        name: The robot.
        outcome: ``refused``: proven that there is none; ``gave up``: none was found.
        reason: Why, in words, with the robots and places that are in the way.
        remedy: The least change that would help.
        obstacles: The names of the robots or obstacles that are in the way.
        where: The place of that [m], if it is one.
    """

    name: str
    outcome: Outcome
    reason: str
    remedy: str
    obstacles: tuple[str, ...] = ()
    where: tuple[float, ...] | None = None


def not_served(name: str, error: PlanningError | GeometryError) -> NotServed:
    """What is told of a robot that has no path."""
    if isinstance(error, PlanningError):
        outcome: Outcome = "gave up" if isinstance(error, GaveUpError) else "refused"
        where = (error.where[0], error.where[1])
        return NotServed(name, outcome, error.reason, error.remedy, error.obstacles, where)
    reason, _, remedy = str(error).partition("; ")
    return NotServed(name, "refused", reason, remedy)
