"""Turns at via points that are no sharper than a radius, where the via points leave room for it.

The spline doubles back at a via point within millimetres where its next one lies behind it, and
overshoots where its direction is given. A leg that is sharper than asked for is laid anew as a
polygon with rounded corners, as legs are that are led round something: through a via point that has
no direction across the middle of its turn, and from one that has by an arc towards what is next.
What isn't clear then, or no gentler, is left as it was.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Final, Generic, NamedTuple, TypeVar

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.space.laying.clear_route import ClearRoute, StuckLegError
from viaspline.space.laying.laid_route import RouteLegs

ROUND: Final = 0.999
"""A turn that is this near to the least radius is as round."""

ROOMY: Final = 1.25
"""Than the least radius the wanted one is so much wider: corners that are moved get sharper."""

ARC_STEP: Final = math.radians(60.0)
"""By so much an arc turns at each of its corners, at most."""

ARC_SHARE: Final = 0.77
"""The radius in the middle of such a corner, of the arc's: it is gentler before and after."""

ABOUT: Final = math.radians(100.0)
"""What lies farther round from a direction than that is gone to by an arc."""

LEAST_GAIN: Final = 0.002
"""By so many orders of magnitude at least a turn has to get gentler."""

DEARER: Final = 1.02
"""So much more a turn may cost that gets gentler, and still isn't round enough."""

NO_RADIUS_M: Final = 1e-6
"""What is sharper is as good as a corner."""

LEAST_WAY: Final = 1e-6
"""Shorter ways have no direction."""

CORNER: Final = 1e-4
"""What turns by more than that at a joint [rad] is a corner."""

Route = TypeVar("Route", bound=ClearRoute)

Lay = Callable[[RouteLegs, Route], Route]
"""Lays a clear route anew, some legs of which are another way now; StuckLegError: it can't be."""

Cost = Callable[[Floats], float]
"""What spans (m, 4, 3) cost to fly: time or length."""


class _Turn(NamedTuple):
    """A leg that is too sharp, and the via point that it is sharp near by."""

    leg: int
    via: int


@dataclass(frozen=True)
class GentleTurns(Generic[Route]):
    """What turns are to be like.

    Attributes:
        least: The radius that is round enough [m].
        radius: Of curvature, to be had if there is room [m].
        lay: Lays a route.
        cost: What a curve costs.
        is_rolling: Whether the robot is under way where the route begins: it can't turn there.
    """

    least: float
    radius: float
    lay: Lay[Route]
    cost: Cost
    is_rolling: bool = False

    def of(self, found: Route) -> Route:
        """A clear route with its sharp turns laid gently, as far as that can be."""
        tried: set[_Turn] = set()
        while left := [turn for turn in self._sharp(found) if turn not in tried]:
            tried.add(left[0])
            found = self._bent(found, left[0])
        return found

    def _sharp(self, found: ClearRoute) -> Iterator[_Turn]:
        """The legs of a route that are too sharp, each with the end that is nearer to where."""
        for leg in range(len(found.legs.inner)):
            spans = found.laid.leg(leg)
            radius, u = _sharpest(spans)
            if radius < ROUND * self.least:
                curve = Path(spans, [])
                yield _Turn(leg, leg + int(curve.distance(u) > 0.5 * curve.length))

    def _bent(self, found: Route, turn: _Turn) -> Route:
        """A route with one of its turns laid anew; itself, where that gains nothing."""
        best, rank = found, (self._lack(found) - LEAST_GAIN, math.inf)
        most = self.cost(found.laid.spans)
        for legs in self._other_turns(found, turn):
            try:
                laid = self.lay(legs, found)
            except StuckLegError:
                continue
            its = self._lack(laid)
            if its > rank[0] or (its, cost := self.cost(laid.laid.spans)) >= rank:
                continue
            if cost <= DEARER * most or turn.leg not in {one.leg for one in self._sharp(laid)}:
                best, rank = laid, (its, cost)
        return best

    def _lack(self, found: ClearRoute) -> float:
        """By how much the legs of a route are too sharp together, each by orders of magnitude."""
        sharpest = (_sharpest(found.laid.leg(leg))[0] for leg in range(len(found.legs.inner)))
        sharp = (max(radius, NO_RADIUS_M) for radius in sharpest if radius < ROUND * self.least)
        return sum(round(math.log10(self.least / radius), 3) for radius in sharp)

    def _other_turns(self, found: Route, turn: _Turn) -> Iterator[RouteLegs]:
        """Ways to turn at a via point in place of the one that is too sharp."""
        legs, wanted, via = found.legs, ROOMY * self.least, turn.via
        if 0 < via < len(legs.vias) - 1 and np.isnan(legs.given[via]).any():
            joint = found.laid.joints[via]
            own = found.laid.spans[joint, 1] - found.laid.spans[joint, 0]
            for way in (_across(legs, via), own / np.linalg.norm(own)):
                given = legs.given.copy()
                given[via] = way
                through = replace(legs, given=given)
                for radius in (wanted, ROOMY * wanted, self.radius):
                    before = self._turning(through, via - 1, via, radius)
                    yield self._turning(before, via, via, radius)
                if not self.is_rolling:
                    before = self._turning(through, via - 1, via, wanted, rest=wanted)
                    yield self._turning(before, via, via, wanted, rest=wanted)
            return
        if self.is_rolling and via == 0:
            return
        way = legs.given[via]
        if not np.isnan(way).any():
            for aside in _asides(legs, turn, way):
                arc = _arc(legs, turn, way, aside, wanted / ARC_SHARE)
                yield self._turning(legs, turn.leg, via, wanted, arc)
        for rest in (self.radius, wanted):
            yield self._turning(legs, turn.leg, via, wanted, rest=rest)

    def _turning(
        self, legs: RouteLegs, leg: int, via: int, radius: float, arc: Floats | None = None, *,
        rest: float | None = None,
    ) -> RouteLegs:  # fmt: skip
        """A route with one leg a polygon that turns by a radius [m] at one of its ends.

        Args:
            legs: Of the route.
            leg: Which one it is; its corners stay.
            via: The via point at that end.
            radius: There.
            arc: Corners that it has beside these, from that via point on [m], (k, d).
            rest: At its other corners [m]; None: as gentle as there is room for.
        """
        inner = legs.inner[leg]
        corners = np.empty((0, legs.vias.shape[1])) if inner is None else inner
        beside = corners[:0] if arc is None else arc
        radii = np.full(len(corners) + 1, self.radius if rest is None else rest)
        close = np.full(len(beside) + 1, radius)
        if via == leg:
            corners, radii = np.concatenate((beside, corners)), np.concatenate((close, radii))
        else:
            corners = np.concatenate((corners, beside[::-1]))
            radii = np.concatenate((radii, close))
        return legs.with_polygon(leg, corners, radii)


def _beside(legs: RouteLegs, via: int, step: int) -> Floats:
    """The way from a via point to what comes before it (step -1) or after it (1) [m], (d,)."""
    inner = legs.inner[via if step > 0 else via - 1]
    if inner is None or not len(inner):
        return np.asarray(legs.vias[via + step] - legs.vias[via])
    return np.asarray(inner[0 if step > 0 else -1] - legs.vias[via])


def _across(legs: RouteLegs, via: int) -> Floats:
    """The direction across the middle of a turn: as far from the way in as from the way out."""
    back, on = _beside(legs, via, -1), _beside(legs, via, 1)
    back, on = back / np.linalg.norm(back), on / np.linalg.norm(on)
    way = on - back
    if np.linalg.norm(way) < LEAST_WAY:  # straight back: to the left, level
        way = np.zeros_like(on)
        way[:2] = -on[1], on[0]
        if not way.any():
            way[0] = 1.0  # straight up and down
    return np.asarray(way / np.linalg.norm(way))


def _asides(legs: RouteLegs, turn: _Turn, way: Floats) -> Iterator[Floats]:
    """The directions square to a given one in which an arc towards what is next may turn.

    Towards it, and to both sides where it lies behind.
    """
    to = _beside(legs, turn.via, 1 if turn.via == turn.leg else -1)
    if turn.via != turn.leg:
        way = -way
    to = to / np.linalg.norm(to)
    if float(to @ way) > math.cos(ABOUT):
        return
    towards = to - (to @ way) * way
    size = float(np.linalg.norm(towards))
    if size > LEAST_WAY:
        yield towards / size
    level = np.array([-way[1], way[0], 0.0])
    size = float(np.linalg.norm(level))
    if size > LEAST_WAY:
        yield level / size
        yield -level / size


def _arc(legs: RouteLegs, turn: _Turn, way: Floats, aside: Floats, radius: float) -> Floats:
    """The corners of an arc from a via point's direction to what is next [m], from there on.

    Args:
        legs: Of the route.
        turn: The leg, and the via point where the arc begins or ends.
        way: The direction there.
        aside: Where the arc turns, square to it.
        radius: Of the arc [m].
    """
    leaves = turn.via == turn.leg
    place, way = legs.vias[turn.via], way if leaves else -way
    centre = place + radius * aside
    to = place + _beside(legs, turn.via, 1 if leaves else -1) - centre
    # From the centre the via point lies against `aside`, and flight begins along `way`.
    along, across = float(to @ way), float(to @ -aside)
    distance = math.hypot(along, across)
    angle = math.atan2(along, across) % math.tau
    angle -= math.acos(min(1.0, radius / distance)) if distance > 0.0 else 0.0
    angle = angle % math.tau
    steps = max(1, math.ceil(angle / ARC_STEP))
    at = (np.arange(steps) + 0.5) * angle / steps
    return np.asarray(centre + radius * (np.sin(at)[:, None] * way - np.cos(at)[:, None] * aside))


def _sharpest(spans: Floats) -> tuple[float, float]:
    """The smallest radius of spans (m, 4, d) [m], and its parameter; 0 at a corner."""
    first, last = spans[1:, 1] - spans[1:, 0], spans[:-1, 3] - spans[:-1, 2]
    sizes = np.linalg.norm(first, axis=1) * np.linalg.norm(last, axis=1)
    cosines = np.divide((first * last).sum(axis=1), sizes, out=np.ones_like(sizes), where=sizes > 0)
    if len(cosines) and cosines.min() < math.cos(CORNER):
        return 0.0, float(np.argmin(cosines) + 1)
    bend, u = Path(spans, []).max_curvature()
    return (1.0 / bend if bend > 0.0 else math.inf), u
