"""From a mission to a plan: curve, detours, certificate and time law, in that order."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

from viaspline.advice import with_advice
from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path
from viaspline.errors import GeometryError, PlanningError
from viaspline.handed_in import check_kind
from viaspline.machine.allowance import TRACKING_REMEDY, allowance, allowance_on_bends
from viaspline.machine.drivability import Drivability
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.measure_drivability import drivability_of
from viaspline.machine.robot_model import is_driven
from viaspline.machine.turns_on_spot import SpotTurning, with_turns
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.planning.alternatives.record import Account
from viaspline.planning.plan_drive import find_drive
from viaspline.planning.problem.ledger import LedgerEntry
from viaspline.planning.problem.preferred_clearance import PreferredClearance
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.routing.visit_order import ordered
from viaspline.trajectory.limits import Station
from viaspline.trajectory.retime import retime
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World

MAX_TRIAL_ROUNDS = 6
"""Rounds of planning and trial drives."""

ALLOWANCE_GROWTH = 1.1
"""By which an allowance grows that was measured once already."""

TURN_RESERVE = 1.2
"""Of a turning circle, where steering at its stop leaves too little to correct with."""


@dataclass(frozen=True)
class Plan:
    """A proven path and its time law.

    Attributes:
        mission: What was asked for, its via points in the order in which they are served.
        world: The known world it was planned in.
        path: The exact curve with its via points.
        certificate: The proven clearance of the body against everything known.
        account: What the search did; its ledger is drawn up when it is read.
        trajectory: The time law along the path.
        tracking_error: How far beside the path the driven robot may get [m]: the path keeps that
            much more than the clearance that was asked for.
    """

    mission: Mission
    world: World
    path: Path
    certificate: Certificate
    account: Account | None
    trajectory: Trajectory
    tracking_error: float = 0.0

    @property
    def ledger(self) -> tuple[LedgerEntry, ...]:
        """Every group met and every side tried."""
        return () if self.account is None else self.account.ledger

    @property
    def preferred_clearance(self) -> PreferredClearance | None:
        """What more clearance than required was weighed; None where none is asked for."""
        return None if self.account is None else self.account.preferred

    @cached_property
    def drivability(self) -> Drivability:
        """How the path drives: its sharpest place, accelerations across it, turns on the spot."""
        return drivability_of(self.path, self.trajectory, self.mission.robot, self.world)


def plan(mission: Mission) -> Plan:
    """Plan a mission: the spline through its via points, round what stands in the way, timed.

    A robot with a drive or a localisation that is not exact is made to follow the plan in trial
    drives. What it gets beside the path, with a margin, is kept in addition, and the mission
    planned again, until that covers what is measured. One with a sensor drives a slalom as well,
    for the bends of paths that it will lay under way. ``robot.tracking_error_m`` says it instead.
    Where steering at its stop leaves nothing to correct with, so that the robot gets too far beside
    a path as tight as that, the turning circle is widened by a fifth: ``Plan.mission`` has it.

    Raises:
        NoPathError: When there is no path, with the reason and the least change that would serve.
        GaveUpError: When a budget ran out before that was known, with what was tried.
        GeometryError: When the mission's numbers contradict each other, or the robot can't follow.

    Example:
        >>> mission = Mission.model_validate({
        ...     "world": {"known": [{"circle": {"center": [25, 0.5], "radius": 4}}]},
        ...     "route": {"start": [0, 0], "goal": [50, 0]},
        ... })
        >>> result = plan(mission)
        >>> result.certificate.holds, round(result.path.length, 1), result.ledger[0].chosen.side
        (True, 50.8, 'right')
    """
    check_kind("mission", mission, Mission, "give Mission.model_validate({...}) or load(file)")
    mission, world = in_order(mission)
    mission = with_advice(mission, world)
    robot = mission.robot
    error = robot.tracking_error_m or 0.0
    if robot.tracking_error_m is None and robot.sensor is not None and is_driven(robot):
        error = allowance_on_bends(robot, Requirements.of(mission).required)
    first = _with_error(mission, world, error)
    if robot.tracking_error_m is not None or not is_driven(robot):
        return first
    try:
        return _as_driven(first)
    except (PlanningError, GeometryError):
        if robot.drive is not None and robot.drive.kind.turn_radius is not None:
            with suppress(PlanningError, GeometryError):
                return _as_driven(_with_error(_with_reserve(mission), world, error))
        raise


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


def _as_driven(first: Plan) -> Plan:
    """The plan that keeps as much beyond the clearance as the robot gets beside it.

    Args:
        first: A plan, whatever it keeps.
    """
    result = first
    for _ in range(MAX_TRIAL_ROUNDS):
        needed = allowance(result.path, result.trajectory, result.mission.robot)
        if needed <= result.tracking_error:
            return result
        error = ALLOWANCE_GROWTH * max(needed, result.tracking_error)
        result = _with_error(first.mission, first.world, error)
    raise GeometryError(
        f"the robot gets ever farther beside its path, {result.tracking_error:.2f} m in the last "
        f"trial drive; give it {TRACKING_REMEDY}, or say what to keep by tracking_error_m"
    )


def _with_reserve(mission: Mission) -> Mission:
    """The mission with a wider turning circle, so that there is steering left to correct with."""
    radius = mission.robot.turn_radius
    assert radius is not None  # steered robots have one
    eased = mission.robot.model_copy(update={"min_turn_radius_m": TURN_RESERVE * radius})
    return mission.model_copy(update={"robot": eased})


def _with_error(mission: Mission, world: World, error: float) -> Plan:
    """The plan that keeps ``error`` [m] more than the clearance."""
    requirements = Requirements.of(mission, error)
    try:
        found = find_drive(mission, world, requirements)
    except PlanningError as problem:
        if error > 0.0:
            problem.reason += f" ({error:.2f} m of it for how far the robot gets beside its path)"
            problem.args = (f"{problem.reason}: {problem.remedy}",)
        raise
    stops = stations(found.path, mission.robot)
    zones = mission.world.speed_zones
    trajectory = retime(found.path, limits_of(mission.robot), stops, zones=zones)
    return Plan(mission, world, found.path, found.certificate, found.account, trajectory, error)


def stations(path: Path, robot: RobotSpec) -> tuple[Station, ...]:
    """The stops of a path: its via points that have a dwell, and turns on the spot."""
    stops = [
        Station(float(distance), via.dwell, via.name)
        for via, distance in zip(path.vias, path.via_distances, strict=True)
        if via.dwell > 0
    ]
    return tuple(with_turns(path, SpotTurning.of(robot), stops))
