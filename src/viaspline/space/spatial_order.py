"""The order of the via points of a round in space, so that the ways between them cost least.

The travelling salesman's problem over the taut ways between all points, round and over what stands
between them: their lengths, or where time counts the times that their speeds allow at best.
Climbing may take longer than descending, so there and back differ. How it is solved, see
`viaspline.planning.routing.least_order`; among very many via points lengths are straight. No gate
is passed backwards, from ahead of it to what lies behind it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import permutations

import numpy as np

from viaspline.errors import GaveUpError, NoPathError
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.mission.route_spec import ViaPoint
from viaspline.mission.space.flight_places import FlightPlaces, flight_places
from viaspline.planning.problem.method import Found
from viaspline.planning.routing.facing_points import FacingPoints
from viaspline.planning.routing.least_order import (
    MAX_VIAS_ALL_ORDERS,
    forwards,
    last_stop,
    round_to_end,
    shortest_order,
)
from viaspline.planning.routing.moved_forwards import Between
from viaspline.planning.routing.visit_order import MAX_VIAS_ROUTED, among_near, named
from viaspline.space.laying.corner_rounding import straight_span
from viaspline.space.leg_router import LegRouter
from viaspline.space.solve_route import proven_upright
from viaspline.space.spatial_request import spatial_problem_of


def ordered_in_space(mission: Mission) -> Mission:
    """A mission in space with its via points in the order in which the round costs least.

    A mission that asks for ``order: given`` is returned as it is. Via points without a name get
    the one that they had in the given order.

    Args:
        mission: What is asked for.

    Raises:
        NoPathError: Every order passes a gate backwards.
        GaveUpError: No order was found that doesn't.

    Example:
        >>> mission = Mission.model_validate({"robot": {"half_height_m": 0.2}, "route": {
        ...     "start": [0, 0, 9], "via": [[30, 0, 9], [10, 0, 9], [20, 0, 5]],
        ...     "goal": [40, 0, 9], "order": "shortest",
        ... }})
        >>> [(via.name, via.at[0]) for via in ordered_in_space(mission).route.via]
        [('via 2', 10.0), ('via 3', 20.0), ('via 1', 30.0)]
    """
    route = mission.route
    if route.order == "given":
        return mission
    vias = tuple(named(via, i) for i, via in enumerate(route.via))
    places = flight_places(mission)
    points = _points(places, closed=route.closed)
    last = last_stop(len(points), len(vias), closed=route.closed)
    facing = _facing(mission, points)
    if len(vias) <= MAX_VIAS_ROUTED:
        order = shortest_order(_costs(mission, places, points), len(vias), last, facing)
    else:
        order = among_near(points, len(vias))
        if facing is not None:
            order = forwards(order, last, _straight(points), facing)
    if facing is not None:
        _see_forwards(facing.backwards(round_to_end(order, last)), vias, points)
    changed = {"via": tuple(vias[i] for i in order), "order": "given"}
    return mission.model_copy(update={"route": route.model_copy(update=changed)})


def _points(places: FlightPlaces, *, closed: bool) -> Floats:
    """Where the round begins, its via points, and where it ends, if that isn't one of them [m]."""
    first = places.start if places.takeoff is None else places.takeoff
    ends = [] if closed else [end for end in (places.goal, places.landing) if end is not None][:1]
    return np.array([first, *places.via, *ends], np.float64)


def _facing(mission: Mission, points: Floats) -> FacingPoints | None:
    """The directions in which gates among the points are passed; None if there is no gate."""
    ways = np.zeros((len(points), 2))
    for k, via in enumerate(mission.route.via, start=1):
        if via.gate is not None:
            ways[k] = via.gate.way
    return FacingPoints(points[:, :2], ways) if ways.any() else None


def _straight(points: Floats) -> Between:
    """The straight lengths between points [m]."""
    return lambda first, last: np.asarray(np.linalg.norm(points[first] - points[last], axis=-1))


def _see_forwards(backwards: list[int], vias: Sequence[ViaPoint], points: Floats) -> None:
    """See that no gate is passed backwards, by the numbers of those points that are.

    Raises:
        NoPathError: One is, as in every other order.
        GaveUpError: One is, and maybe not in every order.
    """
    if not backwards:
        return
    via = vias[backwards[0] - 1]
    where, remedy = points[backwards[0]].tolist(), "turn it round, or give a via point behind it"
    if len(vias) <= MAX_VIAS_ALL_ORDERS:
        reason = f"every order of the via points passes a gate backwards, '{via.name}' among them"
        raise NoPathError(reason, where=where, remedy=remedy, via=via.name)
    raise GaveUpError(
        f"no order of the via points was found that doesn't pass the gate '{via.name}' backwards",
        where=where, remedy=remedy, tried=("the shortest order", "gates elsewhere in it"),
        via=via.name,
    )  # fmt: skip


def _costs(mission: Mission, places: FlightPlaces, points: Floats) -> Floats:
    """What the ways from each point to each other one cost [m or s], (n, n); infinite: no way.

    A landing is flown to at the height of the point before it, and then straight down, if nothing
    is in the way of that.
    """
    problem = spatial_problem_of(mission)
    router = LegRouter(problem, mission)
    lands = places.landing is not None and len(points) > 1 + len(places.via)
    costs = np.zeros((len(points), len(points)))
    for i, j in permutations(range(len(points)), 2):
        first, last = points[i], points[j].copy()
        down = 0.0
        if lands and j == len(points) - 1:
            last[2] = max(first[2], last[2])
            down = router.straight_cost(last, points[j])
            if not proven_upright(problem, straight_span(last, points[j])[None]).holds:
                down = np.inf
        elif lands and i == len(points) - 1:
            continue  # nobody flies on from there
        outcome = router.between(first, last)
        costs[i, j] = outcome.value.cost + down if isinstance(outcome, Found) else np.inf
    return costs
