"""How an old path is left for a new one: while rolling on it, or from a standstill.

Tested through ``planning/replanning/test_replan``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path, PathVia
from viaspline.errors import NoPathError
from viaspline.kernels.arrays import Floats
from viaspline.planning.checking.conflicts import CLEAR, body_conflicts, turn_conflict
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.splice import RunOut, run_out
from viaspline.planning.problem.spline_path import SAME_HEADING_RAD, heading_jumps
from viaspline.planning.problem.via_sequence import RouteVia
from viaspline.planning.replanning.stretch import (
    LEAST_RUN_OUT_M,
    PASSED_M,
    Stretch,
    room_to_run_out,
)
from viaspline.world.world import World

AT_REST = 0.05  # a run-out from a standstill, over that of a rolling robot


@dataclass(frozen=True)
class Departure:
    """How an old path is left: by which spans [m], and where and in which direction one goes on."""

    spans: Floats
    start: RouteVia
    tangent: Floats | None


Leave = Callable[[Path, Stretch, World, Requirements, float], Departure]


def rolling(
    path: Path, stretch: Stretch, world: World, requirements: Requirements, reach: float
) -> Departure:
    """Leave a path while rolling on it, by a run-out of a length [m]."""
    room = room_to_run_out(path, stretch)[0]
    refuse_no_room(path, stretch.u, room)
    out = run_out(path, stretch.u, min(reach, room))
    refuse_blocked(out, world, requirements)
    return Departure(out.span[None], RouteVia("the robot", out.end, None), out.tangent)


def standing(
    path: Path, stretch: Stretch, world: World, requirements: Requirements, reach: float
) -> Departure:
    """Leave a path from a standstill: in any direction if the robot turns on the spot.

    Else it goes on with its wheels as they are, by a run-out that is shorter than a rolling robot's
    [m]: as slow as it is, it turns them on little way.
    """
    if not requirements.turns_at_rest:
        return rolling(path, stretch, world, requirements, AT_REST * reach)
    place = np.asarray(path.evaluate(stretch.u))
    return Departure(np.empty((0, 4, place.size)), RouteVia("the robot", place, None), None)


def straight_on(
    path: Path, stretch: Stretch, world: World, requirements: Requirements, reach: float
) -> Departure:
    """Leave a path from a standstill in the direction in which the body looks."""
    left = standing(path, stretch, world, requirements, reach)
    return replace(left, tangent=np.asarray(path.tangent(stretch.u)))


def turning_away(
    path: Path, stretch: Stretch, world: World, requirements: Requirements, reach: float
) -> Departure:
    """Leave a path where it has a corner at a station: in any direction, for the robot turns there.

    See ``turns_at``.
    """
    via = station_at(path, stretch.u)
    assert via is not None  # there is one
    place = np.array(via.at)
    start = RouteVia(via.name, place, via.index, via.dwell)
    return Departure(np.empty((0, 4, place.size)), start, None)


def turns_at(path: Path, u: float, requirements: Requirements) -> bool:
    """Whether a path has a corner at a station, where the robot stands and turns in any case."""
    via = station_at(path, u)
    if via is None or not requirements.turns_at_rest or not 0.0 < via.u < len(path.spans):
        return False
    before, after = path.spans[round(via.u) - 1 : round(via.u) + 1, None]
    return abs(float(heading_jumps(before, after)[0])) > SAME_HEADING_RAD


def station_at(path: Path, u: float) -> PathVia | None:
    """The station of a path at a parameter, if one is there."""
    found = (via for via in path.vias if via.dwell > 0.0 and abs(via.u - u) <= PASSED_M)
    return next(found, None)


class BlockedTurnError(NoPathError):
    """A body can't turn on the spot where it stands without coming too close to something."""


def refuse_blocked_turn(
    heading: float, span: Floats, world: World, requirements: Requirements
) -> None:
    """Raise BlockedTurnError for a body that stands and can't turn to where a span begins.

    Args:
        heading: In which it stands [rad].
        span: By which it is to go on [m], (4, d).
        world: What it keeps clear of.
        requirements: The body.
    """
    index = turn_conflict(world, heading, span[:, :2], requirements)
    if index != CLEAR:
        name = world.name(index)
        raise BlockedTurnError(
            f"{name!r} is too near to turn on the spot",
            where=span[0],
            remedy="leave it where there is room for its body to turn",
            obstacles=(name,),
        )


def refuse_blocked(piece: RunOut, world: World, requirements: Requirements) -> None:
    """Raise NoPathError for a run-out that comes too close to something."""
    index = int(body_conflicts(world, piece.span[None], requirements)[0])
    if index != CLEAR:
        name = world.name(index)
        raise NoPathError(
            f"{name!r} is too near to turn away from it under way",
            where=piece.span[0],
            remedy="stop and turn on the spot, or look farther ahead",
            obstacles=(name,),
        )


def refuse_no_room(path: Path, u: float, room: float) -> None:
    """Raise NoPathError for a place on a path by which a run-out has no room to speak of [m]."""
    if room < LEAST_RUN_OUT_M:
        raise NoPathError(
            "via points are too near to each other to turn away between them under way",
            where=np.asarray(path.evaluate(u)),
            remedy="stop and turn on the spot, or look farther ahead",
        )
