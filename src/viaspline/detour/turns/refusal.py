"""Why a turning circle is too wide, and the least change that would allow a path."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from viaspline.detour.course import Course
from viaspline.detour.turns.poses import Leg
from viaspline.errors import NoPathError

SMALLER = (0.9, 0.7, 0.5, 0.3, 0.15)  # parts of the radius that are tried
DIGITS = 3


def refuse_circle(
    course: Course, radius: float, failing: int, serves: Callable[[float], bool]
) -> NoPathError:
    """The error for a course that can't be driven with a turning circle.

    Args:
        course: What was asked for.
        radius: The radius of the turning circle [m].
        failing: The leg that can't be driven, as far as that can be said.
        serves: Whether there is a path with a smaller radius [m].
    """
    via = course.ends(failing)[1]
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
        f"the turning circle of {radius:g} m is too wide to come to via point {via.name!r}",
        where=via.at,
        remedy=remedy,
        via=via.name,
    )


def first_failing(legs: Sequence[Leg], can: Callable[[Sequence[Leg]], bool]) -> int:
    """The first leg up to which there is no row of headings."""
    return next((k for k in range(len(legs)) if not can(legs[: k + 1])), len(legs) - 1)
