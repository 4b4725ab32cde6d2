"""Routes whose legs are led round what stands on them, by their ways or by fewer corners of these.

Tested through ``space/test_solve_route`` and ``space/test_plan_spatial``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from operator import attrgetter
from typing import Final, NamedTuple

import numpy as np

from viaspline.curve.certificate import Certificate
from viaspline.errors import PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.ledger import LedgerEntry
from viaspline.space.laying.clear_route import ClearRoute, StuckLegError, clear_route
from viaspline.space.laying.laid_route import RouteLegs
from viaspline.space.laying.otherwise_laid import changes
from viaspline.space.laying.sooner_corners import with_fewer
from viaspline.space.laying.via_turns import ROOMY
from viaspline.space.leg_check import LegCheck
from viaspline.space.route_law import cost_of
from viaspline.space.spatial_account import LedLeg, SpatialAccount, UntoldSides
from viaspline.space.spatial_problem import SpatialProblem, SpatialVia
from viaspline.space.weighed_ways import (
    LegScale,
    WaysPast,
    WeighedWay,
    by_cost,
    corner_radius,
    least_radius,
    told,
)

MOST_LEGS: Final = 8
"""Of so many legs at most it is tried for each by itself which of its ways are better."""

MOST_OTHERS: Final = 6
"""So many ways of a leg are tried in its route at most, beside the one that is the best alone."""

NEARLY: Final = 1.2
"""Ways that cost more alone, of the cheapest, aren't tried there."""

LEAST_GAIN: Final = 1e-3
"""Part of the cost of a route that has to be gained by one of these."""

LEAST_SHORTER: Final = 0.02
"""Part of the length of a route that has to be gained by leaving the spline where it is clear."""

MOST_FEWER: Final = 16
"""So many ways with fewer corners are tried in their route at most."""


class LedWay(NamedTuple):
    """A way of a leg that is led round something: its corners [m], (k, 3), and its ledger."""

    inner: Floats
    entry: LedgerEntry


class LedWays(NamedTuple):
    """The best taut way, and the best with fewer corners, which is no slower alone.

    Others are as well, nearly; the best first. On sides on which none was looked for there may be
    more, past what was nearest; None: it was looked for on all.
    """

    taut: LedWay
    sooner: LedWay
    others: Sequence[LedWay]
    untold: Certificate | None


KnownWays = dict[tuple[SpatialVia, SpatialVia, str | None], LedWays]
"""The ways of legs that were looked for, by their via points and what is nearest to their curve.

Routes of problems that differ in their via points alone share them.
"""


@dataclass(frozen=True)
class LedRoute(ClearRoute):
    """A route, and the ways of the legs that are led round something."""

    ways: Mapping[int, LedWay]


@dataclass(frozen=True, eq=False)
class RouteLayer:
    """Lays routes of a problem, each way past a thing looked for once.

    Attributes:
        problem: What is asked.
        router: Finds the ways past things.
        check: What every leg has to pass.
        take: Which of the ways of a leg it is led by.
        known: Those that were found, whoever looked for them.
        led: Those by which legs are led, by leg.
        untold: Of which of these the ways on other sides weren't weighed, by leg.
    """

    problem: SpatialProblem
    router: WaysPast
    check: LegCheck
    take: Callable[[LedWays], LedWay] = attrgetter("sooner")
    known: KnownWays = field(default_factory=dict)
    led: dict[int, LedWays] = field(default_factory=dict)
    untold: dict[int, LedLeg] = field(default_factory=dict)

    @property
    def radius(self) -> float:
        """Of curvature, to be had if there is room [m]."""
        return corner_radius(self.problem)

    def cheapest(self, legs: RouteLegs) -> Sequence[LedRoute]:
        """The route, each leg by whichever of its ways makes the whole of it cheaper.

        Alone, fewer corners are no slower; with neighbours that go on from them they may be.

        Args:
            legs: Of the route, left to the spline.

        Returns:
            That, and the one whose legs are the best alone if that is another: sharp turns may be
            laid more gently there.

        Raises:
            NoPathError: When there is no way, proven.
            GaveUpError: When none was found.
            StuckLegError: When a leg can't be laid.
        """
        try:
            best = self.lay(legs, {})
        except StuckLegError:  # what was free alone isn't with its neighbours
            return [replace(self, take=attrgetter("taut")).lay(legs, {})]
        differ = [
            leg for leg in sorted(best.ways) if self.led[leg].taut is not self.led[leg].sooner
        ]
        if differ:
            best = self._by_other_ways(legs, best, differ)
        together = self._with_fewer_corners(legs, self._best_together(legs, best))
        together = self._laid_sooner(together)
        return [best] if together is best else [together, best]

    def _by_other_ways(self, legs: RouteLegs, best: LedRoute, differ: list[int]) -> LedRoute:
        """A route with all corners of some of its legs, where that makes the whole of it cheaper.

        Args:
            legs: Of the route, left to the spline.
            best: The route, each leg by those of its corners with which it is the best alone.
            differ: Which legs have others.
        """
        cost = cost_of(self.problem)
        least, taut = cost(best.laid), frozenset[int]()
        for which in _others(differ):
            tried = taut ^ which
            ways = {
                leg: self.led[leg].taut if leg in tried else self.led[leg].sooner
                for leg in best.ways
            }
            other = self._led_by(legs, ways)
            if other is not None and (price := cost(other.laid)) < least:
                best, least, taut = other, price, tried
        return best

    def _best_together(self, legs: RouteLegs, found: LedRoute) -> LedRoute:
        """A route with other ways of its legs, one after the other, as long as it gets cheaper.

        One leg that is all of the route is weighed alone.
        """
        if len(legs.inner) == 1 or len(found.ways) > MOST_LEGS:
            return found
        cost = cost_of(self.problem)
        best, least = found, cost(found.laid)
        for leg in sorted(found.ways):
            for way in self.led[leg].others:
                other = self._led_by(legs, {**best.ways, leg: way})
                if other is None or (price := cost(other.laid)) >= least * (1 - LEAST_GAIN):
                    continue
                best, least = other, price
        return best

    def _with_fewer_corners(self, legs: RouteLegs, found: LedRoute) -> LedRoute:
        """A route with fewer corners of its legs, as long as the whole of it gets cheaper by that.

        Which corners cost time alone, from rest to rest, was tried before; between its neighbours a
        leg is flown faster. One leg that is all of the route is weighed alone, and where the length
        counts corners cost nothing.
        """
        if len(legs.inner) == 1 or self.problem.objective == "length":
            return found
        cost = cost_of(self.problem)
        best, least, tried = found, cost(found.laid), 0
        for leg in sorted(found.ways):
            others = self._fewer_of(leg, best)
            while tried < MOST_FEWER and (way := next(others, None)) is not None:
                tried += 1
                other = self._led_by(legs, {**best.ways, leg: way})
                if other is not None and (price := cost(other.laid)) < least * (1 - LEAST_GAIN):
                    best, least, others = other, price, self._fewer_of(leg, other)
        return best

    def _fewer_of(self, leg: int, route: LedRoute) -> Iterator[LedWay]:
        """The way of a leg with fewer corners: a curve may pass where its lines don't."""
        way, ends = route.ways[leg], route.legs.vias[leg : leg + 2]
        points = np.concatenate((ends[:1], way.inner, ends[1:]))
        for fewer in with_fewer(points, self.radius):
            yield way._replace(inner=fewer[1:-1])

    def _laid_sooner(self, found: LedRoute) -> LedRoute:
        """A route with closer turns, or legs that aren't the spline any more, if that is sooner.

        See ``changes``; where the length counts turns are close already.
        """
        close = ROOMY * least_radius(self.problem)
        others = list(changes(found.legs, self.radius, close))
        if not others:
            return found
        gain = LEAST_GAIN if self.problem.objective == "time" else LEAST_SHORTER
        cost = cost_of(self.problem)
        best, least = found, cost(found.laid)
        for change in others:
            try:
                other = self.laid_anew(change(best.legs), best)
            except StuckLegError:
                continue
            if (price := cost(other.laid)) < least * (1 - gain):
                best, least = other, price
        return best

    def lay(self, legs: RouteLegs, before: Mapping[int, LedWay]) -> LedRoute:
        """The route with what isn't clear of it led round.

        Args:
            legs: Of the route.
            before: The ways of those that are led round something already.

        Raises:
            NoPathError: When there is no way, proven.
            GaveUpError: When none was found.
            StuckLegError: When a leg can't be laid.
        """
        ways = dict(before)

        def lead_round(leg: int, laid: Floats) -> Floats:
            found = self.led[leg] = self._ways(leg, laid)
            self.untold.pop(leg, None)
            if found.untold is not None:
                self.untold[leg] = LedLeg(leg, found.untold)
            ways[leg] = self.take(found)
            return ways[leg].inner

        found = clear_route(legs, self.check, lead_round, self.radius)
        return LedRoute(found.legs, found.laid, ways)

    def laid_anew(self, legs: RouteLegs, before: LedRoute) -> LedRoute:
        """A route with some of its legs laid in another way; StuckLegError: it can't be."""
        try:
            return self.lay(legs, before.ways)
        except PlanningError as error:
            raise StuckLegError(0, np.array(error.where)) from None

    def account(self, found: LedRoute) -> SpatialAccount:
        """What the search for a route did."""
        led = sorted(found.ways)
        untold = {k: self.untold[leg] for k, leg in enumerate(led) if leg in self.untold}
        others = UntoldSides(self.problem, self.router, untold) if untold else None
        return SpatialAccount(tuple(found.ways[leg].entry for leg in led), others)

    def _led_by(self, legs: RouteLegs, ways: Mapping[int, LedWay]) -> LedRoute | None:
        """A route some legs of which are led by these ways; None: it can't be laid."""
        for leg, way in ways.items():
            legs = legs.led_round(leg, way.inner, self.radius)
        try:
            return self.lay(legs, ways)
        except (StuckLegError, PlanningError):
            return None

    def _ways(self, leg: int, laid: Floats) -> LedWays:
        problem, nearest = self.problem, self.check.proof(laid)
        key = problem.vias[leg], problem.vias[leg + 1], nearest.obstacle
        if key not in self.known:
            names = problem.vias[leg].name, problem.vias[leg + 1].name
            members = () if nearest.obstacle is None else (nearest.obstacle,)
            scale = LegScale(problem, self.check, leg)
            plain, untold = self._weighed(scale, nearest)
            better = scale.sooner(plain)

            def led_by(found: Sequence[WeighedWay], taken: WeighedWay) -> LedWay:
                return LedWay(taken.way.inner, LedgerEntry(members, names, told(found, taken)))

            best, least = by_cost(plain)[0], by_cost(better)
            taut = sooner = led_by(plain, best)
            if least[0] is not best:
                sooner = led_by(better, least[0])
            others = [one for one in least[1:] if one.cost <= NEARLY * least[0].cost]
            self.known[key] = LedWays(
                taut, sooner, [led_by(better, one) for one in others[:MOST_OTHERS]], untold
            )
        return self.known[key]

    def _weighed(
        self, scale: LegScale, nearest: Certificate
    ) -> tuple[Sequence[WeighedWay], Certificate | None]:
        """The ways of a leg that may be taken, with what they cost; and past what more may be."""
        ways = self.router.ways(scale.leg, nearest)
        if not self.router.defers(nearest):
            return scale.weighed(ways), None
        try:
            return scale.untimed(ways), nearest
        except StuckLegError:  # others may be laid
            return scale.weighed([*ways, *self.router.others(scale.leg, nearest)]), None


def _others(differ: list[int]) -> Iterator[frozenset[int]]:
    """Which legs are led by their other way at once: all of them, then each."""
    yield frozenset(differ)
    if 1 < len(differ) <= MOST_LEGS:
        yield from (frozenset([leg]) for leg in differ)
