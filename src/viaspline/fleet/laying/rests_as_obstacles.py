"""Resting places as obstacles of a world.

Tested through ``fleet/laying/test_lay_paths``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.fleet.laying.resting_places import RestingPlaces
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planner import Plan
from viaspline.planning.problem.requirements import Requirements
from viaspline.world.world import World

LEAST_DISC_M = 0.02
"""The radius of an obstacle that a robot's own clearance would make up for [m]."""


def world_with_rests(
    alone: Plan, mission: Mission, reach: float, rests: RestingPlaces, indices: Sequence[int],
    more: float,
) -> World:  # fmt: skip
    """The world with resting places in it.

    A path keeps the robot's own clearance to a disc, which is another length than what robots keep
    from each other: the discs are as large as it takes to make up for the difference.

    Args:
        alone: Of the robot, as if it were alone.
        mission: What was planned.
        reach: How far it keeps others away on its part [m].
        rests: Of all robots.
        indices: Those that are put in.
        more: What is kept beyond what has to be [m].
    """
    rows: Floats = rests.rows[list(indices)].copy()
    rows[:, 2] = np.maximum(own_radii(alone, mission, reach, rows) + more, LEAST_DISC_M)
    discs = tuple(
        Obstacle.model_construct(
            name=rests.places[k].name, circle=Circle.model_construct(center=(x, y), radius=radius)
        )
        for k, (x, y, radius) in zip(indices, rows.tolist(), strict=True)
    )
    return alone.world.with_discs(discs, rows)


def own_radii(alone: Plan, mission: Mission, reach: float, rows: Floats) -> Floats:
    """The radii of discs that keep a robot as far off as resting places do, or less than none [m].

    Args:
        alone: Of the robot.
        mission: What was planned.
        reach: Of the robot [m].
        rows: x, y and reach of the places [m], (n, 3).
    """
    required = Requirements.of(mission, alone.tracking_error).required
    radii: Floats = rows[:, 2] + reach - required
    return radii
