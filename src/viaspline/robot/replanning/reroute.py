"""What a robot does about something in its way: goes round it, gives up a point, or stops."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from viaspline.errors import PlanningError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.journey import SAME_PLACE_M, NavigationState
from viaspline.robot.records import give_up, take
from viaspline.robot.replanning.replan_context import ReplanContext, free_until, replan_context_of
from viaspline.robot.replanning.ways_on import Choice, find
from viaspline.robot.run import Event
from viaspline.world.world import World


@dataclass(frozen=True)
class Answer:
    """What to do about a scene.

    Attributes:
        choice: The way on; None if there is none.
        refusal: Why there is none.
        skip: Points of the route that are given up for it, each with the reason.
    """

    choice: Choice | None
    refusal: PlanningError | str = ""
    skip: Mapping[int, str] = field(default_factory=dict)


def notice(journey: NavigationState, obstacles: Sequence[Obstacle]) -> NavigationState:
    """The journey of a robot that has just been told of these obstacles for the first time."""
    belief = journey.belief
    if belief is None:
        old, world = len(journey.world), journey.world.with_obstacles(obstacles)
    else:
        old, belief = len(belief.map), belief.told(obstacles)
        world = belief.world
    names = tuple(world.name(old + i) for i in range(len(obstacles)))
    here = journey.place(journey.distance)
    new = World(
        obstacle.model_copy(update={"name": name})
        for obstacle, name in zip(obstacles, names, strict=True)
    )
    gaps = [float(new.distances_to(i, here)) for i in range(len(obstacles))]
    seen = journey.seen.union(obstacles)
    journey = replace(journey, world=world, belief=belief, seen=seen).noted(
        *(
            Event("detected", journey.time, here, f"sees '{name}' {gap:.1f} m away", {"name": name})
            for name, gap in zip(names, gaps, strict=True)
        )
    )
    if journey.finished or journey.giving_up is not None:
        return journey
    free = free_until(journey, new)
    if free is None:
        return journey
    began = clock.perf_counter()
    context = replan_context_of(journey, new, names, free, journey.requirements)
    found = answer(context, world)
    if found.choice is None:
        journey = give_up(journey, context.speed, str(found.refusal))
    else:
        journey = take(context, found.choice, found.skip)
    spent = clock.perf_counter() - began
    return replace(journey, compute_times=(*journey.compute_times, spent))


def answer(context: ReplanContext, world: World) -> Answer:
    """A way on, past points of the route that can't be reached any more, or why there is none."""
    if not context.is_clear(context.stop):
        return Answer(None, _too_late(context))
    skip, reason = _covered(context)
    if reason is not None:
        return Answer(None, reason)
    while True:
        try:
            return Answer(find(context, world, frozenset(skip)), skip=skip)
        except PlanningError as error:
            lost = _lost(context, skip, error)
            if lost is None:
                return Answer(None, error)
            skip[lost] = error.reason


def _too_late(context: ReplanContext) -> str:
    distance, nearest = context.against.nearest(context.journey.path.at_distance(context.stop))
    name, requirements = context.against.name(int(nearest)), context.journey.requirements
    gap = f"{float(distance) - requirements.radius:.2f} m"
    inside = f"inside the clearance of {requirements.kept:g} m that it has to keep"
    if context.speed == 0.0:
        return f"the robot stands {gap} from '{name}', {inside}"
    return (
        f"'{name}' appeared inside the braking distance; the robot comes to stand {gap} from it, "
        f"{inside}"
    )


def _covered(context: ReplanContext) -> tuple[dict[int, str], str | None]:
    """The points still to come that what is in the way covers; a reason if the goal is one."""
    journey = context.journey
    ahead = [(via, at) for via, at in journey.ahead if at > context.stop + SAME_PLACE_M]
    if not ahead:
        return {}, None
    places = np.array([via.at[:2] for via, _ in ahead])
    distances, nearest = context.against.nearest(places)
    covered: dict[int, str] = {}
    for k in np.flatnonzero(distances < context.floor).tolist():
        via, name = ahead[k][0], context.against.name(int(nearest[k]))
        free = float(distances[k]) - journey.requirements.radius
        why = f"'{name}' leaves {free:.2f} m there, {journey.requirements.kept:g} m are needed"
        if free < 0.0:
            why = f"'{name}' covers it"
        if via.u >= journey.path.domain[1] - 1e-9:
            return {}, f"the goal '{via.name}' can't be reached any more: {why}"
        assert via.index is not None
        covered[via.index] = why
    return covered, None


def _lost(context: ReplanContext, skip: Mapping[int, str], error: PlanningError) -> int | None:
    """Index of the point that an error says can't be reached, if the robot may go on without."""
    path = context.journey.path
    for via, at in context.journey.ahead:
        is_goal = via.u >= path.domain[1] - 1e-9
        if via.name == error.via and at > context.stop + SAME_PLACE_M and not is_goal:
            return via.index if via.index not in skip else None
    return None
