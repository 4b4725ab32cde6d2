"""A plan in space laid anew, with more in its way than stands in its world.

Tested through ``fleet/space/test_lay_in_space``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.space.solve_route import whole_proof
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_request import spatial_problem_of
from viaspline.space.static_plan import static_plan


def laid_round(alone: SpatialPlan, obstacles: Sequence[Obstacle]) -> SpatialPlan:
    """A robot's plan with more obstacles in its world; it is proven in the world without them.

    Raises:
        NoPathError: There is none.
        GaveUpError: None was found.
    """
    plan = static_plan(_among(alone.mission, obstacles))
    proof = whole_proof(spatial_problem_of(alone.mission), plan.path, plan.airborne)
    return replace(plan, mission=alone.mission, world=alone.world, certificate=proof)


def _among(mission: Mission, obstacles: Sequence[Obstacle]) -> Mission:
    world = mission.world
    more = world.model_copy(update={"known": (*world.known, *obstacles)})
    return mission.model_copy(update={"world": more})
