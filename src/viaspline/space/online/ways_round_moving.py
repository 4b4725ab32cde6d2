"""Other paths under way, round where something that moves will be for a while.

Tested through ``space/online/test_fly_among_unseen``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.space.flight_places import flight_places
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.moving_solids import gaps_to
from viaspline.space.among.swept_way import capsule_round
from viaspline.space.online.flight import Flight
from viaspline.space.online.flight_meeting import STEP_S, FlightMeeting
from viaspline.space.online.lead_past import still_ahead
from viaspline.space.online.replan_in_space import NewLeg, replan_in_space
from viaspline.space.online.takeover import Takeover
from viaspline.space.spatial_request import spatial_world_of
from viaspline.tracks.straight_on import HORIZON_S

SPARES_S: Final = (0.2, 1.0, HORIZON_S)
"""It is taken to be there for so much longer before and after [s]."""

HAIR_M: Final = 0.05
"""So much more than is asked for there is left where a path begins [m]."""


def ways_round(
    flight: Flight, begins: Takeover, meeting: FlightMeeting, foreseen: Sequence[MovingSolid]
) -> Iterator[NewLeg]:
    """Paths from a take-over on, timed past all that moves.

    The first goes round where the thing will be while the robot would meet it, others round more
    and more of its way.

    Args:
        flight: So far.
        begins: Where the new path begins.
        meeting: Whom it would meet.
        foreseen: All that is foreseen.
    """
    known, problem = flight.known, flight.problem
    ahead = still_ahead(flight, begins)
    if not ahead:
        return
    one = next(each for each in foreseen if each.name == meeting.solid.name)
    at = np.asarray(flight.legs[-1].path.at_distance(begins.distance))
    for since, until in _windows(flight, meeting, one, at):
        ghost = _ghost(one, since, until)
        if ghost is None:
            continue
        world = known.world.model_copy(update={"known": (*known.world.known, ghost)})
        round_it = known.model_copy(update={"world": world})
        asked = replace(problem, world=spatial_world_of(round_it, flight_places(known)))
        found = replan_in_space(round_it, asked, flight.legs[-1], ahead, begins, foreseen)
        if isinstance(found, NewLeg):
            yield replace(found, problem=replace(found.problem, world=problem.world))


def _windows(
    flight: Flight, meeting: FlightMeeting, one: MovingSolid, at: Floats
) -> Iterator[tuple[float, float]]:
    """From when to when the thing is taken to stand in the way [s].

    No longer than it leaves room where the new path begins [m], (3,).
    """
    robot = flight.known.robot
    begin, end = float(one.times[0]), float(one.times[-2])
    times = np.arange(begin, end + STEP_S, STEP_S)
    gaps = gaps_to(one, FlyingBody.of(robot), np.broadcast_to(at, (len(times), 3)), times)
    near = np.flatnonzero(gaps < robot.clearance_m + HAIR_M)
    if near.size:
        end = float(times[near[0]]) - STEP_S
    for spare in SPARES_S:
        yield max(begin, meeting.begins - spare), min(end, meeting.ends + spare)


def _ghost(one: MovingSolid, since: float, until: float) -> Obstacle | None:
    """What something sweeps from one time to another, as an obstacle that stands."""
    if until <= since:
        return None
    ends = np.column_stack(
        [np.interp((since, until), one.times, one.places[:, k]) for k in range(3)]
    )
    off = float(one.off_at(np.array([until]))[0])
    return capsule_round(one, ends[0], ends[1], off, f"the way of {one.name}")
