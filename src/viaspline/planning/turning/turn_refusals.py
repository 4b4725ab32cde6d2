"""Why a robot with a turning circle or a long body has no path, and what would allow one.

Tested through ``planning/methods/test_ordered`` and ``planning/test_plan_path``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from viaspline.errors import GaveUpError, NoPathError, PlanningError
from viaspline.planning.problem.method import GaveUp, Refusal
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.headings import legs_of, lengths_cost, posed
from viaspline.planning.turning.repair import clear_turn_path, turn_path_if_clear
from viaspline.planning.turning.turn_path import OVERSHOOT

RADIUS_PARTS = (0.9, 0.7, 0.5, 0.3, 0.15)  # of the radius that are tried as a remedy
CLEARANCE_PARTS = (0.5, 0.0)  # of the clearance that are tried as a remedy
MAX_HEADING_ROWS = 40  # that are tried with a smaller radius
SHOWN_DIGITS = 3


def unlaid(problem: DrivenProblem, outcome: Refusal | GaveUp) -> PlanningError:
    """The error of a path that no method has laid.

    Args:
        problem: What was asked for.
        outcome: What the methods came to.
    """
    via = problem.sequence.vias[outcome.via or 0]
    if problem.requirements.turn_radius is None:
        verb = "can't be" if isinstance(outcome, Refusal) else "wasn't"
        what = f"the body {verb} led to via point {via.name!r}: {outcome.reason}"
        remedy = _body_remedy(via.name, partial(_has_room, problem))
    else:
        verb = "can't be served" if isinstance(outcome, Refusal) else "wasn't reached"
        circle = f"with a turning circle of {problem.turn_radius:.4g} m"
        what = f"{circle} via point {via.name!r} {verb}: {outcome.reason}"
        remedy = _circle_remedy(via.name, problem.turn_radius, partial(_serves, problem))
    if isinstance(outcome, Refusal):
        return NoPathError(what, where=via.at, remedy=remedy, via=via.name)
    helps = [remedy, *([outcome.would_help] if outcome.would_help else [])]
    return GaveUpError(
        what, where=via.at, remedy=", or ".join(helps), tried=outcome.tried, via=via.name
    )


def _circle_remedy(via: str, radius: float, serves: Callable[[float], bool]) -> str:
    """What would allow a path, where there may be one with a smaller radius [m]."""
    smaller = _first(lambda part: serves(part * radius), RADIUS_PARTS)
    if smaller is None:
        return f"move {via!r} to where there is room to turn, or leave it out"
    shown = np.floor(smaller * radius * 10**SHOWN_DIGITS) / 10**SHOWN_DIGITS
    return (
        f"a radius of {shown:g} m would do (robot.min_turn_radius_m); or move {via!r} to "
        "where there is room to turn"
    )


def _body_remedy(via: str, has_room: Callable[[float], bool]) -> str:
    """What would allow a path, where there may be one with a part of the clearance."""
    less = _first(has_room, CLEARANCE_PARTS)
    moves = [f"move {via!r} to where there is room for the body"]
    if less is not None:
        moves.insert(0, f"{less:g} of the clearance would do (robot.clearance_m)")
    return ", or ".join(moves)


def _first(serves: Callable[[float], bool], parts: Sequence[float]) -> float | None:
    """The first of some parts that serves; None as well where there is no time to look for one."""
    try:
        return next((part for part in parts if serves(part)), None)
    except SpentBudgetError:
        return None


def _serves(problem: DrivenProblem, radius: float) -> bool:
    """Whether there is a path with another turning circle [m]."""
    rho = OVERSHOOT * radius
    lay = partial(
        turn_path_if_clear, rho=rho, world=problem.world, requirements=problem.requirements
    )
    legs = legs_of(problem.bends, problem.spots)
    closed = problem.sequence.closed
    problem.requirements.spend(lengths_cost(legs))
    return posed(legs, rho, closed, lay, MAX_HEADING_ROWS, MAX_HEADING_ROWS) is not None


def _has_room(problem: DrivenProblem, part: float) -> bool:
    """Whether there is a path with a part of the clearance."""
    clearance = part * problem.requirements.clearance
    requirements = replace(problem.requirements, clearance=clearance)
    return any(
        clear_turn_path(problem.bends, rho, problem.world, requirements) is not None
        for rho in problem.least_radii
    )
