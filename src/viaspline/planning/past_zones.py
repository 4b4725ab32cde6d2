"""A path round speed zones, where one through them loses more than the way round takes.

A zone stands in nobody's way, so nothing leads round it by itself. Here zones are taken for
obstacles: a path that leaves them out is laid as any other, and taken where it is sooner.
"""

from __future__ import annotations

import heapq
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from operator import attrgetter

import numpy as np

from viaspline.curve.path import Path
from viaspline.errors import PlanningError
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.mission.world_spec import SpeedZone
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.alternatives.record import Account, ThroughZones
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.checking.driving_time import driving_time, lost_in_zones, straight_time
from viaspline.planning.plan_path import find_path, lay_path
from viaspline.planning.problem.method import Found
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.routing.path_problem import PathProblem
from viaspline.world.world import World
from viaspline.world.zone_obstacles import zone_obstacles

MOST_ROUTED, MOST_LAID = 12, 3
"""Choices of zones to leave out for which ways are looked for, and those that are laid."""

LEAST_LOST = 0.002
"""Of the time: what is lost in a zone that is left out, and what another path has to save."""


def find_path_past_zones(
    sequence: ViaSequence, world: World, requirements: Requirements
) -> Solution:
    """A proven path, round the speed zones that it is sooner without.

    A zone near which a via point lies is driven through. So are all of them under way, where a
    search has a budget.

    Raises:
        NoPathError: When there is none, with the least change that would serve.
        GaveUpError: When a budget ran out before that was known.
    """
    found = find_path(sequence, world, requirements)
    objective = requirements.objective
    if not (objective.is_time and objective.pace.zones) or requirements.budget is not None:
        return found
    assert isinstance(found.account, Account)
    through = found.account.spline_path
    laid = _PastZones(sequence, world, requirements).soonest(through)
    if laid is None:
        return found
    spline_path, account = laid
    path = Path(spline_path.spans, spline_path.vias)
    names = frozenset(account.world.names[len(world) :])
    kept = replace(account, measured_in=world, through=ThroughZones(names, through))
    return Solution(path, proven(path, world, requirements), kept)


@dataclass(frozen=True)
class _Choice:
    """Zones that are left out together.

    Attributes:
        world: With them as obstacles.
        least: No path takes less [s].
        likely: What the shortest one takes, but for its turns [s].
        met: The zones that this one loses time in, of those that may be left out.
    """

    world: World
    least: float
    likely: float
    met: frozenset[int]


@dataclass(frozen=True)
class _PastZones:
    """Paths through via points that leave out speed zones.

    Attributes:
        sequence: The via points.
        world: The known world.
        requirements: What to keep.
    """

    sequence: ViaSequence
    world: World
    requirements: Requirements

    def soonest(self, through: SplinePath) -> tuple[SplinePath, Account] | None:
        """The soonest path that is found; None where none is sooner than what was laid.

        Args:
            through: What was laid.
        """
        bound = (1.0 - LEAST_LOST) * self._time(through)
        best: tuple[SplinePath, Account] | None = None
        for choice in heapq.nsmallest(MOST_LAID, self._choices(through), key=attrgetter("likely")):
            laid = self._laid(choice) if choice.likely < bound else None
            if laid is not None and self._time(laid[0]) < bound:
                best, bound = laid, self._time(laid[0])
        return best

    def _choices(self, through: SplinePath) -> Iterator[_Choice]:
        """What may be left out: what a path meets, what ways round that meet besides, and each.

        Where a path keeps out of a zone already, it may go round the wrong side of something else
        for that: so what the shortest way meets may be left out as well, and all. Of choices with
        the same way, past zones of which a path loses time in the same ones, the first counts.

        Args:
            through: What was laid.
        """
        losing, shortest = self._losing(through), self._choice(frozenset())
        met = frozenset() if shortest is None else shortest.met
        queue = deque([losing, met, frozenset(self._open), *(frozenset({k}) for k in self._open)])
        seen = {frozenset[int]()}
        ways = set() if shortest is None else {(shortest.least, shortest.likely, frozenset[int]())}
        while queue and len(seen) <= MOST_ROUTED:
            zones = queue.popleft()
            choice = None if zones in seen else self._choice(zones)
            seen.add(zones)
            if choice is None:
                continue
            queue.appendleft(zones | choice.met)
            way = choice.least, choice.likely, zones & losing
            if way not in ways:
                ways.add(way)
                yield choice

    def _losing(self, laid: SplinePath) -> frozenset[int]:
        """The zones that may be left out and in which a path loses time."""
        zones, whole = self.requirements.objective.pace.zones, self._time(laid)
        without = {k: self._time(laid, (*zones[:k], *zones[k + 1 :])) for k in self._open}
        return frozenset(k for k in self._open if whole - without[k] > LEAST_LOST * whole)

    @cached_property
    def _open(self) -> list[int]:
        """The zones that may be left out: every via point has room beside them."""
        places = np.array([via.at[:2] for via in self.sequence.vias])
        required = self.requirements.required
        blocks = [
            World(zone_obstacles((zone,), required))
            for zone in self.requirements.objective.pace.zones
        ]
        return [k for k, one in enumerate(blocks) if (one.distance(places) > required).all()]

    def _choice(self, zones: frozenset[int]) -> _Choice | None:
        """What leaving out zones comes to; None where there is no way."""
        needs, pace = self.requirements, self.requirements.objective.pace
        blocks = zone_obstacles([pace.zones[k] for k in sorted(zones)], needs.required)
        problem = PathProblem.of(self.sequence, self.world.with_obstacles(blocks), needs)
        least = run = 0.0
        lost = np.zeros(len(pace.zones))
        for k, sides in enumerate(problem.sides):
            leg = LegSearch(self.sequence, k, problem.world, needs, problem.router, sides)
            outcome, _ = leg.shortest_allowed(np.zeros(len(problem.world), np.bool_))
            if not isinstance(outcome, Found):
                return None
            way = outcome.value
            run += way.length
            if leg.stands[1] or k == len(problem.sides) - 1:
                least, run = least + straight_time(run, pace), 0.0
            corners = way.corners[:, X : Y + 1]
            lost += [lost_in_zones(corners, replace(pace, zones=(zone,))) for zone in pace.zones]
        met = frozenset(k for k in self._open if lost[k] > 0.0)
        return _Choice(problem.world, least, least + float(lost.sum()), met)

    def _laid(self, choice: _Choice) -> tuple[SplinePath, Account] | None:
        """The path that leaves out what is chosen; None where none is found."""
        try:
            return lay_path(self.sequence, choice.world, self.requirements)
        except PlanningError:
            return None

    def _time(self, laid: SplinePath, zones: tuple[SpeedZone, ...] | None = None) -> float:
        """In which a path is driven [s].

        Args:
            laid: The path.
            zones: In these speed zones; None: in all that there are.
        """
        pace = self.requirements.objective.pace
        if zones is not None:
            pace = replace(pace, zones=zones)
        return driving_time(laid.spans, pace, laid.rests(self.sequence))
