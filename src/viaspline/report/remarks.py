"""What is sound in a mission, but may not be what was meant."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.report.heading_remarks import heading_remarks
from viaspline.report.sight_remarks import sight_remarks

if TYPE_CHECKING:
    from viaspline.whole_plan import Plan

FOLLOWED_EXACTLY: Final = (
    "the robot has no drive: it is taken to follow its path exactly, and nothing is kept for what "
    "a real one gets beside it (robot.drive or tracking_error_m would)"
)


def plan_remarks(mission: Mission, plan: Plan | None = None) -> list[str]:
    """What to know of a plan that it doesn't say itself; of the mission as it was asked for.

    Args:
        mission: What was asked for.
        plan: What came of it, if that is at hand.

    >>> [found] = plan_remarks(Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}}))
    >>> found == FOLLOWED_EXACTLY
    True
    """
    found = [*_order(mission), *heading_remarks(mission)]
    found += [FOLLOWED_EXACTLY] if keeps_nothing(mission.robot) else []
    return found if plan is None else [*found, *_steering(mission, plan)]


def _steering(mission: Mission, plan: Plan) -> list[str]:
    """How a plan leaves steering to correct with, or that it doesn't."""
    asked, laid = mission.robot.turn_radius, plan.mission.robot.turn_radius
    if asked is None or laid is None or mission.robot.tracking_error_m is not None:
        return []
    if laid > asked:
        return [
            f"turns of {laid:.3g} m or more, in place of {asked:.3g} m, leave steering to correct "
            f"what noise does; {plan.tracking_error:.2f} m are kept for that"
        ]
    from viaspline.machine.steering_reserve import ENOUGH_RESERVE, steering_reserve

    if steering_reserve(mission.robot, plan.path.max_curvature()[0]) >= 0.5 * ENOUGH_RESERVE:
        return []
    return [
        "turns as tight as these leave hardly any steering to correct what noise does: "
        f"{plan.tracking_error:.2f} m are kept for that; wider ones don't fit or take far longer"
    ]


def keeps_nothing(robot: RobotSpec) -> bool:
    """Whether a plan keeps nothing for how far the robot gets beside its path."""
    return all(one is None for one in (robot.drive, robot.localization, robot.tracking_error_m))


def _order(mission: Mission) -> list[str]:
    if mission.route.order == "given":
        return []
    from viaspline.planning.routing.visit_order import is_surely_shortest

    if is_surely_shortest(mission):
        return []
    count = len(mission.route.via)
    return [f"the order of the {count} via points is a good one; it isn't proven the best"]


def remarks(mission: Mission) -> list[str]:
    """Sentences about limits that leave others without effect; none if all agree.

    >>> remarks(Mission.model_validate({
    ...     "robot": {"min_turn_radius_m": 2, "max_lateral_accel_mps2": 0.5, "max_speed_mps": 3},
    ...     "route": {"start": [0, 0], "goal": [9, 0]},
    ... }))
    ['max_speed 3 m/s is never reached on a turn of 2 m: max_lateral_accel 0.5 m/s² allows 1 m/s
      there; a radius of 18 m would allow it']
    """
    found = _order(mission)
    robot = mission.robot
    top = robot.max_speed_mps
    found += [
        f"speed zone {zone.name or i + 1!r} allows {zone.max_speed_mps:g} m/s, more than the "
        f"robot's max_speed_mps {top:g}"
        for i, zone in enumerate(mission.world.speed_zones)
        if zone.max_speed_mps > top
    ]
    if robot.turn_radius is not None:
        from viaspline.machine.machine_limits import limits_of

        found += limits_of(robot).conflicts(robot.turn_radius)
    return [*found, *heading_remarks(mission), *sight_remarks(mission)]
