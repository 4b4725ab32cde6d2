"""One way in for missions in the plane and in space.

Tested through ``space/test_plan_spatial``.
"""

from __future__ import annotations

from viaspline import planner
from viaspline.formats.asked_for import AskedMission, asked_mission
from viaspline.planner import Plan
from viaspline.space.spatial_plan import SpatialPlan


def plan(mission: AskedMission) -> Plan | SpatialPlan:
    """Plan a mission: the spline through its via points, round what stands in the way, timed.

    A mission that says anything of heights (``mission.is_spatial``) is planned in space, see
    `viaspline.space.plan_spatial`; else in the plane, see `viaspline.planner`.

    Args:
        mission: What is asked for, or the file that it stands in.

    Returns:
        A plan with ``path``, ``certificate``, ``ledger`` and ``trajectory`` in either case.

    Raises:
        MissionError: When a file can't be read, or has faults.
        NoPathError: When there is no path, with the reason and the least change that would serve.
        GaveUpError: When a budget ran out before that was known, with what was tried.
        GeometryError: When the mission's numbers contradict each other, or the robot can't follow.

    Example:
        >>> from viaspline.mission.model import Mission
        >>> tower = {"circle": {"center": [25, 0.5], "radius": 4}, "height_m": [0, 30]}
        >>> result = plan(Mission.model_validate({
        ...     "world": {"known": [tower]},
        ...     "route": {"start": [0, 0, 10], "goal": [50, 0, 10]},
        ... }))
        >>> result.certificate.holds, round(result.path.length, 1), result.ledger[0].chosen.side
        (True, 50.8, 'right')
    """
    asked = asked_mission(mission)
    if asked.is_spatial:
        from viaspline.space.plan_spatial import plan_spatial

        return plan_spatial(asked)
    return planner.plan(asked)
