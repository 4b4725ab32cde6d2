"""Recovery of a robot that has come closer to something than it should: out, and on from there."""

from __future__ import annotations

import itertools
import math
from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from viaspline.curve.path import Path, PathVia
from viaspline.errors import PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.planning.checking.conflicts import CLEAR, turn_conflict
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.replanning import replan
from viaspline.planning.replanning.sides_ahead import spans_on_wrong_side
from viaspline.robot.navigation.reschedule import braking_at_once
from viaspline.robot.navigation.schedule import ReducedClearance
from viaspline.robot.perception.body_room import room_along
from viaspline.robot.replanning.path_candidate import PathCandidate, timed
from viaspline.robot.replanning.replan_context import MotionAhead, ReplanContext
from viaspline.robot.replanning.replan_search import ReplanResult, search
from viaspline.world.world import World

TOO_NARROW = "sees no way on that is wide enough"
"""Why a robot that has come too close does not go on."""

ESCAPE_DIRECTIONS = 48
"""Directions that are tried,"""

ESCAPE_LENGTHS = 12
"""and lengths in each,"""

MAX_ESCAPE_RATIO = 2.0
"""up to so many required distances."""

ESCAPE_SAMPLES = 9
"""Places on the straight way out where the distance is looked at."""


def way_out(
    context: ReplanContext, requirements: Requirements, floor: float
) -> PathCandidate | None:
    """From where the robot stops straight to the nearest place with room, and on from there.

    It turns on the spot at either end.

    Args:
        context: The robot under way.
        requirements: What the path keeps from that place on.
        floor: What it keeps on the way there [m].

    Returns:
        The path, with what it keeps where; None if there is none, or if the robot can't turn on
        the spot.
    """
    if not requirements.turns_at_rest:
        return None
    world, stop = context.knowledge.world, context.stop
    here = np.asarray(context.schedule.path.at_distance(stop))
    roomy = requirements.required if requirements.footprint is None else requirements.around
    place = _roomy_place(world, here, roomy, floor)
    if place is None:
        return None
    share = np.arange(4.0)[:, None] / 3.0
    straight = by_way_of(context, (here + share * (place - here))[None])
    u = float(straight.parameter(stop))
    heading = float(context.schedule.path.heading(float(context.schedule.path.parameter(stop))))
    until_there = requirements.reduced_to(floor)
    if turn_conflict(world, heading, straight.spans[round(u)], until_there) != CLEAR:
        return None
    if round(u) in spans_on_wrong_side(straight, u, world, requirements):
        return None
    at = stop + math.dist(here, place)
    try:
        found = replan.from_rest(straight, at, world, requirements)
    except SpentBudgetError:
        raise  # it goes on in the next step
    except PlanningError:
        return None
    return timed(
        with_less_until(context, at, floor), "from_rest", replace(found, changed_from=stop), (at,)
    )


def set_down(context: ReplanContext, at: Floats, floor: float) -> ReplanContext:
    """A robot that stands beside its path, on one that leads straight to where it was set.

    From there it leads straight to the via points ahead: it is not one to be driven.

    Args:
        context: The robot; its path is one in the plane, and ends.
        at: Where it was set [m], shape (2,).
        floor: What it keeps [m].
    """
    distance, schedule = context.progress.distance, context.schedule
    stood = replace(context, motion=MotionAhead(0.0, distance, (distance,)))
    here = np.asarray(schedule.path.at_distance(distance))
    share = np.arange(4.0)[:, None] / 3.0
    path = by_way_of(stood, (here + share * (at - here))[None])
    by, controller = math.dist(here, at), context.progress.controller
    progress = replace(
        context.progress,
        distance=distance + by,
        cross_track=0.0,
        along_track=0.0,
        controller=None if controller is None else controller.moved(by),
    )
    schedule = replace(
        schedule,
        path=path,
        turns=(*(turn for turn in schedule.turns if turn < distance), distance),
        slow=(),
        reduced=ReducedClearance(math.inf, floor),
        pending=None,
        held_at=math.inf,
        committed_until=-math.inf,
        proven=None,
    )
    law = braking_at_once(context.task, progress, schedule, 0.0)
    schedule = replace(schedule, trajectory=law)
    return ReplanContext.of(context.task, progress, context.knowledge, schedule)


def room_to_stop(context: ReplanContext, spacing: float) -> float:
    """Smallest distance to anything up to where the robot can stop [m].

    Args:
        context: The robot under way.
        spacing: From each place at which that is looked at to the next [m].
    """
    here = context.progress.distance
    along = np.linspace(here, context.stop, 2 + int((context.stop - here) / spacing))
    world, path = context.knowledge.world, context.schedule.path
    return float(np.min(room_along(world, path, along, context.requirements)))


def way_on_from_close(
    context: ReplanContext, floor: float, spacing: float, kept: Sequence[Requirements]
) -> ReplanResult:
    """A way on for a robot that has come too close, by which it comes no closer.

    Args:
        context: The robot under way.
        floor: What it keeps as far as it must [m].
        spacing: From each place at which that is looked at to the next [m].
        kept: What it keeps as soon as there is room: the first that leads on.
    """
    close = replace(
        context,
        schedule=replace(context.schedule, reduced=ReducedClearance(math.inf, floor)),
        requirements=context.task.requirements.reduced_to(floor),
        floor=floor,
    )
    found = search(close)
    if found.candidate is None:
        return found
    skip = frozenset(found.skip)
    for requirements in kept:
        candidate = restore_clearance(close, found.candidate, requirements, floor, spacing, skip)
        if candidate is not None:
            return replace(found, candidate=candidate)
    return ReplanResult(None, TOO_NARROW)


def restore_clearance(
    context: ReplanContext,
    candidate: PathCandidate,
    requirements: Requirements,
    floor: float,
    spacing: float,
    skip: Collection[int],
) -> PathCandidate | None:
    """A path that keeps less than it should, but only as far as it must.

    From the first place on that has enough room it is laid anew. Where none leads on from there,
    it led through a gap that is too narrow.

    Args:
        context: The robot under way, with what the whole path keeps.
        candidate: The path.
        requirements: What it should keep.
        floor: What it keeps [m].
        spacing: From each place at which that is looked at to the next [m].
        skip: Points of the route that are left out.

    Returns:
        The path, with what it keeps where; None if there is none.
    """
    path, start = candidate.solution.path, candidate.solution.changed_from
    world = context.knowledge.world
    places = np.arange(start, path.length, spacing)
    roomy = np.flatnonzero(room_along(world, path, places, requirements) >= requirements.required)
    if not roomy.size:
        return None
    at = float(places[roomy[0]])
    try:
        found = replan.planned(path, at, world, requirements, skip)
    except SpentBudgetError:
        raise  # it goes on in the next step
    except PlanningError:
        return None
    less = with_less_until(context, at, floor)
    return timed(less, candidate.mode, replace(found, changed_from=start))


def with_less_until(context: ReplanContext, until: float, floor: float) -> ReplanContext:
    """A context in which the path keeps less up to a distance along it [m]."""
    reduced = ReducedClearance(until, floor)
    return replace(context, schedule=replace(context.schedule, reduced=reduced))


def by_way_of(context: ReplanContext, spans: Floats) -> Path:
    """The driven path up to the stop, then some spans (n, 4, d), then straight to the vias ahead.

    Args:
        context: The robot under way.
        spans: They begin where it stops.
    """
    path, stop = context.schedule.path, context.stop
    u = float(path.parameter(stop))
    head = path.section(0.0, u).spans if u > 0.0 else np.empty((0, 4, path.dimension))
    ahead = [via for via, at in context.vias_ahead if at > stop]
    corners = [spans[-1, -1], *(np.array(via.at) for via in ahead)]
    share = np.arange(4.0)[:, None] / 3.0
    lines = [a + share * (b - a) for a, b in itertools.pairwise(corners)]
    passed = [via for via in path.vias if via.u <= min(u, float(len(head)))]
    first = len(head) + len(spans) + 1
    to_come: list[PathVia] = [replace(via, u=float(first + k)) for k, via in enumerate(ahead)]
    return Path(np.concatenate((head, spans, np.array(lines))), (*passed, *to_come))


def _roomy_place(world: World, here: Floats, required: float, floor: float) -> Floats | None:
    """The nearest place that keeps ``required``, with ``floor`` kept on the straight way there."""
    angles = np.linspace(0.0, 2.0 * np.pi, ESCAPE_DIRECTIONS, endpoint=False)
    rays = np.column_stack((np.cos(angles), np.sin(angles)))
    share = np.linspace(0.0, 1.0, ESCAPE_SAMPLES)[:, None, None]
    for reach in MAX_ESCAPE_RATIO * required * np.arange(1, ESCAPE_LENGTHS + 1) / ESCAPE_LENGTHS:
        ends = here[None, :2] + reach * rays
        rooms = world.distance(here[None, None, :2] + share * (ends - here[:2])[None])
        free = np.flatnonzero((rooms[-1] >= required) & (rooms.min(axis=0) >= floor))
        if free.size:
            best = free[np.argmax(rooms[-1][free])]
            return np.concatenate((ends[best], here[2:]))
    return None
