"""Passive safety in space: the robot is at rest before anything can touch it.

The premises: nothing is faster than ``moving.max_speed_mps``, w; a look shows all that has a part
within the sensor's reach R of the robot; nothing that wasn't in reach has come out of nowhere. At
a time t after a look, all that may be there is at a distance from a body at p of at least

    D(p) - w t,   D(p) = min( the gap to what was seen, where it was seen;
                              R - |p - eye|, less the body's own extent ),

for whatever it was, it was outside of D(p) at the look. Along a path D changes by no more than the
way, so between two places h apart it is nowhere less than (D₁ + D₂ - h) / 2. A robot that has left
such a stretch by w t <= (D₁ + D₂ - h) / 2 isn't touched on it: so each stretch has its deadline,
and a law is proven if it keeps them all until it rests. What moves as the map says is looked at
where it is when the robot is there.

At each look the robot is committed up to a latency ahead, and may brake from there: that was proven
by the look before. It goes on as it means to for one more step where braking after that step is
proven, else as fast as is, and where nothing is it brakes.

Tested through ``space/online/test_passive_flight``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.moving_solids import body_of, gaps_to
from viaspline.space.among.timed_past import solids_beside
from viaspline.space.online.flight import Flight
from viaspline.space.online.flown_leg import FlownLeg
from viaspline.space.online.retimed_ahead import (
    SAME_PLACE_M,
    FlightAhead,
    fastest_ahead,
    law_past,
)
from viaspline.space.online.takeover import LATENCY_S
from viaspline.tracks.patience import MAX_HELD_UP_S
from viaspline.trajectory.retime import braking
from viaspline.trajectory.trajectory import Trajectory

SPACING_M: Final = 0.05
"""From place to place of a stretch, at most [m];"""
LEAST_PLACES: Final = 20
"""it has so many at least,"""
MOST_PLACES: Final = 2000
"""and at most."""
HALVINGS: Final = 7
"""How often the interval of accelerations is halved in which the largest one is looked for."""
ROUNDING_M: Final = 1e-6


@dataclass(frozen=True, eq=False)
class FlightThreats:
    """What may come, by one look.

    Attributes:
        seen: What was seen to move, as bodies.
        at: Where the middle of each was [m], (k, 3).
        on_map: What moves as the map says.
        body: That of the robot.
        eye: Where the look was taken [m], (3,).
        reach: All that has a part nearer was seen [m].
        time: Of the look [s].
        top: Nothing is faster [m/s].
    """

    seen: Sequence[FlyingBody]
    at: Floats
    on_map: Sequence[MovingSolid]
    body: FlyingBody
    eye: Floats
    reach: float
    time: float
    top: float

    @classmethod
    def of(cls, flight: Flight, eye: Floats, reach: float, now: float, top: float) -> FlightThreats:
        """Those of a flight that looks now [s]."""
        tracks = flight.tracks.tracks
        sightings = [track.sighting for track in tracks]
        places = np.array([one.place for one in sightings]).reshape(-1, 3)
        bodies = [body_of(one.solid) for one in sightings]
        on_map = solids_beside(flight.known, flight.legs[-1].law, 0.0)
        body = FlyingBody.of(flight.known.robot)
        return cls(bodies, places, on_map, body, eye, reach, now, top)

    def deadlines(self, places: Floats, step: float) -> Floats:
        """When the robot has to have left the stretches between places [s], (n - 1,).

        Args:
            places: Along its path [m], (n, 3).
            step: From each to the next along the path, at most [m].
        """
        free = self.reach - np.linalg.norm(places - self.eye, axis=1) - self.body.outermost
        for its, at in zip(self.seen, self.at, strict=True):
            free = np.minimum(free, self.body.gaps(its, at - places))
        least = 0.5 * (free[1:] + free[:-1] - step)
        return np.asarray(self.time + (least - ROUNDING_M) / self.top)

    def are_kept(self, path_places: Floats, step: float, times: Floats) -> bool:
        """Whether a robot that comes to places at times [s], (n,), is touched by nothing."""
        if (times[1:] > self.deadlines(path_places, step)).any():
            return False
        lasts = np.diff(times)
        return all(
            (
                gaps_to(one, self.body, path_places[:-1], times[:-1])
                > step + one.top_speed * lasts + ROUNDING_M
            ).all()
            for one in self.on_map
        )


def kept_stoppable(flight: Flight, threats: FlightThreats, step: float, latency: float) -> Flight:
    """A flight that can be at rest before anything touches it, also by its next look.

    Args:
        flight: So far.
        threats: What may come, by the look of now.
        step: Until the next look [s].
        latency: So long the robot goes on as it had meant to [s]; 0 for one that hasn't set out.
    """
    leg = _leg_at(flight, threats.time)
    ahead = FlightAhead.of(leg, threats.time, latency)
    step += LATENCY_S - latency  # up to where the next look may change something
    if _goes_on(flight, ahead, threats, step):
        return flight
    if leg is not flight.legs[-1]:  # it stops before the other path begins, and looks from there
        brake = flight.problem.limits.along.brake
        stop = braking(ahead.distance, ahead.speed, brake, ahead.time)
        return flight.without_pending(threats.time).with_law(stop)
    return _slower(flight, ahead, threats, step)


def _leg_at(flight: Flight, now: float) -> FlownLeg:
    """The leg on which a robot is that is committed from now on."""
    last = flight.legs[-1]
    begins_later = len(flight.legs) > 1 and last.law.start_time > now + LATENCY_S
    return flight.legs[-2] if begins_later else last


def _goes_on(flight: Flight, ahead: FlightAhead, threats: FlightThreats, step: float) -> bool:
    """Whether the robot may do as it means to for one more step and brake then."""
    brake = flight.problem.limits.along.brake
    end = ahead.time + step
    leg = _leg_at(flight, threats.time)
    last = flight.legs[-1]
    if leg is not last and last.law.start_time < end:
        joint = last.law.start_time
        first = _is_kept(leg, leg.law, (ahead.time, joint), threats)
        return first and _is_kept(last, _stopping(last.law, end, brake), (joint, math.inf), threats)
    return _is_kept(leg, _stopping(leg.law, end, brake), (ahead.time, math.inf), threats)


def _stopping(law: Trajectory, time: float, brake: float) -> Trajectory:
    """A law up to a time [s] at which the robot begins to brake."""
    if time >= law.end_time:
        return law
    time = law.cut_after(time)
    distance, speed, _ = (float(value) for value in law.state_at(time))
    return law.followed_by(braking(distance, speed, brake, time), law.start_time)


def _is_kept(
    leg: FlownLeg, law: Trajectory, span: tuple[float, float], threats: FlightThreats
) -> bool:
    """Whether nothing touches a robot on its way from one time to another, or to its rest."""
    begin, end = (float(law.distance_at(time)) for time in np.minimum(span, law.end_time))
    if end <= begin:
        return True
    count = int(np.clip(math.ceil((end - begin) / SPACING_M), LEAST_PLACES, MOST_PLACES))
    along = np.linspace(begin, end, count + 1)
    times = np.asarray(law.time_at(along))
    times[0] = max(float(times[0]), span[0])
    places = np.asarray(leg.path.at_distance(np.minimum(along, leg.path.length)))
    return threats.are_kept(places, (end - begin) / count, times)


def _slower(flight: Flight, ahead: FlightAhead, threats: FlightThreats, step: float) -> Flight:
    """A flight that goes on for one step as fast as is proven; it brakes where nothing is."""
    leg, brake = flight.legs[-1], flight.problem.limits.along.brake
    _, _, meant = leg.law.state_at(ahead.time + np.linspace(0.0, step, 5)[:-1])
    low, high, best = -brake, float(np.min(meant)), -brake
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        piece = _piece(ahead, middle, step)
        if _is_kept(leg, _then_braking(piece, brake), (ahead.time, math.inf), threats):
            low = best = middle
        else:
            high = middle
    piece = _piece(ahead, best, step)
    if piece.distances[-1] == ahead.distance and not threats.on_map and not flight.is_held():
        stands = ahead.distance - SAME_PLACE_M
        later = replace(leg, law=leg.law.waiting(stands, step))  # it sets out later
        return replace(flight, legs=(*flight.legs[:-1], later))
    flight = flight.with_law(piece)
    return _going_on_after(flight, piece, threats)


def _piece(ahead: FlightAhead, acceleration: float, step: float) -> Trajectory:
    """A law of constant acceleration [m/s²] for so long [s], up to a rest at most."""
    lasts = step
    if acceleration < 0.0:
        lasts = min(step, ahead.speed / -acceleration)
    speed = max(ahead.speed + acceleration * lasts, 0.0)
    speed = 0.0 if lasts < step else speed
    distance = ahead.distance + 0.5 * (ahead.speed + speed) * lasts
    times = np.array([ahead.time, ahead.time + lasts, ahead.time + step])
    speeds = np.array([ahead.speed, speed, speed])
    distances = np.array([ahead.distance, distance, distance])
    rises = np.array([acceleration if lasts > 0.0 else 0.0, 0.0])
    count = 2 if lasts == step else 3
    return Trajectory(distances[:count], speeds[:count], times[:count], rises[: count - 1])


def _then_braking(piece: Trajectory, brake: float) -> Trajectory:
    """A piece after which the robot brakes."""
    speed, end = float(piece.speeds[-1]), float(piece.distances[-1])
    if speed <= 0.0:
        return piece
    return piece.followed_by(braking(end, speed, brake, piece.end_time), piece.start_time)


def _going_on_after(flight: Flight, piece: Trajectory, threats: FlightThreats) -> Flight:
    """A flight that goes on to the end of its path after a piece, if it can."""
    leg, problem, known = flight.legs[-1], flight.problem, flight.known
    after = FlightAhead(piece.end_time, float(piece.distances[-1]), float(piece.speeds[-1]))
    stop = braking(after.distance, after.speed, problem.limits.along.brake, after.time)
    try:
        fastest = fastest_ahead(leg, problem, after)
    except GeometryError:
        return flight.with_law(stop)
    on_map = solids_beside(known, fastest, known.route.hold_s)
    until = fastest.end_time + known.route.hold_s + MAX_HELD_UP_S
    foreseen = flight.tracks.foreseen(threats.time, until, 0.0)
    moving = (*on_map, *(one.since(after.time) for one in foreseen))
    law = law_past(leg, problem, known, fastest, moving)
    if isinstance(law, str) and on_map:
        law = law_past(leg, problem, known, fastest, on_map)
        return flight.with_law(stop if isinstance(law, str) else law)
    return flight.with_law(fastest if isinstance(law, str) else law)
