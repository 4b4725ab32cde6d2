"""A route in space as one curve: spline where nothing is in the way, rounded detours elsewhere.

Legs that are left to the spline are runs of one cardinal spline each. A run ends at the via points
where a detour begins, with the detour's direction and without curvature, as the detour has it
there; so the curve is G2 wherever the tangents are ``continuous``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.cardinal import CardinalSpline, Knots, Tangents
from viaspline.kernels.arrays import Floats
from viaspline.space.laying.leg_polygon import LegPolygon
from viaspline.space.laying.via_directions import Inner, via_directions
from viaspline.space.laying.via_turns import via_turns


@dataclass(frozen=True, eq=False)
class CurveShape:
    """How the spline runs between via points.

    Attributes:
        tension: Of each leg, shape (n - 1,).
        knots: See `viaspline.curve.cardinal.CardinalSpline`.
        tangents: See there.
    """

    tension: Floats
    knots: Knots = "chordal"
    tangents: Tangents = "continuous"


@dataclass(frozen=True, eq=False)
class RouteLegs:
    """What a curve is laid through.

    Attributes:
        vias: The via points [m], shape (n, d).
        given: Directions that are fixed at via points, unit vectors, shape (n, d); NaN where free.
        inner: The detour via points of each leg, (k, d), n - 1; None where it is the spline.
        radii: How gently legs that aren't the spline turn at their via points and detours [m], one
            array (k + 2,) for each leg.
        shape: Of the spline.
        close: How close turns at via points may be where a wide one would be a loop [m]; infinite:
            as close as other corners.
    """

    vias: Floats
    given: Floats
    inner: tuple[Inner, ...]
    radii: tuple[Floats, ...]
    shape: CurveShape
    close: float = math.inf

    @classmethod
    def left_to_the_spline(
        cls, vias: Floats, given: Floats, shape: CurveShape, close: float = math.inf
    ) -> RouteLegs:
        """A route without a detour."""
        count = len(vias) - 1
        return cls(vias, given, (None,) * count, (np.empty(0),) * count, shape, close)

    def led_round(self, leg: int, inner: Floats, radius: float) -> RouteLegs:
        """This route with detour via points on one leg.

        Args:
            leg: Which one.
            inner: They [m], shape (k, d).
            radius: Of curvature, to be had at each corner if there is room [m].
        """
        return self.with_polygon(leg, inner, np.full(len(inner) + 2, radius))

    def through(self, via: int, way: Floats) -> RouteLegs:
        """This route with a direction at one via point, a unit vector, (d,)."""
        given = self.given.copy()
        given[via] = way
        return replace(self, given=given)

    def with_polygon(self, leg: int, inner: Floats, radii: Floats) -> RouteLegs:
        """This route with one leg that isn't the spline.

        Args:
            leg: Which one.
            inner: Its corners [m], shape (k, d).
            radii: How gently it turns at its via points and corners [m], shape (k + 2,).
        """
        return replace(
            self,
            inner=(*self.inner[:leg], inner, *self.inner[leg + 1 :]),
            radii=(*self.radii[:leg], radii, *self.radii[leg + 1 :]),
        )

    def turns_as(self, other: RouteLegs) -> bool:
        """Whether another route has the same corners on the same legs, as gentle as these."""
        return all(
            (mine is None) == (its is None) and np.array_equal(radii, as_gentle)
            for mine, its, radii, as_gentle in zip(
                self.inner, other.inner, self.radii, other.radii, strict=True
            )
        )

    @cached_property
    def ways(self) -> Floats:
        """Directions at the via points; see ``via_directions``, (n, d)."""
        return via_directions(self.vias, self.inner, self.given)

    @cached_property
    def turns(self) -> Floats:
        """Turns at the via points; see ``via_turns``, (n, 2 d + 3)."""
        return via_turns(self.vias, self.inner, self.given, self.radii, self.close)

    def polygon(self, leg: int, inner: Floats) -> LegPolygon:
        """What a leg is laid through that isn't the spline.

        Args:
            leg: Which one.
            inner: Its corners [m], (k, d).
        """
        points = np.concatenate((self.vias[leg : leg + 1], inner, self.vias[leg + 1 : leg + 2]))
        its, ways = self.turns[leg : leg + 2], self.ways[leg : leg + 2]
        own = np.isnan(its[:, -1]) & np.isnan(self.given[leg : leg + 2, 0])
        close = np.where(own & ~np.isnan(ways[:, 0]), self.close, np.nan)
        return LegPolygon(points, ways, self.radii[leg], its, close)


@dataclass(frozen=True, eq=False)
class LaidRoute:
    """The curve of a route.

    Attributes:
        spans: Bézier control polygons [m], shape (m, 4, d).
        joints: The joints at which the via points lie, shape (n,).
        detours: The joints at which the detour via points of each leg lie.
    """

    spans: Floats
    joints: NDArray[np.intp]
    detours: tuple[NDArray[np.intp], ...]

    def leg(self, k: int) -> Floats:
        """The spans of one leg [m], shape (l, 4, d)."""
        return self.spans[self.joints[k] : self.joints[k + 1]]


def lay_route(legs: RouteLegs) -> LaidRoute:
    """The curve through the via points of a route.

    >>> vias = np.array([[0.0, 0, 5], [10, 0, 5], [10, 10, 5]])
    >>> shape = CurveShape(np.zeros(2))
    >>> legs = RouteLegs.left_to_the_spline(vias, np.full((3, 3), np.nan), shape)
    >>> laid = lay_route(legs.led_round(0, np.array([[5.0, 2, 5]]), 3.0))
    >>> bool(np.array_equal(laid.spans[laid.joints[1], 0], vias[1])), laid.detours[1]
    (True, array([], dtype=int64))
    """
    pieces: list[Floats] = []
    joints, detours = [0], []
    leg = 0
    while leg < len(legs.inner):
        inner = legs.inner[leg]
        if inner is None:
            end = _end_of_run(legs, leg)
            run = _run(legs, leg, end)
            per_leg = len(run) // (end - leg)
            joints += [joints[-1] + per_leg * (k + 1) for k in range(end - leg)]
            detours += [np.empty(0, np.intp)] * (end - leg)
            pieces.append(run)
        else:
            end = leg + 1
            spans, within = legs.polygon(leg, inner).spans()
            detours.append(joints[-1] + within.astype(np.intp))
            joints.append(joints[-1] + len(spans))
            pieces.append(spans)
        leg = end
    return LaidRoute(np.concatenate(pieces), np.array(joints, np.intp), tuple(detours))


def _end_of_run(legs: RouteLegs, leg: int) -> int:
    """The via point up to which one spline runs from the beginning of a leg."""
    end = leg + 1
    while (
        end < len(legs.inner) and legs.inner[end] is None and bool(np.isnan(legs.given[end]).any())
    ):
        end += 1
    return end


def _run(legs: RouteLegs, first: int, last: int) -> Floats:
    """The spans of the spline from one via point to another."""
    shape = legs.shape
    return CardinalSpline(
        legs.vias[first : last + 1],
        shape.tension[first:last],
        knots=shape.knots,
        start_heading=_direction(legs.ways[first]),
        end_heading=_direction(legs.ways[last]),
        tangents=shape.tangents,
    ).spans


def _direction(way: Floats) -> Floats | None:
    return None if np.isnan(way).any() else way
