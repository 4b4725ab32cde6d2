"""What a re-plan lays anew: a stretch of the path that is driven, and its via points.

Tested through ``planning/replanning/test_replan``.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.path import GUIDE, SEAM, Path, PathVia
from viaspline.errors import NoPathError
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import (
    Leg,
    RouteVia,
    ViaSequence,
    direction,
    span_slack,
)
from viaspline.planning.replanning.sides_ahead import leg_ends, whole_legs
from viaspline.world.world import World

PASSED_M = 1e-6  # via points nearer along the path than this have been passed
MAX_RUN_OUT = 0.4  # part of the way to the next via point that a run-out may take


LEAST_RUN_OUT_M = 1e-3
"""Of a shorter run-out rounding leaves no curvature to speak of [m]."""


@dataclass(frozen=True)
class Stretch:
    """What is laid anew: from ``u`` on the old path to a via point of it, or to the goal.

    Attributes:
        u: Where the old path is left.
        ahead: The user via points that are still to be served in the stretch.
        tail: Where the old path is taken up again, None if it is not.
    """

    u: float
    ahead: tuple[PathVia, ...]
    tail: PathVia | None


def blocked_runs(users: Sequence[PathVia], blocked: NDArray[np.intp]) -> list[NDArray[np.intp]]:
    """Blocked spans, parted where a whole leg between via points of the user is free.

    Args:
        users: Via points that have to be served.
        blocked: Indices of spans, in order, (k,).
    """
    legs = np.searchsorted([via.u for via in users], blocked + 0.5)
    return np.split(blocked, 1 + np.flatnonzero(np.diff(legs) > 1))


def stretch_round(
    joints: Sequence[PathVia], users: Sequence[PathVia], u: float, blocked: NDArray[np.intp]
) -> Stretch:
    """What is laid anew, from the last of the joints before the blocked spans to the first after.

    Args:
        joints: Via points at which the old path may be left and taken up again.
        users: Those that have to be served.
        u: From where on it may be left.
        blocked: Indices of spans.
    """
    leave = max([u, *(via.u for via in joints if via.u <= blocked[0])])
    tail = next(via for via in joints if via.u >= blocked[-1] + 1)
    within = tuple(via for via in users if leave + PASSED_M < via.u < tail.u)
    if tail.u >= users[-1].u and users[-1].name == SEAM:
        return Stretch(leave, within, users[-1])
    if tail.u >= users[-1].u:
        return Stretch(leave, (*within, users[-1]), None)
    return Stretch(leave, within, tail)


def leaving_place(path: Path, at: float) -> tuple[float, float]:
    """Where a path is left that may be left from a distance on [m]: there, or after a via point.

    A via point that lies so little ahead that there is no room to run out before it is passed
    first.

    Returns:
        The distance [m] and the parameter.
    """
    least = LEAST_RUN_OUT_M / MAX_RUN_OUT
    for via, distance in zip(path.vias, path.via_distances.tolist(), strict=True):
        if PASSED_M < distance - at < 1.5 * least and via.u < path.domain[1]:
            return distance, via.u
    return at, float(path.parameter(at))


def room_to_run_out(path: Path, stretch: Stretch) -> tuple[float, float]:
    """What a run-out may take on the first and on the last leg of a stretch [m]."""
    targets = [*stretch.ahead, *([stretch.tail] if stretch.tail else [])]
    at = np.asarray(path.distance(np.array([stretch.u, *(via.u for via in targets)])))
    rooms = MAX_RUN_OUT * np.diff(at)
    return float(rooms[0]), float(rooms[-1])


def refuse_the_end(path: Path, stretch: Stretch) -> None:
    """Raise NoPathError for a stretch that leads nowhere."""
    if not stretch.ahead and stretch.tail is None:
        where = np.asarray(path.evaluate(stretch.u))
        raise NoPathError("nothing is left to go to", where=where, remedy="the route ends here")


def vias_to_serve(path: Path, world: World, requirements: Requirements) -> list[PathVia]:
    """The user's via points, and a corridor's guides where there is room: no way leaves them out.

    Without them the way to the next via point might go round the other way.
    """

    def is_free(via: PathVia) -> bool:
        return float(world.distance(via.at[:2])) > requirements.required + PASSED_M

    return [
        via
        for via in path.vias
        if via.kind == "user" or via.name == SEAM or (via.name == GUIDE and is_free(via))
    ]


def is_round(path: Path) -> bool:
    """Whether a path goes on at its end, where it begins."""
    return bool(path.vias) and path.vias[-1].name == SEAM


def stretches_on_round(
    path: Path,
    at: float,
    world: World,
    requirements: Requirements,
    skip: Collection[int],
    blocked: float,
    until: float,
) -> list[Stretch]:
    """What may be laid anew ahead on a round, from the shortest stretch to the longest.

    Each goes on to a via point of the user at which the round is taken up again, beyond what is
    blocked; from one to the next there are twice as many.

    Args:
        path: The round.
        at: From where on it may be laid anew [m].
        world: What is known.
        requirements: What to keep.
        skip: Points of the route that are left out.
        blocked: Up to this distance along it, it has to be laid anew [m].
        until: From this one on it is not looked at yet [m].

    Raises:
        NoPathError: When no via point of the user is left.
    """
    remaining = vias_remaining(path, at, world, requirements, skip)
    u, first, last = np.asarray(path.parameter(np.array([at, blocked, until]))).tolist()
    tails = [
        via
        for via in path.vias
        if via.kind == "user" and via.u >= max(first, u) and via.index not in skip
        and float(world.distance(via.at[:2])) > requirements.required
    ]  # fmt: skip
    tails.append(path.vias[-1])
    within = next(k for k, via in enumerate(tails) if via.u >= last or via is tails[-1])
    chosen = sorted({*(2**k - 1 for k in range(within.bit_length() + 1) if 2**k <= within), within})
    return [
        Stretch(u, tuple(via for via in remaining if via.u < tails[k].u), tails[k]) for k in chosen
    ]


def vias_remaining(
    path: Path, at: float, world: World, requirements: Requirements, skip: Collection[int]
) -> tuple[PathVia, ...]:
    """The via points that are still to be served after a distance, but those in ``skip``.

    Raises:
        NoPathError: When the user's are all behind.
    """
    serve = vias_to_serve(path, world, requirements)
    u = float(path.parameter(min(at + PASSED_M, path.length)))
    remaining = tuple(via for via in serve if via.u > u and via.index not in skip)
    if not any(via.kind == "user" for via in remaining):
        raise NoPathError(
            "no via point is left to go to",
            where=np.asarray(path.at_distance(min(at, path.length))),
            remedy="the route ends here",
        )
    return remaining


def sequence_through(
    path: Path,
    start: RouteVia,
    stretch: Stretch,
    requirements: Requirements,
    meet: RouteVia | None = None,
) -> ViaSequence:
    """A via sequence without detours through those of a stretch, to ``meet`` if it is given."""
    targets = [RouteVia(v.name, np.array(v.at), v.index, v.dwell) for v in stretch.ahead]
    legs = [via.index or 1 for via in stretch.ahead]
    if meet is not None and stretch.tail is not None:
        tail = stretch.tail.u
        targets.append(meet)
        after = (v.index or 1 for v in path.vias if v.index is not None and v.u >= tail)
        legs.append(next(after, 1 + max(v.index or 0 for v in path.vias)))
    ends = list(stretch.ahead)
    if meet is not None and stretch.tail is not None:
        ends.append(next((via for via in leg_ends(path) if via.u >= tail), leg_ends(path)[0]))
    slack = _slack_by_leg(requirements)
    return ViaSequence(
        vias=(start, *targets),
        legs=tuple(Leg.straight(slack[(leg - 1) % len(slack)], len(start.at)) for leg in legs),
        spline=requirements.spline,
        tangents=requirements.tangents,
        end_tangent=direction(requirements.goal_heading_deg, len(start.at))
        if meet is None
        else None,
        parts_of=whole_legs(path, stretch.u, ends),
    )


def _slack_by_leg(requirements: Requirements) -> tuple[float, ...]:
    """The slack of each leg of a lap; of all legs, where they have the same."""
    spline = requirements.spline
    given = spline.slack if spline.slack is not None else spline.tension
    return span_slack(spline, len(given) if isinstance(given, tuple) else 1)
