"""How legs of a route may be laid otherwise, past the same things, if the whole is sooner by that.

A turn at which no speed is lost is a long one: where the way goes back, or is slow for it climbs, a
close one takes less time. And a spline that goes on from a leg that is led round something swings
out where it turns: the leg may go straight on between two turns as well.

Tested in ``space/laying/test_otherwise_laid`` and through ``space/test_plan_spatial``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Final

import numpy as np

from viaspline.space.laying.laid_route import RouteLegs

MOST_LEGS: Final = 8
"""Of so many legs at most each is tried by itself."""


def changes(
    legs: RouteLegs, wide: float, close: float
) -> Iterator[Callable[[RouteLegs], RouteLegs]]:
    """What may be changed of a route, one thing after the other.

    Closer turns on all legs that are led round something, then on each of them; then, for each that
    is left to the spline beside one of these, a straight way between wide turns, and close ones. A
    leg of no length has none.

    Args:
        legs: Of the route.
        wide: Radius of turns at which no speed is lost [m].
        close: Of those that are as close as may be [m].

    >>> from viaspline.space.laying.laid_route import CurveShape
    >>> vias, free = np.array([[0.0, 0], [9, 0], [9, 9]]), np.full((3, 2), np.nan)
    >>> legs = RouteLegs.left_to_the_spline(vias, free, CurveShape(np.zeros(2)))
    >>> led = legs.led_round(0, np.array([[5.0, 2]]), 4.0)
    >>> [change(led).radii for change in changes(led, 4.0, 1.0)][0][0].tolist()
    [1.0, 1.0, 1.0]
    >>> [change(led).radii[1].tolist() for change in changes(led, 4.0, 1.0)]
    [[], [4.0, 4.0], [1.0, 1.0]]
    """
    led = [leg for leg, inner in enumerate(legs.inner) if inner is not None]
    several = 1 < len(led) <= MOST_LEGS
    for which in [led, *([leg] for leg in led if several)] if led and close < wide else []:
        yield partial(_closer, which=which, radius=close)
    beside = {leg for one in led for leg in (one - 1, one + 1)}
    long = np.flatnonzero((legs.vias[1:] != legs.vias[:-1]).any(axis=1)).tolist()
    for leg in sorted(beside.intersection(long).difference(led)):
        for radius in (wide, close) if close < wide else (wide,):
            yield partial(_straight, leg=leg, radius=radius)


def _closer(legs: RouteLegs, which: Sequence[int], radius: float) -> RouteLegs:
    """A route some of whose legs turn by a radius at most [m]."""
    for leg in which:
        inner = legs.inner[leg]
        assert inner is not None  # what is led has corners, or ends
        legs = legs.with_polygon(leg, inner, np.minimum(legs.radii[leg], radius))
    return legs


def _straight(legs: RouteLegs, leg: int, radius: float) -> RouteLegs:
    """A route one of whose legs goes straight on between its turns, of a radius [m]."""
    return legs.led_round(leg, legs.vias[:0], radius)
