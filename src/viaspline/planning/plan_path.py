"""From via points to a proven path, for whichever robot is to drive it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from viaspline.curve.path import Path
from viaspline.planning.alternatives.record import Account
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.methods.clear_spline import ClearSpline
from viaspline.planning.methods.corners_at_stations import CornersAtStations
from viaspline.planning.methods.ordered import SPLINE_METHODS, PathMethod, methods_for
from viaspline.planning.problem.method import Found, first_settled
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.problem.work_budget import LAY_S
from viaspline.planning.routing.path_problem import PathProblem
from viaspline.planning.turning.driven_alternatives import as_driven
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.turn_refusals import unlaid
from viaspline.world.world import World


def lay_path(
    sequence: ViaSequence,
    world: World,
    requirements: Requirements,
    methods: Sequence[PathMethod] | None = None,
) -> tuple[SplinePath, Account]:
    """The curve through via points that the robot can drive clear of everything.

    It passes everything on the side that the mission asks for: see ``routing.asked_sides``. Where
    it comes near to an obstacle on the wrong side that wasn't in its way before, that is in its way
    from then on, and the path is laid anew; so it is laid no more often than there are such sides.

    Args:
        sequence: The via points.
        world: The known world.
        requirements: What to keep.
        methods: In the order in which they are asked, once there is a clear spline; None: those
            for the robot.

    Raises:
        NoPathError: When there is none, with the least change that would serve.
        GaveUpError: When a budget ran out before that was known.
    """
    if not requirements.is_free_disc:
        sequence = replace(sequence, tangents="continuous")
    requirements.spend(LAY_S)
    kept = requirements.keeping_parts()
    asked = PathProblem.of(sequence, world, kept)
    asked_methods = methods_for(requirements, sequence.places) if methods is None else methods
    try:
        return _laid_on_sides(asked, asked_methods)
    finally:
        if kept.parts is not None:
            kept.parts.forget()


def _laid_on_sides(
    asked: PathProblem, asked_methods: Sequence[PathMethod]
) -> tuple[SplinePath, Account]:
    """The path, laid anew where it came near to something on the wrong side."""
    world, required = asked.world, asked.requirements.required
    while True:
        spline_path, account = _laid(asked, asked_methods)
        near = [
            tuple(sides.overlooked(spline_path.leg(k), world, required).tolist())
            for k, sides in enumerate(asked.sides)
        ]
        if not any(near):
            return spline_path, account
        asked = asked.binding_too(near)


def _laid(asked: PathProblem, methods: Sequence[PathMethod]) -> tuple[SplinePath, Account]:
    """The path past what is known to be in its way."""
    world, requirements = asked.world, asked.requirements
    is_spline = methods is SPLINE_METHODS
    clear_spline = ClearSpline() if is_spline else ClearSpline(max_weighed=0)  # turns are weighed
    cleared = clear_spline.lay(asked)
    problem = DrivenProblem(
        asked.sequence, world, requirements, asked.router, asked.overlooked, cleared=cleared
    )
    asked_methods = methods if is_spline else (CornersAtStations(methods),)
    outcome = first_settled(asked_methods, problem)
    if not isinstance(outcome, Found):
        raise unlaid(problem, outcome)
    driven = None if is_spline else partial(as_driven, problem)
    return outcome.value, Account(outcome.value, world, requirements, cleared.passed, driven)


def find_path(sequence: ViaSequence, world: World, requirements: Requirements) -> Solution:
    """A proven path through via points.

    Raises:
        NoPathError: When there is none, with the least change that would serve.
        GaveUpError: When a budget ran out before that was known.
    """
    spline_path, account = lay_path(sequence, world, requirements)
    path = Path(spline_path.spans, spline_path.vias)
    return Solution(path, proven(path, world, requirements), account)
