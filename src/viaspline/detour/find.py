"""From a course to a proven path, for whichever robot is to drive it."""

from __future__ import annotations

from viaspline.curve.path import Path
from viaspline.detour.account import Account
from viaspline.detour.body import proven
from viaspline.detour.brief import Brief
from viaspline.detour.course import Course
from viaspline.detour.detoured import Detoured
from viaspline.detour.drivable import lay_drivable
from viaspline.detour.laid import Laid
from viaspline.detour.search import lay_clear
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
