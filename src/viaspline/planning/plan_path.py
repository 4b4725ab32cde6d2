"""From a course to a proven path, for whichever robot is to drive it."""

from __future__ import annotations

from viaspline.curve.path import Path
from viaspline.planning.alternatives.lay_clear import lay_clear
from viaspline.planning.alternatives.record import Account
from viaspline.planning.alternatives.solution import Detoured
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Brief
from viaspline.planning.problem.spline_path import Laid
from viaspline.planning.problem.via_sequence import Course
from viaspline.planning.turning.turn_planner import lay_drivable
from viaspline.world.world import World


def lay_course(course: Course, world: World, brief: Brief) -> tuple[Laid, Account]:
    """The curve of a course that the robot can drive clear of everything.

    Raises:
        NoPathError: When there is none, with the least change that would serve.
    """
    if brief.turn_radius is None and brief.footprint is None:
        return lay_clear(course, world, brief)
    return lay_drivable(course, world, brief)


def find_path(course: Course, world: World, brief: Brief) -> Detoured:
    """A proven path along a course.

    Raises:
        NoPathError: When there is none, with the least change that would serve.
    """
    laid, account = lay_course(course, world, brief)
    path = Path(laid.spans, laid.vias)
    return Detoured(path, proven(path, world, brief), account)
