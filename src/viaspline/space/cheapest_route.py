"""The route that is cheapest as a whole, by other ways of its legs or fewer corners of these."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Final, NamedTuple

import numpy as np

from viaspline.space.laying.clear_route import StuckLegError
from viaspline.space.laying.laid_route import RouteLegs
from viaspline.space.laying.otherwise_laid import Change, changes, straight_changes
from viaspline.space.laying.sooner_corners import with_fewer
from viaspline.space.led_route import LedRoute, LedWay, RouteLayer
from viaspline.space.route_law import cost_of

MOST_LEGS: Final = 8
"""Of so many legs at most it is tried for each by itself which of its ways are better."""

LEAST_GAIN: Final = 1e-3
"""Part of the cost of a route that has to be gained by one of these."""

LEAST_SHORTER: Final = 0.02
"""Part of the length of a route that has to be gained by leaving the spline where it is clear."""

MOST_FINISHED: Final = 5
"""So many routes with other ways of their legs are laid with fewer corners and closer turns, at
most,"""

NEARLY: Final = 1.1
"""if they cost no more than that, of the cheapest;"""

OTHER_SIDE: Final = 1.05
"""and beside them the cheapest on each other side that costs no more than that."""

MOST_FEWER: Final = 16
"""So many ways with fewer corners are tried in their route at most."""


class PricedRoute(NamedTuple):
    """A route with what it costs as a whole [s or m]."""

    cost: float
    route: LedRoute


@dataclass(frozen=True, eq=False)
class CheapestRoute:
    """What of the ways of legs makes a route cheapest.

    Attributes:
        layer: Lays it, and knows the ways of its legs.
    """

    layer: RouteLayer

    def routes(self, legs: RouteLegs) -> Sequence[LedRoute]:
        """The route, each leg by whichever of its ways makes the whole of it cheaper.

        Alone, fewer corners are no slower; with neighbours that go on from them they may be.

        Args:
            legs: Of the route, left to the spline.

        Returns:
            That, the one whose clear legs are the spline's, others that were finished beside it,
            the cheaper first, and the one whose legs are the best alone, if those are others: sharp
            turns may be laid more gently there.

        Raises:
            NoPathError: When there is no way, proven.
            GaveUpError: When none was found.
            StuckLegError: When a leg can't be laid.
        """
        try:
            laid = self.layer.lay(legs, {})
        except StuckLegError:  # what was free alone isn't with its neighbours
            return [replace(self.layer, take=attrgetter("taut")).lay(legs, {})]
        if not laid.ways:  # a spline that is clear
            return self._and_straight(self._priced(laid))
        best = self._priced(laid)
        differ = [
            leg
            for leg in sorted(laid.ways)
            if self.layer.led[leg].taut is not self.layer.led[leg].sooner
        ]
        if differ:
            best = self._by_other_ways(legs, best, differ)
        finished = [
            self._laid_sooner(self._with_fewer_corners(legs, one))
            for one in self._best_together(legs, best)
        ]
        finished.sort(key=attrgetter("cost"))
        routes = [*self._and_straight(finished[0]), *(one.route for one in finished[1:])]
        known = any(route is best.route for route in routes)
        return routes if known else [*routes, best.route]

    def _priced(self, route: LedRoute) -> PricedRoute:
        return PricedRoute(cost_of(self.layer.problem)(route.laid), route)

    def _by_other_ways(self, legs: RouteLegs, best: PricedRoute, differ: list[int]) -> PricedRoute:
        """A route with all corners of some of its legs, where that makes the whole of it cheaper.

        Args:
            legs: Of the route, left to the spline.
            best: The route, each leg by those of its corners with which it is the best alone.
            differ: Which legs have others.
        """
        taut = frozenset[int]()
        for which in _others(differ):
            tried = taut ^ which
            ways = {
                leg: self.layer.led[leg].taut if leg in tried else self.layer.led[leg].sooner
                for leg in best.route.ways
            }
            other = self.layer.led_by(legs, ways)
            if other is not None and (priced := self._priced(other)).cost < best.cost:
                best, taut = priced, tried
        return best

    def _best_together(self, legs: RouteLegs, found: PricedRoute) -> Sequence[PricedRoute]:
        """Routes with other ways of their legs that are nearly the cheapest, the cheapest first.

        Legs are led otherwise one after the other, as long as it gets cheaper. What is gained by
        fewer corners and closer turns afterwards is more than what such routes differ by. One leg
        that is all of the route is weighed alone.
        """
        if len(legs.inner) == 1 or len(found.route.ways) > MOST_LEGS:
            return [found]
        best, tried = found, [found]
        for leg in sorted(found.route.ways):
            for way in self.layer.led[leg].others:
                other = self.layer.led_by(legs, {**best.route.ways, leg: way})
                if other is None:
                    continue
                tried.append(self._priced(other))
                if tried[-1].cost < best.cost * (1 - LEAST_GAIN):
                    best = tried[-1]
        tried.sort(key=attrgetter("cost"))
        finished = [one for one in tried if one.cost <= NEARLY * best.cost][:MOST_FINISHED]
        sides = {one.route.sides for one in finished}
        for one in tried:
            if one.cost <= OTHER_SIDE * best.cost and one.route.sides not in sides:
                finished.append(one)
                sides.add(one.route.sides)
        return finished

    def _with_fewer_corners(self, legs: RouteLegs, found: PricedRoute) -> PricedRoute:
        """A route with fewer corners of its legs, as long as the whole of it gets cheaper by that.

        Which corners cost time alone, from rest to rest, was tried before; between its neighbours a
        leg is flown faster. One leg that is all of the route is weighed alone, and where the length
        counts corners cost nothing.
        """
        if len(legs.inner) == 1 or self.layer.problem.objective == "length":
            return found
        best, tried = found, 0
        for leg in sorted(found.route.ways):
            others = self._fewer_of(leg, best.route)
            while tried < MOST_FEWER and (way := next(others, None)) is not None:
                tried += 1
                other = self.layer.led_by(legs, {**best.route.ways, leg: way})
                if other is None:
                    continue
                priced = self._priced(other)
                if priced.cost < best.cost * (1 - LEAST_GAIN):
                    best, others = priced, self._fewer_of(leg, other)
        return best

    def _fewer_of(self, leg: int, route: LedRoute) -> Iterator[LedWay]:
        """The way of a leg with fewer corners: a curve may pass where its lines don't."""
        way, ends = route.ways[leg], route.legs.vias[leg : leg + 2]
        points = np.concatenate((ends[:1], way.inner, ends[1:]))
        for fewer in with_fewer(points, self.layer.radius):
            yield way._replace(inner=fewer[1:-1])

    def _laid_sooner(self, found: PricedRoute) -> PricedRoute:
        """A route with closer turns, or legs that aren't the spline any more, if that is sooner.

        See ``changes``; where the length counts turns are close already.
        """
        gain = LEAST_GAIN if self.layer.problem.objective == "time" else LEAST_SHORTER
        legs = found.route.legs
        return self._changed(found, changes(legs, self.layer.radius, legs.close), gain)

    def _and_straight(self, found: PricedRoute) -> Sequence[LedRoute]:
        """A route, after one with straight ways between turns on clear legs if that is cheaper.

        Where the mission says how taut the spline is to be, clear legs keep it.
        """
        if self.layer.problem.keeps_spline:
            return [found.route]
        legs = found.route.legs
        ways = straight_changes(legs, self.layer.radius, legs.close)
        straight = self._changed(found, ways, LEAST_GAIN)
        return [found.route] if straight is found else [straight.route, found.route]

    def _changed(self, found: PricedRoute, ways: Iterable[Change], gain: float) -> PricedRoute:
        """A route with those of some changes that make it cheaper, one after the other.

        Args:
            found: The route.
            ways: What may be changed.
            gain: Part of its cost that each has to gain.
        """
        best = found
        for change in ways:
            legs = change(best.route.legs)
            if legs.turns_as(best.route.legs):
                continue
            try:
                other = self.layer.laid_anew(legs, best.route)
            except StuckLegError:
                continue
            priced = self._priced(other)
            if priced.cost < best.cost * (1 - gain):
                best = priced
        return best


def _others(differ: list[int]) -> Iterator[frozenset[int]]:
    """Which legs are led by their other way at once: all of them, then each."""
    yield frozenset(differ)
    if 1 < len(differ) <= MOST_LEGS:
        yield from (frozenset([leg]) for leg in differ)
