"""Retreat out of a pocket, back along what was driven: where a body has been, it can be.

What a lidar has seen may close a gap behind a robot that has just come through it: noise moves
surfaces by more than the gap has to spare, or more of them shows from the other side. The body
itself has proven that it fits. So a robot that stands and knows no way on turns on the spot, drives
back as it came, through what it takes for too narrow, to where a way leads on.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.errors import PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.planning import replan
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.robot.navigation.progress import SAME_PLACE_M
from viaspline.robot.replanning.path_candidate import timed
from viaspline.robot.replanning.recovery import by_way_of, with_less_until
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.replan_search import ReplanResult

SPACING_RATIO = 0.1
"""From place to place at which the room is looked at, of the distance that is required."""

TRACK_SLACK_M = 1e-3
"""By which the way back may keep less than its samples show [m]."""


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
    ways = _ways_back(context, requirements.required, least)
    if not requirements.turns_at_rest or requirements.footprint is not None or not ways:
        return ReplanResult(None)
    path, stop = context.schedule.path, context.stop
    place, floor = ways[attempt % len(ways)]
    back = path.section(*np.asarray(path.parameter(np.array([place, stop]))).tolist())
    route = by_way_of(context, np.ascontiguousarray(back.spans[::-1, ::-1]))
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
    context: ReplanContext, required: float, least: float
) -> tuple[tuple[float, float], ...]:
    """Where to go back to, the nearest first: the place, and the distance kept on the way [m].

    Of all the places between two gaps one is enough: where none leads on from it, none does from
    the others.
    """
    path, stop = context.schedule.path, context.stop
    count = 2 + int(stop / max(SPACING_RATIO * required, SAME_PLACE_M))
    places = np.linspace(stop, 0.0, count)
    room: Floats = context.knowledge.world.distance(path.at_distance(places))
    floors = np.minimum.accumulate(room) - TRACK_SLACK_M
    roomy = room >= required
    beyond = 1 + np.flatnonzero(roomy[1:] & ~roomy[:-1])
    return tuple(
        (float(places[k]), float(floors[k])) for k in beyond.tolist() if floors[k] >= least
    )
