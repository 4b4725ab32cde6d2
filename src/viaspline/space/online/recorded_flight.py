"""What was flown, over time, and what is proven of it.

Tested through ``space/online/test_fly``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from viaspline.curve.certificate import certify
from viaspline.mission.model import Mission
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.timed_past import proven_beside
from viaspline.space.online.flight import Flight
from viaspline.space.online.flown_encounters import flown_encounters, states_at
from viaspline.space.online.flown_leg import FlownLeg
from viaspline.space.online.solid_sensor import SolidSensor
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_run import SpatialRun
from viaspline.space.without_ground import without_ground
from viaspline.tracks.encounters import touched_by
from viaspline.world.space.spatial_world import SpatialWorld


def recorded(plan: SpatialPlan, flight: Flight, world: SpatialWorld, step: float) -> SpatialRun:
    """The record of a flight.

    Args:
        plan: What it began with.
        flight: What was flown.
        world: Everything that stands, seen or not.
        step: From one moment to the next [s].
    """
    legs, reason = flight.legs, flight.reason
    start, end = plan.trajectory.start_time, flight.end_time
    times = np.append(np.arange(start, end, step, dtype=np.float64), end)
    positions, headings, speeds, climbs = states_at(legs, times)
    clearance = _clearance(plan, legs, not reason, world)
    moving = (leg.moving.clearance for leg in legs if leg.moving is not None)
    clearance = min([clearance, *moving])
    return SpatialRun(
        plan, times, positions, headings, speeds, climbs, flight.replans, clearance, not reason,
        reason,
    )  # fmt: skip


def recorded_among(
    plan: SpatialPlan, flight: Flight, world: SpatialWorld, sensor: SolidSensor, step: float
) -> SpatialRun:
    """The record of a flight among what moved and wasn't on the map.

    Args:
        plan: What it began with.
        flight: What was flown.
        world: Everything that stands, seen or not.
        sensor: What it saw with.
        step: From one moment to the next, and between two looks [s].
    """
    mission, end = plan.mission, flight.end_time
    legs = tuple(_beside_the_map(leg, min(leg.until, end), mission) for leg in flight.legs)
    run = recorded(plan, replace(flight, legs=legs), world, step)
    on_map = MovingSolid.all_of(mission, flight.legs[0].law.start_time, end + step)
    met = flown_encounters(flight.legs, end, mission.robot, on_map, sensor, step)
    reason = run.reason or touched_by(met) or ""
    return replace(
        run, reached=not reason, reason=reason, encounters=met, broken_premises=flight.broken
    )


def _beside_the_map(leg: FlownLeg, until: float, mission: Mission) -> FlownLeg:
    """A leg with the proof of how far it stayed from what moves as the map says, until a time."""
    moving = MovingSolid.all_of(mission, leg.law.start_time, until)
    if not moving or until <= leg.law.start_time:
        return replace(leg, moving=None)
    return replace(leg, moving=proven_beside(leg.path, leg.law, 0.0, mission, moving))


def _clearance(
    plan: SpatialPlan, legs: Sequence[FlownLeg], landed: bool, world: SpatialWorld
) -> float:
    """The proven free space on all that was flown [m]."""
    radius = plan.mission.robot.radius_m if plan.mission.robot.half_height_m is None else 0.0
    asked = plan.mission.robot.clearance_m  # near what is asked for the proof is the finest
    least = np.inf
    for k, leg in enumerate(legs):
        takes_off = k == 0 and plan.mission.route.takeoff is not None
        lands = k == len(legs) - 1 and landed and plan.mission.route.land is not None
        for first, last, on_ground in _stretches(leg, takes_off, lands):
            part = leg.path.section(*np.asarray(leg.path.parameter([first, last])).tolist())
            here = without_ground(world) if on_ground else world
            least = min(least, certify(part, here, asked, radius=radius).clearance)
    return float(least)


def _stretches(leg: FlownLeg, takes_off: bool, lands: bool) -> Iterator[tuple[float, float, bool]]:
    """From where to where on its path a leg was flown [m], and whether it stood on ground there."""
    last = min(float(leg.law.distance_at(min(leg.until, leg.law.end_time))), leg.path.length)
    cuts = {0.0, last}
    up = float(leg.path.distance(1.0)) if takes_off else 0.0
    down = float(leg.path.distance(leg.path.domain[1] - 1.0)) if lands else leg.path.length
    cuts |= {at for at in (up, down) if 0.0 < at < last}
    for first, end in pairwise(sorted(cuts)):
        yield first, end, end <= up or first >= down
