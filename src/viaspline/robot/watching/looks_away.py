"""A robot that never turns on the spot and looks another way than its path: where it gets to.

Its path begins as it should look. One that is set down otherwise comes to it by an arc, as far
beside it as that takes.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.machine.turns_on_spot import heading_onward
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.state import RobotState
from viaspline.robot.watching.measured_motion import noise_of
from viaspline.robot.watching.set_beside import way_back

AWAY_RAD = 0.35
"""By which it may look another way; the control law copes with that [rad]."""

WIDER = (1.0, 1.3)
"""Arcs that it may drive, over its turning circle: it steers in and out."""

PLACES = 33
"""On an arc at which the room is looked at."""


def looks_away_by(robot: RobotSpec, path: Path, distance: float, measured: RobotState) -> float:
    """By how much it looks another way, if it can't turn on the spot [rad]; left is positive.

    Args:
        robot: The mission's.
        path: What it drives.
        distance: Where it is along that [m].
        measured: Where it is.

    Returns:
        0 if that is no more than its control law, or noise, makes of it.
    """
    if path.dimension > 2 or robot.turn_radius is None or robot.turns_on_spot != "never":
        return 0.0
    turned = noise_of(robot)[1]
    angle = math.remainder(measured.heading - heading_onward(path, distance), math.tau)
    return angle if abs(angle) > AWAY_RAD + turned else 0.0


def ways_to_path(
    path: Path, distance: float, measured: RobotState, angle: float, radius: float, over: float
) -> Floats:
    """Where a robot gets to that turns to its path and comes back to it.

    Args:
        path: It comes back to this one.
        distance: Its place along that [m].
        measured: Where it is.
        angle: By which it looks another way [rad].
        radius: Of its turning circle [m].
        over: The distance over which a deviation dies out [m].

    Returns:
        Places on two such ways, (n, 2).

    Example:
        >>> path = Path([[[0, 0], [9, 0], [18, 0], [27, 0]]], vias=[])
        >>> up = RobotState((1.0, 0.0), math.pi / 2, 0.0)
        >>> ways_to_path(path, 1.0, up, math.pi / 2, 2.0, over=1.0).max(axis=0).round(1).tolist()
        [8.8, 2.6]
    """
    x, y = measured.position
    side = -math.copysign(1.0, angle)
    headings = measured.heading + side * np.linspace(0.0, abs(angle), PLACES)
    aside = np.column_stack((np.sin(headings), -np.cos(headings)))
    onward, here = heading_onward(path, distance), np.asarray(path.at_distance(distance))
    ahead = np.array([math.cos(onward), math.sin(onward)])
    ways = []
    for times in WIDER:
        arc = np.array([x, y]) + side * times * radius * (aside - aside[0])
        along = float((arc[-1] - here) @ ahead)
        beside = min(max(distance + along, 0.0), path.length)
        ways += [arc, way_back(path, beside, arc[-1], over)]
    return np.concatenate(ways)
