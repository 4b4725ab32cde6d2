"""Another path for a robot with a lidar: the old one is blocked, or a better one has opened."""

from __future__ import annotations

import math
import time as clock
from dataclasses import replace
from itertools import pairwise

import numpy as np

from viaspline.errors import PlanningError
from viaspline.planning.checking.conflicts import too_close
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.routing.leg_errors import BlockedLegError, UnfinishedLegError
from viaspline.robot.journey import SAME_PLACE_M, NavigationState, ReducedClearance, Wait
from viaspline.robot.records import give_up, take
from viaspline.robot.replanning.escape import relieved, way_out
from viaspline.robot.replanning.kept_sides import is_better
from viaspline.robot.replanning.replan_context import ReplanContext, replan_context_of, speed_now
from viaspline.robot.replanning.reroute import Answer, answer
from viaspline.robot.replanning.ways_on import anew
from viaspline.robot.run import Event

SPARE = 0.1
"""What a new path keeps beyond what is required where there is room for it, of that distance: so
that what shows a little more of itself later does not block it again."""

EVERY = 0.25  # a path that is blocked far ahead is laid anew no more often than this [s]
AGAIN = 0.5  # after it has found no way, a robot tries again so much later [s]
REVIEW = 1.0  # whether a better way has opened is asked no more often than this [s]
PATIENCE = 5.0  # a robot gives up if it has stood so long without a way [s]
TOUCH = 1e-3  # by which a robot that has come too close may come closer yet [m]


def way_round(journey: NavigationState, free: float) -> NavigationState:
    """Round what the path comes too close to, ``free`` metres along it at the soonest."""
    if _may_wait(journey, free):
        return journey
    began = clock.perf_counter()
    context, found = _answer(journey, free)
    if found.choice is not None:
        journey = replace(take(context, found.choice, found.skip), wait=None)
    else:
        journey = _hold(journey, context, _plain(found.refusal))
    return _timed(journey, began)


def better(journey: NavigationState, *, opened: bool) -> NavigationState:
    """A path that is clearly shorter than the one that is driven, if there may be one.

    Args:
        journey: With nothing in its way.
        opened: Whether something that was seen before has gone.
    """
    tight = journey.close is not None and journey.close.until > journey.distance
    if not (opened or tight) or journey.time < journey.reviewed + REVIEW or journey.dwell:
        return journey
    rest = journey.path.length - journey.distance
    if not tight and not is_better(_straight(journey), rest):
        return journey
    began = clock.perf_counter()
    journey = replace(journey, reviewed=journey.time)
    context = replan_context_of(
        journey, journey.world, (), journey.path.length, _spared(journey.requirements)
    )
    freed = replace(context, journey=replace(journey, close=None))
    try:
        choice = anew(freed, journey.world)
    except PlanningError:
        return _timed(journey, began)
    if tight or is_better(choice.found.path.length - journey.distance, rest):
        journey = take(freed, choice, {})
    return _timed(journey, began)


def _timed(journey: NavigationState, began: float) -> NavigationState:
    spent = clock.perf_counter() - began
    return replace(journey, compute_times=(*journey.compute_times, spent))


def _may_wait(journey: NavigationState, free: float) -> bool:
    """Whether a blocked path is not to be laid anew yet: it was just now, or it was in vain."""
    wait = journey.wait
    if wait is not None and wait.reason is not None:
        return journey.time < wait.again
    if not journey.replans or journey.time >= journey.replans[-1].time + EVERY:
        return False
    return (
        free > journey.distance + EVERY * speed_now(journey) + 2.0 * journey.requirements.required
    )


def _straight(journey: NavigationState) -> float:
    """Length of the way on if nothing were in it [m]."""
    stops = [journey.place(journey.distance), *(via.at for via, _ in journey.ahead)]
    return sum(math.dist(a, b) for a, b in pairwise(stops))


def _spared(requirements: Requirements) -> Requirements:
    return replace(requirements, clearance=requirements.clearance + SPARE * requirements.required)


def _answer(journey: NavigationState, free: float) -> tuple[ReplanContext, Answer]:
    """A way on that keeps something to spare; if there is none, one that keeps what it must.

    A robot that has come too close already leaves at the distance that it has, as long as what
    it is close to has not been hit within its body.
    """
    names, journey = _detected(journey)
    requirements, world = journey.requirements, journey.world
    journey = replace(journey, close=None)
    context = replan_context_of(journey, world, names, free, requirements)
    room = _room(context)
    if room >= requirements.required:
        found = answer(replace(context, requirements=_spared(requirements)), world)
        return context, answer(context, world) if found.choice is None else found
    floor = max(room - TOUCH, requirements.radius - journey.cell_size)
    if requirements.required - room > journey.cell_size:
        out = way_out(context, world, _spared(requirements), floor) or way_out(
            context, world, requirements, floor
        )
        if out is not None:
            return out[0], Answer(out[1])
    context = replace(
        context, journey=replace(journey, close=ReducedClearance(math.inf, floor)), floor=floor
    )
    eased = replace(
        requirements, clearance=floor - requirements.radius - requirements.tracking_error
    )
    found = answer(replace(context, requirements=eased), world)
    if found.choice is None:
        return context, found
    context, choice = relieved(context, found.choice, world, _spared(requirements), set(found.skip))
    return context, replace(found, choice=choice)


def _room(context: ReplanContext) -> float:
    """Smallest distance to anything up to where the robot can stop [m]."""
    journey = context.journey
    count = 2 + int((context.stop - journey.distance) / journey.cell_size)
    places = journey.path.at_distance(np.linspace(journey.distance, context.stop, count))
    return float(np.min(context.against.distance(places)))


def _detected(journey: NavigationState) -> tuple[tuple[str, ...], NavigationState]:
    """Names of what is in the way, one for each cluster of it, and the journey with its events."""
    path, world = journey.path, journey.world
    close: list[int] = []
    for start, end, floor in journey.stretches(path.length):
        if end - start > SAME_PLACE_M:
            part = path.section(*np.asarray(path.parameter(np.array([start, end]))).tolist())
            close += too_close(world, part.spans, floor).tolist()
    here = journey.place(journey.distance)
    names: list[str] = []
    events: list[Event] = []
    last = (math.inf, math.inf)
    for index in dict.fromkeys(index for index in close if index >= 0):
        circle = world.obstacles[index].circle
        if (
            circle is not None
            and math.dist(circle.center, last) < 2.0 * journey.requirements.required
        ):
            continue
        last = last if circle is None else circle.center
        name, gap = world.name(index), float(world.distances_to(index, here))
        names.append(name)
        message = f"sees '{name}' {gap:.1f} m away"
        events.append(Event("detected", journey.time, here, message, {"name": name}))
    return tuple(names), journey.noted(*events)


def _plain(refusal: PlanningError | str) -> str:
    """Why there is no way on, as far as a robot can tell that sees a part of the world."""
    if isinstance(refusal, BlockedLegError | UnfinishedLegError):
        return f"sees no way to '{refusal.via}'"
    return str(refusal)


def _hold(journey: NavigationState, context: ReplanContext, reason: str) -> NavigationState:
    """Stay on the path as far as it is clear; give up after a long stand."""
    since = journey.time if journey.wait is None else journey.wait.since
    if context.speed > 0.0:
        since = journey.time
        if journey.wait is None:
            here = journey.place(journey.distance)
            journey = journey.noted(Event("braked", journey.time, here, f"brakes: {reason}"))
    if journey.time - since >= PATIENCE:
        return give_up(journey, context.speed, reason)
    return replace(journey, wait=Wait(since, journey.time + AGAIN, reason))
