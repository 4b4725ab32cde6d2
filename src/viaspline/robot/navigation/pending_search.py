"""A search for a new path that goes on from step to step, and the parts that it has."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping
from dataclasses import dataclass, replace
from typing import Final, TypeAlias

from viaspline.mission.shapes.obstacle import Side
from viaspline.robot.run import Mode
from viaspline.world.world import World

Stage: TypeAlias = tuple[int, int]
"""A part of a search: which of the order, and which place at which the path so far is left."""

UNDER_WAY: Final[tuple[Mode, ...]] = ("reflex", "planned")
"""The modes in which a path is left under way, in this order."""

ORDER: Final[tuple[Mode, ...]] = (*UNDER_WAY, "from_rest", "from_rest")
"""The modes, from the least change to the greatest. From rest the path is laid anew nearby first,
as far as something is in its way, then all of it."""

NEARBY: Final = len(UNDER_WAY)
"""The first of the latter."""

FIRST_STAGE: Final[Stage] = (0, 0)
"""With which a search begins,"""

LAST_STAGE: Final[Stage] = (len(ORDER) - 1, 0)
"""with which it ends,"""

NO_STAGE: Final[Stage] = (len(ORDER), 0)
"""and what comes after that."""


@dataclass(frozen=True)
class SearchSoFar:
    """What a search has come to, as its next step takes it on.

    Attributes:
        limit: What the next step of a robot that stands may spend [s of the reference machine].
        spent: What it has spent in all since it stands [s of the reference machine].
        world: What it is to keep clear of.
        finished: What the parts of the search came to that are over; see ``WorkBudget``.
    """

    limit: float
    spent: float
    world: World
    finished: Mapping[Hashable, object]


@dataclass(frozen=True)
class SideInDoubt:
    """Something that a new path would pass on another side than the robot meant to.

    Attributes:
        place: In it [m].
        side: The side that the robot meant.
        modes: In which a path is sought that keeps to that.
        other: Length of the one that doesn't, driven as far as the path so far [m].
        is_open: Whether it is still sought; else the robot takes the other.
    """

    place: tuple[float, float]
    side: Side
    modes: tuple[Mode, ...]
    other: float
    is_open: bool = True


@dataclass(frozen=True)
class PendingSearch:
    """A search for a new path that is not over yet.

    Attributes:
        since: When it began [s].
        obstacles: What is in the way.
        names: Of those that are new.
        begin_with: The stage with which it goes on.
        so_far: What it takes on to its next step.
        again: Under way it waits until then: it has tried all that it has time for [s].
        free_until: Up to this distance along the path it was certainly clear then [m].
        doubt: What it was found to pass on another side, if that is not decided yet.
        leave: Where alone the path so far is left meanwhile [m], if that is settled: a robot that
            never turns on the spot may have no way on from where it will stand.
        brakes: Whether the robot brakes already, for the time that it may search for is up.
    """

    since: float
    obstacles: World
    names: tuple[str, ...]
    begin_with: Stage
    so_far: SearchSoFar
    again: float = -math.inf
    free_until: float = math.inf
    doubt: SideInDoubt | None = None
    leave: float | None = None
    brakes: bool = False

    def with_new(self, new: World) -> PendingSearch:
        """The search with what has just been seen: that may bar what was tried, so it begins anew.

        Args:
            new: What that is, if it is anything.
        """
        if not len(new):
            return self
        return replace(
            self,
            obstacles=World((*self.obstacles.obstacles, *new.obstacles)),
            names=(*self.names, *new.names),
            begin_with=FIRST_STAGE,
            again=-math.inf,
            free_until=math.inf,
            doubt=None,
            leave=None,
        )
