"""New paths under way: three ways to leave the old one, from the least change to the greatest.

Each takes the path that is being driven and a distance along it before which nothing may change;
each returns a path that begins with exactly what was driven, so that distances along it stay
valid.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

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
from viaspline.planning.plan_path import lay_path
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.splice import RunOut, run_out
from viaspline.planning.problem.via_sequence import RouteVia
from viaspline.planning.stretch import (
    LEAST_RUN_OUT_M,
    PASSED_M,
    Stretch,
    leaving_place,
    refuse_the_end,
    room_to_run_out,
    sequence_through,
    stretch_round,
    vias_remaining,
    vias_to_serve,
)
from viaspline.world.world import World

RUN_OUT_LENGTHS = (2.0, 1.0, 0.3)  # that are tried, in required distances


def reflex(path: Path, at: float, world: World, requirements: Requirements) -> Solution:
    """Lead only the blocked spans ahead round what stands in their way.

    The stretch from the last via point before them to the first one after them is laid anew,
    detour via points of the old path counting too; where that can't be done, the legs between
    the user via points.

    Args:
        path: What is being driven.
        at: Distance along it from which it may differ [m].
        world: What is known now.
        requirements: What to keep.

    Raises:
        NoPathError: When the legs can't be led round so.
    """
    at, u = leaving_place(path, at)
    blocked = _blocked_spans(path, u, world, requirements)
    if not blocked.size:
        certificate = proven(_ahead(path, u), world, requirements)
        return replace(_result(path, at, certificate, None), rejoins_at=at)
    users = vias_to_serve(path, world, requirements)
    narrow = stretch_round(path.vias, users, u, blocked)
    wide = stretch_round(users, users, u, blocked)
    try:
        return _joined(path, narrow, world, requirements)
    except PlanningError:
        if wide == narrow:
            raise
    return _joined(path, wide, world, requirements)


def planned(
    path: Path,
    at: float,
    world: World,
    requirements: Requirements,
    skip: Collection[int] = frozenset(),
) -> Solution:
    """Lay everything ahead anew, leaving out the route's points in ``skip``.

    Raises:
        NoPathError: When there is no way.
    """
    at, u = leaving_place(path, at)
    return _joined(
        path,
        Stretch(u, vias_remaining(path, at, world, requirements, skip), None),
        world,
        requirements,
    )


def from_rest(
    path: Path,
    at: float,
    world: World,
    requirements: Requirements,
    skip: Collection[int] = frozenset(),
) -> Solution:
    """Lay everything ahead anew from a standstill at ``at``.

    The robot may turn on the spot, unless it never does: then it goes on as it stands.

    Raises:
        NoPathError: When there is no way.
    """
    u = float(path.parameter(at))
    stretch = Stretch(u, vias_remaining(path, at, world, requirements, skip), None)
    refuse_the_end(path, stretch)
    start = RouteVia("the robot", np.asarray(path.evaluate(u)), None)
    sequence = sequence_through(path, start, stretch, requirements)
    if requirements.turn_radius is not None and requirements.turns_on_spot == "never":
        sequence = replace(sequence, start_tangent=np.asarray(path.tangent(u)))
    spline_path, account = lay_path(sequence, world, requirements)
    head = _head(path, u)
    vias = (*_vias_until(path, u, len(head)), *spline_path.vias_from(len(head)))
    new = Path(np.concatenate((head, spline_path.spans)), vias)
    certificate = proven(PiecewiseCubic(spline_path.spans), world, requirements)
    return _result(new, at, certificate, account)


def _joined(path: Path, stretch: Stretch, world: World, requirements: Requirements) -> Solution:
    """The new path with the first run-out, from long to short, that lets it be clear."""
    refuse_the_end(path, stretch)
    problem: PlanningError | None = None
    for reach in RUN_OUT_LENGTHS:
        try:
            return _join(
                path, stretch, world, requirements, reach * max(requirements.required, 0.1)
            )
        except PlanningError as error:
            problem = error
    assert problem is not None  # RUN_OUT_LENGTHS is not empty
    raise problem


def _join(
    path: Path, stretch: Stretch, world: World, requirements: Requirements, reach: float
) -> Solution:
    tail = stretch.tail
    first_room, last_room = room_to_run_out(path, stretch)
    if min(first_room, last_room) < LEAST_RUN_OUT_M:
        raise NoPathError(
            "via points are too near to each other to turn away between them under way",
            where=np.asarray(path.evaluate(stretch.u)),
            remedy="stop and turn on the spot, or look farther ahead",
        )
    out = run_out(path, stretch.u, min(reach, first_room))
    _refuse_blocked(out, world, requirements)
    back = None
    if tail is not None:
        back = run_out(path, tail.u, min(reach, last_room), sense=-1).reversed()
        _refuse_blocked(back, world, requirements)
    start = RouteVia("the robot", out.end, None)
    meet = None if back is None else RouteVia("the old path", back.span[0], None)
    sequence = replace(
        sequence_through(path, start, stretch, requirements, meet), start_tangent=out.tangent
    )
    if back is not None:
        sequence = replace(sequence, end_tangent=back.tangent)
    spline_path, account = lay_path(sequence, world, requirements)
    spans = spline_path.spans
    head = _head(path, stretch.u)
    first = len(head) + 1
    pieces = [head, out.span[None], spans]
    vias = [*_vias_until(path, stretch.u, len(head)), *spline_path.vias_from(first)]
    ahead = first + len(spans)
    rejoin = None
    if tail is not None and back is not None:
        pieces += [back.span[None], path.spans[round(tail.u) :]]
        rejoin = ahead + 1
        vias += [replace(via, u=via.u - tail.u + rejoin) for via in path.vias if via.u >= tail.u]
    new = Path(np.concatenate(pieces), vias)
    leaving = float(new.distance(float(len(head))))
    certificate = proven(PiecewiseCubic(new.spans[len(head) :]), world, requirements)
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


def _refuse_blocked(piece: RunOut, world: World, requirements: Requirements) -> None:
    index = int(body_conflicts(world, piece.span[None], requirements)[0])
    if index != CLEAR:
        name = world.name(index)
        raise NoPathError(
            f"{name!r} is too near to turn away from it under way",
            where=piece.span[0],
            remedy="stop and turn on the spot, or look farther ahead",
            obstacles=(name,),
        )


def _blocked_spans(
    path: Path, u: float, world: World, requirements: Requirements
) -> NDArray[np.intp]:
    """Indices of the path's spans from u on that come too close."""
    first = min(int(u), len(path.spans) - 1)
    close = body_conflicts(world, _ahead(path, u).spans, requirements)
    return first + np.flatnonzero(close != CLEAR)


def _ahead(path: Path, u: float) -> PiecewiseCubic:
    end = path.domain[1]
    return path.section(min(u, end - PASSED_M), end)


def _head(path: Path, u: float) -> Floats:
    """The spans before u, the last of them cut there."""
    if u <= 0:
        return np.empty((0, 4, path.dimension))
    return np.asarray(path.section(0.0, u).spans)


def _vias_until(path: Path, u: float, spans: int) -> Sequence[PathVia]:
    return [via for via in path.vias if via.u <= min(u + PASSED_M, spans)]
