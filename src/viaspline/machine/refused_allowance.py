"""A refusal of all paths that keep what a robot gets beside one of them: no proof for the others.

How far a robot gets beside its path depends on the path. That none keeps what was measured on one
doesn't say that there is none which needs less.
"""

from __future__ import annotations

from viaspline.errors import GaveUpError, PlanningError
from viaspline.machine.allowance import tracking_remedy
from viaspline.mission.robot_parts import RobotSpec


def unproven(problem: PlanningError, error: float, robot: RobotSpec) -> GaveUpError:
    """What is told of a robot for which no path keeps what it got beside another one.

    Args:
        problem: With which paths that keep so much are refused, or given up.
        error: What they were to keep beyond the clearance [m].
        robot: Whose drive and localisation ask for that.

    Example:
        >>> refused = PlanningError("the gap is 1 m wide", where=(2, 0), remedy="widen it")
        >>> told = unproven(refused, 0.12, RobotSpec(drive={"differential": {"track_m": 0.5}}))
        >>> told.tried
        ('paths that keep 0.12 m for how far the robot gets beside them',)
    """
    if isinstance(problem, GaveUpError):
        return problem
    return GaveUpError(
        problem.reason,
        where=problem.where,
        remedy=f"{problem.remedy}; or give the robot {tracking_remedy(robot)}",
        tried=(f"paths that keep {error:.2f} m for how far the robot gets beside them",),
        via=problem.via,
        obstacles=problem.obstacles,
        changes=problem.changes,
    )
