"""A saved plan in the plane, proven and timed again.

Tested through ``saved_plans/test_load_plan``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from viaspline.curve.bending import curvature_bound
from viaspline.curve.path import Path
from viaspline.machine.machine_limits import limits_of
from viaspline.mission.model import Mission
from viaspline.planner import Plan
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Requirements
from viaspline.saved_plans.law_within_limits import (
    PROVEN_OFF_M,
    TIMED_OFF,
    check_moving_proof,
    law_of_file,
    law_within_limits,
)
from viaspline.saved_plans.plan_file import PlanFile
from viaspline.saved_plans.saved_search import saved_account, saved_candidates, saved_waits
from viaspline.saved_plans.served_points import AskedPoint, check_served
from viaspline.spacetime.law_on_path import moving_proof
from viaspline.spacetime.timed_drive import TimedDrive
from viaspline.spacetime.timed_problem import TimedProblem
from viaspline.trajectory.limits import Station
from viaspline.trajectory.trajectory import Trajectory
from viaspline.whole_plan import fastest_law, stations
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

StopsOn = Callable[[Path, Mission], Sequence[Station]]
"""Where a robot has to stop on the path of a mission."""


def _stations(path: Path, mission: Mission) -> Sequence[Station]:
    return stations(path, mission.robot)


FastestLaw = Callable[[Path, Mission, Sequence[Station]], Trajectory]
"""The fastest law on the path of a mission, with its stops, where nothing moves."""


def planar_plan(
    plan: PlanFile, mission: Mission, world: World | None = None, stops_on: StopsOn = _stations,
    fastest: FastestLaw = fastest_law,
) -> Plan:  # fmt: skip
    """The plan of a file, of which nothing is believed that can be proven.

    Args:
        plan: The file.
        mission: As it was planned.
        world: What it has on its map, if that is packed already.
        stops_on: Where its robot has to stop on a path.
        fastest: See ``FastestLaw``.

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
    world = World.known(mission) if world is None else world
    said = plan.number("certificate", "clearance_m")
    proofs = [proven(one, world, requirements) for one in _provable(path, mission.route.laps)]
    certificate = min(proofs, key=lambda proof: abs(proof.clearance - said))
    plan.check("clearance [m]", said, certificate.clearance, PROVEN_OFF_M)
    certificate = plan.named(certificate)
    if not certificate.holds:
        raise plan.wrong("the path doesn't keep the clearance that its mission asks for")
    _check_curvature(plan, path, mission)
    problem = TimedProblem(
        mission, world, MovingObstacles.known(mission), requirements, limits_of(mission.robot),
        lambda laid: stops_on(laid, mission),
    )  # fmt: skip
    account = saved_account(plan, path.dimension)
    timed = None
    if mission.world.moving:
        timed = _timed(plan, problem, Solution(path, certificate, account))
        law = timed.trajectory
    else:
        stops = stops_on(path, mission)
        law = fastest(path, mission, stops)
        law = law_of_file(plan, path, law, problem.limits, stops)
    return Plan(mission, world, path, certificate, account, law, error, timed)


def _provable(path: Path, laps: int) -> tuple[Path, ...]:
    """What a proof of a path is one of: the path, or one of its laps, which are all the same."""
    spans, a_lap = path.spans, len(path.spans) // laps
    if laps == 1 or not np.array_equal(np.concatenate([spans[:a_lap]] * laps), spans):
        return (path,)
    return (Path(spans[:a_lap], vias=[]), path)


def _check_curvature(plan: PlanFile, path: Path, mission: Mission) -> None:
    """See that the robot can turn as tightly as its path does."""
    radius = mission.robot.turn_radius
    if radius is None:
        return
    said = plan.number("path", "curvature_bound_1pm")
    plan.check("curvature [1/m]", said, curvature_bound(path)[0], TIMED_OFF * (1.0 + said))


def _timed(plan: PlanFile, problem: TimedProblem, solution: Solution) -> TimedDrive:
    """The law of the file among what moves, proven again, and within the robot's limits."""
    path = solution.path
    free = problem.free_law(path)
    law = law_within_limits(plan, path, free, problem.limits, problem.stops(path))
    certificate = moving_proof(problem, path, law)
    check_moving_proof(plan, certificate)
    return TimedDrive(solution, law, certificate, free, saved_candidates(plan), saved_waits(plan))
