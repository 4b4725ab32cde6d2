"""When a law would bring a robot too near to what it foresees to move.

What is foreseen is no certainty, so instants are looked at; proofs are made of what was flown.

Tested through ``space/online/test_fly_among_unseen``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from viaspline.curve.path import Path
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.moving_solids import gaps_to
from viaspline.tracks.straight_on import HORIZON_S
from viaspline.trajectory.trajectory import Trajectory

STEP_S: Final = 0.05
"""Between two instants [s]."""


class FlightMeeting(NamedTuple):
    """Something that a robot comes too near to.

    Attributes:
        solid: What that is, as it is foreseen.
        begins: When it does first [s].
        ends: When it does last [s].
        least: The least free space between both in between [m].
    """

    solid: MovingSolid
    begins: float
    ends: float
    least: float


def meeting_in_flight(
    path: Path, law: Trajectory, since: float, body: FlyingBody, clearance: float,
    moving: Sequence[MovingSolid],
) -> FlightMeeting | None:  # fmt: skip
    """What a robot comes too near to first by a law.

    Args:
        path: What is flown.
        law: Along it; where it ends the robot stays.
        since: From when on [s].
        body: That of the robot.
        clearance: That is asked for [m].
        moving: What is foreseen.
    """
    times = since + np.arange(0.0, HORIZON_S + STEP_S, STEP_S)
    along = np.minimum(np.asarray(law.distance_at(times)), path.length)
    places = np.asarray(path.at_distance(along))
    first: FlightMeeting | None = None
    for one in moving:
        gaps = gaps_to(one, body, places, times)
        near = np.flatnonzero(gaps < clearance)
        if near.size and (first is None or times[near[0]] < first.begins):
            least = float(gaps.min())
            first = FlightMeeting(one, float(times[near[0]]), float(times[near[-1]]), least)
    return first
