"""The path of a robot that keeps off a stretch of another one's path.

Where two robots meet head-on one of them has to wait until the other one has passed all of that
stretch. Another path may be longer, and sooner at its end.

Tested through ``fleet/test_rerouted_fleet``.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viaspline.errors import GeometryError, PlanningError
from viaspline.fleet.laying.kept_paths import PathAlone
from viaspline.fleet.laying.lay_among_rests import KEPT_MORE_M, lay_among_rests
from viaspline.fleet.laying.resting_places import RestingPlace, RestingPlaces
from viaspline.fleet.laying.rests_as_obstacles import world_with_rests
from viaspline.fleet.laying.soon_laid import check_soon_laid
from viaspline.kernels.arrays import Floats
from viaspline.planner import Plan, plan_in
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget

APART_SHARE = 0.7
"""Places along a stretch are so far apart, as a share of what two robots keep."""
MOST_PLACES = 200
"""Places of a stretch."""
GRID_CELL_S = 2.5e-6
"""What a cell of a map costs when a path is laid [s of the reference machine],"""
PATH_S = 0.03
"""and what a path costs anyway."""


def laying_cost(plan: Plan) -> float:
    """About what it costs to lay the path of a robot once more [s of the reference machine]."""
    grids = [one.grid for one in plan.world.obstacles if one.grid is not None]
    return PATH_S + GRID_CELL_S * sum(grid.blocked.size for grid in grids)


def lay_round_stretch(
    alone: PathAlone, name: str, reach: float, rests: RestingPlaces, other: Plan,
    other_reach: float, stretch: tuple[float, float], work: WorkBudget,
) -> Plan | None:  # fmt: skip
    """Lay the path of a robot round resting places, and off a stretch of another one's path.

    Args:
        alone: What the robot does if it is alone.
        name: The robot.
        reach: How far it keeps others away on its part [m].
        rests: Of all robots.
        other: The plan of the other one.
        other_reach: How far that one keeps others away on its part [m].
        stretch: From where to where along its path [m].
        work: What may be spent where a body isn't led round in no time.

    Returns:
        A plan, proven in the world as it is; None where there is none, or none that is found with
        that, or where the robot itself has to get to that stretch.
    """
    places = _places(other, reach + other_reach, stretch)
    points = np.array([via.at[:2] for _, via in alone.mission.route.points()])
    apart = np.hypot(*(points[:, None] - places[None]).transpose(2, 0, 1)).min(axis=0)
    free = places[apart > reach + other_reach + KEPT_MORE_M]
    if not len(free):
        return None
    discs = RestingPlaces(
        tuple(RestingPlace(f"{k}", "goal", (x, y), other_reach) for k, (x, y) in enumerate(free))
    )
    indices = range(len(free))
    world = world_with_rests(alone.plan, alone.mission, reach, discs, indices, KEPT_MORE_M)
    try:
        took = check_soon_laid(alone.mission, world, alone.plan.tracking_error, work)
        off = plan_in(alone.mission, world, WorkBudget(math.inf, poses=WorkBudget(took)))
        found = lay_among_rests(off, alone.mission, name, reach, rests, work).plan
    except (PlanningError, GeometryError):
        return None
    as_it_is = alone.plan.world
    requirements = Requirements.of(found.mission, found.tracking_error)
    return replace(found, world=as_it_is, certificate=proven(found.path, as_it_is, requirements))


def _places(other: Plan, needed: float, stretch: tuple[float, float]) -> Floats:
    """Places along a stretch of a path [m], (k, 2)."""
    low, high = max(stretch[0], 0.0), min(stretch[1], other.path.length)
    count = min(int(np.ceil((high - low) / (APART_SHARE * needed))) + 1, MOST_PLACES)
    places: Floats = np.asarray(other.path.at_distance(np.linspace(low, high, count)))[:, :2]
    return places
