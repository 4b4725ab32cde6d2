"""From a mission to a plan: order, tension, curve, certificate and time law."""

from __future__ import annotations

from viaspline.compared_tensions import advised_plan
from viaspline.driven_plan import driven_plan
from viaspline.errors import GeometryError
from viaspline.handed_in import check_kind
from viaspline.mission.model import Mission
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.whole_plan import Plan, in_order
from viaspline.world.world import World

__all__ = ["Plan", "plan", "plan_in"]


def plan(mission: Mission) -> Plan:
    """Plan a mission: the spline through its via points, round what stands in the way, timed.

    A robot with a drive or a localisation that is not exact is made to follow the plan in trial
    drives. What it gets beside the path, with a margin, is kept in addition, and the mission
    planned again, until that covers what is measured. One with a sensor drives a slalom as well,
    for the bends of paths that it will lay under way. ``robot.tracking_error_m`` says it instead.
    Where its steering would be left with too little to correct what noise does, so that the robot
    drifted off in bends, turns are laid wider, as wide as that noise asks for: ``Plan.mission`` has
    the circle. Where that has no room, or takes far longer, they stay as they are, and what the
    robot gets beside them is kept.

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
        (True, 50.9, 'right')
    """
    check_kind("mission", mission, Mission, "give Mission.model_validate({...}) or load(file)")
    if mission.is_spatial:
        problem = "the mission is one in space, and is planned by `viaspline plan`"
        raise GeometryError(f"{problem}; in Python hand it to viaspline.plan(mission)")
    return plan_in(*in_order(mission))


def plan_in(mission: Mission, world: World, spending: WorkBudget | None = None) -> Plan:
    """Plan a mission in a world that is at hand: as ``plan``, which builds one for each mission.

    Args:
        mission: Its via points in the order in which they are served; see ``in_order``.
        world: What it keeps clear of: at least what the mission has on its map.
        spending: What all paths past what moves may spend together, but for those by which a
            tension is chosen; None: each as much as usual.

    Raises:
        NoPathError, GaveUpError, GeometryError: As ``plan``.
    """
    if mission.spline.tension == "auto":
        return advised_plan(mission, world)
    return driven_plan(mission, world, spending)
