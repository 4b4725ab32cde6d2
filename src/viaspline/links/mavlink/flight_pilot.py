"""A plan in space at the stick of a copter.

Tested through ``links/mavlink/test_closed_loop``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.links.mavlink.pilot import FAR_OFF_M, Steering
from viaspline.links.mavlink.setpoints import VehicleMotion
from viaspline.links.mavlink.vehicle_state import VehicleState
from viaspline.mission.space.flight_places import flight_places
from viaspline.space.spatial_plan import SpatialPlan

GAIN_PER_S: Final = 1.0
"""Of an error of place."""

MAX_CATCH_UP_MPS: Final = 1.0
"""How fast an error of place is made good, beside the speed of the plan."""

SLACK_M, SLACK_TIME_S = 0.3, 0.4
"""How far a copter may lag behind before its clock waits, at rest and per speed."""

AT_GOAL_M: Final = 0.5
"""So near to the end of its path it has arrived."""


@dataclass(frozen=True, eq=False)
class FlightPilot:
    """A plan in space under way: the time law waits for a copter that lags behind.

    Attributes:
        plan: It.
        law_time: How far in its time law [s]; None before the first step.
        last: When the last step was [s].
    """

    plan: SpatialPlan
    law_time: float | None = None
    last: float = 0.0

    @property
    def allowed_m(self) -> float:
        """Within this of its path the body touches nothing."""
        return min(float(self.plan.certificate.clearance), FAR_OFF_M)

    @property
    def takeoff_m(self) -> float | None:
        """The height of the mission's take-off."""
        takeoff = self.plan.mission.route.takeoff
        return None if takeoff is None else takeoff.to_agl_m

    @property
    def lands(self) -> bool:
        """Whether the mission ends with a landing."""
        return self.plan.mission.route.land is not None

    @cached_property
    def home(self) -> float:
        """The height of the mission's home in its frame [m]."""
        return float(flight_places(self.plan.mission).home)

    @cached_property
    def airborne(self) -> tuple[float, float]:
        """From when to when of the time law it is between take-off and landing [s]."""
        law, (begin, end) = self.plan.trajectory, self.plan.airborne
        return float(law.time_at(begin)), float(law.time_at(end))

    def too_far(self, state: VehicleState) -> str | None:
        """Why it can't set off from there: too far from where it is to be in the air."""
        first = self._place(self.airborne[0])
        off = math.dist((state.x, state.y), (float(first[0]), float(first[1])))
        if self.takeoff_m is None:
            off = math.hypot(off, self.home + state.up - float(first[2]))
        if off <= self.allowed_m:
            return None
        return f"it is {off:.2f} m from its start, and {self.allowed_m:.2f} m are proven clear"

    def steered(self, state: VehicleState, time: float) -> tuple[FlightPilot, Steering]:
        """The velocity of the plan, and towards where the plan is."""
        begin, end = self.airborne
        here = np.array((state.x, state.y, self.home + state.up))
        now = begin if self.law_time is None else self.law_time
        passed = 0.0 if self.law_time is None else max(time - self.last, 0.0)
        now = self._later(now, passed, here)
        distance, speed, _ = (float(x) for x in self.plan.trajectory.state_at(now))
        place, along = self._place(now), self._direction(distance)
        error = place - here
        pull = GAIN_PER_S * error
        size = float(np.linalg.norm(pull))
        pull *= min(1.0, MAX_CATCH_UP_MPS / size) if size > 0.0 else 1.0
        east, north, up = (float(x) for x in speed * along + pull)
        beside = float(np.linalg.norm(error - (error @ along) * along))
        heading = float(self.plan.yaw.at(distance))
        over = now >= end and float(np.linalg.norm(error)) < AT_GOAL_M
        steering = Steering(VehicleMotion(0.0, 0.0, (east, north, up), heading), beside, over)
        return replace(self, law_time=now, last=time), steering

    def _later(self, now: float, passed: float, here: Floats) -> float:
        """The time in the law after some seconds: it waits for a copter that lags behind."""
        distance, speed, _ = (float(x) for x in self.plan.trajectory.state_at(now))
        behind = float((self._place(now) - here) @ self._direction(distance))
        if behind > SLACK_M + SLACK_TIME_S * speed:
            return now
        return min(now + passed, self.airborne[1])

    def _place(self, time: float) -> Floats:
        distance = float(self.plan.trajectory.state_at(time)[0])
        path = self.plan.path
        return np.asarray(path.evaluate(float(path.parameter(distance))), float)

    def _direction(self, distance: float) -> Floats:
        """The unit tangent; nought where the path has none."""
        path = self.plan.path
        first = np.asarray(path.evaluate(float(path.parameter(distance)), 1), float)
        size = float(np.linalg.norm(first))
        return first / size if size > 0.0 else np.zeros(3)
