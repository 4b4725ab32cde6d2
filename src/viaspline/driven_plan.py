"""A mission with numbers for its tension as a whole plan that keeps what its robot gets beside it.

Tested through ``test_planner``.
"""

from __future__ import annotations

from contextlib import suppress
from functools import partial

from viaspline.errors import GeometryError, NoPathError, PlanningError
from viaspline.machine.allowance import allowance_on_bends, tracking_remedy
from viaspline.machine.eased_turns import eased_turns
from viaspline.machine.error_between import planned_between
from viaspline.machine.refused_allowance import unproven
from viaspline.mission.model import Mission
from viaspline.mission.spot_turning import is_driven
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.whole_plan import Plan, with_error
from viaspline.world.world import World

MAX_TRIAL_ROUNDS = 6
"""Rounds of planning and trial drives."""

ALLOWANCE_GROWTH = 1.1
"""By which an allowance grows that was measured once already."""

HARDLY_LONGER, MAX_LONGER = 1.05, 1.25
"""A drive that leaves so much is taken at once where it takes no more than so many times as long as
one that keeps nothing for its tracking error; or than one that keeps what it asks for."""


def driven_plan(mission: Mission, world: World, spending: WorkBudget | None = None) -> Plan:
    """Plan a mission that says how taut its spline is, or doesn't; ``auto`` is not among that.

    Args:
        mission: Its via points in the order in which they are served.
        world: What it has on its map.
        spending: What all paths past what moves may spend together; None: each as much as usual.

    Raises:
        NoPathError: When there is no path, with the reason and the least change that would serve.
        GaveUpError: When a budget ran out before that was known, with what was tried.
        GeometryError: When the mission's numbers contradict each other, or the robot can't follow.
    """
    robot = mission.robot
    if robot.tracking_error_m is not None or not is_driven(robot):
        return with_error(mission, world, robot.tracking_error_m or 0.0, spending)
    error = 0.0
    if robot.sensor is not None:
        error = allowance_on_bends(robot, Requirements.of(mission).required)
    first = _first_plan(mission, world, error, spending)
    return _with_steering_left(first, error, spending)


def _first_plan(
    mission: Mission, world: World, error: float, spending: WorkBudget | None
) -> Plan:  # fmt: skip
    """The plan that keeps an error [m], which its robot gets beside paths as they come.

    Raises:
        NoPathError: When there is none that keeps nothing for it either.
        GaveUpError, GeometryError: As for ``driven_plan``.
    """
    try:
        return with_error(mission, world, error, spending)
    except NoPathError as refused:
        if error <= 0.0 or _is_refused(mission, world, spending):
            raise
        raise unproven(refused, error, mission.robot) from None


def _is_refused(mission: Mission, world: World, spending: WorkBudget | None) -> bool:
    """Whether there is no path that keeps nothing for what the robot gets beside it.

    Raises:
        GaveUpError, GeometryError: As for ``with_error``.
    """
    try:
        with_error(mission, world, 0.0, spending)
    except NoPathError:
        return True
    return False


def _with_steering_left(first: Plan, error: float, spending: WorkBudget | None) -> Plan:
    """The plan as driven whose path leaves steering to correct with, where that doesn't cost much.

    Args:
        first: A plan as the robot could drive it, that keeps ``error`` [m].
        error: With which others begin.
        spending: As for ``driven_plan``.

    Raises:
        PlanningError, GeometryError: What the first ends in, where no other plan is found.
    """
    roomy = []
    mission, robot = first.mission, first.mission.robot
    for radius, kept in eased_turns(first._trials):
        eased = robot.model_copy(update={"min_turn_radius_m": radius})
        wider = mission.model_copy(update={"robot": eased})
        with suppress(PlanningError, GeometryError):
            eased_first = with_error(wider, first.world, max(kept, error), spending)
            roomy.append(as_driven(eased_first, spending))
            if _is_as_soon(roomy[-1], first, HARDLY_LONGER):
                return roomy[-1]
    try:
        tight = as_driven(first, spending)
    except (PlanningError, GeometryError):
        if not roomy:
            raise
        return min(roomy, key=lambda plan: plan.trajectory.duration)
    return next((plan for plan in roomy if _is_as_soon(plan, tight, MAX_LONGER)), tight)


def as_driven(first: Plan, spending: WorkBudget | None = None) -> Plan:
    """The plan that keeps as much beyond the clearance as the robot gets beside it.

    Args:
        first: A plan, whatever it keeps.
        spending: As for ``driven_plan``.
    """
    result = first
    for _ in range(MAX_TRIAL_ROUNDS):
        needed = result._trials.allowance
        if needed <= result.tracking_error:
            return result
        error = ALLOWANCE_GROWTH * max(needed, result.tracking_error)
        plan_with = partial(with_error, first.mission, first.world, spending=spending)
        try:
            result = plan_with(error)
        except PlanningError as refused:
            less = planned_between(
                result.tracking_error, error, plan_with, lambda plan: plan._trials.allowance
            )
            if less is None:
                raise unproven(refused, error, first.mission.robot) from None
            return less
    raise GeometryError(
        f"the robot gets ever farther beside its path, {result.tracking_error:.2f} m in the last "
        f"trial drive; give it {tracking_remedy(result.mission.robot)}"
    )


def _is_as_soon(plan: Plan, other: Plan, longer: float) -> bool:
    """Whether a plan takes at most so many times as long as another."""
    return plan.trajectory.duration <= longer * other.trajectory.duration
