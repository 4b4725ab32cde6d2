"""Where a path can't stay on the line between two via points: what stands there, and its own ends.

Tested through ``planning/turning/test_local_detours``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.world.corner_fans import X as CORNER_X
from viaspline.kernels.world.corner_fans import Y as CORNER_Y
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.routing.blocked_runs import blocked_runs
from viaspline.planning.routing.route_problem import NO_BARRIERS
from viaspline.planning.routing.side_barrier import Barriers, barriers_at, barriers_of
from viaspline.planning.routing.taut_path import TautPath
from viaspline.planning.turning.lane import Lane
from viaspline.planning.turning.lane_block import width_in
from viaspline.planning.turning.lane_turns import BESIDE_LANE
from viaspline.world.world import World

LONG_LANE = 10.0  # a lane over what stands in it, from which on it is kept unless it is said
KEPT_WIDTHS = 4.0  # of what stands in a lane, for which the shortest way may be off it
OFF_LANE = 0.05  # beside its line a leg begins off it, in required distances


@dataclass(frozen=True)
class Stay:
    """A piece of a lane on which the path can't stay on it.

    Attributes:
        begin: Where it begins, along the lane [m].
        end: Where it ends [m].
        aside: How far beside the lane the path gets there [m].
        size: Of what stands in the way there, with what is kept from it [m]: at least.
        barriers: What closes the sides on which the path doesn't pass what stands there, (b, 4);
            none before that is looked for.
    """

    begin: float
    end: float
    aside: float
    size: float
    barriers: Floats


@dataclass(frozen=True)
class LegLane:
    """A leg with the line that it may keep to.

    Attributes:
        leg: The leg.
        lane: The line of all of the leg of the route that it is or is the rest of.
        runs: Where that is blocked, along it [m], (k, 2).
    """

    leg: LegSearch
    lane: Lane
    runs: Floats

    @classmethod
    def of(cls, leg: LegSearch) -> LegLane:
        """The line of a leg."""
        lane = Lane.of(leg.sequence.whole_leg(leg.index))
        along = lane.seen(_both(leg.ends))[:, 0].tolist()
        first, last = min(0.0, *along), max(lane.length, *along)
        ends = lane.at(first), lane.at(last)
        return cls(leg, lane, first + blocked_runs(leg.world, *ends, leg.requirements.required))

    @property
    def ends(self) -> tuple[float, float]:
        """How far along the line the leg begins and ends [m]."""
        first, last = self.lane.seen(_both(self.leg.ends))[:, 0].tolist()
        return first, last

    def is_worth_keeping(self, stays: Sequence[Stay], taut_path: TautPath) -> bool:
        """Whether it is long beside what stands in it, and the shortest way far off it.

        Where that is off it for no more than four widths of what stands there, it keeps to it well
        enough: so it does round a wall that juts out into it.
        """
        return self._is_long_beside(stays) and self._is_far_off(stays, taut_path)

    def _is_far_off(self, stays: Sequence[Stay], taut_path: TautPath) -> bool:
        """Whether the shortest way is off it for more than four widths of what stands in it."""
        places = self.lane.seen(taut_path.corners[:, [CORNER_X, CORNER_Y]])
        off = _length_beside(places, BESIDE_LANE * self.leg.requirements.required)
        reach = off / KEPT_WIDTHS
        for stay in stays:
            if stay.size > 0.0:
                off -= KEPT_WIDTHS * max(self._width(stay, reach), stay.end - stay.begin)
        return off > 0.0

    def _width(self, stay: Stay, reach: float) -> float:
        """Of what stands in the way there [m]; infinite if that is more than a reach."""
        place, world = self._middle(stay), self.leg.world
        index = int(world.nearest(place)[1])
        return self.leg.requirements.recalled(
            ("width", world, self.leg.index, place.tobytes(), reach),
            partial(width_in, world, self.lane, place, index, reach),
        )

    def _middle(self, stay: Stay) -> Floats:
        return self.lane.at(0.5 * (stay.begin + stay.end))

    def _is_long_beside(self, stays: Sequence[Stay]) -> bool:
        """Whether it is long beside what stands in it: all along it, and to the side ahead.

        And whether the path has to leave it at all: within the required distance it is on it.
        """
        required = self.leg.requirements.required
        if max((stay.aside for stay in stays), default=0.0) <= required:
            return False
        grown = 2.0 * required
        along = np.maximum(np.diff(self.runs, axis=1) - grown, 0.0).sum()
        sizes = [max(stay.end - stay.begin, stay.aside) - grown for stay in stays]
        ahead = np.maximum(sizes, 0.0).sum()
        return bool(self.lane.length > LONG_LANE * max(along, ahead))

    def is_off(self, place: Floats) -> bool:
        """Whether a place lies beside the line [m], (d,)."""
        off = abs(float(self.lane.seen(place)[1]))
        return off > OFF_LANE * self.leg.requirements.required

    def stays(self, taut_path: TautPath) -> list[Stay]:
        """Where the path can't stay on it: beside it at the leg's ends, and where it is blocked.

        A taut path says on which side what stands there is passed, and how far aside.
        """
        (first, left), (last, left_last) = self.lane.seen(_both(self.leg.ends)).tolist()
        runs = np.clip(self.runs, first, max(first, last))
        places = self.lane.seen(taut_path.corners[:, [CORNER_X, CORNER_Y]])
        stays = [_blocked(places, run) for run in runs[runs[:, 1] > runs[:, 0]]]
        for at, off in ((first, abs(left)), (last, abs(left_last))):
            if off > OFF_LANE * self.leg.requirements.required:
                stays.append(Stay(at, at, off, 0.0, NO_BARRIERS))
        return sorted(stays, key=lambda stay: stay.begin)

    def closed(self, stay: Stay, taut_path: TautPath) -> Stay:
        """A blocked piece with all of what stands there, and what closes its other side."""
        if not stay.size > 0.0:
            return stay
        world, middle = self.leg.world, self._middle(stay)
        index = int(world.nearest(middle)[1])
        barriers = _barriers(world, self.lane, middle, index)
        passed = barriers.left if taut_path.crosses(barriers.left) else barriers.right
        closed = barriers.right if passed is barriers.left else barriers.left
        width = self._width(stay, self.lane.length)
        size = (width if math.isfinite(width) else 0.0) + 2.0 * self.leg.requirements.required
        return replace(stay, size=max(size, stay.size), barriers=closed)


def _both(ends: tuple[Floats, Floats]) -> Floats:
    """The ends of a leg in a row, (2, 2)."""
    return np.array((ends[0][:2], ends[1][:2]))


def _blocked(places: Floats, run: Floats) -> Stay:
    """A blocked piece of a lane, as a taut path with corners at places (k, 2) [m] passes it."""
    begin, end = run.tolist()
    within = places[(places[:, 0] > begin) & (places[:, 0] < end), 1]
    at_ends = np.interp((begin, end), places[:, 0], places[:, 1])
    aside = float(max(np.abs(within).max(initial=0.0), np.abs(at_ends).max()))
    return Stay(begin, end, aside, max(end - begin, aside), NO_BARRIERS)


def _length_beside(places: Floats, beside: float) -> float:
    """Of a polyline, seen from a lane (k, 2), what lies beside it by more than that [m]."""
    steps = np.diff(places, axis=0)
    left, rises = places[:-1, 1], steps[:, 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        at = np.sort((np.array((-beside, beside))[:, None] - left) / rises, axis=0)
    near = np.diff(np.clip(at, 0.0, 1.0), axis=0)[0]
    shares = np.where(rises == 0.0, np.abs(left) <= beside, near)
    return float(((1.0 - shares) * np.hypot(*steps.T)).sum())


def _barriers(world: World, lane: Lane, place: Floats, index: int) -> Barriers:
    """What closes either side of an obstacle that blocks a lane at a place [m], (2,).

    They begin inside of it: a path may pass between it and a lane that it blocks only just.
    """
    ends = lane.start, lane.at(lane.length)
    if index >= 0 and world.obstacles[index].ring is not None:
        return barriers_of(world, index, *ends)
    return barriers_at(world, place, *ends)
