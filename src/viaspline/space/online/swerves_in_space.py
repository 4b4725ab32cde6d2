"""Paths under way that swerve at once: the spline through a place beside what comes towards it.

A way that is pulled taut round something turns as late as it can, and then sharply: that takes a
robot that has time to slow down. Where it hasn't, it is bent off its path from the start, as gently
as the distance lets it: to the left or to the right, above or below.

Tested through ``space/online/test_fly_among_unseen``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.led_route import KnownWays
from viaspline.space.meeting.gap_of_bodies import BodyPair
from viaspline.space.online.flight import Flight
from viaspline.space.online.flight_meeting import FlightMeeting
from viaspline.space.online.lead_past import ASIDE, still_ahead
from viaspline.space.online.replan_in_space import NewLeg, replan_in_space
from viaspline.space.online.takeover import Takeover
from viaspline.space.spatial_problem import SpatialVia

SPARE_M: Final = 0.1
"""By so much more than is asked for it is bent aside [m]."""
BESIDE: Final = ((0.5, 1.0), (0.5, 1.4), (0.25, 1.2))
"""When it is beside the thing, as a share of the time of the meeting, and by how much of what it
has to be."""
MOST_ASIDE: Final = 0.5
"""How far aside it is bent at most, as a share of the way to there."""
LEAST_ROOM_M: Final = 1.0
"""Of way to where it is to be beside something that comes towards it [m]."""


def swerves(
    flight: Flight, begins: Takeover, meeting: FlightMeeting, foreseen: Sequence[MovingSolid],
    known: KnownWays,
) -> Iterator[NewLeg]:  # fmt: skip
    """Paths from a take-over on beside what would be met, timed past all that moves.

    Args:
        flight: So far.
        begins: Where the new path begins.
        meeting: Whom it would meet.
        foreseen: All that is foreseen.
        known: The ways of legs that were found for others of this flight: legs behind the first
            two are the same.
    """
    ahead = still_ahead(flight, begins)
    one = next(each for each in foreseen if each.name == meeting.solid.name)
    if not ahead or begins.speed == 0.0:
        return  # who stands may turn as sharply as it likes
    path, problem = flight.legs[-1].path, flight.problem
    here = np.asarray(path.at_distance(begins.distance))
    first, last = max(meeting.begins, begins.time), meeting.ends
    if last <= first:
        return
    tension = problem.shape.tension[-len(ahead) :]
    shape = replace(problem.shape, tension=np.append(tension[0], tension))
    swerving = replace(problem, shape=shape, keeps_spline=True)
    for share, wide in BESIDE:
        time = first + share * (last - first)
        there = one.at_any_time(time)
        way = there - here
        room = float(np.linalg.norm(way))
        if room < LEAST_ROOM_M:
            continue
        for aside in _aside(flight, one, time, way / room):
            if wide * float(np.linalg.norm(aside)) > MOST_ASIDE * room:
                continue  # that would be a turn rather than a swerve
            via = SpatialVia(ASIDE, there + wide * aside, None)
            found = replan_in_space(
                flight.known, swerving, flight.legs[-1], (via, *ahead),
                begins, foreseen, known,
            )  # fmt: skip
            if isinstance(found, NewLeg):
                yield found


def _aside(flight: Flight, one: MovingSolid, time: float, way: Floats) -> Iterator[Floats]:
    """From the middle of something to places beside it, square to a way, a unit vector [m]."""
    robot = flight.known.robot
    body, its = FlyingBody.of(robot), one.body
    off = float(one.off_at(np.array([time]))[0])
    pair = BodyPair(
        body.radius + its[0], body.half_height + its[1], body.margin + its[2] + robot.clearance_m
    )
    left = np.array([-way[1], way[0], 0.0])
    size = float(np.linalg.norm(left))
    far = pair.margin + off + SPARE_M
    if size > 0.0:
        level = (pair.radius + far) * left / size
        yield level
        yield -level
    upright = np.array([0.0, 0.0, pair.half_height + far])
    yield upright
    yield -upright
