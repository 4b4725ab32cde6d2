"""Routes that pass a solid on each side: local minima, and not homotopy classes.

A route is searched with one side alone allowed, and pulled taut; then it is let go and pulled taut
without that rule. What slips to where another one lies is no seed of its own.

Tested through ``space/routing/test_space_router``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.routing.way_checks import way_is_free
from viaspline.mission.shapes.solids import Solid
from viaspline.planning.problem.method import Found
from viaspline.space.routing.pass_gates import SIDE_BITS, PassSide, gate
from viaspline.space.routing.shut_sides import is_shut
from viaspline.space.routing.space_router import SpaceRouter
from viaspline.space.routing.taut_route import LENGTH, Norm, TautRoute

_SAMPLES = 64


@dataclass(frozen=True)
class SideSeed:
    """A route past a solid.

    Attributes:
        side: The side on which it passes it.
        route: The route.
    """

    side: PassSide
    route: TautRoute


def seeds(
    router: SpaceRouter,
    obstacle: Solid,
    start: ArrayLike,
    goal: ArrayLike,
    required: float,
    norm: Norm = LENGTH,
    known: TautRoute | None = None,
) -> tuple[SideSeed, ...]:
    """Routes on the sides of a solid that there are, the cheapest first.

    Args:
        router: Where, and how much is spent.
        obstacle: The solid.
        start: [m], (3,).
        goal: [m], (3,).
        required: Distance to be kept from everything [m].
        norm: See ``SpaceRouter.find``.
        known: The cheapest route of all, if that is known: it isn't sought again on its own side.

    Raises:
        GeometryError: See ``SpaceRouter.find``.
    """
    found: list[SideSeed] = []
    quick = router.quick  # a side that there is not would be sought in vain
    apart = 2.0 * (required + router.room.body)
    for side in SIDE_BITS:
        row = gate(obstacle, start, goal, [side])
        if not len(row) or is_shut(router.room, obstacle, row[0], (start, goal), required):
            continue
        if known is not None and way_is_free(router.room.packed, row, known.points, required):
            found.append(SideSeed(side, known))
            continue
        outcome = quick.find(start, goal, required, norm, row)
        if isinstance(outcome, Found):
            free = router.pulled(np.array(outcome.value.points), required, norm)
            found.append(SideSeed(side, free if free.cost < outcome.cost else outcome.value))
    found.sort(key=lambda seed: seed.route.cost)
    kept: list[SideSeed] = []
    for seed in found:
        if all(_distance(seed.route, other.route) > apart for other in kept):
            kept.append(seed)
    return tuple(kept)


def _distance(one: TautRoute, other: TautRoute) -> float:
    """How far apart two routes get, at places as far along each [m]."""
    gaps = _spread(one.points) - _spread(other.points)
    return float(np.linalg.norm(gaps, axis=1).max())


def _spread(points: Floats) -> Floats:
    along = np.concatenate([[0.0], np.linalg.norm(np.diff(points, axis=0), axis=1).cumsum()])
    places = np.linspace(0.0, along[-1], _SAMPLES)
    return np.column_stack([np.interp(places, along, points[:, axis]) for axis in range(3)])
