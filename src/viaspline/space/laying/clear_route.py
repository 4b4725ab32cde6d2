"""From a route to a curve that is proven clear, leg by leg.

The spline is laid through all via points first. Each leg of it that isn't proven clear is led round
what is there, and the spline laid anew through the rest; a leg whose ends have a new direction by
that is looked at again. Corners of a leg that is led round something begin as gentle as there is
room for, and are tightened where the curve comes too near, but no more than that needs: in the end
it is the taut way itself, which is clear.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.space.laying.laid_route import LaidRoute, RouteLegs, lay_route
from viaspline.space.laying.leg_polygon import LegPolygon

TIGHTER: Final = 0.6
"""By which a corner's radius is tightened at a time."""

WIDENED: Final = 0.5
"""How exactly it is known how many times a corner has to be tightened."""

LEAST_RADIUS_M: Final = 1e-4
"""Of a corner that is as good as sharp: nothing is gained by tightening it further."""

Check = Callable[[int, Floats], Floats | None]
"""From a leg and its spans (m, 4, 3) to the place where they aren't as they should be, worst [m],
(3,); None: they are."""

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
        legs, proven = _all_tightened(legs, proven, check)
        laid = lay_route(legs)
        blocked = [
            leg
            for leg, inner in enumerate(legs.inner)
            if inner is None and leg not in proven and check(leg, laid.leg(leg)) is not None
        ]
        if not blocked:
            return ClearRoute(legs, laid)
        before = legs
        for leg in blocked:
            legs = legs.led_round(leg, lead_round(leg, laid.leg(leg)), radius)
        proven = _unchanged(legs, before, proven)


def _unchanged(legs: RouteLegs, before: RouteLegs, proven: set[int]) -> set[int]:
    """Those of the proven legs that have the same directions and turns at both ends as before."""
    after = np.hstack((legs.ways, legs.turns))
    earlier = np.hstack((before.ways, before.turns))
    same = np.all((earlier == after) | (np.isnan(earlier) & np.isnan(after)), axis=1)
    return {leg for leg in proven if same[leg] and same[leg + 1]}


def _all_tightened(legs: RouteLegs, proven: set[int], check: Check) -> tuple[RouteLegs, set[int]]:
    """A route with all legs that aren't the spline as gentle as they can be, and the proven ones.

    A leg that is tightened at a via point has a tighter turn there, and so has its neighbour, which
    is looked at again.
    """
    led = [leg for leg, inner in enumerate(legs.inner) if inner is not None]
    while pending := [leg for leg in led if leg not in proven]:
        tighter = _tightened(legs, pending[0], check)
        kept = proven if tighter is legs else _unchanged(tighter, legs, proven)
        legs, proven = tighter, kept | {pending[0]}
    return legs, proven


def _tightened(legs: RouteLegs, leg: int, check: Check) -> RouteLegs:
    """A route with one leg as gentle as it can be; itself, where that leg is clear as it is."""
    inner = legs.inner[leg]
    assert inner is not None  # the spline has no corners to tighten
    polygon = tightened_leg(legs.polygon(leg, inner), leg, check)
    if np.array_equal(polygon.radii, legs.radii[leg]):
        return legs
    radii = (*legs.radii[:leg], polygon.radii, *legs.radii[leg + 1 :])
    return replace(legs, radii=radii)


def tightened_leg(polygon: LegPolygon, leg: int, check: Check) -> LegPolygon:
    """A leg with its corners as tight as has to be, and no tighter than that asks for.

    Both corners beside a place that fails are tightened, for either may be why, by twice as many
    steps each time; then each of them is widened again as far as the leg still passes.

    Args:
        polygon: The leg.
        leg: Which one it is.
        check: What it has to pass.

    Raises:
        StuckLegError: When it doesn't, however tight its corners are.
    """
    found = polygon
    times, steps = np.zeros(len(polygon.radii)), np.ones(len(polygon.radii))
    while (place := check(leg, found.curve())) is not None:
        corners = _corners_about(found, place)
        if not corners:
            raise StuckLegError(leg, place)
        times[corners] += steps[corners]
        steps[corners] *= 2.0
        found = _tightened_by(polygon, times)
    return _widened(polygon, times, leg, check) if times.any() else found


def _tightened_by(polygon: LegPolygon, times: Floats) -> LegPolygon:
    """A leg with each of its corners tightened so many times."""
    return replace(polygon, radii=polygon.radii * TIGHTER**times)


def _widened(polygon: LegPolygon, times: Floats, leg: int, check: Check) -> LegPolygon:
    """A leg that passes with corners tightened so many times, each as few times as that needs.

    The tightest corner is first, by halving how often it is tightened.
    """
    for corner in np.argsort(-times, kind="stable").tolist():
        fewest, enough = 0.0, float(times[corner])
        fewer = 0.0
        while enough - fewest > WIDENED:
            tried = times.copy()
            tried[corner] = fewer
            if check(leg, _tightened_by(polygon, tried).curve()) is None:
                enough, times = fewer, tried
            else:
                fewest = fewer
            fewer = 0.5 * (fewest + enough)
    return _tightened_by(polygon, times)


def _corners_about(polygon: LegPolygon, place: Floats) -> list[int]:
    """The corners at both ends of the part of a leg that is nearest to a place.

    Those that are as good as sharp are left out; then the nearest other one is taken.
    """
    first, last = polygon.points[:-1], polygon.points[1:]
    ways = last - first
    along = ((place - first) * ways).sum(axis=1) / np.maximum((ways * ways).sum(axis=1), 1e-300)
    nearest = first + np.clip(along, 0.0, 1.0)[:, None] * ways
    part = int(np.argmin(np.linalg.norm(nearest - place, axis=1)))
    wide = polygon.radii >= LEAST_RADIUS_M
    found = [corner for corner in (part, part + 1) if wide[corner]]
    if found or not wide.any():
        return found
    apart = np.linalg.norm(polygon.points - place, axis=1)
    return [int(np.argmin(np.where(wide, apart, np.inf)))]
