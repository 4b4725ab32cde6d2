"""Routes whose legs are led round what stands on them, each by one of the ways that it has.

Tested through ``space/test_solve_route`` and ``space/test_plan_spatial``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from operator import attrgetter
from typing import Final, NamedTuple

import numpy as np

from viaspline.curve.certificate import Certificate
from viaspline.errors import PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.ledger import LedgerEntry, PassingSide
from viaspline.space.laying.clear_route import ClearRoute, StuckLegError, clear_route
from viaspline.space.laying.laid_route import RouteLegs
from viaspline.space.leg_check import LegCheck
from viaspline.space.spatial_account import LedLeg, SpatialAccount, UntoldSides
from viaspline.space.spatial_problem import SpatialProblem, SpatialVia
from viaspline.space.weighed_ways import (
    LegScale,
    WaysPast,
    WeighedWay,
    by_cost,
    corner_radius,
    told,
)

MOST_OTHERS: Final = 6
"""So many ways of a leg are tried in its route at most, beside the one that is the best alone."""

NEARLY: Final = 1.2
"""Ways that cost more alone, of the cheapest, aren't tried there."""


class LedWay(NamedTuple):
    """A way of a leg that is led round something: its corners [m], (k, 3), and its ledger."""

    inner: Floats
    entry: LedgerEntry

    @property
    def side(self) -> PassingSide:
        """On which side of what it is led round it passes."""
        return next(one.side for one in self.entry.candidates if one.chosen)


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

    @property
    def sides(self) -> tuple[PassingSide, ...]:
        """On which side each of these legs passes what it is led round, by leg."""
        return tuple(self.ways[leg].side for leg in sorted(self.ways))


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

    def led_by(self, legs: RouteLegs, ways: Mapping[int, LedWay]) -> LedRoute | None:
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

            def entered(found: Sequence[WeighedWay], taken: WeighedWay) -> LedWay:
                return LedWay(taken.way.inner, LedgerEntry(members, names, told(found, taken)))

            best, least = by_cost(plain)[0], by_cost(better)
            taut = sooner = entered(plain, best)
            if least[0] is not best:
                sooner = entered(better, least[0])
            others = [one for one in least[1:] if one.cost <= NEARLY * least[0].cost]
            self.known[key] = LedWays(
                taut, sooner, [entered(better, one) for one in others[:MOST_OTHERS]], untold
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
