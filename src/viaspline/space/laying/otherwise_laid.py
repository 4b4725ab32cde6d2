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

Change = Callable[[RouteLegs], RouteLegs]
"""From a route to that with something of it changed."""


def changes(legs: RouteLegs, wide: float, close: float) -> Iterator[Change]:
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
    for leg in _plain(legs):
        if leg in beside:
            for radius in _radii(wide, close):
                yield partial(_straight, which=[leg], radius=radius)


def straight_changes(legs: RouteLegs, wide: float, close: float) -> Iterator[Change]:
    """Straight ways between turns, wide or close, not the spline: on all legs, then on each.

    Args:
        legs: Of the route.
        wide: Radius of turns at which no speed is lost [m].
        close: Of those that are as close as may be [m].

    >>> from viaspline.space.laying.laid_route import CurveShape
    >>> vias, free = np.array([[0.0, 0], [9, 0], [9, 9]]), np.full((3, 2), np.nan)
    >>> legs = RouteLegs.left_to_the_spline(vias, free, CurveShape(np.zeros(2)))
    >>> [len(change(legs).radii[0]) for change in straight_changes(legs, 4.0, 1.0)]
    [2, 2, 2, 2, 0, 0]
    """
    plain = _plain(legs)
    if len(legs.inner) == 1 or not plain:  # from end to end the spline is straight
        return
    for which in [plain, *([leg] for leg in plain if 1 < len(plain) <= MOST_LEGS)]:
        for radius in _radii(wide, close):
            yield partial(_straight, which=which, radius=radius)


def _plain(legs: RouteLegs) -> list[int]:
    """The legs of some length that are left to the spline."""
    long = (legs.vias[1:] != legs.vias[:-1]).any(axis=1)
    return [leg for leg, inner in enumerate(legs.inner) if inner is None and long[leg]]


def _radii(wide: float, close: float) -> tuple[float, ...]:
    return (wide, close) if close < wide else (wide,)


def _closer(legs: RouteLegs, which: Sequence[int], radius: float) -> RouteLegs:
    """A route some of whose legs turn by a radius at most [m]."""
    for leg in which:
        inner = legs.inner[leg]
        assert inner is not None  # what is led has corners, or ends
        legs = legs.with_polygon(leg, inner, np.minimum(legs.radii[leg], radius))
    return legs


def _straight(legs: RouteLegs, which: Sequence[int], radius: float) -> RouteLegs:
    """A route some of whose legs go straight on between their turns, of a radius [m]."""
    for leg in which:
        legs = legs.led_round(leg, legs.vias[:0], radius)
    return legs
