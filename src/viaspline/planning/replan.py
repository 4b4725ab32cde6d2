"""New paths under way: four ways to leave the old one, from the least change to the greatest.

Each takes the path that is being driven and a distance along it before which nothing may change;
each returns a path that begins with exactly what was driven, so that distances along it stay
valid.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.path import Path
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import NoPathError, PlanningError
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import CLEAR, body_conflicts, proven
from viaspline.planning.departure import (
    BlockedTurnError,
    Leave,
    rolling,
    standing,
    straight_on,
)
from viaspline.planning.joined_stretch import joined, solution_from
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.sides_ahead import spans_on_wrong_side
from viaspline.planning.stretch import (
    PASSED_M,
    Stretch,
    blocked_runs,
    is_round,
    leaving_place,
    stretch_round,
    stretches_on_round,
    vias_remaining,
    vias_to_serve,
)
from viaspline.world.world import World

LeadRound = Callable[[Path, float, NDArray[np.intp], World, Requirements, float], Solution]


def reflex(
    path: Path, at: float, world: World, requirements: Requirements, until: float = math.inf
) -> Solution:
    """Lead only the blocked spans ahead round what stands in their way.

    The stretch from the last via point before them to the first one after them is laid anew,
    detour via points of the old path counting too; where that can't be done, the legs between
    the user via points. Blocked spans with a free leg between them, such as those of one place in
    several laps, are stretches by themselves, with a ledger of the first.

    Args:
        path: What is being driven.
        at: Distance along it from which it may differ [m].
        world: What is known now.
        requirements: What to keep.
        until: Distance along it from which it is not looked at yet [m], if it is a round that goes
            on at its end.

    Raises:
        NoPathError: When the legs can't be led round so.
    """
    at, u = leaving_place(path, at)
    ahead = _ahead(path, u, until)
    blocked = _blocked_spans(path, u, world, requirements, until)
    if not blocked.size:
        certificate = proven(ahead, world, requirements)
        return replace(solution_from(path, at, certificate, None), rejoins_at=at)
    return _each_led_round(path, u, blocked, world, requirements, until, _led_round)


def _each_led_round(
    path: Path,
    u: float,
    blocked: NDArray[np.intp],
    world: World,
    requirements: Requirements,
    until: float,
    lead_first: LeadRound,
) -> Solution:
    """A path with each run of blocked spans led round what stands in its way, the last one first.

    Args:
        path: What is being driven.
        u: From where on it may be left.
        blocked: The spans, in order.
        world: What is known now.
        requirements: What to keep.
        until: Distance along it from which it is not looked at yet [m].
        lead_first: Leads the first run round, which the robot comes to next.
    """
    *later, first = reversed(blocked_runs(vias_to_serve(path, world, requirements), blocked))
    rest: float | None = None  # of the old path that stays at its end
    for run in later:
        solution = _led_round(path, u, run, world, requirements, until)
        path, rejoins = solution.path, solution.rejoins_at
        if run is later[0] and rejoins is not None:
            rest = path.length - rejoins
    solution = lead_first(path, u, first, world, requirements, until)
    if not later:
        return solution
    return replace(solution, rejoins_at=None if rest is None else solution.path.length - rest)


def _led_round(
    path: Path,
    u: float,
    blocked: NDArray[np.intp],
    world: World,
    requirements: Requirements,
    until: float,
) -> Solution:
    """A path with some blocked spans led round what stands in their way; see ``reflex``."""
    users = vias_to_serve(path, world, requirements)
    narrow = stretch_round(path.vias, users, u, blocked)
    wide = stretch_round(users, users, u, blocked)
    try:
        return joined(path, narrow, world, requirements, until)
    except SpentBudgetError:
        raise
    except PlanningError:
        if wide == narrow:
            raise
    return joined(path, wide, world, requirements, until)


def planned(
    path: Path,
    at: float,
    world: World,
    requirements: Requirements,
    skip: Collection[int] = frozenset(),
    until: float = math.inf,
) -> Solution:
    """Lay everything ahead anew, leaving out the route's points in ``skip``.

    On a round that is what lies ahead up to what is in the way and on to the next via point of the
    user, or a later one, no farther than needed from ``until`` [m].

    Raises:
        NoPathError: When there is no way.
    """
    at, u = leaving_place(path, at)
    if is_round(path):
        return _on_round(path, at, world, requirements, skip, until, rolling)
    stretch = Stretch(u, vias_remaining(path, at, world, requirements, skip), None)
    return joined(path, stretch, world, requirements, until)


def from_rest(
    path: Path,
    at: float,
    world: World,
    requirements: Requirements,
    skip: Collection[int] = frozenset(),
    until: float = math.inf,
) -> Solution:
    """Lay everything ahead anew from a standstill at ``at``; on a round as ``planned`` does.

    The robot may turn on the spot. If it never does, heading and curvature go on as they were; if
    something is too near for its body to turn to where the path leads, it goes on as it stands.

    Raises:
        NoPathError: When there is no way.
    """
    try:
        return _left(path, at, world, requirements, skip, until, standing)
    except BlockedTurnError:
        return _left(path, at, world, requirements, skip, until, straight_on)


def from_rest_nearby(
    path: Path, at: float, world: World, requirements: Requirements, until: float = math.inf
) -> Solution:
    """Lay the path anew from a standstill at ``at`` as far as something is in its way.

    Up to the next via point of the user behind that; more of it as ``reflex`` does.

    Raises:
        NoPathError: When there is no way, nothing is in the way, or nothing of the path would stay.
    """
    u = float(path.parameter(at)) if requirements.turns_at_rest else leaving_place(path, at)[1]
    blocked = _blocked_spans(path, u, world, requirements, until)
    if not blocked.size:
        raise NoPathError(
            "nothing is in the way", where=np.asarray(path.evaluate(u)), remedy="go on as it is"
        )
    return _each_led_round(path, u, blocked, world, requirements, until, _left_nearby)


def _left_nearby(
    path: Path,
    u: float,
    blocked: NDArray[np.intp],
    world: World,
    requirements: Requirements,
    until: float,
) -> Solution:
    """The path from a standstill past some blocked spans; see ``from_rest_nearby``."""
    users = vias_to_serve(path, world, requirements)
    behind = stretch_round(users, users, u, blocked)
    ahead = tuple(via for via in users if u + PASSED_M < via.u < behind.u + PASSED_M)
    stretch = replace(behind, u=u, ahead=(*ahead, *behind.ahead))
    if stretch.tail is None:
        where = np.asarray(path.evaluate(u))
        raise NoPathError("nothing of the path would stay", where=where, remedy="lay it all anew")
    try:
        return joined(path, stretch, world, requirements, until, standing)
    except BlockedTurnError:
        return joined(path, stretch, world, requirements, until, straight_on)


def _left(
    path: Path,
    at: float,
    world: World,
    requirements: Requirements,
    skip: Collection[int],
    until: float,
    leave: Leave,
) -> Solution:
    """Everything ahead laid anew from a standstill that is left in one way."""
    if requirements.turns_at_rest:
        u = float(path.parameter(at))
    else:
        at, u = leaving_place(path, at)
    if is_round(path):
        return _on_round(path, at, world, requirements, skip, until, leave)
    stretch = Stretch(u, vias_remaining(path, at, world, requirements, skip), None)
    return joined(path, stretch, world, requirements, until, leave)


def _on_round(
    path: Path,
    at: float,
    world: World,
    requirements: Requirements,
    skip: Collection[int],
    until: float,
    leave: Leave,
) -> Solution:
    """A new path on a round by the shortest stretch of it on which there is one."""
    problem: PlanningError | None = None
    blocked = _blocked_until(path, at, world, requirements, skip, until)
    for stretch in stretches_on_round(path, at, world, requirements, skip, blocked, until):
        try:
            return joined(path, stretch, world, requirements, until, leave)
        except (SpentBudgetError, BlockedTurnError):
            raise
        except PlanningError as error:
            problem = error
    assert problem is not None  # there is a stretch at least
    raise problem


def _blocked_spans(
    path: Path, u: float, world: World, requirements: Requirements, until: float
) -> NDArray[np.intp]:
    """Indices of the path's spans from u on that come too close, or pass on a wrong side."""
    first = min(int(u), len(path.spans) - 1)
    close = body_conflicts(world, _ahead(path, u, until).spans, requirements)
    wrong = spans_on_wrong_side(path, u, world, requirements)
    return np.union1d(first + np.flatnonzero(close != CLEAR), np.array(sorted(wrong), np.intp))


def _ahead(path: Path, u: float, until: float) -> PiecewiseCubic:
    """The path from u on, to the end of the span that is at a distance [m] or to its own end."""
    end = path.domain[1]
    if until < path.length:
        end = max(float(math.ceil(float(path.parameter(until)))), math.floor(u) + 1.0)
    return path.section(min(u, end - PASSED_M), end)


def _blocked_until(
    path: Path,
    at: float,
    world: World,
    requirements: Requirements,
    skip: Collection[int],
    until: float,
) -> float:
    """Where what is in the way ahead ends along a path, and what is left out of it [m]."""
    u = float(path.parameter(at))
    blocked = 1.0 + _blocked_spans(path, u, world, requirements, until)
    left_out = [via.u for via in path.vias if via.index in skip and via.u > u]
    return float(path.distance(max([u, *blocked.tolist(), *left_out])))
