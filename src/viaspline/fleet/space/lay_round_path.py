"""Another path for a robot, round the whole path of one that it can't pass in time.

In space there is nearly always room above or beside a path. Where two can't be timed along theirs,
as they meet head on, one of them is led round the path of the other, as far as where it begins,
ends and has to pass allows.

Tested through ``fleet/space/test_plan_spatial_fleet``.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Final

import numpy as np

from viaspline.errors import PlanningError
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.space.lay_in_space import KEPT_MORE_M
from viaspline.fleet.space.ways_past_moving import WaysPastMoving
from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.capsule import Capsule
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.among.plan_past_moving import swept
from viaspline.space.laid_round import laid_round
from viaspline.space.meeting.gap_of_bodies import BodyPair
from viaspline.space.spatial_plan import SpatialPlan

OFF_M: Final = 0.1
"""How far a path may be from the lines in its place [m]."""
LONGEST_LINE_M: Final = 10.0
"""Of these lines, so that few of them are left out where a robot begins or ends [m]."""


def led_apart(ways: FleetWays, robot: int, other: int, separation: float) -> FleetWays | None:
    """The ways of a fleet with one robot led round the path of another one, or of what moves.

    Args:
        ways: As they are.
        robot: Who is led.
        other: Round whose path, or the whole way of what moves.
        separation: Free space between any two bodies [m].

    Returns:
        None where no path was found.
    """
    plan = ways.plans[robot]
    assert isinstance(plan, SpatialPlan)
    obstacles = (
        _way_of(ways, other, plan)
        if other >= len(ways.members)
        else _path_of(ways, other, plan, separation)
    )
    if not obstacles:
        return None
    try:
        led = laid_round(plan, obstacles)
        plans = dict(zip(ways.courses.names, ways.plans, strict=True))
        return ways.along({**plans, ways.courses.names[robot]: led}, separation)
    except PlanningError:
        return None


def _way_of(ways: FleetWays, other: int, plan: SpatialPlan) -> list[Obstacle]:
    """All that something that moves passes, as obstacles to a robot."""
    assert isinstance(ways, WaysPastMoving), "only there is what moves"
    name = ways.name_of(other)
    return [part for one in ways.moving if one.name == name for part in swept(one, plan)]


def _path_of(ways: FleetWays, other: int, plan: SpatialPlan, separation: float) -> list[Obstacle]:
    """The path of a robot as obstacles to another one, but for where that one has to pass."""
    there = ways.plans[other]
    assert isinstance(there, SpatialPlan)
    body, its = (FlyingBody.of(one.mission.robot) for one in (plan, there))
    pair = BodyPair(
        body.radius + its.radius, body.half_height + its.half_height, body.margin + its.margin
    )
    lines = _lines(there)
    points = np.array([via.at for via in plan.path.vias if via.kind == "user"], np.float64)
    far = pair.outermost + separation + KEPT_MORE_M + OFF_M
    free = [line for line in lines if _distance(points, *line).min() > far]
    own = plan.mission.robot
    core = np.hypot(body.radius, body.half_height)
    radius = far - float(core) - body.margin - own.clearance_m
    return [
        Obstacle(
            name=f"the path of {ways.members[other].name}, {k + 1}",
            capsule=Capsule.model_validate(
                {"from": first.tolist(), "to": last.tolist(), "radius": max(radius, OFF_M)}
            ),
        )
        for k, (first, last) in enumerate(free)
    ]


def _lines(plan: SpatialPlan) -> list[tuple[Floats, Floats]]:
    """Straight lines in place of a path, none farther from it than ``OFF_M``."""
    count = max(int(np.ceil(plan.path.length / OFF_M)), 1)
    along = np.linspace(0.0, plan.path.length, count + 1)
    places = np.asarray(plan.path.at_distance(along))
    kept, parts = {0, count}, [(0, count)]
    while parts:
        first, last = parts.pop()
        apart = _distance(places[first : last + 1], places[first], places[last])
        worst = first + int(apart.argmax())
        if apart.max() > 0.5 * OFF_M:
            middle = worst
        elif along[last] - along[first] > LONGEST_LINE_M:
            middle = (first + last) // 2
        else:
            continue
        if first < middle < last:
            kept.add(middle)
            parts += [(first, middle), (middle, last)]
    ends = sorted(kept)
    return [(places[a], places[b]) for a, b in pairwise(ends)]


def _distance(places: Floats, first: Floats, last: Floats) -> Floats:
    """Distances of places from a line [m], (n,)."""
    way = last - first
    size = float(way @ way)
    share = (
        np.clip((places - first) @ way / size, 0.0, 1.0) if size > 0.0 else np.zeros(len(places))
    )
    return np.asarray(np.linalg.norm(places - first - share[:, None] * way, axis=1))
