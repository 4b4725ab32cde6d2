"""A way on for a robot whose path is blocked: from the least change to the greatest."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from viaspline.errors import GeometryError, PlanningError
from viaspline.planning import replan
from viaspline.planning.alternatives.solution import Solution
from viaspline.robot.journey import SAME_PLACE_M, certain_until, trajectory_along
from viaspline.robot.replanning.kept_sides import changed_side, is_better
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.run import Mode
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World

SAMPLES = 129  # of a way, to see whether it leads back


@dataclass(frozen=True)
class Choice:
    """A way on: how it was found, where the robot turns on the spot, and when it is where."""

    mode: Mode
    found: Solution
    turns: tuple[float, ...]
    trajectory: Trajectory


def find(context: ReplanContext, world: World, skip: Collection[int] = frozenset()) -> Choice:
    """The first of: reflex, planned, from rest. It keeps the sides of the path that is driven.

    A robot under way doesn't turn back on the spot: a way that leads behind it is left for a
    robot that has come to rest. And it passes nothing that it knew on another side than it meant
    to, unless that is clearly better.

    Args:
        context: The robot under way.
        world: What the way keeps clear of.
        skip: Points of the route that are left out.

    Raises:
        PlanningError: If there is no way to the goal, or none was found.
    """
    choice = _first_way(context, world, skip)
    journey = context.journey
    changed = changed_side(
        journey.path, choice.found.path, choice.found.changed_from, journey.last, journey.laid,
        context.requirements.required,
    )  # fmt: skip
    if changed is None:
        return choice
    place, side = changed
    now = int(world.nearest(place)[1])
    if now < 0 or world.obstacles[now].forced_side is not None:
        return choice
    try:
        kept = _first_way(context, world.with_side(now, side), skip)
    except PlanningError:
        return choice
    rest, other = (c.found.path.length - journey.distance for c in (choice, kept))
    return choice if is_better(rest, other) else kept


def anew(context: ReplanContext, world: World) -> Choice:
    """Everything ahead laid anew, under way or from rest.

    Raises:
        PlanningError: If there is no way to the goal, or none was found.
    """
    return _first_way(context, world, (), ("planned",))


def _first_way(
    context: ReplanContext,
    world: World,
    skip: Collection[int],
    modes: tuple[Mode, ...] = ("reflex", "planned"),
) -> Choice:
    path, requirements = context.journey.path, context.requirements
    leaves = [leave for leave in context.leaves if context.may_leave(leave)]
    for mode in ("planned",) if skip else modes:
        for leave in leaves:
            try:
                if mode == "reflex":
                    found = replan.reflex(path, leave, world, requirements)
                else:
                    found = replan.planned(path, leave, world, requirements, skip=skip)
            except PlanningError:
                continue  # a robot that leaves later, or that stands, may find a way
            choice = timed(context, mode, found)
            if choice is not None and not _turns_back(context, found):
                return choice
    found = replan.from_rest(path, context.stop, world, requirements, skip=skip)
    choice = timed(context, "from_rest", found)
    assert choice is not None  # a robot that stands can go any way on
    return choice


def _turns_back(context: ReplanContext, found: Solution) -> bool:
    """Whether a way leads farther behind the place where it begins than the old path does."""
    at, old, new = found.changed_from, context.journey.path, found.path
    place, ahead = np.asarray(old.at_distance(at)), old.tangent(float(old.parameter(at)))
    depths = [
        float(((line.at_distance(np.linspace(at, line.length, SAMPLES)) - place) @ ahead).min())
        for line in (old, new)
    ]
    return depths[1] < depths[0] - context.requirements.required


def timed(
    context: ReplanContext, mode: Mode, found: Solution, then: tuple[float, ...] = ()
) -> Choice | None:
    """A way with its time law; None if the robot is too fast to go over to it.

    Args:
        context: The robot under way.
        mode: How the way was found; from rest the robot turns where it stops,
        found: The way.
        then: and at these distances along it [m].
    """
    journey = context.journey
    turns = tuple(turn for turn in journey.turns if turn <= found.changed_from + SAME_PLACE_M)
    stands = mode == "from_rest"
    certain = certain_until(journey, found.path, found.changed_from)
    if stands:
        turns, certain = (*turns, context.stop, *then), max(certain, context.stop)
    try:
        trajectory = trajectory_along(
            journey, found.path, turns,
            distance=journey.distance, speed=context.speed, time=journey.time, end=certain,
        )  # fmt: skip
    except GeometryError:
        return None  # it could not stop within what it has seen of it
    if trajectory.over_limit_until is not None and not stands:
        return None
    return Choice(mode, found, turns, trajectory)
