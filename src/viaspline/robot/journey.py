"""What a navigator knows at one moment, and how far along its path the robot is."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.path import Path, PathVia
from viaspline.errors import GeometryError
from viaspline.machine.turns_on_spot import with_turns
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.requirements import Requirements
from viaspline.robot.controller import Controller
from viaspline.robot.perception.belief import LEAST_ROOM, Belief
from viaspline.robot.run import Event, Replan, Visit
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import braking, retime
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World

SAME_PLACE_M = 1e-6
"""Distances nearer than this are the same place [m]."""


@dataclass(frozen=True)
class Dwell:
    """A stay at a station: its name, where it is [m], and until when [s]."""

    name: str
    at: tuple[float, ...]
    until: float


@dataclass(frozen=True)
class Wait:
    """A robot that looks and doesn't know how to go on yet.

    Attributes:
        since: When it began [s].
        again: When it tries again [s].
        reason: Why it can't go on; None if it only sees too little.
    """

    since: float
    again: float
    reason: str | None = None


@dataclass(frozen=True)
class ReducedClearance:
    """A robot that has come closer to something than it should, and is on its way out.

    Attributes:
        until: Distance along the path up to which it keeps less [m].
        floor: Distance that it keeps there from everything known [m].
    """

    until: float
    floor: float


@dataclass(frozen=True)
class NavigationState:
    """A robot's way so far and the way it means to go on; a new one for every step.

    Attributes:
        mission: What was asked for.
        limits: Of the robot, with what its sensor allows.
        reaction: Longest time between two steps [s].
        world: All that is known by now.
        seen: The obstacles in that world that were told one by one.
        plan_path: The path before the robot set off.
        path: The path; all that was driven is its beginning.
        laid: What was known when the path was laid.
        trajectory: The time law along it.
        turns: Distances along the path where it has a corner to turn on the spot [m].
        time: Of the last step [s]; with a drive, when what is decided in it happens.
        tracking_error: How far beside its path the robot may get [m].
        controller: The controller of a robot with a drive; None if it follows exactly.
        belief: What a lidar has shown; None without one.
        close: Where the path keeps less than it should, if it does.
        sighted: Up to this distance along the path the robot has seen where its body will be [m].
        probed_until: Up to this distance along the path the robot goes though it sees too little
            [m].
        reviewed: When it was last asked whether there is a better path [s].
        wait: Since when and why the robot waits, if it does.
        distance: Progress along the path at that time [m].
        off: How far beside the path the robot was then [m].
        last: Index in the route of the last via point that was passed; -1 before the start.
        dwell: The stay at a station that is under way.
        skipped: Route points that were given up, with the reason.
        served: Visits so far.
        events: So far.
        replans: So far.
        compute_times: Of the re-plans [s], wall clock.
        giving_up: Why the robot brakes for good, if it does.
        finished: Whether the drive is over.
    """

    mission: Mission
    limits: Limits
    reaction: float
    world: World
    seen: frozenset[Obstacle]
    plan_path: Path
    path: Path
    laid: World
    trajectory: Trajectory
    time: float
    tracking_error: float = 0.0
    controller: Controller | None = None
    belief: Belief | None = None
    close: ReducedClearance | None = None
    sighted: float = 0.0
    probed_until: float = 0.0
    reviewed: float = -math.inf
    wait: Wait | None = None
    distance: float = 0.0
    off: float = 0.0
    turns: tuple[float, ...] = ()
    last: int = -1
    dwell: Dwell | None = None
    skipped: tuple[tuple[int, str], ...] = ()
    served: tuple[tuple[int, Visit], ...] = ()
    events: tuple[Event, ...] = ()
    replans: tuple[Replan, ...] = ()
    compute_times: tuple[float, ...] = ()
    giving_up: str | None = None
    finished: bool = False

    @cached_property
    def requirements(self) -> Requirements:
        """What every path has to keep; with a lidar it is never nothing."""
        requirements = Requirements.of(self.mission, self.tracking_error)
        if self.belief is None:
            return requirements
        return replace(
            requirements, clearance=max(requirements.clearance, LEAST_ROOM - requirements.radius)
        )

    @property
    def cell_size(self) -> float:
        """Size of the smallest thing that counts for a robot with a lidar [m]."""
        assert self.belief is not None
        return self.belief.echoes.cell_size

    @cached_property
    def ahead(self) -> tuple[tuple[PathVia, float], ...]:
        """The route's points still to come, in order, with their distances along the path [m]."""
        return points_after(self.path, self.last)

    def stretches(self, end: float) -> tuple[tuple[float, float, float], ...]:
        """From here on to ``end`` [m]: from where to where the path keeps which distance [m]."""
        here, required = self.distance, self.requirements.required
        if self.close is None or self.close.until <= here:
            return ((here, end, required),)
        until = min(self.close.until, end)
        return ((here, until, self.close.floor), (until, end, required))

    @property
    def reached(self) -> bool:
        """Whether the drive is over and ended at its goal."""
        return self.finished and self.giving_up is None

    def place(self, distance: float) -> tuple[float, ...]:
        """The path's point at a distance along it [m]."""
        return tuple(np.asarray(self.path.at_distance(distance)).tolist())

    def noted(self, *events: Event) -> NavigationState:
        """The same with these events at its end."""
        return replace(self, events=self.events + events)


def points_after(path: Path, last: int) -> tuple[tuple[PathVia, float], ...]:
    """The user's via points of a path that come after this one of the route."""
    distances: NDArray[np.float64] = path.via_distances
    return tuple(
        (via, float(distance))
        for via, distance in zip(path.vias, distances, strict=True)
        if via.index is not None and via.index > last
    )


def certain_until(journey: NavigationState, path: Path, same: float = math.inf) -> float:
    """How far along a path the robot can go for certain [m].

    Without a lidar it trusts what it knows, and that is to the end.

    Args:
        journey: The robot's way so far.
        path: What is driven.
        same: Up to this distance it is the path of the journey [m].
    """
    if journey.belief is None:
        return path.length
    seen = _seen_until(journey, path, same)
    for start, end, floor in journey.stretches(seen):
        clear = journey.belief.clear_until(path, start, end, floor)
        if clear < end:
            return clear
    return seen


def sighted(journey: NavigationState) -> NavigationState:
    """The same, knowing how far along its path it has seen."""
    return replace(journey, sighted=_seen_until(journey, journey.path, math.inf))


def _seen_until(journey: NavigationState, path: Path, same: float) -> float:
    assert journey.belief is not None
    here = journey.distance
    end = min(here + journey.belief.ahead, path.length)
    floor = min(stretch[2] for stretch in journey.stretches(end))
    return journey.belief.seen_until(path, max(here, min(journey.sighted, same)), end, floor)


def trajectory_along(
    journey: NavigationState,
    path: Path,
    turns: tuple[float, ...],
    *,
    distance: float,
    speed: float,
    time: float,
    end: float = math.inf,
) -> Trajectory:
    """The time law of the rest of a path, with the stops that are still to come.

    A stay that is under way goes on.

    Args:
        journey: The robot's way so far.
        path: What is driven.
        turns: Distances along the path where it turns on the spot [m].
        distance: Where the law begins [m].
        speed: There [m/s].
        time: Then [s].
        end: Where the law ends, at rest [m]; by default where the path does.

    Raises:
        GeometryError: When the robot is too fast to stop where it has to.
    """
    stops = [Station(turn) for turn in turns if turn > distance + SAME_PLACE_M]
    stops += [
        Station(max(at, distance), via.dwell, via.name)
        for via, at in points_after(path, journey.last)
        if via.dwell > 0.0
    ]
    if journey.dwell is not None:
        stops.append(Station(distance, max(journey.dwell.until - time, 0.0), journey.dwell.name))
        speed = 0.0
    if end < path.length:
        stops = [*(stop for stop in stops if stop.distance < end), Station(end)]
    if journey.controller is not None:
        stops = with_turns(path, journey.controller.model, stops, distance)
    trajectory = retime(
        path,
        journey.limits,
        stops,
        zones=journey.mission.world.speed_zones,
        start=min(distance, path.length),
        start_speed=speed,
        start_accel=float(journey.trajectory.state_at(time)[2]),
        start_time=time,
        replaces=journey.trajectory,
    )
    return trajectory if end >= path.length else trajectory.until(end)


def trajectory_on(journey: NavigationState, *, speed: float, time: float) -> Trajectory:
    """The time law from here on along the journey's own path, at this speed [m/s] and time [s].

    Where the robot can't stop in time any more, because what was certain is not so now, it brakes
    as hard as it can.
    """
    here, path = journey.distance, journey.path
    end = max(certain_until(journey, path), journey.probed_until)
    try:
        return trajectory_along(
            journey, path, journey.turns, distance=here, speed=speed, time=time, end=end
        )
    except GeometryError:
        if journey.belief is None:
            raise
        return braking(here, speed, journey.limits.brake, time)
