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
from viaspline.planning.problem.via_sequence import RouteVia
from viaspline.planning.routing.side_refusals import (
    changes_freeing,
    freeing_in_words,
    sides_in_words,
)
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.headings import HEADING_COUNT, costs_between
from viaspline.planning.turning.laid_turns import through_turns
from viaspline.planning.turning.posed_legs import Poses, posed
from viaspline.planning.turning.repair import clear_turn_path, turn_path_if_clear
from viaspline.planning.turning.turn_path import OVERSHOOT
from viaspline.planning.turning.turn_problem import TurnProblem

RADIUS_PARTS = (0.9, 0.7, 0.5, 0.3, 0.15)  # of the radius that are tried as a remedy
CLEARANCE_PARTS = (0.5, 0.0)  # of the clearance that are tried as a remedy
MAX_HEADING_ROWS = 40  # that are tried with a smaller radius
SHOWN_DIGITS = 3


def unlaid(problem: DrivenProblem, outcome: Refusal | GaveUp) -> PlanningError:
    """The error of a path that no method has laid.

    What would allow one takes as long to find as a path: who has a budget has no time for that.

    Args:
        problem: What was asked for.
        outcome: What the methods came to.
    """
    if isinstance(outcome, Refusal) and outcome.error is not None:
        return outcome.error
    via = problem.sequence.vias[outcome.via or 0]
    is_hurried = problem.requirements.budget is not None
    sided = [] if is_hurried else _sides_in_the_way(problem)
    if sided:
        return _no_path_on_sides(problem, outcome, via, sided)
    if via.index is None:
        what, remedy = _no_way_on(problem, outcome)
    elif problem.requirements.turn_radius is None:
        verb = "can't be" if isinstance(outcome, Refusal) else "wasn't"
        what = f"the body {verb} led to via point {via.name!r}: {outcome.reason}"
        parts = () if is_hurried else CLEARANCE_PARTS
        remedy = _body_remedy(via.name, _first(partial(_has_room, problem), parts))
    else:
        verb = "can't be served" if isinstance(outcome, Refusal) else "wasn't reached"
        circle = f"with a turning circle of {problem.turn_radius:.4g} m"
        what = f"{circle} via point {via.name!r} {verb}: {outcome.reason}"
        radii = [] if is_hurried else [part * problem.turn_radius for part in RADIUS_PARTS]
        remedy = _circle_remedy(via.name, _first(partial(_serves, problem), radii))
    if isinstance(outcome, Refusal):
        return NoPathError(what, where=via.at, remedy=remedy, via=via.name)
    helps = [remedy, *([outcome.would_help] if outcome.would_help else [])]
    return GaveUpError(
        what, where=via.at, remedy=", or ".join(helps), tried=outcome.tried, via=via.name
    )


def _no_way_on(problem: DrivenProblem, outcome: Refusal | GaveUp) -> tuple[str, str]:
    """What is said of a robot under way that can't leave where it is, and what helps it on."""
    circle = problem.requirements.turn_radius
    room = "for its body" if circle is None else "to turn"
    who = "" if circle is None else f"with a turning circle of {circle:.4g} m "
    verb = "is no" if isinstance(outcome, Refusal) else "was found no"
    return (
        f"{who}there {verb} way on from where the robot is: {outcome.reason}",
        f"drive it to where there is room {room}, and plan anew from there",
    )


def _no_path_on_sides(
    problem: DrivenProblem, outcome: Refusal | GaveUp, via: RouteVia, sided: Sequence[int]
) -> PlanningError:
    """The error where there would be a path if some obstacles could be passed on other sides."""
    world, circle = problem.world, problem.requirements.turn_radius
    who = "for the body" if circle is None else f"with a turning circle of {circle:.4g} m"
    verb = "can pass" if isinstance(outcome, Refusal) else "was found that passes"
    what = f"{who} no path {verb} {sides_in_words(world, sided)}: {outcome.reason}"
    remedy = freeing_in_words(world, sided)
    names, changes = [world.name(i) for i in sided], changes_freeing(world, sided)
    if isinstance(outcome, Refusal):
        return NoPathError(
            what, where=via.at, remedy=remedy, via=via.name, obstacles=names, changes=changes
        )
    helps = [remedy, *([outcome.would_help] if outcome.would_help else [])]
    return GaveUpError(
        what, where=via.at, remedy=", or ".join(helps), tried=outcome.tried, via=via.name,
        obstacles=names, changes=changes,
    )  # fmt: skip


def _sides_in_the_way(problem: DrivenProblem) -> list[int]:
    """The obstacles that a path passes on the wrong side which there would be without sides."""
    if not any(sides.binding.any() for sides in problem.sides):
        return []
    cleared = replace(problem.cleared, sides=tuple(sides.freed for sides in problem.sides))
    free = replace(problem, cleared=cleared)
    spline_path = free.turns_along(free.shortest_row.taut_paths)
    if spline_path is None:
        poses = _poses(free, free.sharpest)
        spline_path = None if poses is None else through_turns(free.sequence, poses.turn_paths)
    if spline_path is None:
        return []
    wrong = [sides.wrong(spline_path.leg(k)) for k, sides in enumerate(problem.sides)]
    return sorted({int(i) for row in wrong for i in row})


def _circle_remedy(via: str, smaller: float | None) -> str:
    """What would allow a path, where there may be one with a smaller radius [m]."""
    if smaller is None:
        return f"move {via!r} to where there is room to turn, or leave it out"
    shown = np.floor(smaller * 10**SHOWN_DIGITS) / 10**SHOWN_DIGITS
    return (
        f"a radius of {shown:g} m would do (robot.min_turn_radius_m); or move {via!r} to "
        "where there is room to turn"
    )


def _body_remedy(via: str, less: float | None) -> str:
    """What would allow a path, where there may be one with a part of the clearance."""
    moves = [f"move {via!r} to where there is room for the body"]
    if less is not None:
        moves.insert(0, f"{less:g} of the clearance would do (robot.clearance_m)")
    return ", or ".join(moves)


def _first(serves: Callable[[float], bool], tried: Sequence[float]) -> float | None:
    """The first of what is tried that serves, if any does."""
    return next((value for value in tried if serves(value)), None)


def _serves(problem: DrivenProblem, radius: float) -> bool:
    """Whether there is a path with another turning circle [m]."""
    return _poses(problem, OVERSHOOT * radius) is not None


def _poses(problem: DrivenProblem, rho: float) -> Poses | None:
    """Headings and turns of at least a radius [m] along the shortest way, if any are clear."""
    turns = TurnProblem(problem, rho, problem.spots)
    legs = turns.heading_legs(turns.vias, HEADING_COUNT)
    costs = costs_between(legs, problem.requirements)
    lay, closed = turns.on_sides(turn_path_if_clear), problem.sequence.closed
    return posed(legs, costs, closed, lay, MAX_HEADING_ROWS, MAX_HEADING_ROWS)


def _has_room(problem: DrivenProblem, part: float) -> bool:
    """Whether there is a path with a part of the clearance."""
    clearance = part * problem.requirements.clearance
    requirements = replace(problem.requirements, clearance=clearance)
    return any(
        clear_turn_path(problem.bends.turning(rho), problem.world, requirements) is not None
        for rho in problem.least_radii
    )
