"""What was flown, over time, and what is proven of it.

Tested through ``space/online/test_fly``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from viaspline.curve.certificate import certify
from viaspline.space.online.flown_leg import FlownLeg
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_run import SpatialReplan, SpatialRun
from viaspline.space.without_ground import without_ground
from viaspline.world.space.spatial_world import SpatialWorld


def recorded(
    plan: SpatialPlan, legs: Sequence[FlownLeg], replans: tuple[SpatialReplan, ...], reason: str,
    world: SpatialWorld, step: float,
) -> SpatialRun:  # fmt: skip
    """The record of a flight.

    Args:
        plan: What it began with.
        legs: What was flown, each until the next one began.
        replans: Where the path was changed.
        reason: Why the goal wasn't reached; empty if it was.
        world: Everything that there is, seen or not.
        step: From one moment to the next [s].
    """
    start = plan.trajectory.start_time
    end = min(legs[-1].until, legs[-1].law.end_time)
    times = np.append(np.arange(start, end, step, dtype=np.float64), end)
    ends = [*(leg.until for leg in legs[:-1]), np.inf]
    owner = np.searchsorted(ends, times, side="right")
    parts = [leg.states(times[owner == k]) for k, leg in enumerate(legs)]
    positions, headings, speeds, climbs = (
        np.concatenate(column) for column in zip(*parts, strict=True)
    )
    clearance = _clearance(plan, legs, not reason, world)
    moving = (leg.moving.clearance for leg in legs if leg.moving is not None)
    clearance = min([clearance, *moving])
    return SpatialRun(
        plan, times, positions, headings, speeds, climbs, replans, clearance, not reason, reason
    )


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
