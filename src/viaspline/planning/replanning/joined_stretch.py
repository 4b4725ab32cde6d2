"""A stretch of a path laid anew, and joined to what stays of it on either side."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path, PathVia
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.record import Account
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import is_clear, proven
from viaspline.planning.plan_path import lay_path
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.replanning.departure import (
    BlockedTurnError,
    Departure,
    Leave,
    refuse_blocked_turn,
    rolling,
)
from viaspline.planning.replanning.nearby import lay_nearby
from viaspline.planning.replanning.rejoining import Rejoin, Rejoining, merging
from viaspline.planning.replanning.sides_ahead import refuse_wrong_side
from viaspline.planning.replanning.stretch import (
    PASSED_M,
    Stretch,
    refuse_the_end,
    sequence_through,
)
from viaspline.planning.routing.leg_errors import BlockedLegError
from viaspline.world.world import World

RUN_OUT_LENGTHS = (2.0, 1.0, 0.3)  # that are tried, in required distances


def joined(
    path: Path,
    stretch: Stretch,
    world: World,
    requirements: Requirements,
    until: float,
    leave: Leave = rolling,
    rejoin_by: Rejoin = merging,
) -> Solution:
    """The new path with the first run-out that lets it be clear; see ``_run_outs``.

    Args:
        path: What is being driven.
        stretch: What of it is laid anew.
        world: What is known now.
        requirements: What to keep.
        until: Distance along the path from which it is not looked at yet [m].
        leave: How it is left.
        rejoin_by: How it is taken up again.

    Raises:
        NoPathError: When there is no way.
        SpentBudgetError: When there is no time left to look for one.
    """
    refuse_the_end(path, stretch)
    problem: PlanningError | None = None
    for reach in _run_outs(path, stretch, world, requirements, leave):
        lay = partial(_join, path, stretch, leave, rejoin_by, world, requirements, reach, until)
        try:
            asked = (path, stretch, leave, rejoin_by, world, reach, until)
            return _once(requirements, asked, lay)
        except (BlockedLegError, BlockedTurnError, SpentBudgetError):
            raise  # a run-out is clear: where none leads on from one, none does from another
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


def _run_outs(
    path: Path, stretch: Stretch, world: World, requirements: Requirements, leave: Leave
) -> tuple[float, ...]:
    """The lengths of run-outs that are tried [m]; nothing where there are none.

    From long to short, for a long one is gentle. Where something is in the way within the middle
    one and a turning radius, a robot that never turns on the spot begins with the short ones: after
    a long one it can't turn away any more, and to find that out takes a search, while it rolls on
    past the place where a short one would have done.
    """
    if leave is not rolling and requirements.turns_at_rest and stretch.tail is None:
        return (0.0,)
    lengths = tuple(length * max(requirements.required, 0.1) for length in RUN_OUT_LENGTHS)
    turn_radius = requirements.turn_radius
    if leave is not rolling or requirements.turns_at_rest or turn_radius is None:
        return lengths
    reach = float(path.distance(stretch.u)) + lengths[1] + turn_radius
    end = float(path.parameter(min(reach, path.length)))
    ahead = path.section(min(stretch.u, end - PASSED_M), end).spans
    return lengths if is_clear(world, ahead, requirements) else lengths[::-1]


def _join(
    path: Path,
    stretch: Stretch,
    leave: Leave,
    rejoin_by: Rejoin,
    world: World,
    requirements: Requirements,
    reach: float,
    until: float,
) -> Solution:
    """The path with the stretch laid anew, left and taken up again; proven where it is new."""
    departure = leave(path, stretch, world, requirements, reach)
    tail = stretch.tail
    rejoining = None if tail is None else rejoin_by(path, stretch, tail, world, requirements, reach)
    sequence = _sequence_between(path, departure, rejoining, stretch, world, requirements)
    if tail is None:
        spline_path, account = lay_path(sequence, world, requirements)
    else:
        old = path.spans[int(stretch.u) : math.ceil(tail.u)]
        spline_path, account = lay_nearby(sequence, old, world, requirements)
    spans = spline_path.spans
    if not len(departure.spans):
        came = stretch.u if departure.start.index is None else stretch.u - PASSED_M
        refuse_blocked_turn(float(path.heading(came)), spans[0], world, requirements)
    head = head_until(path, stretch.u)
    first = len(head) + len(departure.spans)
    pieces = [head, departure.spans, spans]
    laid = spline_path.vias_from(first)
    vias = [*vias_until(path, stretch.u, len(head)), *laid[departure.start.index is not None :]]
    rejoin = None
    if tail is not None and rejoining is not None:
        rest = path.spans[round(tail.u) :]
        if not len(rejoining.spans):
            heading = float(PiecewiseCubic(spans[-1:]).heading(1.0))
            refuse_blocked_turn(heading, rest[0], world, requirements)
            vias.pop()  # it is one of the old path's
        pieces += [rejoining.spans, rest]
        rejoin = first + len(spans) + len(rejoining.spans)
        vias += [replace(via, u=via.u - tail.u + rejoin) for via in path.vias if via.u >= tail.u]
    new = Path(np.concatenate(pieces), vias)
    leaving = float(new.distance(float(len(head))))
    last = len(new.spans)
    if rejoin is not None and until < path.length:
        last = rejoin  # what stays was proven, and is clear of what is known now
    certificate = proven(PiecewiseCubic(new.spans[len(head) : last]), world, requirements)
    back_at = None if rejoin is None else float(new.distance(float(rejoin)))
    return solution_from(new, leaving, certificate, account, back_at)


def _sequence_between(
    path: Path, departure: Departure, rejoining: Rejoining | None, stretch: Stretch, world: World,
    requirements: Requirements,
) -> ViaSequence:  # fmt: skip
    """What is laid from a departure to where the path is taken up again, if it is.

    Raises:
        GaveUpError: When one of both passes something on another side than is asked for.
    """
    meet = None if rejoining is None else rejoining.end
    sequence = replace(
        sequence_through(path, departure.start, stretch, requirements, meet),
        start_tangent=departure.tangent,
    )
    if len(departure.spans):
        refuse_wrong_side(departure.spans, sequence.whole_leg(0), world, requirements)
    if rejoining is None:
        return sequence
    if len(rejoining.spans):
        last_leg = sequence.whole_leg(len(sequence.legs) - 1)
        refuse_wrong_side(rejoining.spans, last_leg, world, requirements)
    return replace(sequence, end_tangent=rejoining.tangent)


def solution_from(
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


def head_until(path: Path, u: float) -> Floats:
    """The spans before u, the last of them cut there."""
    if u <= 0:
        return np.empty((0, 4, path.dimension))
    return np.asarray(path.section(0.0, u).spans)


def vias_until(path: Path, u: float, spans: int) -> Sequence[PathVia]:
    """The via points of a path up to u, before which it has so many spans."""
    return [via for via in path.vias if via.u <= min(u + PASSED_M, spans)]
