"""New paths under way: three ways to leave the old one, from the least change to the greatest.

Each takes the path that is being driven and a distance along it before which nothing may change;
each returns a path that begins with exactly what was driven, so that distances along it stay
valid.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import GUIDE, Path, PathVia
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import NoPathError, PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.record import Account
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import CLEAR, body_conflicts, proven
from viaspline.planning.plan_path import lay_path
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.splice import RunOut, run_out
from viaspline.planning.problem.via_sequence import (
    Leg,
    RouteVia,
    ViaSequence,
    direction,
    span_slack,
)
from viaspline.world.world import World

PASSED_M = 1e-6  # via points nearer along the path than this have been passed
MAX_RUN_OUT = 0.4  # part of the way to the next via point that a run-out may take
RUN_OUT_LENGTHS = (2.0, 1.0, 0.3)  # that are tried, in required distances


@dataclass(frozen=True)
class _Stretch:
    """What is laid anew: from ``u`` on the old path to a via point of it, or to the goal.

    Attributes:
        u: Where the old path is left.
        ahead: The user via points that are still to be served in the stretch.
        tail: Where the old path is taken up again, None if it is not.
    """

    u: float
    ahead: tuple[PathVia, ...]
    tail: PathVia | None


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
    u = float(path.parameter(at))
    blocked = _blocked_spans(path, u, world, requirements)
    if not blocked.size:
        certificate = proven(_ahead(path, u), world, requirements)
        return replace(_result(path, at, certificate, None), rejoins_at=at)
    users = _to_serve(path, world, requirements)
    narrow = _stretch(path.vias, users, u, blocked)
    wide = _stretch(users, users, u, blocked)
    try:
        return _joined(path, narrow, world, requirements)
    except PlanningError:
        if wide == narrow:
            raise
    return _joined(path, wide, world, requirements)


def _stretch(
    joints: Sequence[PathVia], users: Sequence[PathVia], u: float, blocked: NDArray[np.intp]
) -> _Stretch:
    """From the last of the joints before the blocked spans to the first one after them."""
    leave = max([u, *(via.u for via in joints if via.u <= blocked[0])])
    tail = next(via for via in joints if via.u >= blocked[-1] + 1)
    within = tuple(via for via in users if leave + PASSED_M < via.u < tail.u)
    if tail.u >= users[-1].u:
        return _Stretch(leave, (*within, users[-1]), None)
    return _Stretch(leave, within, tail)


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
    u = float(path.parameter(at))
    return _joined(
        path,
        _Stretch(u, _remaining(path, at, world, requirements, skip), None),
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
    stretch = _Stretch(u, _remaining(path, at, world, requirements, skip), None)
    _refuse_the_end(path, stretch)
    start = RouteVia("the robot", np.asarray(path.evaluate(u)), None)
    sequence = _sequence_through(path, start, stretch, requirements)
    if requirements.turn_radius is not None and requirements.turns_on_spot == "never":
        sequence = replace(sequence, start_tangent=np.asarray(path.tangent(u)))
    spline_path, account = lay_path(sequence, world, requirements)
    head = _head(path, u)
    vias = (*_vias_until(path, u, len(head)), *spline_path.vias_from(len(head)))
    new = Path(np.concatenate((head, spline_path.spans)), vias)
    certificate = proven(PiecewiseCubic(spline_path.spans), world, requirements)
    return _result(new, at, certificate, account)


def _joined(path: Path, stretch: _Stretch, world: World, requirements: Requirements) -> Solution:
    """The new path with the first run-out, from long to short, that lets it be clear."""
    _refuse_the_end(path, stretch)
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
    path: Path, stretch: _Stretch, world: World, requirements: Requirements, reach: float
) -> Solution:
    tail = stretch.tail
    first_room, last_room = _room(path, stretch)
    out = run_out(path, stretch.u, min(reach, first_room))
    _refuse_blocked(out, world, requirements)
    back = None
    if tail is not None:
        back = run_out(path, tail.u, min(reach, last_room), sense=-1).reversed()
        _refuse_blocked(back, world, requirements)
    start = RouteVia("the robot", out.end, None)
    meet = None if back is None else RouteVia("the old path", back.span[0], None)
    sequence = replace(
        _sequence_through(path, start, stretch, requirements, meet), start_tangent=out.tangent
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


def _room(path: Path, stretch: _Stretch) -> tuple[float, float]:
    """What a run-out may take on the first and on the last leg of a stretch [m]."""
    targets = [*stretch.ahead, *([stretch.tail] if stretch.tail else [])]
    at = np.asarray(path.distance(np.array([stretch.u, *(via.u for via in targets)])))
    rooms = MAX_RUN_OUT * np.diff(at)
    return float(rooms[0]), float(rooms[-1])


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


def _refuse_the_end(path: Path, stretch: _Stretch) -> None:
    if not stretch.ahead and stretch.tail is None:
        where = np.asarray(path.evaluate(stretch.u))
        raise NoPathError("nothing is left to go to", where=where, remedy="the route ends here")


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


def _to_serve(path: Path, world: World, requirements: Requirements) -> list[PathVia]:
    """The user's via points, and a corridor's guides where there is room: no way leaves them out.

    Without them the way to the next via point might go round the other way.
    """
    places = [via.at[:2] for via in path.vias]
    free = world.distance(places) > requirements.required + PASSED_M
    return [
        via
        for via, is_free in zip(path.vias, free.tolist(), strict=True)
        if via.kind == "user" or (via.name == GUIDE and is_free)
    ]


def _remaining(
    path: Path, at: float, world: World, requirements: Requirements, skip: Collection[int]
) -> tuple[PathVia, ...]:
    serve = _to_serve(path, world, requirements)
    u = float(path.parameter(min(at + PASSED_M, path.length)))
    remaining = tuple(via for via in serve if via.u > u and via.index not in skip)
    if not any(via.kind == "user" for via in remaining):
        raise NoPathError(
            "no via point is left to go to",
            where=np.asarray(path.at_distance(min(at, path.length))),
            remedy="the route ends here",
        )
    return remaining


def _sequence_through(
    path: Path,
    start: RouteVia,
    stretch: _Stretch,
    requirements: Requirements,
    meet: RouteVia | None = None,
) -> ViaSequence:
    """A via sequence without detours through those of a stretch, to ``meet`` if it is given."""
    targets = [RouteVia(v.name, np.array(v.at), v.index, v.dwell) for v in stretch.ahead]
    legs = [via.index or 1 for via in stretch.ahead]
    if meet is not None and stretch.tail is not None:
        tail = stretch.tail.u
        targets.append(meet)
        legs.append(next(v.index or 1 for v in path.vias if v.index is not None and v.u >= tail))
    slack = _slack_by_leg(path, requirements)
    return ViaSequence(
        vias=(start, *targets),
        legs=tuple(Leg.straight(slack[leg - 1], len(start.at)) for leg in legs),
        spline=requirements.spline,
        tangents=requirements.tangents,
        end_tangent=direction(requirements.goal_heading_deg, len(start.at))
        if meet is None
        else None,
    )


def _slack_by_leg(path: Path, requirements: Requirements) -> tuple[float, ...]:
    count = max(via.index for via in path.vias if via.index is not None)
    given = (
        requirements.spline.slack
        if requirements.spline.slack is not None
        else requirements.spline.tension
    )
    lap = len(given) if isinstance(given, tuple) else count  # laps share what each span has
    return span_slack(requirements.spline, lap) * (count // lap)
