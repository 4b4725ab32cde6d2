"""Why a turning circle is too wide, and the least change that would allow a path."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from viaspline.errors import NoPathError
from viaspline.planning.problem.via_sequence import RouteVia, ViaSequence
from viaspline.planning.turning.hybrid_astar.pose_search import NotFound, Reason

SMALLER = (0.9, 0.7, 0.5, 0.3, 0.15)  # parts of the radius that are tried
LESS = (0.5, 0.0)  # parts of the clearance that are tried
DIGITS = 3


def refuse_circle(
    sequence: ViaSequence, radius: float, failed: NotFound, serves: Callable[[float], bool]
) -> NoPathError:
    """The error for a course that can't be driven with a turning circle.

    Args:
        sequence: What was asked for.
        radius: The radius of the turning circle [m].
        failed: What the search for a path came to.
        serves: Whether there is a path with a smaller radius [m].
    """
    via = _at_fault(sequence, failed)
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


def refuse_body(
    sequence: ViaSequence, failed: NotFound, has_room: Callable[[float], bool]
) -> NoPathError:
    """The error for a course that a long body can't be led along.

    Args:
        sequence: What was asked for.
        failed: What the search for a path came to.
        has_room: Whether there is a path with a part of the clearance.
    """
    via = _at_fault(sequence, failed)
    less = next((part for part in LESS if has_room(part)), None)
    moves = [f"move {via.name!r} to where there is room for the body"]
    if less is not None:
        moves.insert(0, f"{less:g} of the clearance would do (robot.clearance_m)")
    return NoPathError(
        f"the body can't be led to via point {via.name!r}: {failed.reason.value}",
        where=via.at,
        remedy=", or ".join(moves),
        via=via.name,
    )


def _at_fault(sequence: ViaSequence, failed: NotFound) -> RouteVia:
    """The via point at which a search ended."""
    start, goal = sequence.ends(failed.goal)
    return start if failed.reason in (Reason.START_TAKEN, Reason.START_SHUT_IN) else goal
