"""Leading legs round what stands in their way: by groups where they are few, else by islands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.routing.narrow_gaps import narrow_places
from viaspline.kernels.world.clusters import group_labels
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.planning.alternatives.groups import (
    DeferredComparison,
    PassedGroups,
    groups_met,
    pass_groups,
)
from viaspline.planning.alternatives.islands import PassedIslands
from viaspline.planning.alternatives.leg_search import LegSearch, Spline
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.routing.route_refusals import BlockedLegError, explain_blocked_leg
from viaspline.planning.routing.router import NO_BARRIERS, Router, on_the_line
from viaspline.world.world import World

TIGHT = 1e-4  # room on either side that a curve may need beyond what is required [m]
MOST = 200  # such gaps
WEIGHED = 4  # groups up to which the curves on either side are weighed at once
Passed = PassedGroups | DeferredComparison | PassedIslands


@dataclass(frozen=True)
class DetourProblem:
    """A world to find ways in.

    Attributes:
        world: The known world.
        requirements: What to keep.
        router: Of both.
    """

    world: World
    requirements: Requirements
    router: Router

    @classmethod
    def of(cls, sequence: ViaSequence, world: World, requirements: Requirements) -> DetourProblem:
        """The task of a course."""
        places = np.array([via.at[:2] for via in sequence.vias])
        return cls(world, requirements, Router(world, requirements.required, places))

    @cached_property
    def groups(self) -> NDArray[np.int64]:
        """Label of every obstacle's group, (n,)."""
        labels: NDArray[np.int64] = group_labels(self.world.packed, 2 * self.requirements.required)
        return labels

    def lead_round(self, sequence: ViaSequence, index: int, hit: Sequence[int]) -> Passed:
        """Lead one leg round everything, by the shorter side of each group.

        Args:
            sequence: What there is so far.
            index: The leg that comes too close to something.
            hit: Obstacles that its curve comes too close to.

        Raises:
            NoPathError: When there is no way, with the least change that would serve.
        """
        leg = LegSearch(sequence, index, self.world, self.requirements, self.router)
        active = on_the_line(self.world, *leg.ends, self.requirements.required)
        active[list(hit)] = True
        dense = self.router.is_dense(active)
        met = () if dense else groups_met(leg, self.groups, active)
        best, barriers = self._fitted(leg, active)
        if best is None:
            world, requirements = self.world, self.requirements
            raise BlockedLegError(
                sequence.ends(index)[1].name,
                lambda: explain_blocked_leg(sequence, index, world, requirements, barriers),
            )
        if dense:
            return PassedIslands(leg, best)
        if len(met) > WEIGHED:
            return DeferredComparison(leg, met, best, active)
        return pass_groups(leg, met, best, active)

    def _fitted(self, leg: LegSearch, active: Flags) -> tuple[Spline | None, Floats]:
        """The curve along the shortest way on which one fits, and the sides that are forbidden.

        A gap that is just as wide as what is required lets a polyline through, but no curve with
        a certificate: it is closed then.
        """
        closed = NO_BARRIERS
        while True:
            taut_path, barriers = leg.shortest_allowed(active, closed)
            best = leg.curve(taut_path)
            if taut_path is None or best is not None:
                return best, barriers
            places = np.ascontiguousarray(taut_path.corners[:, X : Y + 1])
            tight = narrow_places(self.world.packed, places, self.requirements.required + TIGHT)
            if not len(tight) or len(closed) > MOST:
                return None, barriers
            closed = np.vstack((closed, tight))
