"""The order of the via points of a round, improved: less in all, start and goal where they are.

By the lengths of the ways between all points, round what stands between them: see ``least_order``.
Among very many only exchanges with near neighbours are looked at, and lengths are straight: neither
what stands between nor the sides that are asked for count there.

A closed round is as short the other way round: the way is taken that turns less where a heading is
given at its start, else that which keeps nearer to the given order.

Where time counts, the shortest order is exchanged on until nothing is sooner, by the time of
``round_cost``: for a few via points it is the soonest of all; of many the shortest is taken.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from itertools import permutations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.routing.tour import shortened_tour
from viaspline.kernels.world.clusters import group_labels
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.mission.model import Mission
from viaspline.mission.route_spec import ViaPoint
from viaspline.planning.checking.driving_time import lost_in_zones
from viaspline.planning.problem.method import Outcome
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import WholeLeg
from viaspline.planning.routing.asked_sides import AskedSides, sided
from viaspline.planning.routing.least_order import (
    MAX_VIAS_ALL_ORDERS,
    exchanged,
    last_stop,
    round_of,
    shortest_order,
)
from viaspline.planning.routing.round_cost import RoundLength, RoundTime, WaysBetween
from viaspline.planning.routing.route_on_sides import route_on_sides
from viaspline.planning.routing.route_problem import NO_BARRIERS, on_the_line
from viaspline.planning.routing.router import Router
from viaspline.planning.routing.taut_path import TautPath
from viaspline.world.world import World

MAX_VIAS_ROUTED = 50  # up to which every two have a way between them laid
NEAR = 10  # neighbours of each point that exchanges are looked for among
MAX_EXCHANGES_EACH = 50  # for each point, beyond which the rest is left
MAX_VIAS_ALL_TIMES = 5  # up to which all orders are compared by their time
SAME_COST = 1e-9  # of what orders cost, that is rounding
MAX_VIAS_TIMED = 16  # up to which exchanges are looked for by their time


def ordered(mission: Mission, world: World) -> Mission:
    """The mission with its via points in the order that makes the round short.

    A mission that asks for ``order: given`` is returned as it is. Via points without a name get
    the one that they had in the given order, so that they are still known by it.

    Args:
        mission: What is asked for.
        world: What it has on its map.

    Example:
        >>> mission = Mission.model_validate({"route": {
        ...     "start": [0, 0], "via": [[30, 0], [10, 0], [20, 0]], "goal": [40, 0],
        ...     "order": "shortest",
        ... }})
        >>> [(via.name, via.at[0]) for via in ordered(mission, World.known(mission)).route.via]
        [('via 2', 10.0), ('via 3', 20.0), ('via 1', 30.0)]
    """
    route = mission.route
    if route.order == "given":
        return mission
    vias = tuple(named(via, i) for i, via in enumerate(route.via))
    if len(vias) > MAX_VIAS_ROUTED:
        order = among_near(np.array([point.at[:2] for _, point in route.points()]), len(vias))
    else:
        order = _order_of_few(mission, world)
    changed = {"via": tuple(vias[i] for i in order), "order": "given"}
    return mission.model_copy(update={"route": route.model_copy(update=changed)})


def is_surely_shortest(mission: Mission) -> bool:
    """Whether the order that is taken is the shortest of all, or the soonest, as was asked for.

    In space that isn't known, for the ways between its points are the cheapest that were found.

    >>> is_surely_shortest(Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}}))
    True
    """
    route = mission.route
    if mission.is_spatial:
        return route.order == "given" or len(route.via) <= 1
    most = MAX_VIAS_ALL_TIMES if route.optimise == "time" else MAX_VIAS_ALL_ORDERS
    return route.order == "given" or len(route.via) <= most


def _order_of_few(mission: Mission, world: World) -> tuple[int, ...]:
    """The order of via points between which ways are laid."""
    route, objective = mission.route, Requirements.of(mission).objective
    ways, count = ways_between(mission, world), len(mission.route.via)
    last = last_stop(len(ways.lengths), count, closed=route.closed)
    order = shortest_order(ways.lengths, count, last)
    lengths = RoundLength(ways.lengths)

    def length(order: tuple[int, ...]) -> float:
        return lengths.of(round_of(order, last))

    if not objective.is_time or count > MAX_VIAS_TIMED or not np.isfinite(ways.lengths).all():
        return _directed(order, length, mission, ways)
    stands = np.array([True, *(via.dwell_s > 0.0 for via in route.via), True])
    rounds = RoundTime.of_pace(ways, stands, objective.pace)

    def time(order: tuple[int, ...]) -> float:
        return rounds.of(round_of(order, last))

    if count > MAX_VIAS_ALL_TIMES:
        return _directed(exchanged(time, order), time, mission, ways)
    times = {some: time(some) for some in permutations(sorted(order))}
    least = (1.0 + SAME_COST) * min(times.values())
    return _directed(next(some for some in times if times[some] <= least), time, mission, ways)


def _directed(
    order: tuple[int, ...], cost: Callable[[tuple[int, ...]], float], mission: Mission,
    ways: WaysBetween,
) -> tuple[int, ...]:  # fmt: skip
    """A closed round in the better of its two directions, if they cost the same."""
    if not mission.route.closed:
        return order
    both = (order, order[::-1])
    costs = sorted(map(cost, both))
    if not costs[1] <= (1.0 + SAME_COST) * costs[0]:
        return order
    heading = mission.route.start.heading_deg
    if heading is None:
        return min(both)

    def turned(order: tuple[int, ...]) -> float:
        """By how much it turns at the start, there and as it comes back [rad]."""
        ends = ways.leaving[0, order[0] + 1], ways.arriving[order[-1] + 1, 0]
        return sum(abs(math.remainder(way - math.radians(heading), math.tau)) for way in ends)

    return min(both, key=lambda order: (round(turned(order), 6), order))


def named(via: ViaPoint, place: int) -> ViaPoint:
    """A via point with the name that it goes by at a place of the given order, from 0."""
    return via if via.name else via.model_copy(update={"name": f"via {place + 1}"})


def ways_between(mission: Mission, world: World) -> WaysBetween:
    """The shortest ways between all points of the route.

    Start first, then the via points, then the goal if there is one.
    Each passes obstacles on the sides that the mission asks for, so that there and back may differ.
    A curve through more than two points swings out, and may meet sides that these ways don't.
    """
    at = np.array([point.at[:2] for _, point in mission.route.points()])
    requirements = Requirements.of(mission)
    router = Router(world, requirements.required, at)
    indices = sided(world)
    labels = group_labels(world.packed, 2.0 * requirements.required) if indices.size else indices
    lengths, leaving, arriving, slowed = (np.zeros((len(at), len(at))) for _ in range(4))
    for i, j in permutations(range(len(at)), 2):
        if i > j and not indices.size:
            lengths[i, j] = lengths[j, i]
            leaving[i, j], arriving[i, j] = arriving[j, i] + math.pi, leaving[j, i] + math.pi
            slowed[i, j] = slowed[j, i]
            continue
        sides = AskedSides.of(
            WholeLeg(at[i], at[j]), indices, world, requirements.required, lambda: labels
        )
        active = on_the_line(world, at[i], at[j], requirements.required)
        found, _ = route_on_sides(partial(_found, router, at[i], at[j]), sides, active, NO_BARRIERS)
        if found.value is None:
            lengths[i, j] = np.inf
            continue
        corners = found.value.corners[:, X : Y + 1]
        first, last = np.diff(corners[[0, 1, -2, -1]], axis=0)[::2].tolist()
        lengths[i, j] = found.value.length
        leaving[i, j], arriving[i, j] = math.atan2(*first[::-1]), math.atan2(*last[::-1])
        slowed[i, j] = lost_in_zones(corners, requirements.objective.pace)
    return WaysBetween(lengths, leaving, arriving, slowed)


def _found(
    router: Router, start: Floats, goal: Floats, closed: Floats, active: Flags
) -> tuple[Outcome[TautPath], Flags]:
    """The shortest taut path past segments, and the obstacles that were met, (n,)."""
    met = active.copy()
    return router.find(start, goal, closed, met), met


def among_near(places: Floats, count: int) -> tuple[int, ...]:
    """A short order of very many via points, by straight lengths.

    Args:
        places: Start, via points, and the goal if there is one [m], (n, d).
        count: How many via points there are; a round without a goal ends at its start, and so does
            an open one here, which then goes on to wherever it is at last.
    """
    from scipy.spatial import cKDTree

    has_goal = len(places) > count + 1
    xy = places if has_goal else np.vstack([places, places[0]])
    _, found = cKDTree(xy).query(xy, min(NEAR, len(xy) - 1) + 1)
    near = np.asarray(found, np.int64)[:, 1:]
    first = [0, *(k + 1 for k in _nearest_places(xy[: count + 1])), count + 1]
    tour = shortened_tour(
        np.ascontiguousarray(xy), np.array(first), np.ascontiguousarray(near),
        MAX_EXCHANGES_EACH * len(xy),
    )  # fmt: skip
    return tuple(int(k) - 1 for k in tour[1:-1])


def _nearest_places(xy: Floats) -> list[int]:
    """Always on to the nearest that is left, from the first; counted from the second."""
    left = np.arange(1, len(xy))
    here, order = xy[0], []
    while len(left):
        k = int(np.argmin(((xy[left] - here) ** 2).sum(axis=1)))
        order.append(int(left[k]) - 1)
        here = xy[left[k]]
        left[k] = left[-1]
        left = left[:-1]
    return order
