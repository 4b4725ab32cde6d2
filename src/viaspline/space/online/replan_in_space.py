"""Another path from a place under way, past what was seen.

Tested through ``space/online/test_fly``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.errors import GeometryError, PlanningError
from viaspline.mission.model import Mission
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.timed_past import solids_beside, timed_past
from viaspline.space.led_route import KnownWays
from viaspline.space.leg_router import LegRouter
from viaspline.space.online.flown_leg import FlownLeg
from viaspline.space.online.takeover import Takeover
from viaspline.space.route_law import headings_of, stops_of
from viaspline.space.solve_route import solve_route
from viaspline.space.spatial_problem import SpatialProblem, SpatialVia
from viaspline.space.timing.retime_in_space import retime_in_space
from viaspline.space.timing.yaw_profile import YawProfile

HERE = "take-over"
"""What the place is called from which on another path is flown."""


@dataclass(frozen=True, eq=False)
class NewLeg:
    """What is flown from a take-over on.

    Attributes:
        leg: Path, law and headings.
        problem: What it solves.
    """

    leg: FlownLeg
    problem: SpatialProblem


def replan_in_space(
    mission: Mission, problem: SpatialProblem, old: FlownLeg, ahead: Sequence[SpatialVia],
    begins: Takeover, foreseen: Sequence[MovingSolid] = (), known: KnownWays | None = None,
) -> NewLeg | PlanningError | GeometryError:  # fmt: skip
    """A path from a take-over on through the via points that are still ahead.

    Args:
        mission: Whose obstacles have sides on which they are to be passed.
        problem: What is asked, in the world as it is known now.
        old: What is flown until then.
        ahead: The via points that are still to be served.
        begins: Where and how fast.
        foreseen: What moves and isn't on the map, as it is taken to go on.
        known: See ``solve_route``.

    Returns:
        What is flown from then on; or why there is nothing.
    """
    u = float(np.asarray(old.path.parameter(begins.distance)))
    at, way = old.path.evaluate(u), old.path.tangent(u)
    moving = begins.speed > 0.0
    here = SpatialVia(HERE, at, None, None if moving else 0.0, way if moving else None)
    count = len(ahead)
    tensions = problem.shape.tension[-count:]
    asked = replace(
        problem, vias=(here, *ahead), takeoff=None, laps=1,
        shape=replace(problem.shape, tension=tensions),
    )  # fmt: skip
    try:
        found = solve_route(asked, LegRouter(asked, mission), known)
        if not found.certificate.holds:
            return GeometryError("the path to the landing isn't clear")
        yaw = _turned_from(old, begins, headings_of(asked, found.path), found.path)
        stops = tuple(stops_of(asked, found.path))
        law = retime_in_space(
            found.path,
            asked.limits,
            stops,
            yaw,
            zones=asked.zones,
            start_speed=begins.speed,
            start_time=begins.time,
        )
    except (PlanningError, GeometryError) as problem_found:
        return problem_found
    if law.over_limit_until is not None:
        return GeometryError("the robot is too fast for the new path where it begins")
    leg = FlownLeg(found.path, law, yaw, float("inf"))
    if mission.world.moving or foreseen:
        return _past_moving(NewLeg(leg, asked), mission, foreseen)
    return NewLeg(leg, asked)


def _turned_from(old: FlownLeg, begins: Takeover, yaw: YawProfile, path: Path) -> YawProfile:
    """Headings that begin with the old ones, and turn to the new ones by the next stop."""
    by = math.remainder(float(old.yaw.at(begins.distance) - yaw.at(0.0)), 2.0 * math.pi)
    until = min((at for _, at in path.stops if at > 0.0), default=path.length)
    left = np.clip(1.0 - yaw.distances / until, 0.0, 1.0)
    return YawProfile(yaw.distances, yaw.headings + by * left)


def _past_moving(
    found: NewLeg, mission: Mission, foreseen: Sequence[MovingSolid]
) -> NewLeg | PlanningError | GeometryError:
    """What is flown from a take-over on past what moves, at the speed that the robot has there."""
    leg, law = found.leg, found.leg.law
    moving = (*solids_beside(mission, law, mission.route.hold_s), *foreseen)
    try:
        past = timed_past(leg.path, law, found.problem.limits, mission, moving)
    except PlanningError as problem_found:
        return problem_found
    if isinstance(past, str):
        return GeometryError(f"it can't let {past!r} pass on the new path")
    begins = past.trajectory
    if law.speeds[0] > 0.0 and (begins.speeds[0] != law.speeds[0] or begins.distances[1] == 0.0):
        return GeometryError("the robot is too fast to let what moves pass on the new path")
    return replace(found, leg=replace(leg, law=begins, moving=past.proof))
