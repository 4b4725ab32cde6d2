"""Where a path turns on the spot, and how long that takes a drive."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.trajectory.limits import Station

CORNER_RAD = 0.02
"""Spans whose headings differ by more meet in a corner; less is steered away [rad]."""

SETTLING_TIMES = 3.0
"""Time constants until a heading, or a direction of travel, is right."""

SAME_DISTANCE_M = 1e-6
"""Distances nearer than this are one place [m]."""


def corners(path: PiecewiseCubic) -> tuple[Floats, Floats]:
    """Where the heading of a path jumps, and by how much.

    Args:
        path: Of its curves in space, the ground track counts.

    Returns:
        Distances along it [m], shape (k,), and angles, left is positive [rad], shape (k,).

    Example:
        >>> right, up = [[0, 0], [1, 0], [2, 0], [3, 0]], [[3, 0], [3, 1], [3, 2], [3, 3]]
        >>> at, angle = corners(PiecewiseCubic([right, up]))
        >>> at.round(9).tolist(), angle.round(3).tolist()
        ([3.0], [1.571])
    """
    flat = path.spans[:, :, :2]
    moves = np.linalg.norm(flat - flat[:, :1], axis=2).max(axis=1) > SAME_DISTANCE_M
    index = np.flatnonzero(moves)
    first, last = _direction(flat[index]), _direction(flat[index, ::-1]) + np.pi
    jumps = np.remainder(first[1:] - last[:-1] + np.pi, 2.0 * np.pi) - np.pi
    found = np.flatnonzero(np.abs(jumps) > CORNER_RAD)
    if not found.size:
        return np.empty(0), np.empty(0)
    return np.atleast_1d(np.asarray(path.distance(index[found + 1].astype(float)))), jumps[found]


def _direction(spans: Floats) -> Floats:
    """From the first control point of each span to the first other one [rad], shape (m,)."""
    legs = spans[:, 1:] - spans[:, :1]
    sizes = np.linalg.norm(legs, axis=2)
    first = np.argmax(sizes > 1e-9 * (1.0 + sizes.max(axis=1, keepdims=True)), axis=1)
    leg = legs[np.arange(len(legs)), first]
    angles: Floats = np.arctan2(leg[:, 1], leg[:, 0])
    return angles


def turns_where_it_stands(model: DriveModel) -> bool:
    """Whether a drive turns on the spot to look along its path."""
    return model.actuators.wheelbase <= 0.0 and math.isnan(model.actuators.held_heading)


def turn_time(model: DriveModel, angle: float) -> float:
    """How long a drive takes for a turn on the spot [s], angle [rad]; 0 if it can't.

    One whose body keeps its heading only has to come to rest.
    """
    if model.actuators.wheelbase > 0.0:
        return 0.0
    if not math.isnan(model.actuators.held_heading):
        return SETTLING_TIMES * model.lag
    return abs(angle) / model.spot_rate + SETTLING_TIMES / model.heading_gain + model.lag


def with_turns(
    path: PiecewiseCubic, model: DriveModel, stations: Sequence[Station], start: float = 0.0
) -> list[Station]:
    """Stations with one for every corner ahead, at which the robot stays until it has turned.

    Args:
        path: What is driven.
        model: The drive of the robot.
        stations: Stops that there are anyway; they are kept.
        start: Corners up to this distance along the path are left out [m].
    """
    stops = list(stations)
    for at, angle in zip(*corners(path), strict=True):
        if at <= start + SAME_DISTANCE_M:
            continue
        needed = turn_time(model, float(angle))
        stays = sum(
            stop.dwell for stop in stops if math.isclose(stop.distance, at, abs_tol=SAME_DISTANCE_M)
        )
        if needed > stays:
            stops.append(Station(float(at), needed - stays, "turn"))
    return sorted(stops, key=lambda stop: stop.distance)
