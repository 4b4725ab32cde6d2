"""Why a leg in space has no way, in words that name what is in the way and what would help.

Tested through ``space/test_plan_spatial`` and ``space/test_asked_passes``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.errors import GaveUpError, NoPathError
from viaspline.space.asked_passes import AskedPass
from viaspline.space.routing.taut_route import SpaceGaveUp, SpaceRefusal
from viaspline.space.spatial_problem import SpatialProblem


def refused_leg(problem: SpatialProblem, leg: int, refusal: SpaceRefusal) -> NoPathError:
    """A leg with an end that isn't free, or that is shut in.

    Args:
        problem: What is asked.
        leg: Which one.
        refusal: The proof.
    """
    first, last = problem.vias[leg], problem.vias[leg + 1]
    name = problem.world.name(refusal.obstacle)
    at_start = np.allclose(refusal.where, first.at)
    which = first.name if at_start else last.name
    reason = refusal.reason.removeprefix("the start").removeprefix("the goal").strip()
    return NoPathError(
        f"'{which}' {reason}" + ("" if refusal.obstacle == -1 else f" by '{name}'"),
        where=refusal.where,
        remedy="move it, or ask for less clearance",
        via=which,
        obstacles=() if refusal.obstacle < 0 else (name,),
    )


def shut_leg(problem: SpatialProblem, leg: int, shut: Sequence[AskedPass]) -> NoPathError:
    """A leg that is to pass things where the limits of the world leave no room.

    Args:
        problem: What is asked.
        leg: Which one.
        shut: These things, one at least.
    """
    first, last = problem.vias[leg], problem.vias[leg + 1]
    sides = " and ".join(one.words for one in shut)
    return NoPathError(
        f"from '{first.name}' to '{last.name}' nothing passes {sides}: there is no room for "
        f"{problem.clearance:g} m between that and the ground, the bounds or the altitude band",
        where=first.at.tolist(),
        remedy="leave out pass_on or never_pass_on there, or ask for other sides",
        via=last.name,
        obstacles=tuple(one.name for one in shut),
    )


def given_up_leg(
    problem: SpatialProblem, leg: int, outcome: SpaceGaveUp, sides: str
) -> GaveUpError:
    """A leg for which no way was found.

    Args:
        problem: What is asked.
        leg: Which one.
        outcome: What was tried.
        sides: What it is to pass on which sides, in words, if there is a way without that.
    """
    first, last = problem.vias[leg], problem.vias[leg + 1]
    names = f"from '{first.name}' to '{last.name}'"
    reason = f"{names} {outcome.reason}"
    remedy = f"{outcome.would_help}, or a via point on the way"
    if sides:
        reason = f"{names} no route was found that passes {sides}; without that there is one"
        remedy = "leave out pass_on or never_pass_on there, or ask for other sides"
    return GaveUpError(
        reason, where=first.at.tolist(), remedy=remedy, tried=outcome.tried, via=last.name
    )
