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
from viaspline.errors import NoPathError, PlanningError
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.checking.sharpest_bend import HAIRPIN_1PM, sharpest_bend
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.replanning.departure import (
    BlockedTurnError,
    Leave,
    rolling,
    standing,
    straight_on,
)
from viaspline.planning.replanning.joined_stretch import solution_from
from viaspline.planning.replanning.stretch import (
    PASSED_M,
    Stretch,
    blocked_runs,
    is_round,
    stretch_round,
    stretches_on_round,
)
from viaspline.planning.replanning.taking_up import best_taken_up
from viaspline.planning.replanning.way_ahead import WayAhead
from viaspline.world.world import World

LeadRound = Callable[[WayAhead, NDArray[np.intp]], Solution]


def reflex(
    path: Path, at: float, world: World, requirements: Requirements, until: float = math.inf
) -> Solution:
    """Lead only the blocked spans ahead round what stands in their way.

    The stretch from the last via point before them to the first one after them is laid anew,
    detour via points of the old path counting too; where that can't be done, the legs between
    the user via points. The old path is taken up before that where this is better. Blocked spans
    with a free leg between them, such as those of one place in several laps, are stretches by
    themselves, with a ledger of the first.

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
    way = WayAhead.rolling(path, at, world, requirements, until)
    blocked = way.blocked_spans()
    if not blocked.size:
        certificate = proven(way.curve, world, requirements)
        return replace(solution_from(path, way.at, certificate, None), rejoins_at=way.at)
    return _each_led_round(way, blocked, _led_round)


def _each_led_round(way: WayAhead, blocked: NDArray[np.intp], lead_first: LeadRound) -> Solution:
    """A path with each run of blocked spans led round what stands in its way, the last one first.

    Args:
        way: What is ahead.
        blocked: The spans, in order.
        lead_first: Leads the first run round, which the robot comes to next.
    """
    *later, first = reversed(blocked_runs(way.users, blocked))
    rest: float | None = None  # of the old path that stays at its end
    for run in later:
        solution = _led_round(way, run)
        way, rejoins = replace(way, path=solution.path), solution.rejoins_at
        if run is later[0] and rejoins is not None:
            rest = way.path.length - rejoins
    solution = lead_first(way, first)
    if not later:
        return solution
    return replace(solution, rejoins_at=None if rest is None else solution.path.length - rest)


def _led_round(way: WayAhead, blocked: NDArray[np.intp]) -> Solution:
    """A path with some blocked spans led round what stands in their way; see ``reflex``."""
    users = way.users
    narrow = stretch_round(way.path.vias, users, way.u, blocked)
    wide = stretch_round(users, users, way.u, blocked)
    found = None
    try:
        found = best_taken_up(way, narrow, blocked, way.joined(narrow, rolling))
    except SpentBudgetError:
        raise
    except PlanningError:
        if wide == narrow:
            raise
    if found is None:
        return best_taken_up(way, wide, blocked, way.joined(wide, rolling))
    return found if wide == narrow else _rounder(way, wide, blocked, found)


def _rounder(way: WayAhead, wide: Stretch, blocked: NDArray[np.intp], found: Solution) -> Solution:
    """A path round something; where it is sharper than the robot, another, if that is round.

    A detour via point of the old path may lie where the new one turns sharply to it, or back.
    """
    sharp, round_enough = _sharpest(way, found), _round_enough(way.requirements)
    if sharp <= round_enough:
        return found
    try:
        other = best_taken_up(way, wide, blocked, way.joined(wide, rolling))
    except PlanningError:
        return found
    most = HAIRPIN_1PM if sharp > HAIRPIN_1PM else round_enough
    return other if _sharpest(way, other) <= most else found


def _round_enough(requirements: Requirements) -> float:
    """The curvature up to which nothing is too sharp under way [1/m]."""
    if requirements.objective.is_time and requirements.outer_radius > 0.0:
        return min(1.0 / requirements.outer_radius, HAIRPIN_1PM)
    return HAIRPIN_1PM


def _sharpest(way: WayAhead, solution: Solution) -> float:
    """The largest curvature of what is new of a path [1/m]."""
    path, rejoins = solution.path, solution.rejoins_at
    end = path.domain[1] if rejoins is None else float(path.parameter(rejoins))
    return sharpest_bend(path, way.u, end)


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
    return _all_ahead(WayAhead.rolling(path, at, world, requirements, until), skip, rolling)


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
    way = WayAhead.standing(path, at, world, requirements, until)
    try:
        return _all_ahead(way, skip, standing)
    except BlockedTurnError:
        return _all_ahead(way, skip, straight_on)


def from_rest_nearby(
    path: Path, at: float, world: World, requirements: Requirements, until: float = math.inf
) -> Solution:
    """Lay the path anew from a standstill at ``at`` as far as something is in its way.

    Up to the next via point of the user behind that; more of it as ``reflex`` does.

    Raises:
        NoPathError: When there is no way, nothing is in the way, or nothing of the path would stay.
    """
    way = WayAhead.standing(path, at, world, requirements, until)
    blocked = way.blocked_spans()
    if not blocked.size:
        where = np.asarray(path.evaluate(way.u))
        raise NoPathError("nothing is in the way", where=where, remedy="go on as it is")
    return _each_led_round(way, blocked, _left_nearby)


def _left_nearby(way: WayAhead, blocked: NDArray[np.intp]) -> Solution:
    """The path from a standstill past some blocked spans; see ``from_rest_nearby``."""
    u, users = way.u, way.users
    behind = stretch_round(users, users, u, blocked)
    ahead = tuple(via for via in users if u + PASSED_M < via.u < behind.u + PASSED_M)
    stretch = replace(behind, u=u, ahead=(*ahead, *behind.ahead))
    if stretch.tail is None:
        where = np.asarray(way.path.evaluate(u))
        raise NoPathError("nothing of the path would stay", where=where, remedy="lay it all anew")
    try:
        return way.joined(stretch, standing)
    except BlockedTurnError:
        return way.joined(stretch, straight_on)


def _all_ahead(way: WayAhead, skip: Collection[int], leave: Leave) -> Solution:
    """Everything ahead laid anew, or what is needed of it on a round, left in one way."""
    if is_round(way.path):
        return _on_round(way, skip, leave)
    return way.joined(Stretch(way.u, way.remaining(skip), None), leave)


def _on_round(way: WayAhead, skip: Collection[int], leave: Leave) -> Solution:
    """A new path on a round by the shortest stretch of it on which there is one."""
    problem: PlanningError | None = None
    stretches = stretches_on_round(
        way.path, way.at, way.world, way.requirements, skip, way.blocked_until(skip), way.until
    )
    for stretch in stretches:
        try:
            return way.joined(stretch, leave)
        except (SpentBudgetError, BlockedTurnError):
            raise
        except PlanningError as error:
            problem = error
    assert problem is not None  # there is a stretch at least
    raise problem
