"""What is told of a robot of a fleet that has no plan.

Tested through ``fleet/test_unserved_fleets``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

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
