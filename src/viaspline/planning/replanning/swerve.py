"""A new path under way through one place beside the old one: laid at once, nothing searched.

It costs a small part of what a search round something does, so many places can be tried. What
lies in its way makes it no path; where the robot's turning circle or the mission's sides have a
say, none is laid.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path, PathVia
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import NoPathError
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import Leg, ViaSequence, lay
from viaspline.planning.replanning.departure import Departure, Leave
from viaspline.planning.replanning.joined_stretch import head_until, solution_from, vias_until
from viaspline.planning.replanning.stretch import (
    Stretch,
    is_round,
    leaving_place,
    sequence_through,
    vias_remaining,
)
from viaspline.world.world import World

RUN_OUT_M = 0.2
"""Over so much the curvature of the old path eases off [m], where there is room."""


def may_swerve(path: Path, world: World, requirements: Requirements) -> bool:
    """Whether any path will do that is clear and leads through the via points."""
    asked = any(one.pass_on or one.never_pass_on for one in world.obstacles)
    return requirements.is_free_disc and path.dimension == 2 and not asked and not is_round(path)


@dataclass(frozen=True, eq=False)
class Swerving:
    """What all paths have in common that leave an old one at one place, each for another place.

    Attributes:
        head: The spans of the old path that stay [m], (m, 4, 2).
        vias: The via points on them.
        departure: How the old path is left.
        sequence: From there on, as it is without a place to go by.
        world: What stands.
        requirements: What to keep.
    """

    head: Floats
    vias: Sequence[PathVia]
    departure: Departure
    sequence: ViaSequence
    world: World
    requirements: Requirements

    @classmethod
    def off(
        cls, path: Path, at: float, world: World, requirements: Requirements, leave: Leave
    ) -> Swerving:
        """Leave a path for places on the way to the next via point.

        Args:
            path: What is being driven; ``may_swerve`` holds for it.
            at: Distance along it from which it may differ [m].
            world: What stands.
            requirements: What to keep.
            leave: How the old path is left.

        Raises:
            NoPathError: When it can't be left there.
        """
        at, u = leaving_place(path, at)
        stretch = Stretch(u, vias_remaining(path, at, world, requirements, ()), None)
        departure = leave(path, stretch, world, requirements, RUN_OUT_M)
        sequence = sequence_through(path, departure.start, stretch, requirements)
        sequence = replace(sequence, start_tangent=departure.tangent, tangents="continuous")
        head = head_until(path, u)
        vias = vias_until(path, u, len(head))
        return cls(head, vias, departure, sequence, world, requirements)

    def through(self, place: Floats) -> Solution:
        """Lay everything ahead anew, through a place [m], (2,).

        Raises:
            NoPathError: When that path comes too near to something.
        """
        slack = self.sequence.legs[0].slack[0]
        sequence = self.sequence.with_leg(0, Leg(np.array([place]), np.array([slack, slack])))
        spans, joints = lay(sequence), sequence.first_spans()
        laid = SplinePath.through(sequence, spans, joints, (sequence.pieces,))
        head, out = len(self.head), self.departure.spans
        vias = [*self.vias, *laid.vias_from(head + len(out))]
        new = Path(np.concatenate((self.head, out, spans)), vias)
        certificate = proven(PiecewiseCubic(new.spans[head:]), self.world, self.requirements)
        if not certificate.holds:
            raise NoPathError(
                "there is no room beside the path",
                where=place,
                remedy="look for another place",
            )
        return solution_from(new, float(new.distance(float(head))), certificate, None)
