"""New paths under way: four ways to leave the old one, from the least change to the greatest.

Each takes the path that is being driven and a distance along it before which nothing may change;
each returns a path that begins with exactly what was driven, so that distances along it stay
valid.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Hashable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path, PathVia
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import NoPathError, PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.record import Account
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import CLEAR, body_conflicts, proven
from viaspline.planning.departure import (
    BlockedTurnError,
    Leave,
    refuse_blocked,
    refuse_blocked_turn,
    refuse_no_room,
    rolling,
    standing,
    straight_on,
)
from viaspline.planning.nearby import lay_nearby
from viaspline.planning.plan_path import lay_path
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.splice import run_out
from viaspline.planning.problem.via_sequence import RouteVia
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.routing.leg_errors import BlockedLegError
from viaspline.planning.sides_ahead import refuse_wrong_side, spans_on_wrong_side
from viaspline.planning.stretch import (
    PASSED_M,
    Stretch,
    blocked_runs,
    is_round,
    leaving_place,
    refuse_the_end,
    room_to_run_out,
    sequence_through,
    stretch_round,
    stretches_on_round,
    vias_remaining,
    vias_to_serve,
)
from viaspline.world.world import World

LeadRound = Callable[[Path, float, NDArray[np.intp], World, Requirements, float], Solution]

RUN_OUT_LENGTHS = (2.0, 1.0, 0.3)  # that are tried, in required distances


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
        return replace(_result(path, at, certificate, None), rejoins_at=at)
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
        return _joined(path, narrow, world, requirements, until)
    except SpentBudgetError:
        raise
    except PlanningError:
        if wide == narrow:
            raise
    return _joined(path, wide, world, requirements, until)


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
    return _joined(path, stretch, world, requirements, until)


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
        return _joined(path, stretch, world, requirements, until, standing)
    except BlockedTurnError:
        return _joined(path, stretch, world, requirements, until, straight_on)


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
    return _joined(path, stretch, world, requirements, until, leave)


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
            return _joined(path, stretch, world, requirements, until, leave)
        except (SpentBudgetError, BlockedTurnError):
            raise
        except PlanningError as error:
            problem = error
    assert problem is not None  # there is a stretch at least
    raise problem


def _joined(
    path: Path,
    stretch: Stretch,
    world: World,
    requirements: Requirements,
    until: float,
    leave: Leave = rolling,
) -> Solution:
    """The new path with the first run-out, from long to short, that lets it be clear."""
    refuse_the_end(path, stretch)
    problem: PlanningError | None = None
    for reach in _run_outs(stretch, requirements, leave):
        lay = partial(_join, path, stretch, leave, world, requirements, reach, until)
        try:
            return _once(requirements, (path, stretch, leave, world, reach, until), lay)
        except (BlockedLegError, BlockedTurnError):
            raise  # a run-out is clear: where none leads on from one, none does from another
        except SpentBudgetError:
            raise
        except PlanningError as error:
            problem = error
    assert problem is not None  # there is a length at least
    raise problem


def _once(requirements: Requirements, asked: Hashable, lay: Callable[[], Solution]) -> Solution:
    """What a way to lay a path comes to, a refusal too, which later steps find done."""

    def tried() -> Solution | PlanningError:
        try:
            return lay()
        except SpentBudgetError:
            raise
        except PlanningError as error:
            return error

    found = requirements.once(("joined", asked), tried)
    if isinstance(found, PlanningError):
        raise found.with_traceback(None)
    return found


def _run_outs(stretch: Stretch, requirements: Requirements, leave: Leave) -> tuple[float, ...]:
    """The lengths of run-outs that are tried [m]; nothing where there are none."""
    if leave is not rolling and requirements.turns_at_rest and stretch.tail is None:
        return (0.0,)
    return tuple(length * max(requirements.required, 0.1) for length in RUN_OUT_LENGTHS)


def _join(
    path: Path,
    stretch: Stretch,
    leave: Leave,
    world: World,
    requirements: Requirements,
    reach: float,
    until: float,
) -> Solution:
    departure = leave(path, stretch, world, requirements, reach)
    tail, back = stretch.tail, None
    if tail is not None:
        last_room = room_to_run_out(path, stretch)[1]
        refuse_no_room(path, tail.u, last_room)
        back = run_out(path, tail.u, min(reach, last_room), sense=-1).reversed()
        refuse_blocked(back, world, requirements)
    meet = None if back is None else RouteVia("the old path", back.span[0], None)
    sequence = replace(
        sequence_through(path, departure.start, stretch, requirements, meet),
        start_tangent=departure.tangent,
    )
    if len(departure.spans):
        refuse_wrong_side(departure.spans, sequence.whole_leg(0), world, requirements)
    if back is not None:
        last_leg = sequence.whole_leg(len(sequence.legs) - 1)
        refuse_wrong_side(back.span[None], last_leg, world, requirements)
        sequence = replace(sequence, end_tangent=back.tangent)
    if tail is None:
        spline_path, account = lay_path(sequence, world, requirements)
    else:
        old = path.spans[int(stretch.u) : math.ceil(tail.u)]
        spline_path, account = lay_nearby(sequence, old, world, requirements)
    spans = spline_path.spans
    if not len(departure.spans):
        refuse_blocked_turn(path, stretch.u, spans[0], world, requirements)
    head = _head(path, stretch.u)
    first = len(head) + len(departure.spans)
    pieces = [head, departure.spans, spans]
    vias = [*_vias_until(path, stretch.u, len(head)), *spline_path.vias_from(first)]
    ahead = first + len(spans)
    rejoin = None
    if tail is not None and back is not None:
        pieces += [back.span[None], path.spans[round(tail.u) :]]
        rejoin = ahead + 1
        vias += [replace(via, u=via.u - tail.u + rejoin) for via in path.vias if via.u >= tail.u]
    new = Path(np.concatenate(pieces), vias)
    leaving = float(new.distance(float(len(head))))
    last = len(new.spans)
    if rejoin is not None and until < path.length:
        last = rejoin  # what stays was proven, and is clear of what is known now
    certificate = proven(PiecewiseCubic(new.spans[len(head) : last]), world, requirements)
    back_at = None if rejoin is None else float(new.distance(float(rejoin)))
    return _result(new, leaving, certificate, account, back_at)


def _result(
    new: Path,
    certificate_from: float,
    certificate: Certificate,
    account: Account | None,
    rejoins_at: float | None = None,
) -> Solution:
    """A path whose certificate speaks of what lies ahead of ``certificate_from`` [m]."""
    distance = min(certificate.tightest_distance + certificate_from, new.length)
    moved = replace(
        certificate, tightest_distance=distance, tightest_u=float(new.parameter(distance))
    )
    return Solution(new, moved, account, certificate_from, rejoins_at)


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


def _head(path: Path, u: float) -> Floats:
    """The spans before u, the last of them cut there."""
    if u <= 0:
        return np.empty((0, 4, path.dimension))
    return np.asarray(path.section(0.0, u).spans)


def _vias_until(path: Path, u: float, spans: int) -> Sequence[PathVia]:
    return [via for via in path.vias if via.u <= min(u + PASSED_M, spans)]
