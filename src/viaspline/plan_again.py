"""A mission planned anew with what is known of its robot from an earlier plan.

What a robot needs beside a path hardly depends on where that leads: with what it needed on one, the
next is mostly laid once, where it takes three plans to find that out.

Tested through ``fleet/laying/test_relay``.
"""

from __future__ import annotations

from viaspline.driven_plan import as_driven, driven_plan
from viaspline.errors import GaveUpError, GeometryError, PlanningError
from viaspline.mission.model import Mission
from viaspline.mission.spot_turning import is_driven
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.whole_plan import Plan, with_error
from viaspline.world.world import World


def plan_again(before: Plan, mission: Mission, world: World, spending: WorkBudget) -> Plan:
    """Plan a mission of a robot that another plan is known of.

    It keeps what the robot got beside that one's path, and turns as wide; where that doesn't do, it
    is planned as if nothing were known.

    Args:
        before: Of the same robot, in the same world or another one.
        mission: Its via points in the order in which they are served.
        world: What it has on its map.
        spending: What all paths past what moves may spend together.

    Raises:
        NoPathError, GaveUpError, GeometryError: As ``viaspline.planner.plan``.
    """
    robot, spline = before.mission.robot, before.mission.spline
    known = mission.model_copy(update={"robot": robot, "spline": spline})
    if robot.tracking_error_m is not None or not is_driven(robot):
        return with_error(known, world, robot.tracking_error_m or 0.0, spending)
    try:
        return as_driven(with_error(known, world, before.tracking_error, spending), spending)
    except (PlanningError, GeometryError) as error:
        if isinstance(error, GaveUpError) and robot == mission.robot:
            raise  # whatever it keeps, it would be sought the same way once more
        numbers = mission.model_copy(update={"spline": spline})
        return driven_plan(numbers, world, spending)
