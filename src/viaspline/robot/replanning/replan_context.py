"""A robot under way and what stands in its way: where it can stop, and where it may turn off."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planning.checking.conflicts import CLEAR, conflicts_within
from viaspline.planning.problem.requirements import Requirements
from viaspline.robot.journey import SAME_PLACE_M, NavigationState
from viaspline.world.world import World


@dataclass(frozen=True)
class ReplanContext:
    """A robot under way, and what its path comes too close to.

    Attributes:
        journey: With all that is known in its world already.
        against: What the path may be too close to.
        names: What is in the way, for people.
        free_until: Up to this distance along the path it is certainly clear [m].
        speed: At this moment [m/s].
        stop: Where the robot stands if it brakes now, as a distance along the path [m].
        leaves: Where a new path may leave this one without a stop, the nearest place first [m].
        requirements: What a new path keeps.
        floor: Distance that the path keeps up to where it is left [m].
    """

    journey: NavigationState
    against: World
    names: tuple[str, ...]
    free_until: float
    speed: float
    stop: float
    leaves: tuple[float, ...]
    requirements: Requirements
    floor: float

    def is_clear(self, place: float) -> bool:
        """Whether the path keeps its distance from what is in the way up to a place [m]."""
        path = self.journey.path
        if place < self.free_until:
            return True
        if place - self.free_until <= SAME_PLACE_M:
            point = np.asarray(path.at_distance(place))
            return float(self.against.distance(point)) >= self.floor - SAME_PLACE_M
        first, last = np.asarray(path.parameter(np.array([self.free_until, place]))).tolist()
        return (
            first_conflict(path.section(first, last), self.against, self.floor, self.requirements)
            is None
        )

    def may_leave(self, place: float) -> bool:
        """Whether a new path can leave this one at a place while the robot rolls on."""
        turning = any(abs(turn - place) <= SAME_PLACE_M for turn in self.journey.turns)
        return not turning and self.is_clear(place)


def speed_now(journey: NavigationState) -> float:
    """The robot's speed at the time of the last step [m/s]."""
    return 0.0 if journey.dwell is not None else float(journey.trajectory.state_at(journey.time)[1])


def free_until(journey: NavigationState, against: World) -> float | None:
    """Start of the first span ahead that comes too close to something [m]; None if none does."""
    path = journey.path
    for start, end, floor in journey.stretches(path.length):
        if end - start <= SAME_PLACE_M:
            continue
        first, last = np.asarray(path.parameter(np.array([start, end]))).tolist()
        conflict = first_conflict(path.section(first, last), against, floor, journey.requirements)
        if conflict == 0:
            return start
        if conflict is not None:
            return float(path.distance(float(math.floor(first) + conflict)))
    return None


def first_conflict(
    curve: PiecewiseCubic, world: World, required: float, requirements: Requirements
) -> int | None:
    """Index of the first span on which the body comes nearer to a world than it may, if one does.

    Args:
        curve: What is driven.
        world: What to keep clear of.
        required: The distance that the curve itself is to keep [m].
        requirements: The body.
    """
    blocked = np.flatnonzero(conflicts_within(required, world, curve.spans, requirements) != CLEAR)
    return int(blocked[0]) if blocked.size else None


def replan_context_of(
    journey: NavigationState,
    against: World,
    names: tuple[str, ...],
    free: float,
    requirements: Requirements,
) -> ReplanContext:
    """The scene of a journey whose path is free up to a distance along it [m]."""
    here = journey.distance
    speed = speed_now(journey)
    rest = here if journey.dwell is not None else journey.trajectory.next_rest(here + SAME_PLACE_M)
    stop = min(here + speed * speed / (2.0 * journey.limits.brake), rest)
    wait = speed * journey.reaction
    leaves = {min(here + wait, rest): None}
    if journey.limits.max_lateral_accel is not None:
        leaves[min(stop + wait, rest)] = None  # there it may be slow enough for a sharper bend
    if journey.belief is not None:
        leaves[stop] = None  # there it may have seen enough of another way
    floor = journey.stretches(journey.path.length)[0][2]
    return ReplanContext(
        journey, against, names, free, speed, stop, tuple(leaves), requirements, floor
    )
