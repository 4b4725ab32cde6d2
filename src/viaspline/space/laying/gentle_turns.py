"""Turns that are no sharper than a radius, where there is room for it.

The spline doubles back at a via point within millimetres where its next one lies behind it, and
overshoots where its direction is given. A leg that is sharper than asked for is laid anew as a
polygon with rounded corners, as legs are that are led round something: through a via point that has
no direction across the middle of its turn or along what is near, and from one that has by an arc
towards what is next. What comes behind such a turn is pulled taut from where it ends, for the taut
way from the via point itself has no room beside it. Corners that are close together become fewer.
What isn't clear then, or no gentler, is left as it was.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, Generic, NamedTuple, TypeVar

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.space.laying.clear_route import ClearRoute, StuckLegError
from viaspline.space.laying.fewer_corners import fewer_corners
from viaspline.space.laying.laid_route import LaidRoute, RouteLegs
from viaspline.space.laying.turn_arcs import arc, asides
from viaspline.space.laying.turn_ways import (
    LEAST_WAY,
    Away,
    across_turn,
    beside,
    head_of,
    other_ways,
)
from viaspline.space.laying.via_turns import ROOMY

ROUND: Final = 0.999
"""A turn that is this near to the least radius is as round."""

ARC_SHARE: Final = 0.77
"""The radius in the middle of such a corner, of the arc's: it is gentler before and after."""

LEAST_GAIN: Final = 0.002
"""By so many orders of magnitude at least a turn has to get gentler, if not round enough."""

DEARER: Final = 1.02
"""So much more a turn may cost that gets gentler, and still isn't round enough."""

ROUND_DEARER: Final = 1.2
"""So much more one may cost that gets round enough, where time counts."""

NO_RADIUS_M: Final = 1e-6
"""What is sharper is as good as a corner."""

CORNER: Final = 1e-4
"""What turns by more than that at a joint [rad] is a corner."""

Route = TypeVar("Route", bound=ClearRoute)

Lay = Callable[[RouteLegs, Route], Route]
"""Lays a clear route anew, some legs of which are another way now; StuckLegError: it can't be."""

Cost = Callable[[LaidRoute], float]
"""What a curve costs to fly: time or length."""


Pull = Callable[[int, Floats], Floats | None]
"""From a leg and a way (n, d) [m] to the corners of that way pulled taut, (k, d); None: it isn't
free."""


class _Turn(NamedTuple):
    """A leg that is too sharp, and what it is sharp near by.

    Attributes:
        leg: Which one.
        via: The via point at its end that is nearer.
        corner: Which of its corners is nearer than that; -1: none.
        radius: How sharp it is [m].
    """

    leg: int
    via: int
    corner: int
    radius: float


@dataclass(frozen=True)
class GentleTurns(Generic[Route]):
    """What turns are to be like.

    Attributes:
        least: The radius that is round enough [m].
        radius: Of curvature, to be had if there is room [m].
        lay: Lays a route.
        cost: What a curve costs.
        away: From what is near.
        pull: Pulls ways taut.
        is_rolling: Whether the robot is under way where the route begins: it can't turn there.
        dearer: So much more a turn may cost that gets round enough.
    """

    least: float
    radius: float
    lay: Lay[Route]
    cost: Cost
    away: Away
    pull: Pull
    is_rolling: bool = False
    dearer: float = ROUND_DEARER

    def of(self, found: Route) -> Route:
        """A clear route with its sharp turns laid gently, as far as that can be."""
        tried: set[_Turn] = set()
        while left := [turn for turn in self._sharp(found) if turn not in tried]:
            tried.add(left[0])
            found = self._bent(found, left[0])
        return found

    def best_of(self, routes: Sequence[Route]) -> Route:
        """The cheapest of some clear routes with their sharp turns laid gently.

        One that stays sharp counts for as much more as it may cost to get round. Those that cost as
        much before that aren't looked at.
        """
        best, least = self.of(routes[0]), math.inf
        for route in routes[1:]:
            least = min(least, self._price(best))
            if self.cost(route.laid) >= least:
                continue
            gentle = self.of(route)
            if (price := self._price(gentle)) < least:
                best, least = gentle, price
        return best

    def _price(self, route: Route) -> float:
        """What a route costs, or more where it is too sharp."""
        return self.cost(route.laid) * (self.dearer if self._lack(route) > 0.0 else 1.0)

    def _sharp(self, found: ClearRoute) -> Iterator[_Turn]:
        """The legs of a route that are too sharp, each with what is near to where."""
        for leg in range(len(found.legs.inner)):
            spans = found.laid.leg(leg)
            radius, u = _sharpest(spans)
            if radius < ROUND * self.least:
                curve = Path(spans, [])
                at = float(curve.distance(u))
                joints = found.laid.detours[leg] - found.laid.joints[leg]
                corners = np.abs(np.asarray(curve.distance(joints.astype(float))) - at)
                corner = int(np.argmin(corners)) if len(corners) else -1
                if corner >= 0 and min(at, curve.length - at) < corners[corner]:
                    corner = -1
                via = leg + int(at > 0.5 * curve.length)
                yield _Turn(leg, via, corner, round(radius, 6))

    def _bent(self, found: Route, turn: _Turn) -> Route:
        """A route with one of its turns laid anew; itself, where that gains nothing."""
        best, rank = found, (max(self._lack(found) - LEAST_GAIN, 0.0), math.inf)
        most = self.cost(found.laid)
        for several in self._other_turns(found, turn):
            for legs in several:
                try:
                    laid = self.lay(legs, found)
                except StuckLegError:
                    continue
                its = self._lack(laid)
                if its > rank[0] or (its, cost := self.cost(laid.laid)) >= rank:
                    continue
                dearer = self.dearer if self._is_round(laid, turn) else DEARER
                if cost <= dearer * most:
                    best, rank = laid, (its, cost)
            if self._is_round(best, turn) and rank[1] <= DEARER * most:
                break
        return best

    def _is_round(self, found: ClearRoute, turn: _Turn) -> bool:
        """Whether a leg isn't too sharp any more."""
        return _sharpest(found.laid.leg(turn.leg))[0] >= ROUND * self.least

    def _lack(self, found: ClearRoute) -> float:
        """By how much the legs of a route are too sharp together, each by orders of magnitude."""
        sharpest = (_sharpest(found.laid.leg(leg))[0] for leg in range(len(found.legs.inner)))
        sharp = (max(radius, NO_RADIUS_M) for radius in sharpest if radius < ROUND * self.least)
        return sum(max(round(math.log10(self.least / radius), 3), 1e-3) for radius in sharp)

    def _other_turns(self, found: Route, turn: _Turn) -> Iterator[Iterator[RouteLegs]]:
        """Ways to turn in place of the one that is too sharp, the likelier ones first."""
        legs, via = found.legs, turn.via
        if turn.corner >= 0:
            yield self._with_fewer_corners(legs, turn)
        if 0 < via < len(legs.vias) - 1 and np.isnan(legs.given[via]).any():
            joint = found.laid.joints[via]
            own = found.laid.spans[joint, 1] - found.laid.spans[joint, 0]
            own = own / np.linalg.norm(own)
            middle = across_turn(beside(legs, via, -1), beside(legs, via, 1))
            yield self._through(legs, via, (middle, own))
            yield self._through(legs, via, other_ways(legs, via, own, self.away(legs.vias[via])))
            yield self._with_one_close_leg(legs, via, (middle, own))
        elif not self.is_rolling or via > 0:
            yield self._from_end(legs, turn)

    def _with_fewer_corners(self, legs: RouteLegs, turn: _Turn) -> Iterator[RouteLegs]:
        """Ways to have fewer corners where one of a leg is too sharp."""
        inner = legs.inner[turn.leg]
        assert inner is not None  # it has a corner
        radii = legs.radii[turn.leg]
        points = np.concatenate((legs.vias[turn.leg][None], inner, legs.vias[turn.leg + 1][None]))
        for first, last, instead in fewer_corners(points, turn.corner + 1, ROOMY * self.least):
            corners = np.concatenate((points[1:first], instead, points[last + 1 : -1]))
            wide = np.full(len(instead), self.radius)
            its = np.concatenate((radii[:first], wide, radii[last + 1 :]))
            yield legs.with_polygon(turn.leg, corners, its)

    def _through(self, legs: RouteLegs, via: int, ways: Iterable[Floats]) -> Iterator[RouteLegs]:
        """Ways to turn at a via point that has no direction, through it along one of these."""
        wanted = ROOMY * self.least
        for way in ways:
            through = legs.through(via, way)
            for radius, rest in self._radii(wanted, self.radius):
                before = self._turning(through, via - 1, via, radius, rest)
                yield self._turning(before, via, via, radius, rest)

    def _with_one_close_leg(
        self, legs: RouteLegs, via: int, ways: Iterable[Floats]
    ) -> Iterator[RouteLegs]:
        """Ways to turn at a via point with close corners on one leg beside it, wide on one."""
        wanted = ROOMY * self.least
        for way in ways:
            through = legs.through(via, way)
            for before, after in ((wanted, self.radius), (self.radius, wanted)):
                begun = self._turning(through, via - 1, via, wanted, before)
                yield self._turning(begun, via, via, wanted, after)

    def _radii(self, *of_turn: float) -> Iterator[tuple[float, float | None]]:
        """Radii of a turn and of other corners; see ``_turning``."""
        wanted = of_turn[0]
        for radius in dict.fromkeys(of_turn):
            yield radius, self.radius
        yield wanted, None
        if not self.is_rolling and wanted != self.radius:
            yield wanted, wanted

    def _from_end(self, legs: RouteLegs, turn: _Turn) -> Iterator[RouteLegs]:
        """Ways to turn towards what is next where a leg ends in a direction that is given."""
        wanted, way = ROOMY * self.least, legs.given[turn.via]
        if not np.isnan(way).any():
            for aside in asides(legs, turn.leg, turn.via, way):
                begun = arc(legs, turn.leg, turn.via, way, aside, wanted / ARC_SHARE)
                for radius, rest in self._radii(wanted):
                    yield self._turning(legs, turn.leg, turn.via, radius, rest, begun)
        for radius, rest in self._radii(wanted):
            yield self._turning(legs, turn.leg, turn.via, radius, rest)

    def _turning(
        self, legs: RouteLegs, leg: int, via: int, radius: float, rest: float | None,
        begun: Floats | None = None,
    ) -> RouteLegs:  # fmt: skip
        """A route with one leg a polygon that turns by a radius [m] at one of its ends.

        Its corners are those of the taut way between where it has turned at its ends.

        Args:
            legs: Of the route.
            leg: Which one it is.
            via: The via point at that end.
            radius: There.
            rest: At its other corners and its other end [m]; None: at that end as it is.
            begun: Corners that it turns at from that via point on [m], (k, d).
        """
        inner = legs.inner[leg]
        corners = legs.vias[:0] if inner is None else inner
        other = self.radius if rest is None else rest
        if rest is None and inner is not None:
            other = float(legs.radii[leg][-1 if via == leg else 0])
        by_way = via == leg
        ends = (radius, other) if by_way else (other, radius)
        heads = [head_of(legs, leg, end, ends[end]) for end in (0, 1)]
        begun = legs.vias[:0] if begun is None else begun
        if len(begun):
            heads[0 if by_way else 1] = np.concatenate((legs.vias[via][None], begun))
        between = self.pull(leg, np.concatenate((heads[0][::-1], corners, heads[1])))
        if between is not None and all(
            _are_apart(heads[0][k][None], between, heads[1][k][None]) for k in (0, -1)
        ):
            corners = between
        wide = np.full(len(corners), self.radius if rest is None else rest)
        close = np.full(len(begun), radius)
        first, last = (begun, begun[:0]) if by_way else (begun[:0], begun[::-1])
        radii = np.concatenate((ends[:1], close[: len(first)], wide, close[: len(last)], ends[1:]))
        return legs.with_polygon(leg, np.concatenate((first, corners, last)), radii)


def _are_apart(*places: Floats) -> bool:
    """Whether no two neighbours of these places (n, d) are one."""
    sides = np.linalg.norm(np.diff(np.concatenate(places), axis=0), axis=1)
    return bool(sides.min() > LEAST_WAY)


def _sharpest(spans: Floats) -> tuple[float, float]:
    """The smallest radius of spans (m, 4, d) [m], and its parameter; 0 at a corner."""
    first, last = spans[1:, 1] - spans[1:, 0], spans[:-1, 3] - spans[:-1, 2]
    sizes = np.linalg.norm(first, axis=1) * np.linalg.norm(last, axis=1)
    cosines = np.divide((first * last).sum(axis=1), sizes, out=np.ones_like(sizes), where=sizes > 0)
    if len(cosines) and cosines.min() < math.cos(CORNER):
        return 0.0, float(np.argmin(cosines) + 1)
    bend, u = Path(spans, []).max_curvature()
    return (1.0 / bend if bend > 0.0 else math.inf), u
