"""A planned mission as the tables of good driving look at it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from free_space import FreeSpace
from path_shape import Shape
from taut_route import Triangles
from timing import clock

import viaspline as vs


@dataclass(frozen=True)
class DrivenPlan:
    """A plan, and what is measured of it without the planner.

    Attributes:
        plan: As it was planned.
        seconds: Of the processor, to plan it.
    """

    plan: vs.Plan
    seconds: float

    @classmethod
    def of(cls, mission: vs.Mission) -> DrivenPlan:
        """Plan a mission.

        Raises:
            PlanningError: When it can't be served.
        """
        seconds, plan = clock(lambda: vs.plan(mission))
        return cls(plan, seconds)

    @cached_property
    def shape(self) -> Shape:
        """Of its exact curve."""
        return Shape.of(self.plan.path.spans)

    @cached_property
    def free_space(self) -> FreeSpace:
        """Of the known world."""
        return FreeSpace.of(self.plan.mission)

    @property
    def detours(self) -> int:
        """Via points that the planner put there."""
        return sum(via.kind == "detour" for via in self.plan.path.vias)

    @cached_property
    def legs(self) -> list[np.ndarray]:
        """Points close together from each of the user's via points to the next [m], (n, 2)."""
        joints = [round(via.u) for via in self.plan.path.vias if via.kind == "user"]
        first = np.searchsorted(self.shape.span, joints)
        return [self.shape.points[a:b] for a, b in pairwise(first.tolist()) if b > a]

    @cached_property
    def taut_legs(self) -> list[np.ndarray]:
        """The shortest polylines that the legs can be bent into [m], (k, 2)."""
        around = self.shape.points
        margin = 4.0 * self.free_space.required + 1.0
        triangles = Triangles(self.free_space.polygon(around, margin))
        return [triangles.taut(leg) for leg in self.legs]

    @property
    def taut(self) -> np.ndarray:
        """All of them as one [m], (k, 2)."""
        return np.vstack(self.taut_legs)
