"""Why a turning circle is too wide, and the least change that would allow a path."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from viaspline.detour.course import Course
from viaspline.detour.turns.pose_search import NotFound, Reason
from viaspline.errors import NoPathError

SMALLER = (0.9, 0.7, 0.5, 0.3, 0.15)  # parts of the radius that are tried
DIGITS = 3


def refuse_circle(
    course: Course, radius: float, failed: NotFound, serves: Callable[[float], bool]
) -> NoPathError:
    """The error for a course that can't be driven with a turning circle.

    Args:
        course: What was asked for.
        radius: The radius of the turning circle [m].
        failed: What the search for a path came to.
        serves: Whether there is a path with a smaller radius [m].
    """
    start, via = course.ends(failed.goal)
    if failed.reason in (Reason.START_TAKEN, Reason.START_SHUT_IN):
        via = start
    smaller = next((part * radius for part in SMALLER if serves(part * radius)), None)
    if smaller is None:
        remedy = f"move {via.name!r} to where there is room to turn, or leave it out"
    else:
        shown = np.floor(smaller * 10**DIGITS) / 10**DIGITS
        remedy = (
            f"a radius of {shown:g} m would do (robot.min_turn_radius_m); or move {via.name!r} to "
            "where there is room to turn"
        )
    return NoPathError(
        f"with a turning circle of {radius:.4g} m via point {via.name!r} can't be served: "
        f"{failed.reason.value}",
        where=via.at,
        remedy=remedy,
        via=via.name,
    )
