"""Where a path turns on the spot, and how long that takes a drive."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cusps import SAME_CUSP, beside_cusps, cusps
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.mission.spot_turning import SpotTurning
from viaspline.trajectory.limits import Station

CORNER_RAD = 0.02
"""Spans whose headings differ by more meet in a corner; less is steered away [rad]."""

TURN = "turn"
"""What the stay of a robot that turns on the spot is called."""

SAME_DISTANCE_M = 1e-6
"""Distances nearer than this are one place [m]."""


def corners(path: PiecewiseCubic) -> tuple[Floats, Floats]:
    """Where the heading of a path jumps, and by how much: between spans, and at cusps in them.

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
    back = cusps_of(path)
    if not found.size and not back.size:
        return np.empty(0), np.empty(0)
    u = np.concatenate((index[found + 1].astype(float), back))
    angles = np.concatenate((jumps[found], _turns_at(path, back)))
    order = np.argsort(u, kind="stable")
    return np.atleast_1d(np.asarray(path.distance(u[order]))), angles[order]


def cusps_of(path: PiecewiseCubic) -> Floats:
    """Parameters of the cusps inside of the spans of a path, in order, shape (k,).

    What turns by more than a right angle within three millimetres is one.

    Args:
        path: Of its curves in space, the ground track counts.

    Example:
        >>> cusps_of(PiecewiseCubic([[[0, 0], [4, 0], [4, 0], [0, 0]]])).tolist()
        [0.5]
    """
    return cusps(np.array(path.spans[:, :, :2], order="C"))  # numba compiles for one kind


def beside_cusps_of(path: PiecewiseCubic, at: Floats) -> Floats:
    """How far in the parameter before and after its cusps a path looks as it comes and goes, (k,).

    Args:
        path: Of its curves in space, the ground track counts.
        at: From ``cusps_of``.
    """
    return beside_cusps(np.array(path.spans[:, :, :2], order="C"), at)


def _turns_at(path: PiecewiseCubic, at: Floats) -> Floats:
    """By how much a path turns at its cusps [rad], (k,): at a true one by half a turn."""
    beside = beside_cusps_of(path, at)
    turns = np.asarray(path.heading(at + beside)) - np.asarray(path.heading(at - beside))
    turns = np.remainder(turns + np.pi, 2.0 * np.pi) - np.pi
    found: Floats = np.where(beside == SAME_CUSP, np.pi, turns)
    return found


def seam_corner(path: PiecewiseCubic) -> float:
    """By how much a path that ends where it starts turns there [rad], left is positive.

    0 where it goes on smoothly, or ends elsewhere.

    Example:
        >>> there, back = [[0, 0], [1, 0], [2, 0], [3, 0]], [[3, 0], [3, 3], [0, 3], [0, 0]]
        >>> round(seam_corner(PiecewiseCubic([there, back])), 3)
        1.571
        >>> seam_corner(PiecewiseCubic([there]))
        0.0
    """
    flat = path.spans[:, :, :2]
    moving = np.flatnonzero(np.ptp(flat, axis=1).max(axis=1) > SAME_DISTANCE_M)
    if not moving.size or np.abs(flat[-1, 3] - flat[0, 0]).max() > SAME_DISTANCE_M:
        return 0.0
    after, before = _direction(flat[moving[:1]]), _direction(flat[moving[-1:], ::-1]) + np.pi
    turn = float((np.remainder(after - before + np.pi, 2.0 * np.pi) - np.pi)[0])
    return turn if abs(turn) > CORNER_RAD else 0.0


def _direction(spans: Floats) -> Floats:
    """From the first control point of each span to the first other one [rad], shape (m,)."""
    legs = spans[:, 1:] - spans[:, :1]
    sizes = np.linalg.norm(legs, axis=2)
    first = np.argmax(sizes > 1e-9 * (1.0 + sizes.max(axis=1, keepdims=True)), axis=1)
    leg = legs[np.arange(len(legs)), first]
    angles: Floats = np.arctan2(leg[:, 1], leg[:, 0])
    return angles


def heading_onward(path: PiecewiseCubic, distance: float) -> float:
    """The way on from where a robot stands [rad]: behind a corner or a cusp that is there.

    Args:
        path: What is driven.
        distance: Where it stands along it [m].

    Example:
        >>> from viaspline.curve.cardinal import CardinalSpline
        >>> back = CardinalSpline([(0, 0), (10, 0), (4, 0)])
        >>> cusp = float(corners(back)[0][0])
        >>> heading_onward(back, cusp - 0.1), round(abs(heading_onward(back, cusp)), 6)
        (0.0, 3.141593)
    """
    behind = min(distance + 2.0 * SAME_DISTANCE_M, float(path.length))
    return float(path.heading(float(path.parameter(behind))))


def turns_where_it_stands(model: DriveModel) -> bool:
    """Whether a drive turns on the spot to look along its path."""
    return model.actuators.wheelbase <= 0.0 and math.isnan(model.actuators.held_heading)


def turns_on(path: PiecewiseCubic, turning: SpotTurning) -> tuple[float, ...]:
    """Distances along a path at which a robot turns on the spot [m], in order.

    Args:
        path: What is driven.
        turning: How the robot turns on the spot.

    Example:
        >>> right, up = [[0, 0], [1, 0], [2, 0], [3, 0]], [[3, 0], [3, 1], [3, 2], [3, 3]]
        >>> [round(at, 6) for at in turns_on(PiecewiseCubic([right, up]), SpotTurning(rate=1.0))]
        [3.0]
    """
    return () if turning == SpotTurning() else tuple(corners(path)[0].tolist())


def with_turns(
    path: PiecewiseCubic, turning: SpotTurning, stations: Sequence[Station], start: float = 0.0
) -> list[Station]:
    """Stations with one for every corner ahead, at which the robot stays until it has turned.

    Args:
        path: What is driven.
        turning: How the robot turns on the spot.
        stations: Stops that there are anyway; they are kept.
        start: Corners up to this distance along the path are left out [m].
    """
    stops = list(stations)
    if turning == SpotTurning():
        return stops
    for at, angle in zip(*corners(path), strict=True):
        if at <= start + SAME_DISTANCE_M:
            continue
        needed = turning.time(float(angle))
        stays = sum(
            stop.dwell for stop in stops if math.isclose(stop.distance, at, abs_tol=SAME_DISTANCE_M)
        )
        if needed > stays:
            stops.append(Station(float(at), needed - stays, TURN))
    return sorted(stops, key=lambda stop: stop.distance)
