"""Where beside its path a robot truly is, as measured: how far along it, and how far off.

Tested through ``robot/watching/test_path_deviation``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.navigation.track_path import ON_PATH_M, project
from viaspline.robot.state import RobotState

AROUND_M = 0.5
"""A robot is looked for so far before and behind where it was and where it should be [m]."""

PASSED_M = 0.1
"""It has passed a corner when it should be so far behind that [m]."""

TURNING_MPS = 0.05
"""One that is slower may be turning where it stands [m/s]."""

AT_TURN_M = 1e-3
"""And one that is nearer to a corner than this is at it [m]."""


@dataclass(frozen=True)
class TruePlace:
    """Where a robot is, as measured.

    Attributes:
        distance: Along its path [m].
        aside: How far its reference point is beside the path there [m].
        off: How far any point of its body is from where it would be on the path [m].
    """

    distance: float
    aside: float
    off: float


def is_there(schedule: Schedule, measured: RobotState, should: float) -> bool:
    """Whether a robot is exactly where it should be along its path [m]."""
    place = np.asarray(schedule.path.at_distance(should))
    return float(np.linalg.norm(np.asarray(measured.position) - place)) <= ON_PATH_M


def is_held_at_turn(schedule: Schedule, place: TruePlace, should: float) -> bool:
    """Whether a robot is taken to be at a place where it turns until it should be farther.

    What it drives there can't be told from its place.

    Args:
        schedule: What it means to do.
        place: Where it is on its path.
        should: Distance along the path at which it should be [m].
    """
    return place.distance in schedule.turns and place.distance > should - PASSED_M


def is_just_past_turn(schedule: Schedule, should: float) -> bool:
    """Whether a robot should be so little beyond a turn that it may be taken to be before it.

    Args:
        schedule: What it means to do.
        should: Distance along the path at which it should be [m].
    """
    return any(should - PASSED_M < turn <= should for turn in schedule.turns)


def true_place(
    robot: RobotSpec,
    schedule: Schedule,
    measured: RobotState,
    should: float,
    last: float,
    around: float = 0.0,
) -> TruePlace:
    """Where a robot is on its path.

    It is looked for near where it was and where it should be, so a path that crosses or repeats
    itself makes no difference.

    Args:
        robot: Its body.
        schedule: Its path.
        measured: Where it is.
        should: Distance along the path at which it should be [m].
        last: Distance at which it was in the step before [m].
        around: By which more it is looked for before and behind [m].
    """
    path = schedule.path
    if is_there(schedule, measured, should):
        return TruePlace(should, 0.0, 0.0)
    turns, moves = schedule.turns, measured.ground_speed > TURNING_MPS
    passed = [turn for turn in turns if turn <= should - PASSED_M]
    left = [turn for turn in turns if should - PASSED_M < turn <= should]
    to_come = [turn for turn in turns if turn > should]
    low = max([min(last, should) - AROUND_M - around, 0.0, *passed])
    high = min([max(last, should) + AROUND_M + around, path.length, *to_come])
    until = min([high, *left])
    found = [(project(path, measured.position, min(low, until), until), moves)]
    if left:  # how it looks tells whether it has left the turn, and stands or creeps beyond it
        found.append((project(path, measured.position, left[-1], max(high, left[-1])), True))
    reach = 2.0 * max(robot.outer_radius, AT_TURN_M)
    offs = []
    for (distance, aside), looks_on in found:
        turned = _turned(robot, schedule, measured.heading, distance) if looks_on else 0.0
        offs.append((aside + reach * math.sin(0.5 * turned), distance, aside))
    off, distance, aside = min(offs)
    return TruePlace(distance, aside, aside if robot.footprint is None else off)


def _turned(robot: RobotSpec, schedule: Schedule, heading: float, distance: float) -> float:
    """By how much a body looks another way than its path leads at a place of it [rad].

    Where it turns on the spot that is the way on or the way that it came, until it stands.
    """
    if robot.held_heading is not None:
        return abs(math.remainder(heading - robot.held_heading, math.tau))
    path, places = schedule.path, [distance]
    for turn in schedule.turns:
        if abs(turn - distance) <= AT_TURN_M:
            places += [max(turn - AT_TURN_M, 0.0), min(turn + AT_TURN_M, path.length)]
    ways = np.asarray(path.heading(np.asarray(path.parameter(np.array(places)))))
    return min(abs(math.remainder(heading - way, math.tau)) for way in ways.tolist())
