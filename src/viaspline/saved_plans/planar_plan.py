"""A saved plan in the plane, proven and timed again.

Tested through ``saved_plans/test_load_plan``.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.curve.bending import curvature_bound
from viaspline.curve.path import Path
from viaspline.machine.machine_limits import limits_of
from viaspline.mission.model import Mission
from viaspline.planner import Plan
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Requirements
from viaspline.saved_plans.plan_file import PlanFile
from viaspline.saved_plans.saved_law import saved_law
from viaspline.saved_plans.served_points import AskedPoint, check_served
from viaspline.spacetime.plan_among import moving_proof
from viaspline.spacetime.timed_drive import TimedDrive
from viaspline.spacetime.timed_problem import TimedProblem
from viaspline.trajectory.trajectory import Trajectory
from viaspline.whole_plan import stations
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

PROVEN_OFF_M: Final = 1e-3
"""Two proofs of one clearance differ by no more."""
TIMED_OFF: Final = 1e-6
"""Part of a time or a speed by which another machine may round it."""


def planar_plan(plan: PlanFile, mission: Mission) -> Plan:
    """The plan of a file, of which nothing is believed that can be proven.

    Args:
        plan: The file.
        mission: As it was planned.

    Raises:
        SavedPlanError: It isn't a plan of the mission, its path isn't clear, or its proof or its
            time law isn't what the file says.
    """
    path = plan.path()
    if path.dimension not in (2, 3):
        raise plan.wrong("the path isn't one of the mission")
    points = enumerate(point for _, point in mission.route.points())
    check_served(plan, path, (AskedPoint(i, point.at, point.dwell_s) for i, point in points))
    error = plan.number("tracking_error_m") if "tracking_error_m" in plan.data else 0.0
    requirements = Requirements.of(mission, error)
    world = World.known(mission)
    certificate = proven(path, world, requirements)
    plan.check(
        "clearance [m]", plan.number("certificate", "clearance_m"), certificate.clearance,
        PROVEN_OFF_M,
    )  # fmt: skip
    certificate = plan.named(certificate)
    if not certificate.holds:
        raise plan.wrong("the path doesn't keep the clearance that its mission asks for")
    _check_curvature(plan, path, mission)
    problem = TimedProblem(
        mission, world, MovingObstacles.known(mission), requirements, limits_of(mission.robot),
        lambda laid: stations(laid, mission.robot),
    )  # fmt: skip
    law = problem.free_law(path)
    timed = None
    if mission.world.moving:
        timed = _timed(plan, problem, Solution(path, certificate, None), law)
        law = timed.trajectory
    said = plan.number("trajectory", "duration_s")
    plan.check("duration [s]", said, law.duration, TIMED_OFF * (1.0 + law.duration))
    return Plan(mission, world, path, certificate, None, law, error, timed)


def _check_curvature(plan: PlanFile, path: Path, mission: Mission) -> None:
    """See that the robot can turn as tightly as its path does."""
    radius = mission.robot.turn_radius
    if radius is None:
        return
    said = plan.number("path", "curvature_bound_1pm")
    plan.check("curvature [1/m]", said, curvature_bound(path)[0], TIMED_OFF * (1.0 + said))


def _timed(
    plan: PlanFile, problem: TimedProblem, solution: Solution, free: Trajectory
) -> TimedDrive:
    """The law of the file among what moves, proven again, and within the robot's limits."""
    path = solution.path
    law = saved_law(plan)
    if not math.isclose(law.distances[-1], path.length, rel_tol=1e-9, abs_tol=1e-9):
        raise plan.wrong("trajectory.law doesn't end where the path does")
    if law.start_time != problem.mission.route.depart_s or law.distances[0] != 0.0:
        raise plan.wrong("trajectory.law doesn't begin where and when the mission does")
    allowed = np.asarray(free.speed_at(law.distances))
    if (law.speeds > allowed * (1.0 + TIMED_OFF) + TIMED_OFF).any():
        raise plan.wrong("trajectory.law is faster than the robot's limits allow")
    limits = problem.limits
    if ((law.accelerations > limits.max_accel + TIMED_OFF)
            | (law.accelerations < -limits.brake - TIMED_OFF)).any():  # fmt: skip
        raise plan.wrong("trajectory.law speeds up or brakes harder than the robot may")
    for stop in problem.stops(path):
        at = np.abs(law.distances - stop.distance) <= 1e-9 * (1.0 + path.length)
        if not at.any() or np.ptp(law.times[at]) < stop.dwell - TIMED_OFF:
            raise plan.wrong(f"trajectory.law doesn't stay at '{stop.name}' as long as asked")
    certificate = moving_proof(problem, path, law)
    said = plan.number("certificate", "moving", "clearance_m")
    plan.check("clearance to what moves [m]", said, certificate.clearance, PROVEN_OFF_M)
    if not certificate.holds:
        raise plan.wrong("the drive doesn't keep its clearance to what moves")
    return TimedDrive(solution, law, certificate, free)
