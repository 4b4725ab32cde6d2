"""From a mission in space to a plan as if nothing moved: curve, proofs, headings and time law.

Tested through ``space/test_plan_spatial``.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.curve.height_certificate import certify_heights
from viaspline.curve.path import Path
from viaspline.mission.model import Mission
from viaspline.space.leg_router import LegRouter
from viaspline.space.part_of_path import part_of_path
from viaspline.space.route_law import headings_of, stops_of
from viaspline.space.solve_route import solve_route
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.spatial_request import spatial_problem_of
from viaspline.space.timing.retime_in_space import retime_in_space
from viaspline.space.timing.yaw_profile import YawProfile
from viaspline.space.weighed_ways import WaysPast
from viaspline.trajectory.trajectory import Trajectory


def static_plan(mission: Mission) -> SpatialPlan:
    """Plan a mission in space as if nothing in its world moved.

    Args:
        mission: With its via points in the order in which they are served.

    Raises:
        NoPathError: When there is no path, with the reason.
        GaveUpError: When none was found.
        GeometryError: When it asks for something that isn't planned in space.
    """
    problem = spatial_problem_of(mission)
    return static_plan_by(mission, problem, LegRouter(problem, mission))


def static_plan_by(mission: Mission, problem: SpatialProblem, ways: WaysPast) -> SpatialPlan:
    """Plan a mission in space as if nothing moved, by ways that somebody else finds.

    Args:
        mission: With its via points in the order in which they are served.
        problem: What it asks for.
        ways: Finds the ways past what stands on its legs.

    Raises:
        NoPathError: When there is no path, with the reason.
        GaveUpError: When none was found.
    """
    found = solve_route(problem, ways)
    path = found.path
    yaw = headings_of(problem, path)
    law = fastest_law(problem, path, yaw, mission.route.depart_s)
    u = np.asarray(path.parameter(found.airborne)).tolist()
    heights = certify_heights(part_of_path(path, *u), problem.world)
    return SpatialPlan(
        mission, problem.world, path, found.certificate, heights, found.account, found.airborne,
        problem.limits, yaw, law,
    )  # fmt: skip


def fastest_law(problem: SpatialProblem, path: Path, yaw: YawProfile, depart: float) -> Trajectory:
    """The fastest law along a path if nothing moves.

    Args:
        problem: Whose path it is.
        path: It.
        yaw: Where the body looks along it.
        depart: When it sets out [s].
    """
    stops = tuple(stops_of(problem, path))
    return retime_in_space(path, problem.limits, stops, yaw, zones=problem.zones, start_time=depart)


def as_if_still(plan: SpatialPlan) -> SpatialPlan:
    """A plan with the fastest law along its path, as if nothing in its world moved."""
    problem = spatial_problem_of(plan.mission)
    law = fastest_law(problem, plan.path, plan.yaw, plan.mission.route.depart_s)
    return replace(plan, trajectory=law, moving=None, waits=())
