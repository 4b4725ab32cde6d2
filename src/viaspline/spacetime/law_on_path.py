"""The law with which a path is driven past what moves, and its proof."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from viaspline.curve.path import Path
from viaspline.planning.problem.method import Found, GaveUp, Outcome, Refusal
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.spacetime.alternatives import Alternative
from viaspline.spacetime.driven_body import driven_body
from viaspline.spacetime.timed_problem import TimedProblem
from viaspline.trajectory.moving_certificate import (
    MovingCertificate,
    certified_moving,
    keeps_from_moving,
)
from viaspline.trajectory.timed_body import TimedBody
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.law_among import BUDGET_S, law_among
from viaspline.trajectory.yielding.no_law import Unserved

Explained: TypeAlias = Callable[[Unserved], Refusal | GaveUp]
"""What is said where there is no law."""

WORTH_S = 1.0
"""What has to be lost by waiting before it is looked for bays to wait in, and for drives [s]."""

LATER_S = (1.0, 2.0, 3.0, 5.0, 8.0, 13.0, 21.0, 34.0)
"""Departures that are tried where the one that is asked for doesn't serve, so much later [s]."""


def law_on_path(problem: TimedProblem, taken: Alternative) -> Outcome[Trajectory]:
    """The law with the earliest arrival on a path.

    A body that isn't a disc is taken for the disc around it first. Where that can't be served, or
    loses time, it is taken for smaller ones: such a law is taken if it is proven for the body. A
    robot that only waits where it stands anyway is tried at lower speeds where waits don't serve.
    """
    late = taken.free.end_time + WORTH_S
    with problem.budget.share(BUDGET_S) as budget:
        outcome = _law_keeping(problem, taken, budget, problem.required)
        for required in problem.requirements.within_around:
            if isinstance(outcome, Found) and outcome.value.end_time <= late:
                return outcome
            other = _law_keeping(problem, taken, budget, required)
            if not isinstance(other, Found) or _is_later(other, outcome):
                continue
            if _keeps_clear(problem, taken.solution.path, other.value):
                return other
        for speed in problem.lower_speeds:
            if isinstance(outcome, Found) or budget.is_spent:
                break
            slower = _law_keeping(problem, taken, budget, problem.required, speed)
            outcome = slower if isinstance(slower, Found) else outcome
    return outcome


def _is_later(law: Found[Trajectory], than: Outcome[Trajectory]) -> bool:
    return isinstance(than, Found) and law.value.end_time >= than.value.end_time


def _law_keeping(
    problem: TimedProblem, taken: Alternative, budget: WorkBudget, required: float,
    speed: float | None = None,
) -> Outcome[Trajectory]:  # fmt: skip
    """The law on a path of a disc that keeps a distance about its reference point [m].

    It goes no faster than at some speed [m/s], if that is said.
    """
    route = problem.mission.route
    is_one_of_many = problem.outer is not None and bool(taken.passings or taken.is_searched)
    is_first = required == problem.required and speed is None
    problem.budget.spent += problem.law_s(taken.free)
    return _law(
        problem, taken.solution.path, required, route.depart_s, budget, speed,
        Unserved.outcome if is_first and not is_one_of_many else _unexplained,
    )  # fmt: skip


def _law(
    problem: TimedProblem, path: Path, required: float, depart: float,
    budget: WorkBudget | None, speed: float | None, explained: Explained,
) -> Outcome[Trajectory]:  # fmt: skip
    """See ``law_among``."""
    return law_among(
        path, problem.limits, problem.stops(path), moving=problem.moving, required=required,
        zones=problem.mission.world.speed_zones, start_time=depart,
        hold=problem.mission.route.hold_s, speed_cap=speed, budget=budget, explained=explained,
    )  # fmt: skip


def _unexplained(_: Unserved) -> GaveUp:
    """That there is no law, where what would help is told of another path.

    To find that out costs as much as the paths themselves where most of them have no law.
    """
    return GaveUp((), reason="no law was found on this path among what moves")


def moving_proof(problem: TimedProblem, path: Path, law: Trajectory) -> MovingCertificate:
    """What is proven of a path and a law on it: the distance to all that moves."""
    return certified_moving(_body(problem, path, law), problem.moving, problem.requirements.kept)


def _keeps_clear(problem: TimedProblem, path: Path, law: Trajectory) -> bool:
    """Whether that proof would hold."""
    return keeps_from_moving(_body(problem, path, law), problem.moving, problem.requirements.kept)


def _body(problem: TimedProblem, path: Path, law: Trajectory) -> TimedBody:
    """The body on this path and by this law."""
    mission = problem.mission
    return driven_body(problem.requirements, mission.robot, path, law, hold=mission.route.hold_s)


def departure_that_serves(problem: TimedProblem, path: Path) -> str | None:
    """When to depart instead, on the path among what stands, if one of some later times serves."""
    for later in LATER_S:
        depart = problem.mission.route.depart_s + later
        outcome = _law(problem, path, problem.required, depart, None, None, _unexplained)
        if isinstance(outcome, Found) and _keeps_clear(problem, path, outcome.value):
            return f"depart {later:g} s later (route.depart_s: {depart:g})"
    return None
