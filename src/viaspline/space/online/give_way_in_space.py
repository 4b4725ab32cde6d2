"""What a flight does about what moves and isn't on its map: another law, another path, a hover.

Its path is timed anew first. Where that costs much, or can't be done, it is led round what it would
meet, and the earliest arrival wins. What moves may turn: so there is room to spare beside it, and
where that can't be, what is required. Where nothing is found the robot takes what meets something
last, and braking if that is no worse: it hovers, and looks again.

Tested through ``space/online/test_fly_among_unseen``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import Final

import numpy as np

from viaspline.curve.certificate import certify
from viaspline.errors import GeometryError
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.timed_past import solids_beside
from viaspline.space.online.chosen_takeovers import takeovers
from viaspline.space.online.flight import Flight
from viaspline.space.online.flight_meeting import FlightMeeting, meeting_in_flight
from viaspline.space.online.lead_past import ended, still_ahead, taken_over
from viaspline.space.online.replan_in_space import NewLeg, replan_in_space
from viaspline.space.online.retimed_ahead import FlightAhead, fastest_ahead, law_past
from viaspline.space.online.swerves_in_space import swerves
from viaspline.space.online.takeover import Takeover
from viaspline.space.online.ways_round_moving import ways_round
from viaspline.space.without_ground import without_ground
from viaspline.tracks.patience import (
    APART_M,
    FREE_S,
    GAIN_S,
    MAX_HELD_UP_S,
    MAX_PAUSE_S,
    PATIENCE_S,
    PAUSE_SHARE,
    RETRY_S,
)
from viaspline.trajectory.retime import braking
from viaspline.trajectory.trajectory import Trajectory

SPEED_SHARES: Final = (0.9, 0.6, 0.3)
"""Of the speed, down to which the robot brakes where it can't fly into another path any faster."""


def give_way_in_space(flight: Flight, now: float) -> Flight:
    """A flight that meets nothing that moves, as far as is foreseen.

    Args:
        flight: So far, with what its last look has shown.
        now: When that was [s].
    """
    leg = flight.legs[-1]
    ahead = FlightAhead.of(leg, now)
    if leg.law.start_time > ahead.time or _is_there(flight, ahead):
        return flight  # another path begins first, or nothing is left to be flown
    meeting = _meeting(flight, leg.law, ahead, 0.0)
    is_due = now >= flight.timed_at + _pause(flight, now)
    is_idle = meeting is None or flight.is_held()
    if is_idle and not (is_due and (flight.gives_way or flight.is_held())):
        return flight
    return _decided(replace(flight, timed_at=now), now, ahead, meeting, is_due=is_due)


def _pause(flight: Flight, now: float) -> float:
    """From one look for something better to the next: the longer, the longer it stands [s]."""
    stood = max(now - flight.stands_since, 0.0)
    return min(max(PAUSE_SHARE * stood, RETRY_S), MAX_PAUSE_S)


@dataclass(frozen=True, eq=False)
class _WaitingLaw:
    """A law on the path that there is.

    Attributes:
        fastest: If nothing moved.
        law: Past what moves, with so much room to it; None: there is none.
        apart: How much that is beyond what is asked for [m].
    """

    fastest: Trajectory
    law: Trajectory | None
    apart: float

    @property
    def ends(self) -> float:
        """When it arrives [s]."""
        return math.inf if self.law is None else self.law.end_time

    @property
    def late(self) -> float:
        """How much later than if nothing moved [s]."""
        return self.ends - self.fastest.end_time


def _decided(
    flight: Flight, now: float, ahead: FlightAhead, meeting: FlightMeeting | None, *, is_due: bool
) -> Flight:
    if flight.is_held() and not _is_clear(flight, ahead):
        return _from_rest(flight, now, ahead) if ahead.speed == 0.0 else flight
    tried = list(_waiting(flight, now, ahead.after_dwell(flight.legs[-1])))
    soonest = min(tried, key=lambda one: one.ends, default=None)
    if soonest is not None and soonest.law is not None and soonest.late <= PATIENCE_S:
        return replace(flight.with_law(soonest.law), gives_way=soonest.late > FREE_S)
    if is_due:
        ends = math.inf if soonest is None else soonest.ends
        led = _by_another_way(flight, now, ahead, meeting, ends)
        if led is not None:
            return replace(led, gives_way=True)
    if soonest is not None and soonest.law is not None:
        return replace(flight.with_law(soonest.law), gives_way=True)
    if meeting is None:
        return flight
    flight = replace(flight, held_by=meeting.solid.name)
    return _out_of_the_way(flight, ahead, [one.fastest for one in tried[:1]])


def _is_clear(flight: Flight, ahead: FlightAhead) -> bool:
    """Whether the rest of the path is clear of what stands, as far as is known."""
    leg, problem = flight.legs[-1], flight.problem
    u, end = float(np.asarray(leg.path.parameter(ahead.distance))), leg.path.domain[1]
    if u >= end:
        return True
    rest = leg.path.section(u, end)
    world = problem.world if problem.landing is None else without_ground(problem.world)
    return certify(rest, world, problem.clearance, radius=problem.radius).holds


def _from_rest(flight: Flight, now: float, ahead: FlightAhead) -> Flight:
    """A flight on another path from where the robot hovers, if there is one."""
    begins = Takeover(ahead.time, ahead.distance, 0.0, ahead.time)
    via = still_ahead(flight, begins)
    until = begins.time + MAX_HELD_UP_S
    foreseen = _from(flight.tracks.foreseen(now, until, APART_M[0]), begins.time)
    leg = flight.legs[-1]
    found = replan_in_space(flight.known, flight.problem, leg, via, begins, foreseen)
    if not via or not isinstance(found, NewLeg):
        return flight
    old = replace(leg, until=begins.time)
    return taken_over(flight, now, begins, old, found, (flight.held_by,))


def _waiting(flight: Flight, now: float, ahead: FlightAhead) -> Iterator[_WaitingLaw]:
    """Laws on the path that there is, with ever less room, up to the first one that there is."""
    leg, problem, known = flight.legs[-1], flight.problem, flight.known
    try:
        fastest = fastest_ahead(leg, problem, ahead)
    except GeometryError:
        return
    on_map = solids_beside(known, fastest, known.route.hold_s)
    until = fastest.end_time + known.route.hold_s + MAX_HELD_UP_S
    for apart in APART_M:
        moving = (*on_map, *_from(flight.tracks.foreseen(now, until, apart), ahead.time))
        law = law_past(leg, problem, known, fastest, moving)
        yield _WaitingLaw(fastest, law if isinstance(law, Trajectory) else None, apart)
        if isinstance(law, Trajectory):
            return


def _from(moving: Sequence[MovingSolid], time: float) -> tuple[MovingSolid, ...]:
    """What moves, from a time on [s]."""
    return tuple(one.since(time) for one in moving)


def _meeting(
    flight: Flight, law: Trajectory, ahead: FlightAhead, apart: float
) -> FlightMeeting | None:
    """What the robot would come too near to by a law, of what it foresees."""
    robot = flight.known.robot
    until = ahead.time + 1.0
    now = min((track.estimate.time for track in flight.tracks.tracks), default=ahead.time)
    return meeting_in_flight(
        flight.legs[-1].path, law, ahead.time, FlyingBody.of(robot), robot.clearance_m,
        flight.tracks.foreseen(now, until, apart),
    )  # fmt: skip


_Ways = Callable[[Flight, Takeover, FlightMeeting, Sequence[MovingSolid]], Iterator[NewLeg]]
"""Other paths from a take-over on, past whom the robot would meet and all that is foreseen."""


def _by_another_way(
    flight: Flight, now: float, ahead: FlightAhead, meeting: FlightMeeting | None, ends: float
) -> Flight | None:
    """A flight on another path that arrives so much sooner that it is worth it; else None."""
    if meeting is None:
        try:
            fastest = fastest_ahead(flight.legs[-1], flight.problem, ahead)
        except GeometryError:
            return None
        meeting = _meeting(flight, fastest, ahead, APART_M[0])
    if meeting is None:
        return None
    begins_at = list(_takeovers(flight, now, ahead))
    both: tuple[_Ways, ...] = (partial(swerves, known={}), ways_round)
    for ways, begins in product(both, begins_at):
        best = None
        until = max(flight.legs[-1].law.end_time, begins.time) + MAX_HELD_UP_S
        foreseen = _from(flight.tracks.foreseen(now, until, APART_M[0]), begins.time)
        for found in ways(flight, begins, meeting, foreseen):
            if found.leg.law.end_time + GAIN_S < ends:
                best, ends = found, found.leg.law.end_time
        old = ended(flight.legs[-1], begins, flight.problem.limits.along.brake, flight.known)
        is_clear = old.moving is None or old.moving.holds
        if best is not None and is_clear:
            return taken_over(flight, now, begins, old, best, (meeting.solid.name,))
    return None


def _takeovers(flight: Flight, now: float, ahead: FlightAhead) -> Iterator[Takeover]:
    """Where another path may begin: as fast as the robot is, and slower, but not from a stop."""
    if ahead.speed == 0.0:
        stood = ahead.after_dwell(flight.legs[-1])
        yield Takeover(stood.time, stood.distance, 0.0, stood.time)
        return
    brake = flight.problem.limits.along.brake
    yield from takeovers(flight.legs[-1], now, brake, SPEED_SHARES, flight.climb)


def _out_of_the_way(flight: Flight, ahead: FlightAhead, others: Sequence[Trajectory]) -> Flight:
    """A flight that does what meets something last; it brakes if that is no worse."""
    leg, brake = flight.legs[-1], flight.problem.limits.along.brake
    stop = braking(ahead.distance, ahead.speed, brake, ahead.time)
    laws = [stop, leg.law, *others]

    def met(k: int) -> tuple[float, float, int]:
        found = _meeting(flight, laws[k], ahead, 0.0)
        return (math.inf, 0.0, -k) if found is None else (found.begins, found.least, -k)

    best = max(range(len(laws)), key=met)
    if best == 1:
        return flight
    return replace(flight.with_law(laws[best]), gives_way=True)


def _is_there(flight: Flight, ahead: FlightAhead) -> bool:
    """Whether the robot has come to the end of its path by then."""
    return not flight.is_held() and ahead.time >= flight.legs[-1].law.end_time
