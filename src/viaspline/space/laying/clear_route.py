"""From a route to a curve that is proven clear, leg by leg.

The spline is laid through all via points first. Each leg of it that isn't proven clear is led round
what is there, and the spline laid anew through the rest; a leg whose ends have a new direction by
that is looked at again. Corners of a leg that is led round something begin as gentle as there is
room for, and are tightened where the curve comes too near: in the end it is the taut way itself,
which is clear.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.space.laying.laid_route import LaidRoute, RouteLegs, lay_route
from viaspline.space.laying.leg_polygon import LegPolygon
from viaspline.space.laying.via_directions import via_directions

TIGHTER: Final = 0.6
"""By which a corner's radius is tightened at a time."""

LEAST_RADIUS_M: Final = 1e-4
"""Of a corner that is as good as sharp: nothing is gained by tightening it further."""

Check = Callable[[Floats], Floats | None]
"""From spans (m, 4, 3) to the place where they aren't clear, worst [m], (3,); None: they are."""

LeadRound = Callable[[int, Floats], Floats]
"""From a leg and the curve that it would have to its detour via points [m], (k, 3)."""


@dataclass(frozen=True, eq=False)
class StuckLegError(Exception):
    """A leg that isn't proven clear as its taut way either.

    Attributes:
        leg: Which one.
        place: Where [m], (3,).
    """

    leg: int
    place: Floats


@dataclass(frozen=True)
class ClearRoute:
    """A route whose legs are all proven clear, and the curve through it."""

    legs: RouteLegs
    laid: LaidRoute


def clear_route(legs: RouteLegs, check: Check, lead_round: LeadRound, radius: float) -> ClearRoute:
    """Lay a route so that it is clear everywhere.

    Args:
        legs: Through what; legs that have detours already keep them.
        check: What every piece of the curve has to pass.
        lead_round: How a leg is led round what is in its way.
        radius: Of curvature, to be had at corners if there is room [m].

    Raises:
        StuckLegError: When a leg doesn't pass, however tight its corners are.
    """
    proven: set[int] = set()
    while True:
        ways = via_directions(legs.vias, legs.inner, legs.given)
        for leg, inner in enumerate(legs.inner):
            if inner is not None and leg not in proven:
                legs = _tightened(legs, leg, ways, check)
                proven.add(leg)
        laid = lay_route(legs)
        blocked = [
            leg
            for leg, inner in enumerate(legs.inner)
            if inner is None and leg not in proven and check(laid.leg(leg)) is not None
        ]
        if not blocked:
            return ClearRoute(legs, laid)
        for leg in blocked:
            legs = legs.led_round(leg, lead_round(leg, laid.leg(leg)), radius)
        proven = _unchanged(legs, ways, proven)


def _unchanged(legs: RouteLegs, before: Floats, proven: set[int]) -> set[int]:
    """Those of the proven legs whose directions at both ends are as before."""
    after = via_directions(legs.vias, legs.inner, legs.given)
    same = np.all((before == after) | (np.isnan(before) & np.isnan(after)), axis=1)
    return {leg for leg in proven if same[leg] and same[leg + 1]}


def _tightened(legs: RouteLegs, leg: int, ways: Floats, check: Check) -> RouteLegs:
    """A route with one leg as gentle as it can be."""
    inner = legs.inner[leg]
    assert inner is not None  # the spline has no corners to tighten
    points = np.concatenate((legs.vias[leg : leg + 1], inner, legs.vias[leg + 1 : leg + 2]))
    polygon = tightened_leg(LegPolygon(points, ways[leg : leg + 2], legs.radii[leg]), leg, check)
    radii = (*legs.radii[:leg], polygon.radii, *legs.radii[leg + 1 :])
    return replace(legs, radii=radii)


def tightened_leg(polygon: LegPolygon, leg: int, check: Check) -> LegPolygon:
    """A leg with its corners as tight as has to be, and no tighter than that asks for.

    Args:
        polygon: The leg.
        leg: Which one it is.
        check: What it has to pass.

    Raises:
        StuckLegError: When it doesn't, however tight its corners are.
    """
    while (place := check(polygon.spans()[0])) is not None:
        apart = np.linalg.norm(polygon.points - place, axis=1)
        apart[polygon.radii < LEAST_RADIUS_M] = np.inf
        corner = int(np.argmin(apart))
        if np.isinf(apart[corner]):
            raise StuckLegError(leg, place)
        polygon = polygon.tightened(corner, TIGHTER)
    return polygon
