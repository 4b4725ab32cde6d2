"""A flight among things that move and aren't on its map, look by look.

Tested through ``space/online/test_fly_among_unseen``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import MovingThings
from viaspline.space.online.flight import Flight
from viaspline.space.online.give_way_in_space import give_way_in_space
from viaspline.space.online.lead_past import reacted
from viaspline.space.online.passive_flight import FlightThreats, kept_stoppable
from viaspline.space.online.solid_sensor import SolidSensor
from viaspline.space.online.takeover import LATENCY_S
from viaspline.tracks.encounters import STANDING_MPS
from viaspline.tracks.patience import FROZEN, MAX_FROZEN_S, MAX_HELD_UP_S
from viaspline.tracks.premise import is_faster, jumped_words, too_fast_words


@dataclass(frozen=True, eq=False)
class FlightWatch:
    """What a flight is watched with.

    Attributes:
        sensor: What it sees of what moves.
        things: What it has to reckon with where it doesn't see; None: nothing is said.
        step: Between two looks [s].
        until: When it is over at the latest [s].
    """

    sensor: SolidSensor
    things: MovingThings | None
    step: float
    until: float


def watch_flight(flight: Flight, watch: FlightWatch) -> Flight:
    """A flight to its end: its goal, or where it hovers for good.

    Args:
        flight: As it was planned.
        watch: What it is watched with.
    """
    begin = flight.legs[0].law.start_time
    number = 0
    while True:
        now = begin + number * watch.step
        flight = flight.standing_until(now + LATENCY_S + watch.step)
        if flight.reason or (not flight.is_held() and now >= flight.legs[-1].law.end_time):
            return flight
        if now >= watch.until:
            return _given_up(flight, now, f"it hasn't arrived after {now - begin:.0f} s")
        flight = _looked(flight, watch, now, number)
        number += 1


def _looked(flight: Flight, watch: FlightWatch, now: float, number: int) -> Flight:
    """A flight after one more look."""
    place, speed = _state(flight, now)
    reach = watch.sensor.reach
    seen = [one for one in flight.unseen if float(one.world.distance(place[None])[0]) <= reach]
    if seen:
        flight = reacted(flight, now, seen)
        if flight.reason:
            return flight
    flight = _tracked(flight, watch, place, now, number)
    flight = give_way_in_space(flight, now)
    is_passive = watch.things is not None and watch.things.safety == "passive"
    froze = False
    if is_passive and watch.things is not None:
        threats = FlightThreats.of(flight, place, reach, now, watch.things.max_speed_mps)
        kept = kept_stoppable(flight, threats, watch.step, LATENCY_S if number else 0.0)
        froze = kept is not flight and _stands(kept, now + LATENCY_S + watch.step)
        flight = kept
    if speed > STANDING_MPS or not (froze or flight.is_held()):
        return replace(flight, stands_since=math.inf)
    since = min(flight.stands_since, now)
    if now - since >= (MAX_FROZEN_S if froze else MAX_HELD_UP_S):
        words = f"for {MAX_HELD_UP_S:g} s it found no way past {flight.held_by!r}"
        return _given_up(flight, now, FROZEN if froze else words)
    return replace(flight, stands_since=since)


def _state(flight: Flight, now: float) -> tuple[Floats, float]:
    """Where the robot is [m], (3,), and how fast [m/s]."""
    leg = flight.ahead_of(now)[0]
    places, _, speeds, _ = leg.states(np.array([now]))
    return places[0], float(speeds[0])


def _stands(flight: Flight, time: float) -> bool:
    """Whether the robot stands at a time [s] without having come to its goal."""
    leg = flight.legs[-1]
    distance, speed, _ = leg.law.state_at(time)
    return float(speed) <= STANDING_MPS and float(distance) < leg.path.length


def _tracked(flight: Flight, watch: FlightWatch, place: Floats, now: float, number: int) -> Flight:
    """A flight with what its sensor shows of what moves, and of premises that are broken."""
    before = {track.sighting.index: track for track in flight.tracks.tracks}
    tracks = flight.tracks.with_sightings(watch.sensor.seen(place, now, number), now)
    broken = list(flight.broken)
    if watch.things is not None:
        top = watch.things.max_speed_mps
        for track in tracks.tracks:
            old = before.get(track.sighting.index)
            if track.jumped:
                broken.append(f"{jumped_words(track.name)} after {now:.1f} s")
            was_fast = old is not None and is_faster(old.estimate, top)
            if is_faster(track.estimate, top) and not was_fast:
                words = too_fast_words(track.name, track.estimate, top)
                broken.append(f"{words}, after {now:.1f} s")
    return replace(flight, tracks=tracks, broken=tuple(broken))


def _given_up(flight: Flight, now: float, reason: str) -> Flight:
    """A flight that ends here and now."""
    flight = flight.without_pending(now)
    legs = (*flight.legs[:-1], replace(flight.legs[-1], until=now))
    return replace(flight, legs=legs, reason=reason)
