"""What a robot means to do from now on."""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path, PathVia
from viaspline.robot.navigation.laps_ahead import LapsAhead
from viaspline.robot.navigation.pending_search import PendingSearch
from viaspline.trajectory.slow_zones import Slow
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World


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
class HeldUp:
    """A robot that stands because it knows no way on past what moves.

    Attributes:
        since: When it began [s].
        again: When it looks for one again, if nothing changes there [s].
        seen: What was in sight at the last look that was seen to move: which, since when it is
            where it is [s], and whether it moves.
    """

    since: float
    again: float
    seen: tuple[tuple[int, float, bool], ...]


@dataclass(frozen=True)
class ReducedClearance:
    """A robot that has come closer to something than it should, and is on its way out.

    Attributes:
        until: Distance along the path up to which it keeps less [m].
        floor: Distance that it keeps there from everything known [m].
    """

    until: float
    floor: float

    def moved(self, by: float) -> ReducedClearance:
        """It on a path whose distances count from another place on [m]."""
        return replace(self, until=self.until + by)


@dataclass(frozen=True)
class Schedule:
    """Where a robot means to be when: its path, its trajectory, and how far it trusts them.

    Attributes:
        path: The path; what was driven of it is its beginning. On a route of many laps it is a
            round that goes on at its end, and what lies behind is taken off it now and then.
        trajectory: The time law along it, from the last change on.
        laid_in: What was known when the path was laid.
        laid_at: When it was laid under way [s]; -inf before the first re-plan.
        turns: Distances along the path where the robot turns on the spot, at corners and cusps [m].
        slow: Stretches of the path on which the robot has to be slower, so that it gets no farther
            beside the path than is kept.
        reduced: Where the path keeps less clearance than it should, if it does.
        timed_at: When the trajectory was found [s]; -inf: before the robot set off.
        sighted_until: Up to this distance along the path the robot has seen where its body will
            be [m].
        probed_until: Up to this distance along the path the robot goes though it sees too little
            [m].
        reviewed_at: When it was last asked whether there is a better path [s].
        wait: Since when and why the robot waits, if it does.
        pending: The search for a new path that is not over yet, if there is one.
        held_at: The robot goes no farther along the path while it searches [m].
        committed_until: Up to this time the trajectory stays as it is, because what is to follow
            is still being found [s].
        giving_up: Why the robot brakes for good, if it does.
        laps: What the path goes on with at its end; None if the path was all laps from the start.
        driven: Distance that was driven before the path begins [m].
        gives_way: Whether the trajectory is slower than it could be, for what moves.
        next_way: Which of the ways past what moves is tried next; 0: all were, or none.
        frozen_since: Since when it stands and no step of it is proven to be safe from what may
            come, or meant none [s]; inf if it doesn't.
        frozen_at: How far it had driven when it first stood so [m]; inf if it has come on since.
        frozen_before: For how long it had stood so since then, before it waited for a gap [s].
        waits_for_gap: Whether it stands until what crosses is gone, by a law that goes on then.
        held_up: Set while it stands and knows no way on past what moves.
        proven: The last law from all of which it was proven to stand before anything touches it.
        stays_put: Whether it doesn't correct its place where it rests: it might be touched
            meanwhile.
    """

    path: Path
    trajectory: Trajectory
    laid_in: World
    laid_at: float = -math.inf
    turns: tuple[float, ...] = ()
    slow: tuple[Slow, ...] = ()
    reduced: ReducedClearance | None = None
    timed_at: float = -math.inf
    sighted_until: float = 0.0
    probed_until: float = 0.0
    reviewed_at: float = -math.inf
    wait: Wait | None = None
    pending: PendingSearch | None = None
    held_at: float = math.inf
    committed_until: float = -math.inf
    giving_up: str | None = None
    laps: LapsAhead | None = None
    driven: float = 0.0
    gives_way: bool = False
    next_way: int = 0
    frozen_since: float = math.inf
    frozen_at: float = math.inf
    frozen_before: float = 0.0
    waits_for_gap: bool = False
    held_up: HeldUp | None = None
    proven: Trajectory | None = None
    stays_put: bool = False

    @property
    def is_proven(self) -> bool:
        """Whether from all of the trajectory it stands before anything touches it."""
        return self.trajectory is self.proven

    @property
    def is_blocked(self) -> bool:
        """Whether the robot waits because no way on was found."""
        return self.wait is not None and self.wait.reason is not None

    @property
    def is_round(self) -> bool:
        """Whether the path goes on at its end, where it begins."""
        return self.laps is not None and self.laps.unseen > 0.0

    @property
    def looked_at(self) -> float:
        """Distance along the path up to which it is looked at what is in its way [m]."""
        return self.path.length - (0.0 if self.laps is None else self.laps.unseen)

    def place(self, distance: float) -> tuple[float, ...]:
        """The path's point at a distance along it [m]."""
        return tuple(np.asarray(self.path.at_distance(distance)).tolist())

    def kept(
        self, start: float, end: float, required: float
    ) -> tuple[tuple[float, float, float], ...]:
        """What the path keeps on which stretch of it.

        Args:
            start: From this distance along the path on [m].
            end: Up to this one [m].
            required: Distance that the path keeps where it is not reduced [m].

        Returns:
            In order: from where, to where, and the distance kept from everything known [m].
        """
        if self.reduced is None or self.reduced.until <= start:
            return ((start, end, required),)
        until = min(self.reduced.until, end)
        return ((start, until, self.reduced.floor), (until, end, required))


def vias_after(path: Path, last_via: int) -> tuple[tuple[PathVia, float], ...]:
    """The user's via points of a path that come after one of the route.

    Args:
        path: The path.
        last_via: Index in the route of the last via point that was passed.

    Returns:
        Each with its distance along the path [m], in order.
    """
    stops = path.stops
    return stops[bisect_right(stops, last_via, key=_index) :]


def _index(stop: tuple[PathVia, float]) -> int:
    return -1 if stop[0].index is None else stop[0].index
