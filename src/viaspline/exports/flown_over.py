"""What a flight passes over or under: no fence round it can go along, as fences have no top.

Tested through ``exports/test_plan_of_path``.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely
from numpy.typing import ArrayLike

from viaspline.mission.model import Mission
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.space.flying_body import FlyingBody

SLACK_M = 1e-3
"""So much nearer than it has to be, seen from above, and it is passed over or under."""


def flown_over(mission: Mission, points: ArrayLike) -> dict[int, str]:
    """The numbers and names of what stands on the map and is passed over or under.

    That is what the body comes nearer to, seen from above, than its clearance.

    Args:
        mission: What was asked for.
        points: The corners that are flown [m], shape (n, 2) or (n, 3).

    >>> tower = {"name": "hall", "circle": {"center": [20, 0], "radius": 5}, "height_m": [0, 10]}
    >>> over = Mission.model_validate({
    ...     "world": {"known": [tower]}, "route": {"start": [0, 0, 20], "goal": [40, 0, 20]}})
    >>> flown_over(over, [[0, 0, 20], [40, 0, 20]])
    {0: 'hall'}
    """
    return dict(_flown_over(mission, points)) if mission.is_spatial else {}


def without(mission: Mission, numbers: dict[int, str]) -> Mission:
    """A mission whose map lacks some of its obstacles.

    Args:
        mission: The mission.
        numbers: Which ones.
    """
    if not numbers:
        return mission
    kept = tuple(one for k, one in enumerate(mission.world.known) if k not in numbers)
    world = mission.world.model_copy(update={"known": kept})
    return mission.model_copy(update={"world": world})


def _flown_over(mission: Mission, points: ArrayLike) -> Iterator[tuple[int, str]]:
    lines = shapely.LineString(np.asarray(points, np.float64)[:, :2])
    free = FlyingBody.of(mission.robot).beside + mission.robot.clearance_m - SLACK_M
    for k, obstacle in enumerate(mission.world.known):
        ring = None if obstacle.motion is not None else obstacle.ring
        if ring is not None and _away(ring, lines) < free:
            yield k, obstacle.called(k)


def _away(ring: RoundedRing, lines: shapely.LineString) -> float:
    """How far lines are from what a fence would be round [m]."""
    if ring.is_disc:
        return float(lines.distance(shapely.Point(ring.vertices[0]))) - ring.radius
    return float(lines.distance(shapely.Polygon(ring.polygon_around()[0])))
