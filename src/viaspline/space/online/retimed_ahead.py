"""The law of a path under way, timed anew from where the robot can next do something else.

Tested through ``space/online/test_fly_among_unseen``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from viaspline.errors import GeometryError, PlanningError
from viaspline.mission.model import Mission
from viaspline.space.among.law_past_moving import law_past_moving
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.timed_past import kept_about
from viaspline.space.online.flown_leg import FlownLeg
from viaspline.space.online.takeover import LATENCY_S
from viaspline.space.route_law import stops_of
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.timing.retime_in_space import retime_in_space
from viaspline.space.timing.yaw_profile import YawProfile
from viaspline.trajectory.trajectory import Trajectory

SAME_PLACE_M: Final = 1e-6
"""Stops that are no farther ahead are where the robot is [m]."""

STANDS_MPS: Final = 1e-9
"""A robot that is slower stands, but for rounding [m/s]."""


class FlightAhead(NamedTuple):
    """Where a robot is when it can next do something else.

    Attributes:
        time: When that is [s].
        distance: Along its path [m].
        speed: There [m/s].
    """

    time: float
    distance: float
    speed: float

    @classmethod
    def of(cls, leg: FlownLeg, now: float, latency: float = LATENCY_S) -> FlightAhead:
        """Of a robot that looks now [s], and may do something else so much later [s]."""
        time = leg.law.cut_after(now + latency)
        distance, speed, _ = (float(value) for value in leg.law.state_at(time))
        return cls(time, distance, speed if speed > STANDS_MPS else 0.0)

    def after_dwell(self, leg: FlownLeg) -> FlightAhead:
        """It, or when the robot has stood as long as it has to where it is."""
        law = leg.law
        for stop in law.stations:
            if self.speed == 0.0 and abs(stop.distance - self.distance) <= SAME_PLACE_M:
                comes = float(law.times[law.distances.searchsorted(stop.distance - SAME_PLACE_M)])
                return self._replace(time=max(self.time, comes + stop.dwell))
        return self


def fastest_ahead(leg: FlownLeg, problem: SpatialProblem, ahead: FlightAhead) -> Trajectory:
    """The fastest law along the rest of a path if nothing moved.

    Args:
        leg: What is flown.
        problem: What it solves.
        ahead: Where the law begins.

    Raises:
        GeometryError: The robot is too fast for what is ahead.
    """
    later = ahead.distance + SAME_PLACE_M
    stops = tuple(s for s in stops_of(problem, leg.path) if s.distance > later)
    law = retime_in_space(
        leg.path, problem.limits, stops, _turning_after(leg.yaw, later), zones=problem.zones,
        start=min(ahead.distance, leg.path.length), start_speed=ahead.speed, start_time=ahead.time,
    )  # fmt: skip
    if law.over_limit_until is not None:
        raise GeometryError("the robot is too fast for the rest of its path")
    return law


def _turning_after(yaw: YawProfile, distance: float) -> YawProfile:
    """Headings without the turns on the spot before a distance along the path [m]."""
    kept = yaw.distances > distance
    first = float(yaw.at(distance))
    return YawProfile(
        np.append(distance, yaw.distances[kept]), np.append(first, yaw.headings[kept])
    )


def law_past(
    leg: FlownLeg, problem: SpatialProblem, mission: Mission, fastest: Trajectory,
    moving: Sequence[MovingSolid],
) -> Trajectory | str:  # fmt: skip
    """A law along the rest of a path past what moves.

    Args:
        leg: What is flown.
        problem: What it solves.
        mission: Whose robot it is.
        fastest: The fastest law if nothing moved.
        moving: What moves, from that law's beginning on.

    Returns:
        The law, which begins as that one does; or the name of what it can't let pass.
    """
    if not moving:
        return fastest
    try:
        past = law_past_moving(
            leg.path, fastest, mission.route.hold_s, problem.limits, kept_about(mission), moving
        )
    except PlanningError:
        return moving[0].name
    if isinstance(past, str):
        return past
    law, first = past.trajectory, min(moving, key=lambda one: float(one.times[-1]))
    if law.end_time + mission.route.hold_s > first.times[-1]:
        return first.name  # nobody knows where it will be then
    begins_so = law.speeds[0] == fastest.speeds[0] and law.distances[1] > law.distances[0]
    return law if fastest.speeds[0] == 0.0 or begins_so else moving[0].name


def going_on(law: Trajectory, later: Trajectory) -> Trajectory:
    """A law up to where another one begins in the state in which this one is then.

    Where this one has ended by then the robot stands in between.
    """
    begins = float(later.distances[0]) + SAME_PLACE_M
    stops = (*(stop for stop in law.stations if stop.distance <= begins), *later.stations)
    if later.start_time <= law.end_time:
        return replace(law.followed_by(later, law.start_time), stations=stops)
    return replace(
        later,
        distances=np.concatenate((law.distances, later.distances)),
        speeds=np.concatenate((law.speeds, later.speeds)),
        times=np.concatenate((law.times, later.times)),
        accelerations=np.concatenate((law.accelerations, [0.0], later.accelerations)),
        stations=stops,
        changes=_joined_bends(law.changes, later.changes, law, later),
        jerks=_joined_bends(law.jerks, later.jerks, law, later),
    )


def standing(distance: float, since: float, until: float) -> Trajectory:
    """The law of a robot that stays where it is [m] from one time to another [s]."""
    still = np.zeros(2)
    return Trajectory(np.full(2, distance), still, np.array([since, until]), np.zeros(1))


def _joined_bends(
    first: np.ndarray | None, second: np.ndarray | None, law: Trajectory, later: Trajectory
) -> np.ndarray | None:
    if first is None and second is None:
        return None
    before = np.zeros(len(law.accelerations)) if first is None else first
    after = np.zeros(len(later.accelerations)) if second is None else second
    return np.concatenate((before, [0.0], after))
