"""How much free space a flight had over time, of what stands and what moves, seen or not.

Tested through ``report/space/test_flight_picture``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.mission.space.flight_places import flight_places
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.report.space.moving_in_space import solids_met
from viaspline.space.among.moving_solids import MovingSolids
from viaspline.space.spatial_request import spatial_world_of
from viaspline.space.spatial_run import SpatialRun
from viaspline.space.without_ground import without_ground

STILL_M = 1e-6
"""Sideways: as long as a robot hasn't gone farther it takes off, or lands."""


def flown_clearance(run: SpatialRun) -> Floats:
    """Free space between the body and everything, at the times of a run [m], shape (n,).

    While it takes off and lands the ground doesn't count.
    """
    mission, places = run.plan.mission, run.positions
    world = mission.world
    everything = mission.model_copy(
        update={"world": world.model_copy(update={"known": (*world.known, *world.unseen_standing)})}
    )
    there = spatial_world_of(everything, flight_places(mission))
    on_ground = _on_ground(run)
    free = np.array(there.distance(places))
    if on_ground.any():
        free[on_ground] = without_ground(there).distance(places[on_ground])
    body: Floats = free - (mission.robot.radius_m if mission.robot.half_height_m is None else 0.0)
    moving = MovingSolids(solids_met(run), FlyingBody.of(mission.robot))
    return np.minimum(body, moving.distance(places, run.times))


def _on_ground(run: SpatialRun) -> Flags:
    """When a robot takes off or lands, shape (n,)."""
    places, route = run.positions[:, :2], run.plan.mission.route
    over: Flags = np.zeros(len(places), bool)
    if route.takeoff is not None:
        over |= np.logical_and.accumulate(np.hypot(*(places - places[0]).T) <= STILL_M)
    if route.land is not None and run.reached:
        back = np.hypot(*(places - places[-1]).T)[::-1] <= STILL_M
        over |= np.logical_and.accumulate(back)[::-1]
    return over
