"""Which speed zones a path had better leave out, told by the shortest ways of its legs.

A way is not yet a path: it doesn't know of turns. It takes a routing to find, and tells within some
percent what a path along it takes, so few paths have to be laid.

Tested through ``planning/test_past_zones``.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from operator import attrgetter

import numpy as np

from viaspline.curve.slow_parts import slow_parts
from viaspline.kernels.arrays import Floats
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.checking.driving_time import lost_in_zones
from viaspline.planning.problem.method import Found
from viaspline.planning.problem.path_pace import Pace
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.routing.path_problem import PathProblem
from viaspline.world.world import World
from viaspline.world.zone_obstacles import zone_obstacles

MOST_WAYS = 6
"""Of a leg, each without other zones."""

FEW_LEGS = 8
"""So many are tried without any zone as well."""

Zones = frozenset[int]
"""Indices of the zones of a pace."""

NONE: Zones = frozenset()


@dataclass(frozen=True)
class ZoneWay:
    """The shortest way of a leg without some zones.

    Attributes:
        without: Those zones.
        takes: At full speed, but for the zones that it meets [s].
        met: Those of them that may be left out.
        corners: It [m], (n, 2).
    """

    without: Zones
    takes: float
    met: Zones
    corners: Floats


@dataclass(frozen=True)
class ZoneChoices:
    """Speed zones that a path may leave out.

    Attributes:
        sequence: The via points.
        world: The known world, without zones.
        requirements: What to keep.
        through: The path that was laid as if zones were nothing to go round.
    """

    sequence: ViaSequence
    world: World
    requirements: Requirements
    through: SplinePath

    def without(self, zones: Zones) -> World:
        """The world with zones as obstacles."""
        return self.world.with_obstacles(chain(*(self._blocks[k] for k in sorted(zones))))

    def worth_a_path(self) -> Iterator[Zones]:
        """Zones to leave out together, the likeliest first.

        Those that each leg is sooner without; then without those that another leg is sooner
        through. Turns are wider than a way, and may meet a zone that the way hardly passes: so a
        path of few legs may leave out all.
        """
        best = [self._soonest(leg) for leg in range(len(self.sequence.legs))]
        together = NONE.union(*(way.without for way in best))
        through = NONE.union(*(way.met for way in best))
        choices = [together, together - through]
        if len(best) <= FEW_LEGS and any(self._may_meet(leg) for leg in range(len(best))):
            choices.append(self._open)
        return (zones for zones in dict.fromkeys(choices) if zones)

    @property
    def _pace(self) -> Pace:
        return self.requirements.objective.pace

    @cached_property
    def _blocks(self) -> list[tuple[Obstacle, ...]]:
        """Each zone as obstacles."""
        return [zone_obstacles((one,), self.requirements.required) for one in self._pace.zones]

    @cached_property
    def _open(self) -> Zones:
        """The zones that may be left out: every via point has room beside them."""
        places = np.array([via.at[:2] for via in self.sequence.vias])
        rooms = (World(blocks).distance(places).min() for blocks in self._blocks)
        return frozenset(k for k, room in enumerate(rooms) if room > self.requirements.required)

    @cached_property
    def _boxes(self) -> Floats:
        """The least and the greatest x and y of each zone [m], (n, 2, 2)."""
        corners = [zone.corners for zone in self._pace.zones]
        return np.array([(ring.min(axis=0), ring.max(axis=0)) for ring in corners])

    def _near(self, places: Floats, within: float = 0.0) -> Iterable[int]:
        """The zones whose boxes meet that of some places (n, 2) [m], grown by ``within`` [m]."""
        low, high = places.min(axis=0) - within, places.max(axis=0) + within
        apart = (self._boxes[:, 0] > high) | (self._boxes[:, 1] < low)
        near: list[int] = np.flatnonzero(~apart.any(axis=1)).tolist()
        return near

    @cached_property
    def _losing(self) -> list[Zones]:
        """The zones that may be left out and that each leg of what was laid leads through."""
        legs = (self.through.leg(leg)[:, :, :2] for leg in range(len(self.sequence.legs)))
        return [
            frozenset(
                k
                for k in self._open.intersection(self._near(spans.reshape(-1, 2)))
                if slow_parts(spans, [self._pace.zones[k]])
            )
            for spans in legs
        ]

    def _soonest(self, leg: int) -> ZoneWay:
        """The way of a leg that takes least, without as few zones as that takes."""
        plain = self._way(leg, NONE)
        if plain is None:
            return ZoneWay(NONE, np.inf, NONE, np.empty((0, 2)))
        met = plain.met | self._losing[leg]
        queue, ways = deque([met, *(frozenset({k}) for k in sorted(met))]), {NONE: plain}
        while queue and len(ways) < MOST_WAYS:
            zones = queue.popleft()
            way = None if zones in ways else self._way(leg, zones)
            if way is not None:
                ways[zones] = way
                queue.appendleft(zones | way.met)
        return min(ways.values(), key=attrgetter("takes"))

    def _may_meet(self, leg: int) -> bool:
        """Whether a leg leads through a zone that may be left out, or its shortest way close by."""
        way = self._way(leg, NONE)
        return way is not None and bool(self._losing[leg] or self._beside(way.corners))

    def _beside(self, corners: Floats) -> Zones:
        """Zones that may be left out, and that a way (n, 2) [m] passes as it does what stands."""
        import shapely

        way, required = shapely.LineString(corners), self.requirements.required
        near = self._open.intersection(self._near(corners, required))
        areas = {k: shapely.Polygon(self._pace.zones[k].corners) for k in near}
        return frozenset(k for k, area in areas.items() if way.distance(area) < required)

    def _way(self, leg: int, zones: Zones) -> ZoneWay | None:
        """The shortest way of a leg without some zones, if there is one."""
        if (leg, zones) not in self._ways:
            self._ways[leg, zones] = self._routed(leg, zones)
        return self._ways[leg, zones]

    @cached_property
    def _ways(self) -> dict[tuple[int, Zones], ZoneWay | None]:
        """Ways that were looked for: the same are asked for more than once."""
        return {}

    def _routed(self, leg: int, zones: Zones) -> ZoneWay | None:
        if zones not in self._problems:
            self._problems[zones] = PathProblem.of(
                self.sequence, self.without(zones), self.requirements
            )
        problem = self._problems[zones]
        search = LegSearch(
            self.sequence, leg, problem.world, self.requirements, problem.router,
            problem.sides[leg],
        )  # fmt: skip
        outcome, _ = search.shortest_allowed(np.zeros(len(problem.world), np.bool_))
        if not isinstance(outcome, Found):
            return None
        corners = outcome.value.corners[:, X : Y + 1]
        takes, met = outcome.value.length / self._pace.speed, set[int]()
        for k in self._near(corners):
            lost = lost_in_zones(corners, replace(self._pace, zones=(self._pace.zones[k],)))
            takes += lost
            if lost > 0.0:
                met.add(k)
        return ZoneWay(zones, takes, self._open & met, corners)

    @cached_property
    def _problems(self) -> dict[Zones, PathProblem]:
        """Problems of ways without zones: several legs have the same."""
        return {}
