"""Whether the path of a saved plan serves the route of its mission.

Tested through ``saved_plans/test_load_plan``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from viaspline.curve.path import Path
from viaspline.saved_plans.plan_file import ON_PATH_M, PlanFile


class AskedPoint(NamedTuple):
    """A point of a route.

    Attributes:
        number: Its place in the route, 0 for the start.
        at: Where it is [m].
        dwell: How long the robot stays there [s].
    """

    number: int
    at: tuple[float, ...]
    dwell: float


def check_served(plan: PlanFile, path: Path, asked: Iterable[AskedPoint]) -> None:
    """See that a path runs through every point of a route, in order, and stays as long as asked.

    Args:
        plan: The file that says so.
        path: Its path, with via points that lie on it.
        asked: The points of the route.

    Raises:
        SavedPlanError: It doesn't.
    """
    stops = [(via.u, via.index) for via in path.vias if via.index is not None]
    if stops != sorted(stops):
        raise plan.wrong("the points of the route aren't in order on the path")
    served = {via.index: via for via in path.vias if via.index is not None}
    for point in asked:
        via = served.get(point.number)
        if via is None or not math.dist(via.at[: len(point.at)], point.at) <= ON_PATH_M:
            where = f"point {point.number} of the mission's route"
            raise plan.wrong(f"the path doesn't run through {where}")
        if via.dwell != point.dwell:
            stays = f"the robot stays {via.dwell:g} s at '{via.name}'"
            raise plan.wrong(f"{stays}, and the mission asks for {point.dwell:g} s")
