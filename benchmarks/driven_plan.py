"""A planned mission as the tables of good driving look at it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from curve_nodes import Task
from driving_time import DrivingLimits, driving_time
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

    @property
    def between_stations(self) -> list[Shape]:
        """From each place at which it stops to the next; the seam of a round is in the last."""
        path, route = self.plan.path, self.plan.mission.route
        stations = [round(via.u) for via in path.vias if via.dwell > 0.0]
        parts = [part for part in np.split(path.spans, stations) if len(part)]
        if route.closed:
            parts[-1] = np.concatenate((parts[-1], path.spans[:1]))
        return [Shape.of(part) for part in parts]

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
        joints = [round(via.u) for via in self.stops]
        first = np.searchsorted(self.shape.span, joints)
        return [self.shape.points[a : b + 1] for a, b in pairwise(first.tolist())]

    @property
    def stops(self) -> list[vs.PathVia]:
        """The user's via points, start and goal among them, as they lie on the path."""
        return [via for via in self.plan.path.vias if via.kind == "user"]

    @property
    def driving_time(self) -> float:
        """The least on its path, dwells left out [s]."""
        rests = [at for via, at in self.plan.path.stops if via.dwell > 0.0]
        shape, limits = self.shape, DrivingLimits.of(self.plan.mission.robot)
        return driving_time(shape.along, shape.curvature, np.array(rests), limits)

    @property
    def task(self) -> Task:
        """The best curve of its kind is asked for, with these via points and stops."""
        route, stops = self.plan.mission.route, self.stops
        ends = {0: route.start, len(stops) - 1: route.goal}
        return Task(
            space=self.free_space,
            legs=tuple(self.legs),
            rests=(True, *(via.dwell > 0.0 for via in stops[1:-1]), True),
            limits=DrivingLimits.of(self.plan.mission.robot),
            headings={
                k: math.radians(end.heading_deg)
                for k, end in ends.items()
                if end is not None and end.heading_deg is not None
            },
            closed=route.closed,
        )

    @cached_property
    def taut_legs(self) -> list[np.ndarray]:
        """The shortest polylines that the legs can be bent into [m], (k, 2)."""
        around = self.shape.points
        margin = 4.0 * self.free_space.required + 1.0
        triangles = Triangles(self.free_space.polygon(around, margin))
        return [triangles.taut(leg) for leg in self.legs]

    @property
    def task_from_taut(self) -> Task:
        """The same, begun with the taut route of its kind."""
        return replace(self.task, legs=tuple(self.taut_legs))

    @property
    def taut(self) -> np.ndarray:
        """All of them as one [m], (k, 2)."""
        return np.vstack(self.taut_legs)
