"""What a flight does about something that stands in its way and was just seen.

It takes another path from a place a little ahead, where that joins without a corner; if there is
none that it can fly into at its speed, it stops and looks from there.

Tested through ``space/online/test_fly``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from viaspline.curve.certificate import certify
from viaspline.mission.model import Mission
from viaspline.mission.space.flight_places import flight_places
from viaspline.space.among.timed_past import proven_beside, solids_beside
from viaspline.space.online.chosen_takeovers import climbs, takeovers
from viaspline.space.online.flight import Flight
from viaspline.space.online.flown_leg import FlownLeg
from viaspline.space.online.replan_in_space import NewLeg, replan_in_space
from viaspline.space.online.sightings import UnseenSolid
from viaspline.space.online.takeover import Takeover, braked_takeover
from viaspline.space.spatial_problem import SpatialVia
from viaspline.space.spatial_request import spatial_world_of
from viaspline.space.spatial_run import SpatialReplan
from viaspline.space.without_ground import without_ground
from viaspline.trajectory.retime import braking

SPEED_SHARES: Final = (0.6, 0.3, 0.0)
"""Of the speed, down to which the robot brakes where a path can't be flown into any faster."""

ASIDE: Final = "aside"
"""What a place is called through which a path swerves: it needn't be served by another path. Unlike
a via point of the route that has this name it has no index."""


def reacted(flight: Flight, now: float, seen: Sequence[UnseenSolid]) -> Flight:
    """A flight in which something was seen: with another path, if it is in the way."""
    known = with_seen(flight.known, seen)
    unseen = tuple(one for one in flight.unseen if one not in seen)
    # What isn't in the way now may be in that of a path past something else.
    problem = replace(flight.problem, world=spatial_world_of(known, flight_places(known)))
    problems = (*flight.problems[:-1], problem)
    flight = replace(flight, known=known, unseen=unseen, problems=problems)
    if all(_is_passed_clear(flight, now, one) for one in seen):
        return flight
    names = tuple(one.name for one in seen)
    if len(flight.ahead_of(now)) > 1:  # a path that is given up before it began
        names = (*flight.replans[-1].obstacles, *names)
        flight = flight.without_pending(now)
    return _led_past(flight, now, names)


def _led_past(flight: Flight, now: float, names: tuple[str, ...]) -> Flight:
    """A flight on another path from where it can take it up; else one that ends where it stops."""
    known, problem, leg = flight.known, flight.problem, flight.legs[-1]
    brake = problem.limits.along.brake
    is_climbing = climbs(leg, now, flight.climb)
    for begins in takeovers(leg, now, brake, SPEED_SHARES, flight.climb):
        ahead = still_ahead(flight, begins)
        if not ahead:
            continue
        if is_climbing and _nearest_before(flight, now, begins) < problem.clearance:
            continue
        old = ended(leg, begins, brake, known)
        if old.moving is not None and not old.moving.holds:
            continue
        found = replan_in_space(known, problem, leg, ahead, begins)
        if isinstance(found, NewLeg):
            return taken_over(flight, now, begins, old, found, names)
    return _stopped(flight, now, names)


def with_seen(known: Mission, seen: Sequence[UnseenSolid]) -> Mission:
    """The mission with what was seen on its map."""
    names = {one.name for one in seen}
    world = known.world
    found = [
        one.model_copy(update={"name": one.name or f"world.unseen[{k}]"})
        for k, one in enumerate(world.unseen_standing)
        if (one.name or f"world.unseen[{k}]") in names
    ]
    return known.model_copy(
        update={"world": world.model_copy(update={"known": (*world.known, *found)})}
    )


def _is_passed_clear(flight: Flight, now: float, one: UnseenSolid) -> bool:
    """Whether all that is still to be flown is clear of something."""
    problem = flight.problem
    for leg in flight.ahead_of(now):
        first, last = float(leg.law.distance_at(now)), leg.path.length
        if leg.until < np.inf:
            last = float(leg.law.distance_at(leg.until))
        span = np.minimum([first, last], leg.path.length)
        u, end = np.asarray(leg.path.parameter(span)).tolist()
        if u >= end:
            continue
        rest = leg.path.section(u, end)
        if not certify(rest, one.world, problem.clearance, radius=problem.radius).holds:
            return False
    return True


def still_ahead(flight: Flight, begins: Takeover) -> tuple[SpatialVia, ...]:
    """The via points of the route after a take-over."""
    leg, problem = flight.legs[-1], flight.problem
    users = [via for via in leg.path.vias if via.kind == "user"]
    users = users[problem.takeoff is not None : len(users) - (problem.landing is not None)]
    distances = np.asarray(leg.path.distance([via.u for via in users]))
    later = distances > begins.distance + 1e-6
    vias = zip(problem.vias, later, strict=True)
    return tuple(
        via for via, after in vias if after and not (via.index is None and via.name == ASIDE)
    )


def taken_over(
    flight: Flight, now: float, begins: Takeover, old: FlownLeg, found: NewLeg,
    names: tuple[str, ...],
) -> Flight:  # fmt: skip
    """A flight that has taken another path.

    Args:
        flight: So far.
        now: When it looked [s].
        begins: Where the new path begins.
        old: What is flown until then.
        found: The new path.
        names: What was in the way.
    """
    replan = SpatialReplan(now, begins.time, names, found.leg.path, begins.speed == 0.0)
    return replace(
        flight, legs=(*flight.legs[:-1], old, found.leg),
        problems=(*flight.problems, found.problem), replans=(*flight.replans, replan),
    )  # fmt: skip


def ended(leg: FlownLeg, begins: Takeover, brake: float, known: Mission) -> FlownLeg:
    """A leg as it is flown until another one begins; where it brakes, proven again."""
    if begins.since >= begins.time or begins.time >= leg.law.end_time:
        return replace(leg, until=begins.time)
    distance, speed, _ = (float(value) for value in leg.law.state_at(begins.since))
    stop = braking(distance, speed, brake, begins.since)
    law = leg.law.followed_by(stop, leg.law.start_time)
    braked = replace(leg, law=law, until=begins.time)
    if not known.world.moving:
        return braked
    moving = solids_beside(known, braked.law, 0.0)
    return replace(braked, moving=proven_beside(leg.path, braked.law, 0.0, known, moving))


def _stopped(flight: Flight, now: float, names: tuple[str, ...]) -> Flight:
    """A flight that ends where the robot comes to rest."""
    brake = flight.problem.limits.along.brake
    leg = flight.legs[-1]
    begins = braked_takeover(leg, now, brake, 0.0)
    old = ended(leg, begins, brake, flight.known)
    replan = SpatialReplan(now, begins.time, names, None, True)
    reason = f"it found no way past {' and '.join(names)}, and hovers before it"
    reason += _too_late(flight, now, begins)
    return replace(
        flight, legs=(*flight.legs[:-1], old), replans=(*flight.replans, replan), reason=reason
    )


def _too_late(flight: Flight, now: float, begins: Takeover) -> str:
    """That it saw something too late to stop with the clearance that is asked for, if it did."""
    leg, sensor = flight.legs[-1], flight.known.robot.sensor
    here = float(leg.law.distance_at(now))
    nearest = _nearest_before(flight, now, begins)
    if sensor is None or nearest >= flight.problem.clearance:
        return ""
    speed, takes = float(leg.law.speed_at(here)), min(begins.distance, leg.path.length) - here
    return (
        f"; it comes as near as {max(nearest, 0.0):.2f} m, for from {speed:.1f} m/s it "
        f"takes {takes:.1f} m to stop, and its sensor sees {sensor.reach:g} m: fly slower, "
        "or give it a longer range_m"
    )


def _nearest_before(flight: Flight, now: float, begins: Takeover) -> float:
    """How near it comes to what is known before a take-over [m]; inf: no nearer than asked for.

    While it climbs from the ground, that doesn't count.
    """
    problem, leg = flight.problem, flight.legs[-1]
    here = float(leg.law.distance_at(now))
    first, last = np.minimum([here, begins.distance], leg.path.length).tolist()
    if last <= first:
        return math.inf
    part = leg.path.section(*np.asarray(leg.path.parameter([first, last])).tolist())
    world = without_ground(problem.world) if climbs(leg, now, flight.climb) else problem.world
    proof = certify(part, world, problem.clearance, radius=problem.radius)
    return math.inf if proof.holds else proof.clearance
