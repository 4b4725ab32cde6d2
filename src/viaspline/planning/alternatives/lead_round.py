"""Leading legs round what stands in their way: by groups where they are few, else by islands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.routing.corners import X, Y
from viaspline.kernels.routing.narrow_gaps import narrow_places
from viaspline.kernels.world.clusters import group_labels
from viaspline.planning.alternatives.groups import (
    PassedGroups,
    WeighedLater,
    groups_met,
    pass_groups,
)
from viaspline.planning.alternatives.islands import PassedIslands
from viaspline.planning.alternatives.leg_search import LegSearch, Spline
from viaspline.planning.problem.requirements import Brief
from viaspline.planning.problem.via_sequence import Course
from viaspline.planning.routing.route_refusals import BlockedLegError, explain_blocked_leg
from viaspline.planning.routing.router import NO_BARRIERS, Flags, Floats, Router, on_the_line
from viaspline.world.world import World

TIGHT = 1e-4  # room on either side that a curve may need beyond what is required [m]
MOST = 200  # such gaps
WEIGHED = 4  # groups up to which the curves on either side are weighed at once
Passed = PassedGroups | WeighedLater | PassedIslands


@dataclass(frozen=True)
class Task:
    """A world to find ways in.

    Attributes:
        world: The known world.
        brief: What to keep.
        router: Of both.
    """

    world: World
    brief: Brief
    router: Router

    @classmethod
    def of(cls, course: Course, world: World, brief: Brief) -> Task:
        """The task of a course."""
        places = np.array([via.at[:2] for via in course.vias])
        return cls(world, brief, Router(world, brief.required, places))

    @cached_property
    def groups(self) -> NDArray[np.int64]:
        """Label of every obstacle's group, (n,)."""
        labels: NDArray[np.int64] = group_labels(self.world.packed, 2 * self.brief.required)
        return labels

    def lead_round(self, course: Course, index: int, hit: Sequence[int]) -> Passed:
        """Lead one leg round everything, by the shorter side of each group.

        Args:
            course: What there is so far.
            index: The leg that comes too close to something.
            hit: Obstacles that its curve comes too close to.

        Raises:
            NoPathError: When there is no way, with the least change that would serve.
        """
        leg = LegSearch(course, index, self.world, self.brief, self.router)
        active = on_the_line(self.world, *leg.ends, self.brief.required)
        active[list(hit)] = True
        dense = self.router.is_dense(active)
        met = () if dense else groups_met(leg, self.groups, active)
        best, barriers = self._fitted(leg, active)
        if best is None:
            world, brief = self.world, self.brief
            raise BlockedLegError(
                course.ends(index)[1].name,
                lambda: explain_blocked_leg(course, index, world, brief, barriers),
            )
        if dense:
            return PassedIslands(leg, best)
        if len(met) > WEIGHED:
            return WeighedLater(leg, met, best, active)
        return pass_groups(leg, met, best, active)

    def _fitted(self, leg: LegSearch, active: Flags) -> tuple[Spline | None, Floats]:
        """The curve along the shortest way on which one fits, and the sides that are forbidden.

        A gap that is just as wide as what is required lets a polyline through, but no curve with
        a certificate: it is closed then.
        """
        closed = NO_BARRIERS
        while True:
            way, barriers = leg.shortest_allowed(active, closed)
            best = leg.curve(way)
            if way is None or best is not None:
                return best, barriers
            places = np.ascontiguousarray(way.corners[:, X : Y + 1])
            tight = narrow_places(self.world.packed, places, self.brief.required + TIGHT)
            if not len(tight) or len(closed) > MOST:
                return None, barriers
            closed = np.vstack((closed, tight))
