"""Retreat out of a pocket, back along what was driven: where a body has been, it can be.

What a lidar has seen may close a gap behind a robot that has just come through it: noise moves
surfaces by more than the gap has to spare, or more of them shows from the other side. The body
itself has proven that it fits. So a robot that stands and knows no way on turns on the spot, drives
back as it came, through what it takes for too narrow, to where a way leads on.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.machine.turns_on_spot import corners
from viaspline.planning.checking.conflicts import CLEAR, turn_conflict
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.replanning import replan
from viaspline.robot.navigation.progress import SAME_PLACE_M
from viaspline.robot.replanning.path_candidate import timed
from viaspline.robot.replanning.recovery import by_way_of, with_less_until
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.replan_search import ReplanResult

SPACING_RATIO = 0.1
"""From place to place at which the room is looked at, of the distance that is required."""

TRACK_SLACK_M = 1e-3
"""By which the way back may keep less than its samples show [m]."""

BODY_SPACING_M = 0.01
"""From sample to sample of a polygon, of which a corner may pass something closely [m]."""

BEFORE_JOINT = 1e-9
"""A heading with which a corner is reached is looked up so far before it, in the parameter."""


def retreat(
    context: ReplanContext, requirements: Requirements, least: float, attempt: int
) -> ReplanResult:
    """Back along what was driven, to a place from which there is a way on, and on from there.

    Args:
        context: The robot; it stands.
        requirements: What the path keeps from that place on.
        least: What is nearer to the way back than this was not there when it was driven [m].
        attempt: 0 tries the nearest place, every further one the next: so that no decision takes
            long.

    Returns:
        The path, with what it keeps where; if there is none, why the place leads nowhere. Without
        a reason if there is no such place, or if the robot can't turn round where it stands.
    """
    if not requirements.turns_at_rest:
        return ReplanResult(None)
    if requirements.footprint is not None:
        least = max(least, requirements.radius + 2.0 * TRACK_SLACK_M)
    ways = _ways_back(context, requirements, least)
    if not ways:
        return ReplanResult(None)
    path, stop = context.schedule.path, context.stop
    place, floor = ways[attempt % len(ways)]
    section = path.section(*np.asarray(path.parameter(np.array([place, stop]))).tolist())
    back = PiecewiseCubic(np.ascontiguousarray(section.spans[::-1, ::-1]))
    if requirements.footprint is not None:
        floor = _body_floor(context, requirements, place)
        if floor < least or not _turns_round(context, back, requirements, floor):
            return ReplanResult(None)
    route = by_way_of(context, back.spans)
    at = 2.0 * stop - place
    try:
        found = replan.from_rest(route, at, context.knowledge.world, requirements)
    except SpentBudgetError:
        raise  # it goes on in the next step
    except PlanningError as error:
        return ReplanResult(None, error)
    turns = sorted(2.0 * stop - turn for turn in context.schedule.turns if place < turn < stop)
    narrowed = with_less_until(context, at, floor)
    solution = replace(found, changed_from=stop)
    return ReplanResult(timed(narrowed, "from_rest", solution, (*turns, at)))


def _ways_back(
    context: ReplanContext, requirements: Requirements, least: float
) -> tuple[tuple[float, float], ...]:
    """Where to go back to, the nearest first: the place, and the distance kept on the way [m].

    Of all the places between two gaps one is enough: where none leads on from it, none does from
    the others. At a place a polygon has room to turn.
    """
    stop, required = context.stop, requirements.required
    count = 2 + int(stop / max(SPACING_RATIO * required, SAME_PLACE_M))
    places = np.linspace(stop, 0.0, count)
    room = _room_back(context, requirements, places)
    floors = np.minimum.accumulate(room) - TRACK_SLACK_M
    if requirements.footprint is None:
        roomy = room >= required
    else:
        middles = np.asarray(context.schedule.path.at_distance(places))
        roomy = context.knowledge.world.distance(middles) >= requirements.around
    beyond = 1 + np.flatnonzero(roomy[1:] & ~roomy[:-1])
    return tuple(
        (float(places[k]), float(floors[k])) for k in beyond.tolist() if floors[k] >= least
    )


def _room_back(context: ReplanContext, requirements: Requirements, places: Floats) -> Floats:
    """The room at places of the path for a body that looks back along it [m], shape (n,).

    That of a polygon is no less than its largest disc's radius; see ``room_along``.
    """
    path, world = context.schedule.path, context.knowledge.world
    if requirements.footprint is None:
        room: Floats = world.distance(path.at_distance(places))
        return room
    u = np.asarray(path.parameter(places))
    at, headings = np.asarray(path.evaluate(u))[:, :2], np.asarray(path.heading(u)) + np.pi
    return requirements.radius + world.body_distance(at, headings, requirements.footprint)


def _body_floor(context: ReplanContext, requirements: Requirements, place: float) -> float:
    """The distance that a polygon keeps on its way back to a place [m]."""
    stop = context.stop
    places = np.linspace(place, stop, 2 + math.ceil((stop - place) / BODY_SPACING_M))
    return float(_room_back(context, requirements, places).min()) - TRACK_SLACK_M


def _turns_round(
    context: ReplanContext, back: PiecewiseCubic, requirements: Requirements, floor: float
) -> bool:
    """Whether a polygon can turn where it stands, and wherever it has turned on its way.

    Args:
        context: The robot; it stands.
        back: Its way back.
        requirements: The body.
        floor: What it keeps there [m].
    """
    body, path = requirements.reduced_to(floor), context.schedule.path
    joints = np.rint(np.asarray(back.parameter(corners(back)[0]))).astype(int).tolist()
    before = [float(back.heading(joint - BEFORE_JOINT)) for joint in joints]
    arrivals = [float(path.heading(float(path.parameter(context.stop)))), *before]
    return all(
        turn_conflict(context.knowledge.world, arrival, back.spans[joint], body) == CLEAR
        for arrival, joint in zip(arrivals, (0, *joints), strict=True)
    )
