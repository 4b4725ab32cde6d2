"""A saved plan in space, proven and timed again.

Tested through ``saved_plans/test_load_plan``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from viaspline.curve.height_certificate import certify_heights
from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.mission.model import Mission
from viaspline.saved_plans.law_within_limits import (
    PROVEN_OFF_M,
    TIMED_OFF,
    check_moving_proof,
    law_of_file,
    law_within_limits,
)
from viaspline.saved_plans.plan_file import PlanFile
from viaspline.saved_plans.saved_search import saved_ledger, saved_waits
from viaspline.saved_plans.served_points import AskedPoint, check_served
from viaspline.space.among.plan_past_moving import proof_past_moving
from viaspline.space.part_of_path import part_of_path
from viaspline.space.route_law import headings_of, stops_of
from viaspline.space.solve_route import whole_proof
from viaspline.space.spatial_account import SpatialAccount
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.spatial_request import spatial_problem_of
from viaspline.space.timing.retime_in_space import along_limits, retime_in_space
from viaspline.space.timing.yaw_profile import YawProfile
from viaspline.trajectory.limits import Station
from viaspline.trajectory.trajectory import Trajectory

StopsOn = Callable[[SpatialProblem, Path], Iterable[Station]]
"""Where the robot of a problem has to stop on a path."""
LawAlone = Callable[[SpatialPlan], Trajectory]
"""The fastest law along the path of a plan, whose law is that of all of it at once."""
HeadingsOn = Callable[[SpatialProblem, Path], YawProfile]
"""Where the robot of a problem looks along a path."""


def plan_in_space(plan: PlanFile, mission: Mission) -> SpatialPlan:
    """The plan of a file, of which nothing is believed that can be proven.

    Args:
        plan: The file.
        mission: As it was planned.

    Raises:
        SavedPlanError: It isn't a plan of the mission, its path isn't clear or too high or low, or
            its proof or its time law isn't what the file says.
    """
    if not mission.world.moving:
        return flight_as_if_still(plan, mission)
    alone = _alone(plan, mission, stops_of, headings_of, comes_again=False)
    free = alone.trajectory
    law = law_within_limits(plan, alone.path, free, along_limits(alone.limits), free.stations)
    proof = proof_past_moving(alone, law)
    check_moving_proof(plan, proof)
    return replace(alone, trajectory=law, moving=proof, waits=saved_waits(plan))


def flight_as_if_still(
    plan: PlanFile, mission: Mission, stops_on: StopsOn = stops_of,
    headings_on: HeadingsOn = headings_of, law_alone: LawAlone = lambda plan: plan.trajectory, *,
    comes_again: bool = False,
) -> SpatialPlan:  # fmt: skip
    """The plan of a file, of which all is proven but how far it is from what moves.

    Args:
        plan: The file.
        mission: As it was planned.
        stops_on: Where its robot has to stop on a path.
        headings_on: Where it looks along a path.
        law_alone: How it flies if it is alone.
        comes_again: Whether all of its laps are the first one again, which alone is proven.

    Raises:
        SavedPlanError: As ``plan_in_space``.
    """
    alone = _alone(plan, mission, stops_on, headings_on, comes_again=comes_again)
    free = law_alone(alone)
    law = law_of_file(plan, alone.path, free, along_limits(alone.limits), free.stations)
    return replace(alone, trajectory=law)


def _alone(
    plan: PlanFile, mission: Mission, stops_on: StopsOn, headings_on: HeadingsOn, *,
    comes_again: bool,
) -> SpatialPlan:  # fmt: skip
    """The path of a file, proven, with the fastest law along it."""
    problem = spatial_problem_of(mission)
    path = plan.path()
    if path.dimension != 3:
        raise plan.wrong("the path isn't in space, and the mission is")
    check_served(plan, path, _points(problem))
    ends = plan.numbers("airborne_m")
    if ends.shape != (2,) or not 0.0 <= ends[0] <= ends[1] <= path.length * (1.0 + TIMED_OFF):
        raise plan.wrong("airborne_m isn't a part of the path")
    airborne = (float(ends[0]), float(ends[1]))
    _check_upright(plan, problem, airborne, path.length)
    shown, flown = path, airborne
    if comes_again:
        shown = _first_lap(plan, path, problem.laps, int(problem.takeoff is not None))
        flown = (airborne[0], shown.length)
    try:
        certificate = whole_proof(problem, shown, flown)
        u = np.asarray(shown.parameter(flown)).tolist()
        heights = certify_heights(part_of_path(shown, *u), problem.world)
    except GeometryError as error:
        raise plan.wrong(f"the path can't be proven: {error}") from None
    said = plan.number("certificate", "clearance_m")
    plan.check("clearance [m]", said, certificate.clearance, PROVEN_OFF_M)
    certificate = plan.named(certificate)
    if not (certificate.holds and heights.holds):
        raise plan.wrong("the path doesn't keep the clearance or the heights of its mission")
    yaw = headings_on(problem, path)
    law = retime_in_space(
        path, problem.limits, tuple(stops_on(problem, path)), yaw, zones=problem.zones,
        start_time=mission.route.depart_s,
    )  # fmt: skip
    return SpatialPlan(
        mission, problem.world, path, certificate, heights, SpatialAccount(saved_ledger(plan, 3)),
        airborne, problem.limits, yaw, law,
    )  # fmt: skip


def _first_lap(plan: PlanFile, path: Path, laps: int, before: int) -> Path:
    """The first lap of a path, of which all others are the same, and so many spans before it.

    Raises:
        SavedPlanError: They aren't.
    """
    spans = path.spans[before:]
    a_lap = len(spans) // laps
    if not np.array_equal(np.concatenate([spans[:a_lap]] * laps), spans):
        raise plan.wrong("the laps of the path aren't the first one again")
    return Path(path.spans[: before + a_lap], vias=[])


def _points(problem: SpatialProblem) -> list[AskedPoint]:
    """The points of a route that have to be served; take-off and landing are on the ground."""
    points = [
        AskedPoint(via.index, tuple(via.at.tolist()), via.dwell or 0.0)
        for via in problem.vias
        if via.index is not None
    ]
    if problem.takeoff is not None:
        points[0] = points[0]._replace(at=tuple(problem.takeoff.tolist()), dwell=0.0)
    if problem.landing is not None:
        points[-1] = points[-1]._replace(at=tuple(problem.landing.tolist()), dwell=0.0)
    return points


def _check_upright(
    plan: PlanFile, problem: SpatialProblem, airborne: tuple[float, float], length: float
) -> None:
    """See that only what takes off or lands is proven without the ground."""
    grounded = (problem.takeoff is not None, problem.landing is not None)
    if airborne[0] > 0.0 and not grounded[0]:
        raise plan.wrong("airborne_m begins under way, and the mission has no take-off")
    if airborne[1] < length * (1.0 - TIMED_OFF) and not grounded[1]:
        raise plan.wrong("airborne_m ends under way, and the mission has no landing")
    if problem.takeoff is not None:
        up = float(np.linalg.norm(problem.vias[0].at - problem.takeoff))
        plan.check("take-off [m]", airborne[0], up, TIMED_OFF * (1.0 + length))
    if problem.landing is not None:
        down = float(np.linalg.norm(problem.vias[-1].at - problem.landing))
        plan.check("landing [m]", length - airborne[1], down, TIMED_OFF * (1.0 + length))
