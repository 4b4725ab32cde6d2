"""A mission with numbers for its tension as a whole plan: curve, certificate and time law.

Tested through ``test_planner``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from viaspline.curve.certificate import PROOF_SLACK_M, Certificate
from viaspline.curve.path import Path
from viaspline.errors import PlanningError
from viaspline.machine.allowance import TrialDrives
from viaspline.machine.drivability import Drivability
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.measure_drivability import drivability_of
from viaspline.machine.turns_on_spot import with_turns
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.spot_turning import SpotTurning
from viaspline.planning.alternatives.kept_account import KeptAccount
from viaspline.planning.alternatives.record import Account
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.plan_drive import find_drive
from viaspline.planning.problem.ledger import LedgerEntry
from viaspline.planning.problem.preferred_clearance import PreferredClearance
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.routing.visit_order import ordered
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.named_columns import Table
from viaspline.presentable.rounded_number import rounded
from viaspline.presentable.saved_value import SavedValue
from viaspline.presentable.shown_value import ShownValue
from viaspline.spacetime.plan_among import plan_among
from viaspline.spacetime.timed_drive import TimedDrive
from viaspline.spacetime.timed_problem import TimedProblem
from viaspline.trajectory.limits import Station
from viaspline.trajectory.moving_certificate import MovingCertificate
from viaspline.trajectory.path_samples import USUAL_STEP_M, path_samples
from viaspline.trajectory.retime import retime
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World


@dataclass(frozen=True, eq=False)
class Plan(ShownValue, SavedValue, ComparedByValue):
    """A proven path and its time law.

    Two plans are equal if they are of one mission, with one path, one law and the same proofs; what
    the search did to find them doesn't count.

    Attributes:
        mission: What was asked for, its via points in the order in which they are served.
        world: The known world it was planned in.
        path: The exact curve with its via points.
        certificate: The proven clearance of the body against everything known.
        account: What the search did; its ledger is drawn up when it is read.
        trajectory: The time law along the path. Where anything of the mission moves, known or
            unseen, it begins at ``route.depart_s``, else at 0.
        tracking_error: How far beside the path the driven robot may get [m]: the path keeps that
            much more than the clearance that was asked for.
        timed: How path and time law were chosen among what moves, and what is proven of that; None
            where nothing is known to move.
    """

    mission: Mission
    world: World
    path: Path
    certificate: Certificate
    account: Account | KeptAccount | None
    trajectory: Trajectory
    tracking_error: float = 0.0
    timed: TimedDrive | None = None

    def _said(self) -> tuple[object, ...]:
        return (
            self.mission, self.world, self.path, self.certificate, self.trajectory,
            self.tracking_error, self.moving_certificate,
        )  # fmt: skip

    def __repr__(self) -> str:
        clear = self.certificate.clearance + PROOF_SLACK_M  # what just touches isn't -0.00 m off
        return (
            f"<Plan: {rounded(self.path.length, 1)} m in {self.trajectory.duration:.1f} s, "
            f"{rounded(clear, 2)} m clear, {len(self.path.vias)} via points>"
        )

    @property
    def moving_certificate(self) -> MovingCertificate | None:
        """The proven clearance to everything that is known to move; None where nothing is."""
        return None if self.timed is None else self.timed.certificate

    @property
    def ledger(self) -> tuple[LedgerEntry, ...]:
        """Every group met and every side tried."""
        return () if self.account is None else self.account.ledger

    @property
    def preferred_clearance(self) -> PreferredClearance | None:
        """What more clearance than required was weighed; None where none is asked for."""
        return None if self.account is None else self.account.preferred

    def samples(self, step: float = USUAL_STEP_M) -> Table:
        """The path as a table, which pandas and polars take as it is.

        Args:
            step: From point to point along the path, at most [m]; both ends are among them.

        Returns:
            A structured array, (n,), of ``distance_m``, ``x_m``, ``y_m`` (``z_m`` with heights),
            ``heading_rad``, ``curvature_1pm``, ``speed_mps`` and ``time_s``.

        Raises:
            GeometryError: When the step is no number above 0, or the table has too many rows.
        """
        return path_samples(self.path, self.trajectory, step)

    @cached_property
    def drivability(self) -> Drivability:
        """How the path drives: its sharpest place, accelerations across it, turns on the spot."""
        robot, route = self.mission.robot, self.mission.route
        once = route.closed and route.laps == 1  # of more laps the seams lie inside of the path
        return drivability_of(self.path, self.trajectory, robot, self.world, closed=once)

    @cached_property
    def _trials(self) -> TrialDrives:
        """Trial drives of its robot along it, which two questions are asked of."""
        return TrialDrives(self.path, self.trajectory, self.mission.robot)


def in_order(mission: Mission) -> tuple[Mission, World]:
    """The mission with its via points in the order in which they are served, and its known world.

    The world is built once, and again only where it has a corridor that runs along the via points
    in another order now.
    """
    world = World.known(mission)
    served = ordered(mission, world)
    if served is not mission and mission.route.corridor is not None:
        world = World.known(served)
    return served, world


def with_error(
    mission: Mission, world: World, error: float, spending: WorkBudget | None = None
) -> Plan:
    """The plan that keeps ``error`` [m] more than the clearance, however far the robot gets beside.

    Args:
        mission: Its via points in the order in which they are served.
        world: What it has on its map.
        error: What it keeps beyond the clearance [m].
        spending: What all paths past what moves may spend together; None: each as much as usual.

    Raises:
        NoPathError: When there is no path that keeps it, with the least change that would serve.
        GaveUpError: When a budget ran out before that was known, with what was tried.
        GeometryError: When the mission's numbers contradict each other.
    """
    requirements = Requirements.of(mission, error)
    if spending is not None:
        requirements = replace(requirements, shared=spending.shared, poses=spending.poses)
    try:
        found = find_drive(mission, world, requirements)
    except PlanningError as problem:
        if error > 0.0:
            problem.reason += f" ({error:.2f} m of it for how far the robot gets beside its path)"
            problem.args = (f"{problem.reason}: {problem.remedy}",)
        raise
    if mission.world.moving:
        return _among_what_moves(mission, world, requirements, found, spending)
    trajectory = fastest_law(found.path, mission, stations(found.path, mission.robot))
    if mission.world.unseen_moving:
        trajectory = trajectory.delayed(mission.route.depart_s)
    return Plan(mission, world, found.path, found.certificate, found.account, trajectory, error)


def _among_what_moves(
    mission: Mission, world: World, requirements: Requirements, found: Solution,
    spending: WorkBudget | None,
) -> Plan:  # fmt: skip
    """The plan that arrives first past what moves."""
    robot = mission.robot
    problem = TimedProblem(
        mission, world, MovingObstacles.known(mission), requirements, limits_of(robot),
        lambda path: stations(path, robot),
    )  # fmt: skip
    if spending is None:
        timed = plan_among(problem, found)
    else:
        with problem.within(spending) as one:
            timed = plan_among(one, found)
    path, certificate, account = (
        timed.solution.path, timed.solution.certificate, timed.solution.account,
    )  # fmt: skip
    return Plan(
        mission, world, path, certificate, account, timed.trajectory,
        requirements.tracking_error, timed,
    )  # fmt: skip


def fastest_law(path: Path, mission: Mission, stops: Sequence[Station]) -> Trajectory:
    """The fastest law along a path of a mission, with its stops, where nothing moves.

    Args:
        path: In the plane.
        mission: Its robot's limits and its speed zones are kept.
        stops: Where the robot has to stop: see ``stations``.
    """
    return retime(path, limits_of(mission.robot), stops, zones=mission.world.speed_zones)


def stations(path: Path, robot: RobotSpec) -> tuple[Station, ...]:
    """The stops of a path: its via points that have a dwell, and turns on the spot."""
    stops = [
        Station(float(distance), via.dwell, via.name)
        for via, distance in zip(path.vias, path.via_distances, strict=True)
        if via.dwell > 0
    ]
    return tuple(with_turns(path, SpotTurning.of(robot), stops))
