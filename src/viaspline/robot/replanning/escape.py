"""The way out for a robot that has come closer to something than it should."""

from __future__ import annotations

import itertools
import math
from collections.abc import Collection
from dataclasses import replace

import numpy as np

from viaspline.curve.path import Path, PathVia
from viaspline.errors import PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.planning import replan
from viaspline.planning.problem.requirements import Requirements
from viaspline.robot.journey import ReducedClearance
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.ways_on import Choice, timed
from viaspline.world.world import World

DIRECTIONS = 48  # that are tried
REACHES = 12  # and lengths in each,
FARTHEST = 2.0  # up to so many required distances
PLACES = 9  # on the way where the distance is looked at


def way_out(
    context: ReplanContext, world: World, requirements: Requirements, floor: float
) -> tuple[ReplanContext, Choice] | None:
    """From where the robot stops straight to the nearest place with room, and on from there.

    It turns on the spot at either end.

    Args:
        context: The robot under way.
        world: What is known.
        requirements: What the path keeps from that place on.
        floor: What it keeps on the way there [m].

    Returns:
        The scene with what is kept where, and the way; None if there is none.
    """
    journey, path = context.journey, context.journey.path
    here = np.asarray(path.at_distance(context.stop))
    place = _roomy_place(world, here, requirements.required, floor)
    if place is None:
        return None
    straight = _straight_on(context, place)
    at = context.stop + math.dist(here, place)
    try:
        found = replan.from_rest(straight, at, world, requirements)
    except PlanningError:
        return None
    context = replace(context, journey=replace(journey, close=ReducedClearance(at, floor)))
    choice = timed(context, "from_rest", replace(found, changed_from=context.stop), (at,))
    return None if choice is None else (context, choice)


def relieved(
    context: ReplanContext,
    choice: Choice,
    world: World,
    requirements: Requirements,
    skip: Collection[int],
) -> tuple[ReplanContext, Choice]:
    """A way that keeps less than it should, but only as far as it must.

    From the first place on that has enough room it is laid anew.

    Args:
        context: The robot under way, with what the whole way keeps.
        choice: The way.
        world: What is known.
        requirements: What it should keep.
        skip: Points of the route that are left out.

    Returns:
        The scene with what is kept where, and the way; the same if there is no other.
    """
    journey, path, start = context.journey, choice.found.path, choice.found.changed_from
    assert journey.close is not None
    places = np.arange(start, path.length, journey.cell_size)
    roomy = np.flatnonzero(world.distance(path.at_distance(places)) >= requirements.required)
    if not roomy.size:
        return context, choice
    at = float(places[roomy[0]])
    try:
        found = replan.planned(path, at, world, requirements, skip)
    except PlanningError:
        return context, choice
    freed = replace(
        context, journey=replace(journey, close=ReducedClearance(at, journey.close.floor))
    )
    again = timed(freed, choice.mode, replace(found, changed_from=start))
    return (context, choice) if again is None else (freed, again)


def _roomy_place(world: World, here: Floats, required: float, floor: float) -> Floats | None:
    """The nearest place that keeps ``required``, with ``floor`` kept on the straight way there."""
    angles = np.linspace(0.0, 2.0 * np.pi, DIRECTIONS, endpoint=False)
    rays = np.column_stack((np.cos(angles), np.sin(angles)))
    share = np.linspace(0.0, 1.0, PLACES)[:, None, None]
    for reach in FARTHEST * required * np.arange(1, REACHES + 1) / REACHES:
        ends = here[None, :2] + reach * rays
        rooms = world.distance(here[None, None, :2] + share * (ends - here[:2])[None])
        free = np.flatnonzero((rooms[-1] >= required) & (rooms.min(axis=0) >= floor))
        if free.size:
            best = free[np.argmax(rooms[-1][free])]
            return np.concatenate((ends[best], here[2:]))
    return None


def _straight_on(context: ReplanContext, place: Floats) -> Path:
    """The driven path up to the stop, then straight to a place, then to the via points ahead."""
    path = context.journey.path
    u = float(path.parameter(context.stop))
    head = path.section(0.0, u).spans if u > 0.0 else np.empty((0, 4, path.dimension))
    ahead = [via for via, at in context.journey.ahead if at > context.stop]
    corners = [np.asarray(path.evaluate(u)), place, *(np.array(via.at) for via in ahead)]
    share = np.arange(4.0)[:, None] / 3.0
    lines = [a + share * (b - a) for a, b in itertools.pairwise(corners)]
    passed = [via for via in path.vias if via.u <= min(u, float(len(head)))]
    to_come: list[PathVia] = [
        replace(via, u=float(len(head) + 2 + k)) for k, via in enumerate(ahead)
    ]
    return Path(np.concatenate((head, np.array(lines))), (*passed, *to_come))
