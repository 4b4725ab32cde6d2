"""The directions in which a via point may be passed in a turn that is laid anew."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.corner_polygon import stub_length
from viaspline.space.laying.laid_route import RouteLegs

LEAST_WAY: Final = 1e-6
"""Shorter ways have no direction."""

SAME_WAY: Final = 1e-3
"""Directions that are nearer to each other are one."""

Away = Callable[[Floats], Floats]
"""From a place [m], (d,), to the direction away from what is near there, a unit vector, (d,); NaN:
nothing is."""


def beside(legs: RouteLegs, via: int, step: int) -> Floats:
    """The way from a via point to what comes before it (step -1) or after it (1) [m], (d,)."""
    inner = legs.inner[via if step > 0 else via - 1]
    if inner is None or not len(inner):
        return np.asarray(legs.vias[via + step] - legs.vias[via])
    return np.asarray(inner[0 if step > 0 else -1] - legs.vias[via])


def across_turn(back: Floats, on: Floats) -> Floats:
    """The direction across the middle of a turn: as far from the way in as from the way out.

    Args:
        back: To where it comes from [m], (d,).
        on: To where it goes [m], (d,).

    >>> across_turn(np.array([-3.0, 0, 0]), np.array([-5.0, 0, 0]))  # straight back
    array([0., 1., 0.])
    """
    back, on = _unit(back), _unit(on)
    way = on - back
    if np.linalg.norm(way) < LEAST_WAY:  # to the right of the way on, level
        way = np.zeros_like(on)
        way[:2] = on[1], -on[0]
        if not way.any():
            way[0] = 1.0  # straight up and down
    return _unit(way)


def head_of(legs: RouteLegs, leg: int, end: int, radius: float) -> Floats:
    """From a via point to where a leg has gone straight on along its direction [m], (1 or 2, d).

    Args:
        legs: Of the route.
        leg: Which one.
        end: 0 for its first via point, 1 for its last.
        radius: Of the turn there [m].
    """
    via = leg + end
    place, way = legs.vias[via], legs.given[via] * (-1.0 if end else 1.0)
    if np.isnan(way).any():
        return np.asarray(place[None])
    stub = stub_length(beside(legs, via, -1 if end else 1), way, radius)
    return np.array([place, place + stub * way])


def other_ways(legs: RouteLegs, via: int, own: Floats, away: Floats) -> Iterator[Floats]:
    """Directions beside that across a turn and the curve's own one, each another than those before.

    Along what is near there, and level, so that nothing and no limit of the height is nearer after
    the via point than at it; along the way in, and along the way out.

    Args:
        legs: Of the route.
        via: The via point.
        own: The direction of the curve there, a unit vector.
        away: From what is near, a unit vector; NaN: nothing is.
    """
    middle = across_turn(beside(legs, via, -1), beside(legs, via, 1))
    back, on = _unit(beside(legs, via, -1)), _unit(beside(legs, via, 1))
    known = [middle, own]
    upright = np.zeros_like(middle)
    upright[-1] = 1.0
    flat = [way - (way @ wall) * wall
            for wall in (away, upright) if not np.isnan(wall).any()
            for way in (middle, own, on - back)]  # fmt: skip
    for way in (*flat, -back, on):
        if np.linalg.norm(way) < LEAST_WAY:
            continue
        found = _unit(way)
        if min(float(np.linalg.norm(found - one)) for one in known) > SAME_WAY:
            known.append(found)
            yield found


def _unit(way: Floats) -> Floats:
    return np.asarray(way / np.linalg.norm(way))
