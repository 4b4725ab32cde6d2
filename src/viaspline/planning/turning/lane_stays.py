"""Where a path can't stay on the line between two via points: what stands there, and its own ends.

Tested through ``planning/turning/test_local_detours``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.world.corner_fans import X as CORNER_X
from viaspline.kernels.world.corner_fans import Y as CORNER_Y
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.routing.blocked_runs import blocked_runs
from viaspline.planning.routing.route_problem import NO_BARRIERS
from viaspline.planning.routing.side_barrier import Barriers, barriers_at, barriers_of
from viaspline.planning.routing.taut_path import TautPath
from viaspline.planning.turning.lane import Lane
from viaspline.world.world import World

LONG_LANE = 10.0  # a lane over what stands in it, from which on it is kept unless it is said
OFF_LANE = 0.05  # beside its line a leg begins off it, in required distances


@dataclass(frozen=True)
class Stay:
    """A piece of a lane on which the path can't stay on it.

    Attributes:
        begin: Where it begins, along the lane [m].
        end: Where it ends [m].
        aside: How far beside the lane the path gets there [m].
        size: Of the largest thing that stands in the way there [m].
        corners: Of the taut path there: along the lane and to its left [m], (k, 2).
        barriers: What closes the sides on which the path doesn't pass what stands there, (b, 4).
    """

    begin: float
    end: float
    aside: float
    size: float
    corners: Floats
    barriers: Floats

    def and_next(self, other: Stay) -> Stay:
        """This one and the one after it as one."""
        return Stay(
            self.begin,
            other.end,
            max(self.aside, other.aside),
            max(self.size, other.size),
            np.vstack((self.corners, other.corners)),
            np.vstack((self.barriers, other.barriers)),
        )


@dataclass(frozen=True)
class BlockedRun:
    """A piece of a lane that something stands in.

    Attributes:
        begin: Where it begins, along the lane [m].
        end: Where it ends [m].
        barriers: What closes either side of what stands there.
    """

    begin: float
    end: float
    barriers: Barriers


@dataclass(frozen=True)
class LegLane:
    """A leg with the line that it may keep to.

    Attributes:
        leg: The leg.
        lane: The line of all of the leg of the route that it is or is the rest of.
        ends: Where the leg begins and ends: along the line and to its left [m], (2, 2).
        is_off: Whether it does so beside the line, (2,).
        runs: Where that is blocked, along it [m], (k, 2).
    """

    leg: LegSearch
    lane: Lane
    ends: Floats
    is_off: Flags
    runs: Floats

    @classmethod
    def of(cls, leg: LegSearch) -> LegLane:
        """The line of a leg."""
        lane = Lane.of(leg.sequence.whole_leg(leg.index))
        ends = lane.seen(np.array([end[:2] for end in leg.ends]))
        first, last = min(0.0, *ends[:, 0]), max(lane.length, *ends[:, 0])
        required = leg.requirements.required
        runs = first + blocked_runs(leg.world, lane.at(first), lane.at(last), required)
        is_off = np.abs(ends[:, 1]) > OFF_LANE * required
        return cls(leg, lane, ends, is_off, runs)

    def is_long_beside(self, stays: Sequence[Stay]) -> bool:
        """Whether it is long beside what stands in it: all along it, and to the side ahead."""
        grown = 2.0 * self.leg.requirements.required
        along = np.maximum(np.diff(self.runs, axis=1) - grown, 0.0).sum()
        sizes = [max(stay.end - stay.begin, stay.aside) - grown for stay in stays]
        ahead = np.maximum(sizes, 0.0).sum()
        return bool(self.lane.length > LONG_LANE * max(along, ahead))

    def stays(self, taut_path: TautPath) -> list[Stay]:
        """Where the path can't stay on it: beside it at the leg's ends, and where it is blocked.

        A taut path says on which side what stands there is passed, and how far aside.
        """
        places = self.lane.seen(taut_path.corners[:, [CORNER_X, CORNER_Y]])
        stays = [_blocked(taut_path, places, run) for run in self.blocked]
        for at, left in self.ends[self.is_off].tolist():
            stays.append(Stay(at, at, abs(left), 0.0, np.empty((0, 2)), NO_BARRIERS))
        return sorted(stays, key=lambda stay: stay.begin)

    @cached_property
    def blocked(self) -> tuple[BlockedRun, ...]:
        """Where it is blocked between the ends of the leg, in its order."""
        first, last = self.ends[:, 0].tolist()
        runs = np.clip(self.runs, first, max(first, last))
        return tuple(
            BlockedRun(begin, end, _barriers(self.leg.world, self.lane, 0.5 * (begin + end)))
            for begin, end in runs[runs[:, 1] > runs[:, 0]].tolist()
        )


def _blocked(taut_path: TautPath, places: Floats, run: BlockedRun) -> Stay:
    """A blocked piece of a lane, as a taut path with corners at places (k, 2) [m] passes it."""
    begin, end = run.begin, run.end
    corners = places[(places[:, 0] > begin) & (places[:, 0] < end)]
    at_ends = np.interp([begin, end], places[:, 0], places[:, 1])
    aside = float(np.abs(np.append(corners[:, 1], at_ends)).max())
    is_left = taut_path.crosses(run.barriers.left)
    closed = run.barriers.right if is_left else run.barriers.left
    return Stay(begin, end, aside, max(end - begin, 2.0 * aside), corners, closed)


def _barriers(world: World, lane: Lane, along: float) -> Barriers:
    """What closes either side of what blocks a lane at a distance from its start [m].

    They begin inside of it: a path may pass between it and a lane that it blocks only just.
    """
    place = lane.at(along)
    index = int(world.nearest(place)[1])
    ends = lane.start, lane.at(lane.length)
    if index >= 0 and world.obstacles[index].ring is not None:
        return barriers_of(world, index, *ends)
    return barriers_at(world, place, *ends)
