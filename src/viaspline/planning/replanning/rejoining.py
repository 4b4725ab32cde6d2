"""How an old path is taken up again: while rolling onto it, or from where the robot stands on it.

Tested through ``planning/replanning/test_taking_up``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viaspline.curve.path import Path, PathVia
from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.splice import run_out
from viaspline.planning.problem.via_sequence import RouteVia
from viaspline.planning.replanning.departure import refuse_blocked, refuse_no_room
from viaspline.planning.replanning.stretch import Stretch, room_to_run_out
from viaspline.world.world import World


@dataclass(frozen=True)
class Rejoining:
    """Where a new stretch ends: in which direction, and by which spans the old path is met [m]."""

    spans: Floats
    end: RouteVia
    tangent: Floats | None


Rejoin = Callable[[Path, Stretch, PathVia, World, Requirements, float], Rejoining]


def merging(
    path: Path, stretch: Stretch, tail: PathVia, world: World, requirements: Requirements,
    reach: float,
) -> Rejoining:  # fmt: skip
    """Take an old path up at its via point ``tail`` while rolling, by a run-in of a length [m]."""
    room = room_to_run_out(path, stretch)[1]
    refuse_no_room(path, tail.u, room)
    back = run_out(path, tail.u, min(reach, room), sense=-1).reversed()
    refuse_blocked(back, world, requirements)
    return Rejoining(back.span[None], RouteVia("the old path", back.span[0], None), back.tangent)


def turning(
    path: Path, stretch: Stretch, tail: PathVia, world: World, requirements: Requirements,
    reach: float,
) -> Rejoining:  # fmt: skip
    """Take an old path up where the robot stands and turns on the spot: from any direction."""
    place = np.array(tail.at)
    return Rejoining(
        np.empty((0, 4, place.size)), RouteVia(tail.name, place, tail.index, tail.dwell), None
    )


def may_turn(tail: PathVia | None, requirements: Requirements) -> bool:
    """Whether the robot stands at a via point in any case, and turns where it stands."""
    return tail is not None and tail.dwell > 0.0 and requirements.turns_at_rest
