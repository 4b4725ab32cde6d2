"""Why there is no path past robots that have none themselves, and stand at their starts for ever.

Refused is what is proven: that they can't leave, and that there is no way round them with not a
hair more than has to be kept.

Tested through ``fleet/laying/test_lay_paths``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from viaspline.errors import GaveUpError, GeometryError, NoPathError, PlanningError
from viaspline.fleet.laying.resting_places import RestingPlace, RestingPlaces
from viaspline.fleet.laying.rests_as_obstacles import LEAST_DISC_M, own_radii, world_with_rests
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan_in
from viaspline.planning.problem.work_budget import WorkBudget

POSES_S = 4.0
"""What searches among poses may spend on ways round resting places, for each robot [s of the
reference machine]. Where they spent it, it is taken that there is no way, and not proven."""

TRIED = ("ways round robots that can't leave",)


def stranded_at_point(mission: Mission, reach: float, rest: RestingPlace) -> PlanningError:
    """That a robot that can't leave stands where another one has to get to.

    Args:
        mission: Of the other one.
        reach: How far that keeps others away on its part [m].
        rest: Where the first one stands, too near to one of the other's points.
    """
    points = list(mission.route.points())
    apart = [float(np.hypot(*(np.array(via.at[:2]) - rest.at))) for _, via in points]
    key, via = points[int(np.argmin(apart))]
    words = f"{key} '{via.name}'" if via.name else key
    by = reach + rest.reach - min(apart)
    reason = f"'{rest.robot}', which can't leave its start, stands {by:.2f} m too near to {words}"
    remedy = f"move '{rest.robot}' or {words} by {by:.2f} m, or leave '{rest.robot}' out"
    if rest.is_proven:
        return NoPathError(reason, where=rest.at, remedy=remedy, obstacles=(rest.robot,))
    return GaveUpError(
        reason, where=rest.at, remedy=remedy, obstacles=(rest.robot,), tried=TRIED
    )  # fmt: skip


def no_way_past_stranded(
    alone: Plan, mission: Mission, reach: float, rests: RestingPlaces, stuck: Sequence[int]
) -> PlanningError:
    """What there is to say where no path was found round robots that can't leave.

    Args:
        alone: Of the robot that has to pass, as if it were alone.
        mission: What was planned.
        reach: How far it keeps others away on its part [m].
        rests: Of all robots.
        stuck: Indices of those that can't leave and are in the way.
    """
    places = [rests.places[k] for k in stuck]
    names = tuple(one.robot for one in places)
    who = " and ".join(repr(name) for name in names)
    leave = f"leave {who} out" if len(names) == 1 else f"leave one of {who} out"
    reason = f"{who}, which can't leave the start, is in the way"
    try:
        among = world_with_rests(alone, mission, reach, rests, stuck, 0.0)
        plan_in(mission, among, WorkBudget(math.inf, poses=WorkBudget(POSES_S)))
    except (PlanningError, GeometryError) as error:
        is_exact = own_radii(alone, mission, reach, rests.rows[list(stuck)]).min() >= LEAST_DISC_M
        if isinstance(error, PlanningError):
            reason = f"{reason}: {error.reason}"
        if is_exact and isinstance(error, NoPathError) and all(one.is_proven for one in places):
            return NoPathError(
                reason, where=error.where, remedy=leave, via=error.via, obstacles=names
            )
    return GaveUpError(reason, where=places[0].at, remedy=leave, obstacles=names, tried=TRIED)
