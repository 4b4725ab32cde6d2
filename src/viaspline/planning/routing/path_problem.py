"""The problem of laying a whole path: through which points, in which world, keeping what.

Tested through ``planning/methods/test_clear_spline``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viaspline.kernels.arrays import Ints
from viaspline.kernels.world.clusters import group_labels
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import ViaSequence
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
    """

    sequence: ViaSequence
    world: World
    requirements: Requirements
    router: Router

    @classmethod
    def of(cls, sequence: ViaSequence, world: World, requirements: Requirements) -> PathProblem:
        """The problem of a via sequence."""
        places = np.array([via.at[:2] for via in sequence.vias])
        return cls(sequence, world, requirements, Router(world, requirements.required, places))

    @cached_property
    def groups(self) -> Ints:
        """Label of every obstacle's group, (n,): those between which the robot doesn't get."""
        labels: Ints = group_labels(self.world.packed, 2 * self.requirements.required)
        return labels
