"""From a course to a proven path, for whichever robot is to drive it."""

from __future__ import annotations

from viaspline.curve.path import Path
from viaspline.planning.alternatives.lay_clear import lay_clear
from viaspline.planning.alternatives.record import Account
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.turning.turn_planner import lay_drivable
from viaspline.world.world import World


def lay_course(
    sequence: ViaSequence, world: World, requirements: Requirements
) -> tuple[SplinePath, Account]:
    """The curve of a course that the robot can drive clear of everything.

    Raises:
        NoPathError: When there is none, with the least change that would serve.
    """
    if requirements.turn_radius is None and requirements.footprint is None:
        return lay_clear(sequence, world, requirements)
    return lay_drivable(sequence, world, requirements)


def find_path(sequence: ViaSequence, world: World, requirements: Requirements) -> Solution:
    """A proven path along a course.

    Raises:
        NoPathError: When there is none, with the least change that would serve.
    """
    spline_path, account = lay_course(sequence, world, requirements)
    path = Path(spline_path.spans, spline_path.vias)
    return Solution(path, proven(path, world, requirements), account)
