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

from viaspline.curve.certificate import Certificate, certify
from viaspline.curve.path import Path, PathVia
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.detour.brief import Brief
from viaspline.detour.course import Course, Leg, RouteVia, span_slack
from viaspline.detour.detoured import Detoured
from viaspline.detour.fit import CLEAR, too_close
from viaspline.detour.join import RunOut, run_out
from viaspline.detour.ledger import LedgerEntry
from viaspline.detour.search import clear_course, path_vias
from viaspline.errors import NoPathError
from viaspline.world.world import World

Floats = NDArray[np.float64]
NEAR = 1e-6  # via points nearer along the path than this have been passed [m]
REACHES = (2.0, 1.0, 0.3)  # lengths of a run-out, in required distances


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


def reflex(path: Path, at: float, world: World, brief: Brief) -> Detoured:
    """Lead only the blocked legs ahead round what stands in their way.

    Args:
        path: What is being driven.
        at: Distance along it from which it may differ [m].
        world: What is known now.
        brief: What to keep.

    Raises:
        NoPathError: When the legs can't be led round so.
    """
    u = float(path.parameter(at))
    blocked = _blocked_spans(path, u, world, brief)
    users = [via for via in path.vias if via.kind == "user"]
    if not blocked.size:
        certificate = certify(_ahead(path, u), world, brief.clearance, radius=brief.radius)
        return Detoured(path, certificate, (), at, at)
    before = [via for via in users if via.u <= blocked[0]]
    leave = max(u, before[-1].u if before else 0.0)
    after = [via for via in users if via.u >= blocked[-1] + 1]
    tail = after[0] if after[0] is not users[-1] else None
    last = after[0].u
    ahead = tuple(via for via in users if leave + NEAR < via.u <= last)
    return _joined(path, _Stretch(leave, ahead, tail), world, brief)


def planned(
    path: Path, at: float, world: World, brief: Brief, skip: Collection[int] = frozenset()
) -> Detoured:
    """Lay everything ahead anew, leaving out the route's points in ``skip``.

    Raises:
        NoPathError: When there is no way.
    """
    u = float(path.parameter(at))
    return _joined(path, _Stretch(u, _remaining(path, at, skip), None), world, brief)


def from_rest(
    path: Path, at: float, world: World, brief: Brief, skip: Collection[int] = frozenset()
) -> Detoured:
    """Lay everything ahead anew from a standstill at ``at``: the robot may turn on the spot.

    Raises:
        NoPathError: When there is no way.
    """
    u = float(path.parameter(at))
    ahead = _remaining(path, at, skip)
    start = RouteVia("standstill", np.asarray(path.evaluate(u)), None)
    course = _course(path, start, ahead, brief, u)
    cleared, spans, ledger = clear_course(course, world, brief)
    head = _head(path, u)
    vias = (*_vias_until(path, u, len(head)), *path_vias(cleared, len(head)))
    new = Path(np.concatenate((head, spans)), vias)
    certificate = certify(PiecewiseCubic(spans), world, brief.clearance, radius=brief.radius)
    return _result(new, at, certificate, ledger)


def _joined(path: Path, stretch: _Stretch, world: World, brief: Brief) -> Detoured:
    """The new path with the first run-out, from long to short, that lets it be clear."""
    problem: NoPathError | None = None
    for reach in REACHES:
        try:
            return _join(path, stretch, world, brief, reach * max(brief.required, 0.1))
        except NoPathError as error:
            problem = error
    assert problem is not None  # REACHES is not empty
    raise problem


def _join(path: Path, stretch: _Stretch, world: World, brief: Brief, reach: float) -> Detoured:
    out = run_out(path, stretch.u, reach)
    _refuse_blocked(out, world, brief)
    tail = stretch.tail
    back = None if tail is None else run_out(path, tail.u, reach, sense=-1).reversed()
    if back is not None:
        _refuse_blocked(back, world, brief)
    start = RouteVia("leave", out.end, None)
    course = replace(
        _course(path, start, stretch.ahead, brief, stretch.u), start_tangent=out.tangent
    )
    if back is not None:
        meet = RouteVia("rejoin", back.span[0], None)
        course = replace(course, vias=(*course.vias[:-1], meet), end_tangent=-back.tangent)
    cleared, spans, ledger = clear_course(course, world, brief)
    head = _head(path, stretch.u)
    first = len(head) + 1
    pieces = [head, out.span[None], spans]
    vias = [*_vias_until(path, stretch.u, len(head)), *path_vias(cleared, first)]
    ahead = first + len(spans)
    rejoin = None
    if tail is not None and back is not None:
        pieces += [back.span[None], path.spans[round(tail.u) :]]
        rejoin = ahead + 1
        vias += [replace(via, u=via.u - tail.u + rejoin) for via in path.vias if via.u >= tail.u]
    new = Path(np.concatenate(pieces), vias)
    leaving = float(new.distance(float(len(head))))
    certificate = certify(
        PiecewiseCubic(new.spans[len(head) :]), world, brief.clearance, radius=brief.radius
    )
    back_at = None if rejoin is None else float(new.distance(float(rejoin)))
    return _result(new, leaving, certificate, ledger, back_at)


def _result(
    new: Path,
    certificate_from: float,
    certificate: Certificate,
    ledger: tuple[LedgerEntry, ...],
    rejoins_at: float | None = None,
) -> Detoured:
    """A path whose certificate speaks of what lies ahead of ``certificate_from`` [m]."""
    distance = certificate.tightest_distance + certificate_from
    moved = replace(certificate, tightest_distance=distance)
    return Detoured(new, moved, ledger, certificate_from, rejoins_at)


def _refuse_blocked(piece: RunOut, world: World, brief: Brief) -> None:
    index = int(too_close(world, piece.span[None], brief.required)[0])
    if index != CLEAR:
        name = world.name(index)
        raise NoPathError(
            f"{name!r} is too near to turn away from it under way",
            where=piece.span[0],
            remedy="stop and turn on the spot, or look farther ahead",
            obstacles=(name,),
        )


def _blocked_spans(path: Path, u: float, world: World, brief: Brief) -> NDArray[np.intp]:
    """Indices of the path's spans from u on that come too close."""
    first = min(int(u), len(path.spans) - 1)
    close = too_close(world, _ahead(path, u).spans, brief.required)
    return first + np.flatnonzero(close != CLEAR)


def _ahead(path: Path, u: float) -> PiecewiseCubic:
    return path.section(u, path.domain[1])


def _head(path: Path, u: float) -> Floats:
    """The spans before u, the last of them cut there."""
    if u <= 0:
        return np.empty((0, 4, path.dimension))
    return np.asarray(path.section(0.0, u).spans)


def _vias_until(path: Path, u: float, spans: int) -> Sequence[PathVia]:
    return [via for via in path.vias if via.u <= min(u + NEAR, spans)]


def _remaining(path: Path, at: float, skip: Collection[int]) -> tuple[PathVia, ...]:
    distances = path.via_distances
    return tuple(
        via
        for via, distance in zip(path.vias, distances, strict=True)
        if via.kind == "user" and distance > at + NEAR and via.index not in skip
    )


def _course(
    path: Path, start: RouteVia, ahead: Sequence[PathVia], brief: Brief, u: float
) -> Course:
    """A course without detours from a place under way through the via points ahead."""
    if not ahead:
        raise NoPathError("nothing is left to go to", where=start.at, remedy="the route ends here")
    slack = _slack_by_leg(path, brief)
    vias = (start, *(RouteVia(v.name, np.array(v.at), v.index, v.dwell) for v in ahead))
    legs = tuple(
        Leg.straight(slack[min((v.index or 1), len(slack)) - 1], len(start.at)) for v in ahead
    )
    return Course(vias, legs, brief.spline)


def _slack_by_leg(path: Path, brief: Brief) -> tuple[float, ...]:
    count = max(via.index for via in path.vias if via.index is not None)
    return span_slack(brief.spline, count)
