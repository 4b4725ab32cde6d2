"""The problem of laying a whole path: through which points, in which world, keeping what.

Tested through ``planning/methods/test_clear_spline``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from viaspline.kernels.arrays import Ints
from viaspline.kernels.world.clusters import group_labels
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.routing.asked_sides import AskedSides, sided
from viaspline.planning.routing.router import Router
from viaspline.world.world import World


@dataclass(frozen=True)
class PathProblem:
    """A path that is asked for.

    Attributes:
        sequence: The via points and nothing else.
        world: The known world.
        requirements: What to keep.
        router: Finds routes between the via points in that world.
        overlooked: Indices of obstacles whose side binds a leg though it isn't in its way: a path
            that was laid came near to it. One row for each leg; empty where there are none.
    """

    sequence: ViaSequence
    world: World
    requirements: Requirements
    router: Router
    overlooked: tuple[tuple[int, ...], ...] = ()

    @classmethod
    def of(cls, sequence: ViaSequence, world: World, requirements: Requirements) -> PathProblem:
        """The problem of a via sequence."""
        places = np.array([via.at[:2] for via in sequence.vias])
        router = Router(world, requirements.required, places)
        if not requirements.objective.is_time:
            router = router.for_shortest
        return cls(sequence, world, requirements, router)

    def binding_too(self, overlooked: Sequence[tuple[int, ...]]) -> PathProblem:
        """This problem, where the sides of some more obstacles bind: a row for each leg."""
        known = self.overlooked or ((),) * len(overlooked)
        rows = tuple((*old, *new) for old, new in zip(known, overlooked, strict=True))
        return replace(self, overlooked=rows)

    @cached_property
    def sides(self) -> tuple[AskedSides, ...]:
        """The sides that are asked for, as every leg sees them."""
        indices, required = sided(self.world), self.requirements.required
        legs = [self.sequence.whole_leg(k) for k in range(len(self.sequence.legs))]
        sides = [
            AskedSides.of(leg, indices, self.world, required, lambda: self.groups) for leg in legs
        ]
        if self.overlooked:
            sides = [s.with_binding(more) for s, more in zip(sides, self.overlooked, strict=True)]
        return tuple(sides)

    @cached_property
    def groups(self) -> Ints:
        """Label of every obstacle's group, (n,): those between which the robot doesn't get."""
        labels: Ints = group_labels(self.world.packed, 2 * self.requirements.required)
        return labels
